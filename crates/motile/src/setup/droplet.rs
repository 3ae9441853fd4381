//! Descriptions of droplets.

use std::f64::consts::PI;

use active_interface::{ContractileTension, Cortex, Curve, Exchange, ExcludedVolume, Flux, InterfaceError, Motion};
use motile_base::Vec2;
use serde::{Deserialize, Serialize};

use super::{
    FieldsSetup, GelSetup, Method, MethodKind, NoiseSetup, OutlineOrigin, OutlineSetup, Setup,
    body::{BodySetup, Planned},
    checked::Checked,
    method::MARKERS,
};
use crate::SetupError;

/// A droplet: a closed fluid interface with its own tension and, unless it is passive, active particles.
///
/// ```
/// use motile::prelude::*;
///
/// let strong = DropletSetup { centre: [1.0, 0.0], angle: 0.3, ..DropletSetup::active(-4.0) };
/// let drop_of_oil = DropletSetup { viscosity: Some(10.0), ..DropletSetup::passive(10.0) };
/// assert_eq!((strong.tension, drop_of_oil.particles), (10.0, None));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("drop", "swimmer", "microswimmer", "cell", "squirmer"))]
pub struct DropletSetup {
    /// Name for messages.
    pub name: String,
    /// Position of the centre (length); regions are centred on the origin.
    pub centre: [f64; 2],
    /// Direction of swimming at the start (radians from the x axis), by which the shape is turned.
    pub angle: f64,
    /// Centre in three dimensions (length), in place of `centre`. The scene is then computed without symmetry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<[f64; 3]>,
    /// Direction of swimming at the start in three dimensions, a vector of any length, in place of `angle`. The scene
    /// is then computed without symmetry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heading: Option<[f64; 3]>,
    /// Viscosity of the droplet (stress times time); `None` for the viscosity of the fluid around it.
    #[doc(alias("viscosity ratio", "viscosity contrast"))]
    pub viscosity: Option<f64>,
    /// Tension gamma0 of the interface without particles (force).
    #[doc(alias("surface tension"))]
    pub tension: f64,
    /// Bending modulus B of the interface (force times length squared), whose energy is
    /// `B/2 INT (kappa - kappa0)^2 ds`.
    pub bending: f64,
    /// Curvature kappa0 (1/length; positive for a circle) at which bending is at rest.
    pub reference_curvature: f64,
    /// Viscosity of the cortex, which resists stretching of the interface.
    pub cortex: Cortex,
    /// Friction xi of the interface with a substrate, of the force `-xi v` per length (force times time per length
    /// squared), v the velocity of the fluid on it.
    pub friction: f64,
    /// Viscosity of the film between the interface and the straight walls of a channel (stress times time). Its
    /// thickness is the distance d to each wall. The force `-wall-friction v/d` per length resists the velocity v along
    /// the interface.
    pub wall_friction: f64,
    /// Force on the fluid inside per area (force per length squared), in three dimensions per volume. For example, it
    /// is the weight: density minus density of the fluid around it, times g. In the plane it is refused, because
    /// nothing holds a fluid that is pushed.
    #[doc(alias("gravity", "buoyancy", "sedimentation"))]
    pub body_force: [f64; 2],
    /// Force on the fluid inside in all (force), uniform over its area. It adds to `body_force`. In the plane, the
    /// forces on all bodies have to add up to zero.
    pub force: [f64; 2],
    /// Motion of the markers along the interface; across it they move with the fluid.
    pub motion: Motion,
    /// Area restored to the initial one after each step.
    pub area_constraint: bool,
    /// Shape at the start.
    pub shape: DropletShape,
    /// Permission for a round droplet that is too wide for its channel or tube to start squeezed between the walls.
    /// Without it, such a droplet is refused.
    pub squeezed: bool,
    /// The active particles on the interface; `None` for a passive droplet, in a file `particles = "none"`.
    #[serde(with = "super::particles_entry")]
    pub particles: Option<Particles>,
    /// Fields in the laboratory that it feels.
    #[serde(skip_serializing_if = "FieldsSetup::is_none")]
    pub fields: FieldsSetup,
    /// The gel that fills it, if there is one.
    pub gel: Option<GelSetup>,
}

impl Default for DropletSetup {
    /// Creates an active droplet of activity -2 and radius 1 in the origin.
    fn default() -> Self {
        Self {
            name: "droplet".to_owned(),
            centre: [0.0, 0.0],
            angle: 0.0,
            position: None,
            heading: None,
            viscosity: None,
            tension: 10.0,
            bending: 0.0,
            reference_curvature: 0.0,
            cortex: Cortex::default(),
            friction: 0.0,
            wall_friction: 0.0,
            body_force: [0.0; 2],
            force: [0.0; 2],
            motion: Motion::default(),
            area_constraint: false,
            shape: DropletShape::default(),
            squeezed: false,
            particles: Some(Particles::default()),
            fields: FieldsSetup::default(),
            gel: None,
        }
    }
}

impl DropletSetup {
    /// Creates the default droplet with this activity zeta delta-mu (force times length; negative if contractile).
    #[must_use]
    pub fn active(activity: f64) -> Self {
        Self { particles: Some(Particles { activity, ..Particles::default() }), ..Self::default() }
    }

    /// Creates the default droplet with this activity and this strength A of the step-like excluded volume (both force
    /// times length).
    #[must_use]
    pub fn contractile(activity: f64, excluded_volume: f64) -> Self {
        let excluded_volume = ExcludedVolume::Step(excluded_volume);
        Self { particles: Some(Particles { activity, excluded_volume, ..Particles::default() }), ..Self::default() }
    }

    /// Creates a droplet without particles, of constant tension (force).
    #[must_use]
    pub fn passive(tension: f64) -> Self {
        Self { tension, particles: None, ..Self::default() }
    }

    /// Creates the default droplet by Cowley's method: markers that move with the fluid and are inserted and removed,
    /// an area constraint. Where Cowley leaves the choice open, this uses a first-order upwind flux, and implicit
    /// diffusion as by default.
    #[must_use]
    pub fn thesis() -> Self {
        Self {
            motion: Motion::WithFluid,
            area_constraint: true,
            particles: Some(Particles { flux: Flux::Upwind, ..Particles::default() }),
            ..Self::default()
        }
    }

    /// Returns the droplet as a circle of that radius R (length), all else as it was.
    ///
    /// The concentration c0 of the particles stays, so that their number, 2 pi R c0, grows with R. Below a threshold a
    /// round droplet does not swim: |activity| has to exceed `2 D (eta_in + eta_ext) / (R c0)`, Cowley (2.20), which a
    /// large droplet does at less activity (without the effect of the excluded volume, which matters near 2 c0 only).
    /// The region does not grow with the droplet, and on a grid the spacing does not.
    ///
    /// ```
    /// use motile::active_interface::theory::{LinearTheory, RoundDroplet};
    /// use motile::prelude::*;
    ///
    /// let droplet = DropletSetup::active(-0.3).with_radius(2.0);
    /// let (viscosity_inside, viscosity_outside) = (100.0, 100.0);
    /// let (radius, tension, activity, concentration, diffusivity) = (2.0, 40.0, -0.3, 100.0, 0.1);
    /// let round =
    ///     RoundDroplet { radius, viscosity_inside, viscosity_outside, tension, activity, concentration, diffusivity };
    /// // -0.4 for a radius of 1.
    /// assert!((LinearTheory::new(round)?.activity_threshold() + 0.2).abs() < 1e-12);
    /// let setup = Setup { region: Region::Plane, droplets: vec![droplet], ..Setup::default() };
    /// let Built { scene, droplets, .. } = setup.build()?;
    /// let number = scene.body(droplets[0])?.particle_numbers().iter().sum::<f64>();
    /// assert!((number / (std::f64::consts::TAU * 2.0 * 100.0) - 1.0).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_radius(self, radius: f64) -> Self {
        Self { shape: DropletShape::Round { radius }, ..self }
    }

    /// Returns the activity zeta delta-mu (force times length); 0 without particles.
    #[must_use]
    pub fn activity(&self) -> f64 {
        self.particles.map_or(0.0, |particles| particles.activity)
    }
}

/// Active particles on an interface. They raise its tension: `gamma = gamma0 - zeta_dmu c - Pi(c)`, Cowley (2.39).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("surfactant", "motors", "myosin", "concentration"))]
pub struct Particles {
    /// Activity zeta delta-mu (force times length; in three dimensions force times length squared), negative if
    /// contractile. Forces are line tensions.
    pub activity: f64,
    /// Excluded volume Pi(c), which keeps the particles from collapsing to a point.
    pub excluded_volume: ExcludedVolume,
    /// Diffusion constant along the interface (length squared per time).
    pub diffusion: f64,
    /// Mean concentration c0 at the start (1/length; in three dimensions 1/length squared).
    pub concentration: f64,
    /// Spread over the interface at the start.
    pub start: Start,
    /// Flux that carries them from element to element; with [`Flux::Upwind`] speeds are about 3 to 7 % too high.
    pub flux: Flux,
    /// Their exchange with the inside of the droplet; `None` for particles that stay on the interface.
    pub exchange: Option<ExchangeSetup>,
    /// Noise on them; `None` for none.
    pub noise: Option<NoiseSetup>,
}

impl Default for Particles {
    fn default() -> Self {
        Self {
            activity: -2.0,
            excluded_volume: ExcludedVolume::Step(10.0),
            diffusion: 0.1,
            concentration: 100.0,
            start: Start::Polarised,
            flux: Flux::Weno5,
            exchange: None,
            noise: None,
        }
    }
}

impl Particles {
    /// Returns the law of the tension with these particles on an interface of the tension gamma0 (force).
    ///
    /// # Errors
    /// Returns an error for a negative tension, values that are out of their range.
    pub fn law(&self, tension: f64) -> Result<ContractileTension, InterfaceError> {
        ContractileTension::new(tension, self.activity, self.excluded_volume, self.concentration)
    }

    /// Refuses values out of their range, except in the exchange with an inside.
    pub(super) fn check(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        checked.finite("particles.activity", self.activity)?;
        checked.not_negative("particles.diffusion", self.diffusion)?;
        checked.positive("particles.concentration", self.concentration)?;
        let (key, tension) = ("particles.activity", self.activity * self.concentration);
        let remedy = "the tension at the mean concentration would not be finite. Use a smaller number";
        checked.require(tension.is_finite(), key, self.activity, remedy)?;
        match self.excluded_volume {
            ExcludedVolume::Step(strength) => checked.not_negative("particles.excluded-volume.step", strength)?,
            ExcludedVolume::Quadratic(strength) => {
                checked.not_negative("particles.excluded-volume.quadratic", strength)?;
            }
            other => other.check().map_err(|error| SetupError::from(error).of("particles.excluded-volume"))?,
        }
        self.noise.map_or(Ok(()), |noise| noise.check(checked, self))?;
        let Start::Perturbed { amplitude, .. } = self.start else { return Ok(()) };
        let (key, holds) = ("particles.start.perturbed.amplitude", (0.0..1.0).contains(&amplitude));
        checked.require(holds, key, amplitude, "use a number from 0 to below 1")
    }
}

/// Exchange of particles with the inside of the droplet: `dc/dt = ... + k_on C - k_off c`, C the density inside, next
/// to the interface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ExchangeSetup {
    /// Rate k_on at which they bind to the interface (length per time).
    pub binding: f64,
    /// Rate k_off at which they unbind (1/time).
    pub unbinding: f64,
    /// Number inside at the start; `None` for as many as are at rest with the concentration on the interface.
    #[serde(default)]
    pub number_inside: Option<f64>,
    /// Their diffusion constant inside (length squared per time), where the flow carries them along too; `None` if they
    /// are well mixed.
    #[serde(default)]
    pub diffusion_inside: Option<f64>,
    /// Spacing of the mesh for them (length); `None` for the spacing of the grid, or without a grid the distance of
    /// five markers, at most a tenth of the radius.
    #[serde(default)]
    pub spacing_inside: Option<f64>,
}

impl ExchangeSetup {
    /// Creates the exchange with a well-mixed inside that is at rest with the interface at the start, from the rates of
    /// binding (length per time) and unbinding (1/time).
    #[must_use]
    pub fn new(binding: f64, unbinding: f64) -> Self {
        Self { binding, unbinding, number_inside: None, diffusion_inside: None, spacing_inside: None }
    }

    /// Returns the rates.
    pub(super) fn rates(&self) -> Result<Exchange, InterfaceError> {
        Exchange::new(self.binding, self.unbinding)
    }

    /// Returns the number inside at the start of a droplet of that concentration and area, which has been checked to
    /// exist.
    pub(super) fn number(&self, concentration: f64, area: f64) -> Result<f64, InterfaceError> {
        let density = self.rates()?.concentration_at_rest(concentration);
        Ok(self.number_inside.or_else(|| density.map(|density| density * area)).unwrap_or(0.0))
    }
}

/// Spread of the particles over the interface at the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Start {
    /// `(1 - cos(theta - angle)) c0`: crowded at the rear of a droplet that swims at `angle`, Cowley (2.46).
    Polarised,
    /// c0 everywhere.
    Uniform,
    /// Uniform with small random Fourier modes; in three dimensions with the parts of them that are symmetric about the
    /// axis.
    Perturbed {
        /// Relative amplitude.
        amplitude: f64,
        /// Seed of the random modes; equal seeds give equal droplets.
        seed: u64,
    },
}

/// The shape of a droplet at the start, about its centre.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", rename_all_fields = "kebab-case")]
#[non_exhaustive]
pub enum DropletShape {
    /// A circle. If it touches the walls on both sides, it starts as an ellipse, or between elastic walls as a stadium.
    /// This shape leaves a film of a twentieth of the radius, and has the area and the particles of the circle. If it
    /// is wider, it is refused, unless it is [`DropletSetup::squeezed`] to such a shape. With a gap, however narrow, it
    /// stays a circle. In a tube, a sphere, which starts as a spheroid of its volume there. [`Setup::shape`] returns
    /// the shape at the start.
    Round {
        /// Radius of the circle (length).
        radius: f64,
    },
    /// A circle squeezed along y, with its area and its particles, in three dimensions a sphere squeezed around the
    /// axis, with its volume and its particles; the angle turns the particles alone.
    Squeezed {
        /// Radius of the circle (length).
        radius: f64,
        /// Half of its extent in y (length), below the radius.
        half_height: f64,
        /// Shape that it becomes.
        to: Squeezed,
    },
    /// An ellipse.
    Ellipse {
        /// Half axes along and across the angle (length).
        half_axes: [f64; 2],
    },
    /// `r(theta) = R (1 + sum_k a_k cos(k theta) + b_k sin(k theta))`, k from 1.
    Modes {
        /// Mean radius R (length).
        radius: f64,
        /// Amplitudes a_k (no dimension).
        cosines: Vec<f64>,
        /// Amplitudes b_k (no dimension).
        #[serde(default)]
        sines: Vec<f64>,
    },
    /// The smooth closed curve through points (length), which stays near their polygon
    /// ([`Curve::through_points`], [`Setup::distances_from_points`]).
    Points(Vec<[f64; 2]>),
    /// An outline from a file or from points: the smooth curve through them, a smoother one that passes them at a
    /// stated distance, or a polygon with rounded corners.
    Outline(OutlineSetup),
}

/// Shape of a squeezed circle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Squeezed {
    /// An ellipse.
    Ellipse,
    /// Two half circles with straight sides between them.
    Stadium,
}

impl Default for DropletShape {
    fn default() -> Self {
        Self::Round { radius: 1.0 }
    }
}

impl DropletShape {
    /// Returns the curve about the origin before it is turned, whether it is to be turned, and the circle that
    /// particles are spread on where that is another curve.
    pub(super) fn curve(&self) -> Result<(Curve, bool, Option<f64>), SetupError> {
        Ok(match self {
            &Self::Round { radius } => (Curve::circle(radius)?, true, None),
            &Self::Squeezed { radius, half_height, to } => {
                let curve = match to {
                    Squeezed::Ellipse => Curve::ellipse(radius * radius / half_height, half_height)?,
                    Squeezed::Stadium => Curve::stadium(straight(radius, half_height), half_height)?,
                };
                (curve, false, Some(radius))
            }
            Self::Ellipse { half_axes: [along, across] } => (Curve::ellipse(*along, *across)?, true, None),
            Self::Modes { radius, cosines, sines } => (Curve::fourier(*radius, cosines, sines)?, true, None),
            Self::Points(points) => {
                let points: Vec<Vec2> = points.iter().map(|&[x, y]| Vec2::new(x, y)).collect();
                (Curve::through_points(&points)?, true, None)
            }
            Self::Outline(outline) => (outline.curve(OutlineOrigin::Centroid)?, true, None),
        })
    }
}

/// Returns the meridian of a squeezed sphere with its mirror image, a spheroid or a cylinder with round ends of the
/// volume of the sphere, and the area of the sphere over the area of its surface.
pub(super) fn squeezed_sphere(radius: f64, half: f64, to: Squeezed) -> Result<(Curve, f64), InterfaceError> {
    let sphere = 4.0 * PI * radius * radius;
    Ok(match to {
        Squeezed::Ellipse => {
            let along = radius.powi(3) / (half * half);
            let eccentricity = (1.0 - (half / along).powi(2)).sqrt();
            let around = if eccentricity > 0.0 { eccentricity.asin() / eccentricity } else { 1.0 };
            let area = 2.0 * PI * half * (half + along * around);
            (Curve::ellipse(along, half)?, sphere / area)
        }
        Squeezed::Stadium => {
            let straight = 2.0 / 3.0 * (radius.powi(3) / (half * half) - half);
            (Curve::stadium(straight, half)?, sphere / (4.0 * PI * half * (half + straight)))
        }
    })
}

/// Half the length of the straight sides of the stadium with ends of radius `half` (length) that has the area of a
/// circle.
fn straight(radius: f64, half: f64) -> f64 {
    0.25 * PI * (radius * radius - half * half) / half
}

impl DropletSetup {
    /// Returns true if fields or forces act on the droplet, whose speed is then known as precisely as its outline.
    pub(super) fn is_pushed(&self) -> bool {
        !self.fields.is_none() || [self.body_force, self.force] != [[0.0; 2]; 2]
    }
}

impl BodySetup for DropletSetup {
    fn kind(&self) -> [&'static str; 2] {
        ["droplets", "droplet"]
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn needs(&self) -> Option<(&'static str, &'static [MethodKind])> {
        self.gel.map(|_| ("gels", &[MethodKind::Layers, MethodKind::Grid][..]))
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let made = setup.droplet(self)?;
        // Droplets of the same seed have noise of their own.
        let number = setup.droplets.iter().position(|droplet| std::ptr::eq(droplet, self)).unwrap_or(0);
        Ok(Planned::of(match made.noise() {
            Some(noise) => made.with_noise(noise.with_stream(number as u64))?,
            None => made,
        }))
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        let unused = [("position", "centre", self.position), ("heading", "angle", self.heading)];
        for (key, other, value) in unused {
            let remedy = format!("three numbers need a region in three dimensions. Use {other} in this region");
            checked.refuse_if(value.is_some(), key, format!("{:?}", value.unwrap_or_default()), remedy)?;
        }
        checked.positive("viscosity", self.viscosity)?;
        checked.not_negative("tension", self.tension)?;
        checked.not_negative("bending", self.bending)?;
        checked.finite("reference-curvature", self.reference_curvature)?;
        checked.all_finite("body-force", &self.body_force)?;
        checked.all_finite("force", &self.force)?;
        setup.check_body_force(checked, self.body_force)?;
        let remedy = "bending stiffness exists in two dimensions only. Remove the key";
        let plane = self.bending == 0.0 || !setup.region.is_axisymmetric();
        checked.require(plane, "bending", self.bending, remedy)?;
        check_resistance(self.cortex, [self.friction, self.wall_friction], self.particles.is_some(), checked, setup)?;
        let carried = self.motion == Motion::WithFluid;
        if !self.cortex.is_none()
            && let Method::Grid(grid) = &setup.method
        {
            let remedy = "a cortex needs the mobility correction on a grid, without it speeds are off by several per \
                          cent. Use true, or the method layers or integral";
            Checked { place: "method.grid" }.refuse_if(!grid.corrected, "corrected", false, remedy)?;
            let remedy = "a cortex on a grid needs equally spaced markers. Use equidistributed";
            checked.refuse_if(carried, "motion", "with-fluid", remedy)?;
        }
        let remedy = "bending needs a fixed number of markers. Use equidistributed";
        checked.refuse_if(self.bending > 0.0 && carried, "motion", "with-fluid", remedy)?;
        if let Motion::Equidistributed { relaxation, .. } = self.motion {
            checked.not_negative("motion.equidistributed.relaxation", relaxation)?;
        }
        self.shape.check(checked, "shape")?;
        self.gel.map_or(Ok(()), |gel| gel.check(checked, self))?;
        self.fields.check(checked, self.particles.as_ref(), setup)?;
        let Some(particles) = &self.particles else { return Ok(()) };
        particles.check(checked)?;
        if let Some(ExchangeSetup { binding, unbinding, number_inside, diffusion_inside, spacing_inside }) =
            particles.exchange
        {
            checked.not_negative("particles.exchange.binding", binding)?;
            checked.not_negative("particles.exchange.unbinding", unbinding)?;
            checked.positive("particles.exchange.diffusion-inside", diffusion_inside)?;
            checked.positive("particles.exchange.spacing-inside", spacing_inside)?;
            let remedy = "a droplet with a mesh inside needs a fixed number of markers. Use equidistributed";
            checked.refuse_if(diffusion_inside.is_some() && carried, "motion", "with-fluid", remedy)?;
            checked.not_negative("particles.exchange.number-inside", number_inside)?;
            let rests = number_inside.is_some() || binding > 0.0 || unbinding == 0.0;
            let remedy = "nothing that unbinds comes back, so the number inside has no steady value. Set it";
            checked.require(rests, "particles.exchange.binding", binding, remedy)?;
        }
        Ok(())
    }
}

impl DropletShape {
    /// Checks the numbers of a shape under that key.
    pub(super) fn check(&self, checked: &Checked<'_>, at: &str) -> Result<(), SetupError> {
        let key = |name: &str| format!("{at}.{name}");
        match self {
            Self::Round { radius } => checked.positive(&key("round.radius"), *radius),
            Self::Squeezed { radius, half_height, .. } => {
                checked.positive(&key("squeezed.radius"), *radius)?;
                let (key, remedy) = (
                    key("squeezed.half-height"),
                    "a squeezed circle is less high than round. Use a number below the radius",
                );
                checked.positive(&key, *half_height)?;
                checked.require(half_height <= radius, &key, *half_height, remedy)
            }
            Self::Ellipse { half_axes } => {
                half_axes.iter().try_for_each(|&axis| checked.positive(&key("ellipse.half-axes"), axis))
            }
            Self::Modes { radius, cosines, sines } => {
                checked.positive(&key("modes.radius"), *radius)?;
                checked.amplitudes(&key("modes.cosines"), cosines)?;
                checked.amplitudes(&key("modes.sines"), sines)
            }
            Self::Points(points) => check_points(points, checked, &key("points")),
            Self::Outline(outline) => outline.check(checked, &key("outline"), false),
        }
    }
}

/// Refuses a cortex and friction of an interface, with particles or without, that cannot be.
pub(super) fn check_resistance(
    cortex: Cortex,
    [friction, wall_friction]: [f64; 2],
    carries: bool,
    checked: &Checked<'_>,
    setup: &Setup,
) -> Result<(), SetupError> {
    let Cortex { viscosity, per_concentration, shear_viscosity, inextensible } = cortex;
    checked.not_negative("cortex.viscosity", viscosity)?;
    checked.not_negative("cortex.per-concentration", per_concentration)?;
    checked.not_negative("cortex.shear-viscosity", shear_viscosity)?;
    checked.not_negative("friction", friction)?;
    let remedy = "there are no particles on this interface. Use 0, or set the viscosity";
    checked.require(carries || per_concentration == 0.0, "cortex.per-concentration", per_concentration, remedy)?;
    let plane = !setup.region.is_axisymmetric();
    let remedy = "a membrane that does not stretch exists in two dimensions only. Remove the key";
    checked.refuse_if(!plane && inextensible, "cortex.inextensible", true, remedy)?;
    let remedy = "on a grid, a membrane that does not stretch is not resolved. Use the method integral or layers";
    let grid = matches!(setup.method, Method::Grid(_));
    checked.refuse_if(grid && inextensible, "cortex.inextensible", true, remedy)?;
    let remedy = "a line in two dimensions has no shear along itself. Remove the key, or use the region space or tube";
    checked.require(!plane || shear_viscosity == 0.0, "cortex.shear-viscosity", shear_viscosity, remedy)?;
    let remedy = "friction with a substrate exists in two dimensions only. Remove the key";
    checked.require(plane || friction == 0.0, "friction", friction, remedy)?;
    checked.not_negative("wall-friction", wall_friction)?;
    if wall_friction > 0.0 {
        let remedy = "it needs the straight walls of a channel, at rest. Use region.channel, or remove the key";
        let straight = setup.region.drive().is_some() && setup.walls.is_empty() && setup.flow.wall_velocity.is_none();
        checked.require(plane && straight, "wall-friction", wall_friction, remedy)?;
    }
    Ok(())
}

/// Refuses points of a shape under that key.
pub(super) fn check_points(points: &[[f64; 2]], checked: &Checked<'_>, key: &str) -> Result<(), SetupError> {
    let remedy = format!("use from {} to {} points", MARKERS[0], MARKERS[1]);
    let wrong = points.len() < 8 || points.len() as f64 > MARKERS[1];
    checked.refuse_if(wrong, key, format!("{} points", points.len()), remedy)?;
    checked.all_points_finite(key, points)
}
