//! Droplets in three dimensions without symmetry.

use std::f64::consts::PI;

use active_interface::{ConstantTension, Cortex, Flux, Motion, internal::SplitMix64};
use motile_base::{Region, TubeShape};
use motile_scene::Scene;
use serde::{Deserialize, Serialize};
use space_droplets::{
    EdgeFollowing, LARGEST_DEGREE, PeriodicBox, Slit, SpaceBody, SpaceDroplet, SpaceDroplets, SpaceFluid, Tube,
};

use super::{
    AnyFlow, Built, DropletSetup, DropletShape, ExcludedVolume, FlowSetup, IntegralMethod, Method, Particles, Setup,
    Start, checked::Checked,
};
use crate::SetupError;

/// Smallest degree of the harmonics.
const LEAST_DEGREE: usize = 2;
/// Largest sine of the angle between a heading and the x axis that is round-off.
const ON_AXIS: f64 = 1e-12;
/// Strength with which parameters follow the edge of the particles, and the time for that (R^2/D).
const EDGE: f64 = 4.0;
const EDGE_TIME: f64 = 0.1;
/// Largest degree of the noise on particles at the start.
const NOISE: usize = 4;

/// Resolution of droplets in three dimensions without symmetry: shapes and concentrations are sums of spherical
/// harmonics ([`space_droplets`]).
///
/// You can choose this method in unbounded fluid in three dimensions and in a straight tube. Scenes use it by
/// themselves if a droplet has a `position` or `heading`, if its `centre` or `angle` is off the axis, or if a flow is
/// imposed. In a slit and in a box in three dimensions, there is no other method. Scenes that are axisymmetric about
/// the x axis use boundary integrals, which are faster.
///
/// ```
/// use motile::prelude::*;
///
/// let droplet = DropletSetup { heading: Some([1.0, 2.0, 2.0]), ..DropletSetup::contractile(-1.0, 2.0) };
/// let setup = Setup {
///     region: Region::Space,
///     method: Method::Harmonics(HarmonicsMethod { degree: 6 }),
///     step: StepSize::Adaptive { tolerance: 1e-3 },
///     droplets: vec![droplet],
///     ..Setup::default()
/// };
/// let Built { mut scene, space: Some(droplets), .. } = setup.build()? else { panic!("no droplets in space") };
/// scene.run(2.0).go()?;
/// let seen = &scene.observe(droplets)?[0];
/// println!("speed {:.3} along {:.3?}", seen.speed, seen.heading);
/// assert!(seen.speed > 0.1 && (seen.heading[1] - 2.0 / 3.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("spherical harmonics", "three dimensions"))]
pub struct HarmonicsMethod {
    /// Degree of the spherical harmonics of each droplet, 2 to 96. 8 to 12 is enough for droplets without sharp
    /// particles; swimmers need 16 to 24. The cost grows with about the fourth power of the degree.
    pub degree: usize,
}

impl Default for HarmonicsMethod {
    fn default() -> Self {
        Self { degree: 16 }
    }
}

impl DropletSetup {
    /// Returns the unit vector along which the droplet heads at the start in three dimensions: along its `heading`, or
    /// at its `angle` to the x axis.
    #[must_use]
    pub fn direction(&self) -> [f64; 3] {
        let [x, y, z] = self.heading.unwrap_or([self.angle.cos(), self.angle.sin(), 0.0]);
        let length = x.hypot(y).hypot(z);
        [x / length, y / length, z / length]
    }

    /// Returns the centre in three dimensions (length): its `position`, or its `centre` with z = 0.
    #[must_use]
    pub fn place(&self) -> [f64; 3] {
        self.position.unwrap_or([self.centre[0], self.centre[1], 0.0])
    }
}

impl Setup {
    /// Returns true if the scene is of droplets in three dimensions without symmetry, which [`HarmonicsMethod`]
    /// computes. These are all scenes in a slit or in a box in three dimensions. In unbounded fluid and in a tube,
    /// these are scenes with this method, or with a droplet or a flow that breaks the symmetry about the x axis.
    #[must_use]
    pub fn lacks_symmetry(&self) -> bool {
        let is_off = |droplet: &DropletSetup| {
            let DropletSetup { position, heading, centre, angle, .. } = droplet;
            position.is_some() || heading.is_some() || centre[1] != 0.0 || angle.sin().abs() > ON_AXIS
        };
        let breaks = || !self.flow.is_none() || self.droplets.iter().any(is_off);
        match self.region {
            Region::Slit { .. } | Region::SpaceBox { .. } => true,
            Region::Space | Region::Tube { .. } => matches!(self.method, Method::Harmonics(_)) || breaks(),
            _ => false,
        }
    }

    /// Returns the degree of the harmonics.
    fn degree(&self) -> Result<usize, SetupError> {
        let top = Checked { place: "" };
        match self.method {
            Method::Harmonics(HarmonicsMethod { degree }) => {
                let remedy = format!("use a number from {LEAST_DEGREE} to {LARGEST_DEGREE}; 16 is a good start");
                let wrong = !(LEAST_DEGREE..=LARGEST_DEGREE).contains(&degree);
                top.refuse_if(wrong, "method.harmonics.degree", degree, remedy)?;
                Ok(degree)
            }
            Method::Integral(method) if method == IntegralMethod::default() => Ok(HarmonicsMethod::default().degree),
            other => {
                let remedy = "without symmetry about an axis, droplets need spherical harmonics. Use \
                              method.harmonics.degree = 16, or put droplets on the x axis, heading along the x axis";
                top.refuse("method", &other.kind().name(), remedy)
            }
        }
    }

    /// Refuses what has no meaning or no method for droplets without symmetry.
    pub(super) fn check_space(&self) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        self.check_surroundings()?;
        self.degree()?;
        let axis = "or use an axisymmetric scene with the method integral";
        let lists = [
            ("solids", self.solids.len()),
            ("rigid-bodies", self.rigid_bodies.len()),
            ("shells", self.shells.len()),
            ("fibres", self.fibres.len()),
            ("gels", self.gels.len()),
            ("walls", self.walls.len()),
            ("interfaces", self.interfaces.len()),
            ("suspension", self.suspension.len()),
        ];
        for (key, count) in lists {
            let remedy = "in three dimensions without symmetry, there are droplets only. Remove them, or use a \
                          two-dimensional region";
            top.refuse_if(count > 0, key, count, remedy)?;
        }
        top.refuse_if(
            self.droplets.is_empty(),
            "droplets",
            "[]",
            "without symmetry, a scene needs a droplet. Add one",
        )?;
        let remedy = format!("spherical harmonics have a degree instead. Remove the key, {axis}");
        top.refuse_if(self.tolerance.is_some(), "tolerance", self.tolerance.unwrap_or_default(), remedy)?;
        let remedy = "friction of the fluid exists in two dimensions only. Use 0";
        top.require(self.friction == 0.0, "friction", self.friction, remedy)?;
        let remedy = "this scene has no mirror symmetry to be held. Remove the key";
        top.refuse_if(self.mirror_symmetric, "mirror-symmetric", true, remedy)?;
        let remedy = "no bound on gaps is kept without symmetry. Remove the key, or use a repulsion";
        top.refuse_if(self.least_gap.is_some(), "least-gap", self.least_gap.unwrap_or_default(), remedy)?;
        self.check_flow_in_space()?;
        self.check_steps()?;
        for (number, droplet) in self.droplets.iter().enumerate() {
            droplet.check_in_space(&Checked { place: &format!("droplets[{number}]") }, axis)?;
        }
        self.check_fits()?;
        self.check_apart()
    }

    /// Refuses walls that cannot be, and tubes that spherical harmonics do not have.
    fn check_surroundings(&self) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        match self.region {
            Region::Tube { radius, shape, drive, length } => {
                top.positive("region.tube.radius", radius)?;
                self.check_tube()?;
                let remedy = "if a droplet is off the axis, the tube is straight and without ends. Remove the shape, \
                              or put all droplets on the x axis, heading along it, with the method integral";
                top.refuse_if(shape != TubeShape::Straight, "region.tube.shape", "given", remedy)?;
                let remedy = "if a droplet is off the axis, a gradient acts over a tube without end, where it is the \
                              gradient without droplets. Remove the length, or prescribe the flux";
                let limited = length.filter(|_| drive.flux().is_none());
                top.refuse_if(limited.is_some(), "region.tube.length", limited.unwrap_or_default(), remedy)
            }
            Region::Slit { lower, upper } => {
                let checked = Checked { place: "region.slit" };
                checked.finite("lower", lower)?;
                checked.finite("upper", upper)?;
                let remedy = format!("it is the height of the upper wall. Use a number above {lower}, the lower one");
                checked.refuse_if(upper <= lower, "upper", upper, remedy)
            }
            Region::SpaceBox { lengths } => {
                let (checked, ratio) = (Checked { place: "region.box" }, PeriodicBox::LARGEST_RATIO);
                for (number, length) in lengths.into_iter().enumerate() {
                    checked.positive(&format!("lengths[{number}]"), length)?;
                }
                let most = lengths.iter().fold(0.0_f64, |most, length| most.max(*length));
                let narrow = lengths.iter().position(|length| most > ratio * length);
                let (key, value) =
                    narrow.map_or(("", 0.0), |k| (["lengths[0]", "lengths[1]", "lengths[2]"][k], lengths[k]));
                let remedy = format!("this is less than a {ratio:.0}th of the longest side. Use a wider box");
                checked.refuse_if(narrow.is_some(), key, value, remedy)
            }
            _ => Ok(()),
        }
    }

    /// Refuses flows that cannot be imposed.
    fn check_flow_in_space(&self) -> Result<(), SetupError> {
        let FlowSetup { shear, extension, rotation, poiseuille, wall_velocity } = self.flow;
        let checked = Checked { place: "flow" };
        for (key, value) in [("shear", shear), ("extension", extension), ("rotation", rotation)] {
            checked.finite(key, value)?;
            let remedy = match self.region {
                Region::Space => continue,
                Region::Tube { .. } => {
                    "this flow would pass through the wall. Use region.tube.drive = { flux = 1 } in its place, or \
                     region = \"space\""
                }
                Region::Slit { .. } => {
                    "this flow would pass through the walls. Use region = \"space\", or remove the key"
                }
                _ => "this flow does not repeat in a periodic box. Use region = \"space\", or remove the key",
            };
            checked.refuse_if(value != 0.0, key, value, remedy)?;
        }
        let remedy = "in three dimensions, linear flows can be imposed on unbounded fluid. Use shear, extension and \
                      rotation there, or a flux as region.tube.drive";
        checked.refuse_if(poiseuille.is_some(), "poiseuille", "given", remedy)?;
        checked.refuse_if(wall_velocity.is_some(), "wall-velocity", "given", remedy)
    }

    /// Refuses round droplets that cross a wall or do not fit into a box. Other shapes are compared when they are made.
    fn check_fits(&self) -> Result<(), SetupError> {
        for (number, droplet) in self.droplets.iter().enumerate() {
            let DropletShape::Round { radius } = droplet.shape else { continue };
            let place = format!("droplets[{number}]");
            let (checked, [x, y, z]) = (Checked { place: &place }, droplet.place());
            let key = if droplet.position.is_some() { "position" } else { "centre" };
            let size = format!("a droplet of radius {radius}");
            match self.region {
                Region::Tube { radius: wall, .. } => {
                    let reach = y.hypot(z) + radius;
                    let remedy = format!(
                        "{size} reaches {reach:.4} from the axis there, beyond the wall of the tube at {wall}. Use a \
                         wider tube or a smaller droplet, or move it to the axis"
                    );
                    checked.refuse_if(reach >= wall, key, format!("{:?}", [x, y, z]), remedy)?;
                }
                Region::Slit { lower, upper } => {
                    let remedy = format!(
                        "{size} reaches from z = {:.4} to {:.4} there, beyond the walls at {lower} and {upper}. Move \
                         it between them, or use a smaller droplet or a wider slit",
                        z - radius,
                        z + radius
                    );
                    let crosses = z - radius <= lower || z + radius >= upper;
                    checked.refuse_if(crosses, key, format!("{:?}", [x, y, z]), remedy)?;
                }
                Region::SpaceBox { lengths } => {
                    let side = lengths.into_iter().fold(f64::INFINITY, f64::min);
                    let remedy = format!(
                        "it is wider than the box, whose shortest side is {side}. Use a smaller droplet or a larger box"
                    );
                    checked.refuse_if(2.0 * radius >= side, "shape.round.radius", radius, remedy)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Refuses round droplets that overlap, before anything is computed. Other shapes are compared when they are made.
    fn check_apart(&self) -> Result<(), SetupError> {
        for (number, droplet) in self.droplets.iter().enumerate() {
            for (other, earlier) in self.droplets[..number].iter().enumerate() {
                let (DropletShape::Round { radius }, DropletShape::Round { radius: of_other }) =
                    (&droplet.shape, &earlier.shape)
                else {
                    continue;
                };
                let [here, there] = [droplet.place(), earlier.place()];
                let apart = |i: usize| match self.region {
                    // The nearest periodic image.
                    Region::SpaceBox { lengths } => {
                        here[i] - there[i] - lengths[i] * ((here[i] - there[i]) / lengths[i]).round()
                    }
                    _ => here[i] - there[i],
                };
                let distance = (0..3).map(|i| apart(i).powi(2)).sum::<f64>().sqrt();
                let remedy = format!(
                    "it overlaps or touches droplets[{other}]: their centres are {distance:.4} apart, and their radii \
                     add up to {:.4}. Move them apart",
                    radius + of_other
                );
                let key = if droplet.position.is_some() { "position" } else { "centre" };
                let place = format!("droplets[{number}]");
                Checked { place: &place }.refuse_if(distance <= radius + of_other, key, format!("{here:?}"), remedy)?;
            }
        }
        Ok(())
    }

    /// Returns the scene of a description that has been checked.
    pub(super) fn assembled_in_space(&self) -> Result<Built, SetupError> {
        self.check_collapse(self.droplets.len())?;
        let keyed = |number: usize| move |error: SetupError| error.of(&self.key(number));
        let droplets = self.droplets.iter().enumerate();
        let droplets = droplets.map(|(number, droplet)| self.space_droplet(droplet).map_err(keyed(number)));
        let mut all = SpaceDroplets::new(droplets.collect::<Result<Vec<_>, _>>()?)?;
        if let Some(repulsion) = self.repulsion {
            all = all.with_repulsion(repulsion);
        }
        let all = self.surrounded(all)?;
        let names: Vec<String> = (0..self.droplets.len()).map(|number| self.name_of(number)).collect();
        let flow: AnyFlow = Box::new(SpaceFluid::new(self.viscosity)?);
        let mut scene = Scene::new(flow).with_step_size(self.step).advanced_by(self.integrator);
        let space = Some(scene.add(SpaceBody::new(all, &names)?));
        let (droplets, solids, rigid_bodies, shells) = Default::default();
        let (fibres, gels, interfaces) = Default::default();
        Ok(Built { scene, droplets, solids, rigid_bodies, shells, fibres, gels, interfaces, space })
    }

    /// Returns the droplets in the surroundings that the region describes.
    ///
    /// A pressure gradient acts over a tube without end. There, the finite pressure that droplets add does not count,
    /// so the mean flow is the same as without droplets.
    fn surrounded(&self, droplets: SpaceDroplets) -> Result<SpaceDroplets, SetupError> {
        Ok(match self.region {
            Region::Tube { radius, drive, .. } => {
                let mean_flow = match drive.flux() {
                    Some(flux) => flux / (PI * radius * radius),
                    None => -drive.gradient() * radius * radius / (8.0 * self.viscosity),
                };
                let tube = Tube::new(radius)?.along([1.0, 0.0, 0.0])?;
                droplets.with_surroundings(tube.with_mean_flow(mean_flow)?)?
            }
            Region::Slit { lower, upper } => droplets.with_surroundings(Slit::new(lower, upper)?)?,
            Region::SpaceBox { lengths } => droplets.with_surroundings(PeriodicBox::new(lengths)?)?,
            _ => droplets,
        })
    }

    /// Returns the name of a droplet in warnings and tables, with its number if another one has the same name.
    fn name_of(&self, number: usize) -> String {
        let name = &self.droplets[number].name;
        let is_shared = self.droplets.iter().filter(|other| other.name == *name).count() > 1;
        if is_shared { format!("{name} {number}") } else { name.clone() }
    }

    /// Returns a droplet of a scene in three dimensions without symmetry, for scenes that are put together by hand.
    ///
    /// # Errors
    /// Returns an error for parameters out of their range.
    pub fn space_droplet(&self, droplet: &DropletSetup) -> Result<SpaceDroplet, SetupError> {
        let (degree, axis) = (self.degree()?, droplet.direction());
        let viscosities = [droplet.viscosity.unwrap_or(self.viscosity), self.viscosity];
        let position = |s: [f64; 3]| droplet.shape.point(axis, s);
        let made = match &droplet.particles {
            None => SpaceDroplet::shaped(degree, position, viscosities, ConstantTension::new(droplet.tension)?)?,
            Some(particles) => {
                let law = particles.law(droplet.tension)?;
                let made = SpaceDroplet::shaped(degree, position, viscosities, law)?;
                let spread = particles.start.spread(axis);
                let concentration = |factor: f64| {
                    let spread = &spread;
                    move |s: [f64; 3]| factor * particles.concentration * spread(position(s))
                };
                let made = made.with_particles(particles.diffusion, concentration(1.0))?;
                // In all, as many as on a surface with the mean concentration everywhere.
                let factor = particles.concentration * made.area() / made.particle_number();
                let made = made.with_particles(particles.diffusion, concentration(factor))?;
                match particles.edge_following(droplet.shape.radius()?) {
                    Some(edge) => made.with_edge_following(edge)?,
                    None => made,
                }
            }
        };
        let FlowSetup { shear, extension, rotation, .. } = self.flow;
        let gradient = [[extension, shear - rotation, 0.0], [rotation, -extension, 0.0], [0.0; 3]];
        Ok(made.with_imposed_flow(gradient)?.with_position(droplet.place())?)
    }
}

impl DropletSetup {
    /// Refuses values out of their range, and what droplets without symmetry do not have.
    fn check_in_space(&self, checked: &Checked<'_>, axis: &str) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        if let Some(position) = self.position {
            checked.all_finite("position", &position)?;
            let remedy = "it says the same as centre. Use one of them";
            checked.refuse_if(self.centre != [0.0; 2], "position", format!("{position:?}"), remedy)?;
        }
        if let Some(heading) = self.heading {
            checked.all_finite("heading", &heading)?;
            let remedy = "it says the same as angle. Use one of them";
            checked.refuse_if(self.angle != 0.0, "heading", format!("{heading:?}"), remedy)?;
            let remedy = "a vector of length 0 has no direction. Use another one";
            checked.refuse_if(heading == [0.0; 3], "heading", format!("{heading:?}"), remedy)?;
        }
        checked.positive("viscosity", self.viscosity)?;
        checked.not_negative("tension", self.tension)?;
        let missing = |wrong: bool, key: &str, what: &str| {
            let remedy = format!("droplets without symmetry have no {what}. Remove the key, {axis}");
            checked.refuse_if(wrong, key, "given", remedy)
        };
        let planar = |wrong: bool, key: &str, what: &str| {
            let remedy = format!("{what} exist in two dimensions only. Remove the key");
            checked.refuse_if(wrong, key, "given", remedy)
        };
        planar(self.bending != 0.0, "bending", "elastic interfaces")?;
        planar(self.reference_curvature != 0.0, "reference-curvature", "elastic interfaces")?;
        missing(self.cortex != Cortex::default(), "cortex", "cortex")?;
        missing(self.friction != 0.0, "friction", "friction with a substrate")?;
        missing(self.body_force != [0.0; 2], "body-force", "weight")?;
        missing(self.force != [0.0; 2], "force", "forces from outside")?;
        missing(!self.fields.is_none(), "fields", "fields")?;
        planar(self.gel.is_some(), "gel", "gels")?;
        planar(self.squeezed, "squeezed", "walls that squeeze a droplet")?;
        let remedy = "parameters of the surface follow the edge of the particles. Remove the key";
        checked.refuse_if(self.motion != Motion::default(), "motion", "given", remedy)?;
        let remedy = "the volume returns to its value after each step in any case. Remove the key";
        checked.refuse_if(self.area_constraint, "area-constraint", true, remedy)?;
        self.shape.check_in_space(checked)?;
        let Some(particles) = &self.particles else { return Ok(()) };
        particles.check(checked)?;
        missing(particles.noise.is_some(), "particles.noise", "noise during a run")?;
        missing(particles.exchange.is_some(), "particles.exchange", "exchange with the inside")?;
        let remedy = "spherical harmonics transport particles without a flux of elements. Remove the key";
        checked.refuse_if(particles.flux != Flux::default(), "particles.flux", "given", remedy)
    }
}

impl DropletShape {
    /// Refuses shapes that have no counterpart around an axis.
    fn check_in_space(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        let remedy = "without symmetry, droplets start round, as an ellipse, or with modes that are cosines, each \
                      turned around the heading. Use one of these shapes";
        match self {
            Self::Round { radius } => checked.positive("shape.round.radius", *radius),
            Self::Ellipse { half_axes } => {
                checked.positive("shape.ellipse.half-axes[0]", half_axes[0])?;
                checked.positive("shape.ellipse.half-axes[1]", half_axes[1])
            }
            Self::Modes { radius, cosines, sines } => {
                checked.positive("shape.modes.radius", *radius)?;
                checked.amplitudes("shape.modes.cosines", cosines)?;
                let key = "shape.modes.sines";
                checked.refuse_if(sines.iter().any(|sine| *sine != 0.0), key, "given", remedy)?;
                let sum: f64 = cosines.iter().map(|cosine| cosine.abs()).sum();
                let remedy = "the sum of their magnitudes must be below 1, so that the radius stays positive. Use \
                              smaller amplitudes";
                checked.refuse_if(sum >= 1.0, "shape.modes.cosines", format!("{cosines:?}"), remedy)
            }
            _ => checked.refuse("shape", &"given", remedy),
        }
    }

    /// Returns the point of the surface (length) at the parameter s, a unit vector, of a shape turned around an axis.
    fn point(&self, axis: [f64; 3], s: [f64; 3]) -> [f64; 3] {
        let along = s[0] * axis[0] + s[1] * axis[1] + s[2] * axis[2];
        match self {
            Self::Ellipse { half_axes: [a, b] } => std::array::from_fn(|i| b * s[i] + (a - b) * along * axis[i]),
            Self::Modes { radius, cosines, .. } => {
                let angle = along.clamp(-1.0, 1.0).acos();
                let waves = (1..).zip(cosines).map(|(k, cosine)| cosine * (f64::from(k) * angle).cos());
                let radius = radius * (1.0 + waves.sum::<f64>());
                s.map(|x| radius * x)
            }
            other => {
                let radius = other.radius().unwrap_or(1.0);
                s.map(|x| radius * x)
            }
        }
    }
}

/// A concentration over its mean, as a function of the place from the centre.
type Spread = Box<dyn Fn([f64; 3]) -> f64>;

impl Start {
    /// Returns the concentration over its mean as a function of the place from the centre, for a heading.
    fn spread(self, axis: [f64; 3]) -> Spread {
        let cosine = |x: [f64; 3], n: [f64; 3]| {
            let length = x[0].hypot(x[1]).hypot(x[2]);
            (x[0] * n[0] + x[1] * n[1] + x[2] * n[2]) / length
        };
        match self {
            Self::Polarised => Box::new(move |x| 1.0 - cosine(x, axis)),
            Self::Uniform => Box::new(|_| 1.0),
            Self::Perturbed { amplitude, seed } => {
                let waves = noise(seed, axis);
                Box::new(move |x| {
                    let sum: f64 =
                        waves.iter().map(|wave| wave.weight * legendre(wave.degree, cosine(x, wave.axis))).sum();
                    1.0 + amplitude * sum
                })
            }
        }
    }
}

/// A Legendre polynomial about an axis.
struct Wave {
    degree: usize,
    weight: f64,
    axis: [f64; 3],
}

/// Returns Legendre polynomials of degree 1 to 4 about random axes, with random weights whose sum is 1. The heading
/// turns the axes.
fn noise(seed: u64, heading: [f64; 3]) -> Vec<Wave> {
    let mut random = SplitMix64::new(seed);
    // Columns of a rotation that takes the x axis to the heading.
    let [x, y, z] = heading;
    let across = y.hypot(z);
    let second = if across > 0.0 { [0.0, -z / across, y / across] } else { [0.0, 1.0, 0.0] };
    let third = [y * second[2] - z * second[1], z * second[0] - x * second[2], x * second[1] - y * second[0]];
    let mut waves: Vec<Wave> = (1..=NOISE)
        .map(|degree| {
            let weight = random.uniform();
            let height = 2.0 * random.uniform() - 1.0;
            let (sin, cos) = (std::f64::consts::TAU * random.uniform()).sin_cos();
            let radius = (1.0 - height * height).max(0.0).sqrt();
            let own = [height, radius * cos, radius * sin];
            let axis = std::array::from_fn(|i| own[0] * heading[i] + own[1] * second[i] + own[2] * third[i]);
            Wave { degree, weight, axis }
        })
        .collect();
    let total: f64 = waves.iter().map(|wave| wave.weight).sum();
    waves.iter_mut().for_each(|wave| wave.weight /= total);
    waves
}

/// Returns the Legendre polynomial of a degree, by its recurrence.
fn legendre(degree: usize, x: f64) -> f64 {
    let (mut before, mut now) = (1.0, x);
    for l in 1..degree {
        let l = l as f64;
        (before, now) = (now, ((2.0 * l + 1.0) * x * now - l * before) / (l + 1.0));
    }
    now
}

impl Particles {
    /// Returns how parameters follow the edge of the particles, if the excluded volume makes one.
    fn edge_following(&self, radius: f64) -> Option<EdgeFollowing> {
        let has_edge = !matches!(self.excluded_volume, ExcludedVolume::None | ExcludedVolume::Quadratic(_));
        let time = EDGE_TIME * radius * radius / self.diffusion;
        (has_edge && time.is_finite()).then_some(EdgeFollowing { strength: EDGE, time })
    }
}

#[cfg(test)]
mod tests;
