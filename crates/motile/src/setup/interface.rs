//! Descriptions of interfaces that are periodic along x.

use std::f64::consts::TAU;

use active_interface::{ActiveInterface, Cortex, InitialConcentration, Motion, line_through, wave};
use motile_base::{Drive, Region, Vec2};
use motile_scene::{Body, Scene, gap::Boundary};
use serde::{Deserialize, Serialize};

use super::{
    AnyFlow, FieldsSetup, GelSetup, MethodKind, OutlineOrigin, OutlineSetup, Particles, Setup, Start,
    body::{BodySetup, Planned},
    checked::Checked,
    droplet::{check_points, check_resistance},
    strays::points_along,
};
use crate::SetupError;

/// An interface that is periodic along x over the whole length of a box or a channel, with its own tension and, unless
/// it is passive, active particles. It is the active boundary of section 5.2.2.3.1 of Cowley.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::{InterfaceSetup, Side};
///
/// // A layer of fluid between two active interfaces in a channel.
/// let setup = Setup {
///     region: Region::Channel { length: 6.0, width: 6.0, drive: Drive::ZeroGradient },
///     method: Method::Integral(IntegralMethod { nodes: 32, elements: 64 }),
///     interfaces: vec![
///         InterfaceSetup { height: -1.0, inside: Side::Below, ..InterfaceSetup::active(-0.5) },
///         InterfaceSetup { height: 1.0, ..InterfaceSetup::active(-0.5) },
///     ],
///     droplets: Vec::new(),
///     ..Setup::default()
/// };
/// let Built { mut scene, interfaces, .. } = setup.build()?;
/// scene.run(1.0).go()?;
/// let seen = scene.observe(interfaces[1])?;
/// println!("height {:.6}, {:.3} particles", seen.height, seen.particle_number);
/// assert!((seen.height - 1.0).abs() < 1e-9 && (seen.particle_number - 600.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct InterfaceSetup {
    /// Name for messages.
    pub name: String,
    /// Mean height (length); regions are centred on the origin.
    pub height: f64,
    /// Side of the interface on which its inside lies.
    pub inside: Side,
    /// Viscosity of the fluid inside (stress times time); `None` for the viscosity of the fluid on the other side.
    pub viscosity: Option<f64>,
    /// Tension gamma0 of the interface without particles (force).
    pub tension: f64,
    /// Viscosity of the cortex, which resists stretching of the interface.
    pub cortex: Cortex,
    /// Friction xi of the interface with a substrate, of the force `-xi v` per length (force times time per length
    /// squared), v the velocity of the fluid on it.
    pub friction: f64,
    /// Viscosity of the film between the interface and the straight walls of a channel (stress times time), see
    /// [`crate::setup::DropletSetup::wall_friction`].
    pub wall_friction: f64,
    /// Motion of the markers along the interface; across it they move with the fluid.
    pub motion: Motion,
    /// Area between the interface and a horizontal line restored to the initial one after each step.
    pub area_constraint: bool,
    /// Shape at the start.
    pub shape: InterfaceShape,
    /// Elasticity along it, at rest in the shape at the start; `None` for a fluid interface. It needs markers that move
    /// with the fluid.
    pub elasticity: Option<ElasticitySetup>,
    /// The active particles on the interface; `None` for a passive one, in a file `particles = "none"`. A polarised
    /// start is `(1 - cos(2 pi x/L)) c0`, L the length of the region.
    #[serde(with = "super::particles_entry")]
    pub particles: Option<Particles>,
    /// Fields in the laboratory that it feels.
    #[serde(skip_serializing_if = "FieldsSetup::is_none")]
    pub fields: FieldsSetup,
    /// Active polar gel between the interface and the rigid wall on its inside, with the method
    /// [`crate::setup::Method::Layers`]; `None` for fluid.
    pub gel: Option<GelSetup>,
}

/// Number of the first stream of noise of interfaces.
const INTERFACES: u64 = 1 << 32;

/// Elasticity of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ElasticitySetup {
    /// Modulus of stretching (force).
    pub stretching: f64,
    /// Modulus of bending (force times length squared).
    #[serde(default)]
    pub bending: f64,
}

/// Side of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Above it.
    #[default]
    Above,
    /// Below it.
    Below,
}

/// The shape of an interface at the start, about its height.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum InterfaceShape {
    /// Flat.
    #[default]
    Flat,
    /// `y = sum_k a_k cos(2 pi k x/L) + b_k sin(2 pi k x/L)`, k from 1, L the length of the region.
    Waves {
        /// Amplitudes a_k (length).
        cosines: Vec<f64>,
        /// Amplitudes b_k (length).
        #[serde(default)]
        sines: Vec<f64>,
    },
    /// The smooth curve through points of one period (length), along x or against it, near their polygon; the next
    /// image of the first follows the last.
    Points(Vec<[f64; 2]>),
    /// A line of one period from a file or from points, through its points or smoother.
    Line(OutlineSetup),
}

impl Default for InterfaceSetup {
    /// Creates a flat interface of activity -2 in the middle, its inside above.
    fn default() -> Self {
        Self {
            name: "interface".to_owned(),
            height: 0.0,
            inside: Side::default(),
            viscosity: None,
            tension: 10.0,
            cortex: Cortex::default(),
            friction: 0.0,
            wall_friction: 0.0,
            motion: Motion::default(),
            area_constraint: true,
            shape: InterfaceShape::default(),
            elasticity: None,
            particles: Some(Particles::default()),
            fields: FieldsSetup::default(),
            gel: None,
        }
    }
}

impl InterfaceSetup {
    /// Creates the default interface with this activity zeta delta-mu (force times length; negative if contractile).
    #[must_use]
    pub fn active(activity: f64) -> Self {
        Self { particles: Some(Particles { activity, ..Particles::default() }), ..Self::default() }
    }

    /// Creates an interface without particles, of constant tension (force).
    #[must_use]
    pub fn passive(tension: f64) -> Self {
        Self { tension, particles: None, ..Self::default() }
    }

    fn markers(&self, advance: f64, count: usize) -> Result<Vec<Vec2>, SetupError> {
        Ok(match &self.shape {
            InterfaceShape::Flat => wave(self.height, advance, &[], &[], count)?,
            InterfaceShape::Waves { cosines, sines } => wave(self.height, advance, cosines, sines, count)?,
            InterfaceShape::Points(points) => {
                let up = Vec2::new(0.0, self.height);
                let points: Vec<Vec2> = points_along(points, advance).into_iter().map(|point| point + up).collect();
                line_through(&points, advance, count)?
            }
            InterfaceShape::Line(outline) => {
                let up = Vec2::new(0.0, self.height);
                let mut points = outline.prepared(Some(advance.abs()), OutlineOrigin::File)?.points;
                if advance < 0.0 {
                    points.reverse();
                }
                points.iter_mut().for_each(|point| *point += up);
                line_through(&points, advance, count)?
            }
        })
    }
}

impl Setup {
    /// Returns an interface of this scene, for scenes that are put together by hand.
    ///
    /// # Errors
    /// Returns an error for parameters out of their range.
    pub fn interface(&self, interface: &InterfaceSetup) -> Result<ActiveInterface, SetupError> {
        let [length, _] = self.region.lengths();
        let advance = if interface.inside == Side::Above { length } else { -length };
        let count = match self.method.resolution() {
            Ok([nodes, elements]) => {
                // As many to a mode as `membrane_count` gives a shell.
                let least = if interface.elasticity.is_some() { nodes + nodes.div_ceil(2) } else { nodes };
                least.max(elements)
            }
            Err(grid) => (length / grid.marker_spacing.unwrap_or(0.5 * grid.spacing)).ceil() as usize,
        };
        let markers = interface.markers(advance, count)?;
        let made = match &interface.particles {
            None => ActiveInterface::periodic_passive(&markers, advance, interface.tension)?,
            Some(particles) => {
                let c0 = particles.concentration;
                let initial = match particles.start {
                    Start::Polarised => {
                        InitialConcentration::by_arc_fraction(move |s| c0 * (1.0 - (TAU * (s - 0.5)).cos()))
                    }
                    Start::Uniform => InitialConcentration::uniform(c0)?,
                    Start::Perturbed { amplitude, seed } => InitialConcentration::perturbed(c0, amplitude, seed)?,
                };
                let numbers = initial.particle_numbers_over(&markers, advance)?;
                let law = particles.law(interface.tension)?;
                let made = ActiveInterface::periodic(&markers, advance, numbers, law, particles.diffusion)?;
                made.with_flux(particles.flux)
            }
        };
        let made = made.with_name(&interface.name).with_motion(interface.motion);
        let mut made = made.with_area_constraint(interface.area_constraint);
        if let Some(ElasticitySetup { stretching, bending }) = interface.elasticity {
            made = made.with_elasticity(stretching, bending)?;
        }
        if !interface.fields.is_none() {
            made = made.with_fields(interface.fields.fields(self.region.periods())?)?;
        }
        if let Some(noise) = interface.particles.and_then(|particles| particles.noise) {
            let number = self.interfaces.iter().position(|other| std::ptr::eq(other, interface)).unwrap_or(0);
            // Beyond all droplets.
            made = made.with_noise(noise.noise()?.with_stream(INTERFACES + number as u64))?;
        }
        let made = made.with_cortex(interface.cortex)?.with_friction(interface.friction)?;
        let made = made.with_wall_friction(interface.wall_friction)?;
        Ok(match interface.viscosity {
            Some(inside) => made.with_viscosity_inside(inside)?,
            None => made,
        })
    }
}

impl BodySetup for InterfaceSetup {
    fn kind(&self) -> [&'static str; 2] {
        ["interfaces", "interface"]
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn needs(&self) -> Option<(&'static str, &'static [MethodKind])> {
        match self.gel {
            Some(_) => Some(("gels behind interfaces", &[MethodKind::Layers])),
            None => Some(("interfaces across the period", &[MethodKind::Integral, MethodKind::Layers])),
        }
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let body = setup.interface(self)?;
        if let Region::Channel { length, width, .. } | Region::SlipChannel { length, width, .. } = setup.region
            && body.markers().iter().any(|marker| marker.y.abs() >= 0.5 * width)
        {
            return Err(SetupError::NoRoom { length, width, hint: String::new() });
        }
        let boundary = Boundary::of(&body, setup.region.periods());
        let kind = body.kind();
        let add = |scene: &mut Scene<AnyFlow>| {
            scene.add(body);
            Ok(())
        };
        Ok(Planned { boundary, kind, corners: Vec::new(), add: Box::new(add) })
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        let remedy = "such an interface repeats along x, so the region must be periodic. Use a box or a channel";
        Checked { place: "" }.refuse_if(setup.region == Region::Plane, "region", "plane", remedy)?;
        if let (Region::Box { .. }, true) = (setup.region, setup.flow.shear != 0.0) {
            let remedy = "the images of an interface across the period of a sheared box slide past each other, which \
                          is not computed. Use a channel with wall-velocity";
            return Checked { place: "flow" }.refuse("shear", &setup.flow.shear, remedy);
        }
        checked.finite("height", self.height)?;
        if let Some(viscosity) = self.viscosity {
            checked.positive("viscosity", viscosity)?;
            let flux = setup.region.drive().and_then(Drive::flux);
            if let Some(flux) = flux.filter(|_| viscosity != setup.viscosity) {
                let remedy = "a flux cannot be prescribed along layers of different viscosity. Prescribe a gradient";
                return Checked { place: "region.channel.drive" }.refuse("flux", &flux, remedy);
            }
        }
        checked.not_negative("tension", self.tension)?;
        check_resistance(self.cortex, [self.friction, self.wall_friction], self.particles.is_some(), checked, setup)?;
        if let Motion::Equidistributed { relaxation, .. } = self.motion {
            checked.not_negative("motion.equidistributed.relaxation", relaxation)?;
        }
        if let Some(ElasticitySetup { stretching, bending }) = self.elasticity {
            checked.not_negative("elasticity.stretching", stretching)?;
            checked.not_negative("elasticity.bending", bending)?;
            let remedy = "the points of an elastic interface move with the fluid. Use \"with-fluid\"";
            checked.refuse_if(self.motion != Motion::WithFluid, "motion", "equidistributed", remedy)?;
        }
        match &self.shape {
            InterfaceShape::Flat => {}
            InterfaceShape::Waves { cosines, sines } => {
                checked.amplitudes("shape.waves.cosines", cosines)?;
                checked.amplitudes("shape.waves.sines", sines)?;
            }
            InterfaceShape::Points(points) => check_points(points, checked, "shape.points")?,
            InterfaceShape::Line(outline) => {
                outline.check(checked, "shape.line", false)?;
                let remedy = "an interface is smooth. Remove the key, or use smooth";
                checked.refuse_if(outline.rounding.is_some(), "shape.line.rounding", "given", remedy)?;
            }
        }
        self.gel.map_or(Ok(()), |gel| gel.check_in_layer(checked, self, setup))?;
        self.fields.check(checked, self.particles.as_ref(), setup)?;
        for (name, entries) in [
            ("tension", &self.fields.tension),
            ("activity", &self.fields.activity),
            ("friction", &self.fields.friction),
        ] {
            let steep = entries.iter().position(|entry| entry.gradient.is_some_and(|it| it.slope[0] != 0.0));
            let remedy = "a slope along an interface across the period would jump at its end. Use a wave, or 0";
            let key = format!("fields.{name}[{}].gradient.slope[0]", steep.unwrap_or(0));
            checked.refuse_if(steep.is_some(), &key, "not zero", remedy)?;
        }
        let Some(particles) = &self.particles else { return Ok(()) };
        let remedy = "nothing holds the particles that leave it. Use \"none\", or a droplet";
        checked.refuse_if(particles.exchange.is_some(), "particles.exchange", "given", remedy)?;
        particles.check(checked)
    }
}
