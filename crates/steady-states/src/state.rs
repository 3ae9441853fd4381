//! Steady states and what is measured of them.

use std::f64::consts::TAU;

use motile::active_interface::observables::InterfaceState;
use motile::active_interface::{Convention, Observables, observe};
use motile::ib_core::{FlowSample, Vec2, input::same_length};
use motile::{DropletShape, Region, Setup};

use crate::model::FrameMotion;
use crate::modes::Part;
use crate::newton::{Outcome, REMEDY, centred};
use crate::profile::Sampler;
use crate::spectrum::{Eigenmode, ModeShape, Spectrum};
use crate::system::{Point, System};
use crate::{Parameter, Profile, SteadyError};

/// Points for observables between the nodes, for each node.
const REFINEMENT: usize = 16;
/// Size of the last modes over that of all from which on a state is not resolved.
const LONGEST_TAIL: f64 = 0.01;
/// Nodes with which a state is looked for first.
const COARSE: usize = 64;
/// Part of the activity with which a state is looked for where it is not found directly, and the least step from
/// there.
const WEAKER: f64 = 0.5;
const LEAST_STEP: f64 = 0.01;
/// Most nodes on the way, and the change by a step in time after which Newton's method takes over: the first attempt is
/// the quickest one.
const ATTEMPTS: [(usize, f64); 3] = [(0, 0.02), (160, 0.02), (160, 0.003)];
/// Largest relative change of the velocity by Newton's method.
const SAME_SPEED: f64 = 0.3;

/// A droplet that moves without changing, by Newton's method.
///
/// Its shape and concentration are constant in a frame that moves with it, as trigonometric polynomials on the nodes of
/// [`motile::IntegralMethod`] (the cells of that method have no part in this), so that errors fall faster than any
/// power of their number.
#[derive(Debug, Clone)]
pub struct SteadyState {
    setup: Setup,
    point: Point,
    profile: Profile,
    outcome: Outcome,
    mirror: bool,
    tail: f64,
    /// Of the centroid (length per time).
    velocity: Vec2,
    /// D/R^2 (1/time).
    rate: f64,
}

/// What is measured of a steady state.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Speed (length per time).
    pub speed: f64,
    /// Stresslet along the motion (force times length), the convention of the far field; zero at rest, not a number
    /// of a droplet with a nucleus, whose part in it is not known.
    pub stresslet: f64,
    /// Aspect ratio from area moments, along x over across it.
    pub aspect_ratio: f64,
    /// Largest and smallest concentration, over their mean on a circle.
    pub concentration: [f64; 2],
    /// Length of the interface (length).
    pub perimeter: f64,
    /// Centroid (length).
    pub centroid: Vec2,
    /// Least curvature (1/length): negative for shapes with a hollow.
    pub least_curvature: f64,
}

impl SteadyState {
    /// The steady swimmer that a description leads to, its mirror image at the x axis if the start is: implicit steps
    /// in time from the start that the description has, on few nodes, then Newton's method on its own. Where that
    /// fails, the same at a weaker activity and from there along the activity.
    ///
    /// # Errors
    /// A description of something else than one round active droplet without a grid; no convergence.
    pub fn find(setup: &Setup) -> Result<Self, SteadyError> {
        Self::settled(setup).or_else(|error| {
            let goal = Parameter::Activity.get(setup).unwrap_or(f64::NAN);
            let weaker = |part: f64| Parameter::Activity.with(setup, part * goal);
            let mut part = WEAKER;
            let mut state = weaker(part).and_then(|setup| Self::settled(&setup)).map_err(|_| error)?;
            let mut step = 0.5 * (1.0 - part);
            while part < 1.0 {
                let ahead = (part + step).min(1.0);
                match Self::from_profile(&weaker(ahead)?, &state.profile, state.point.frame, state.mirror) {
                    Ok(next) => (part, state) = (ahead, next),
                    Err(_) if step > LEAST_STEP => step *= 0.5,
                    Err(_) => {
                        return Err(SteadyError::NotFound {
                            what: "a steady swimmer over the activity",
                            from: part * goal,
                            to: goal,
                            remedy: "follow the branch from the first value, it may turn back or need more nodes",
                        });
                    }
                }
            }
            Ok(state)
        })
    }

    /// By steps in time and Newton's method.
    fn settled(setup: &Setup) -> Result<Self, SteadyError> {
        let start = start(setup)?;
        let mirror = is_mirror(&start);
        let part = if mirror { Part::Even } else { Part::Full };
        let mut failed = None;
        for (most_nodes, steady) in ATTEMPTS {
            let mut system = System::new(&with_nodes(setup, COARSE))?;
            let profile = centred(start.resampled(system.model.nodes(), 0.0)?)?;
            has_room(setup, &profile)?;
            let mut point = system.point(&profile, [0.0; 3])?;
            let found = system
                .settle(&mut point, part, most_nodes, steady)
                .and_then(|_| Self::from_profile(setup, &system.profile(&point), point.frame, mirror));
            let unit = system.model.radius * system.model.diffusion_rate();
            let near = |a: f64, b: f64| (a - b).abs() < SAME_SPEED * (a.abs() + unit);
            match found {
                Ok(found) if found.point.frame.iter().zip(point.frame).take(2).all(|(a, b)| near(*a, b)) => {
                    return Ok(found);
                }
                // Another state, far away.
                Ok(found) => {
                    let Outcome { residual, iterations, .. } = found.outcome;
                    failed = Some(SteadyError::NoConvergence { residual, iterations, remedy: REMEDY });
                }
                Err(error) => failed = Some(error),
            }
        }
        Err(failed.unwrap_or(SteadyError::Singular { what: "the start", remedy: REMEDY }))
    }

    /// The droplet of a description at rest: a circle with the same concentration everywhere, a steady state wherever
    /// it has room.
    ///
    /// # Errors
    /// As [`SteadyState::find`].
    pub fn uniform(setup: &Setup) -> Result<Self, SteadyError> {
        let nodes = nodes_of(setup)?;
        let model = System::new(setup)?.model;
        let (radius, mean) = (model.radius, model.concentration);
        let positions = (0..nodes).map(|k| radius * Vec2::from_angle(TAU * k as f64 / nodes as f64)).collect();
        let centre = Vec2::from(setup.droplets[0].centre);
        let nuclei = setup.rigid_bodies.iter().map(|body| Vec2::from(body.centre) - centre).collect();
        let profile = Profile { positions, density: vec![radius * mean; nodes], nuclei };
        let (system, point, outcome) = Self::newton(setup, &profile, [0.0; 3], true, 0.0)?;
        Self::of(&system, point, outcome, true)
    }

    /// Newton's method from a droplet that is near a steady state, such as one from a run ([`Profile::from_markers`])
    /// or a neighbour ([`SteadyState::profile`]) with its velocity; `mirror` says that only states which are their own
    /// mirror image at the x axis are looked for, from the mean of the droplet and its image.
    ///
    /// # Errors
    /// As [`SteadyState::find`].
    pub fn near(setup: &Setup, profile: &Profile, velocity: Vec2, mirror: bool) -> Result<Self, SteadyError> {
        if mirror {
            return Self::from_profile(setup, &profile.symmetrised()?, [velocity.x, 0.0, 0.0], true);
        }
        // Across a channel nothing goes on for ever.
        let across = if matches!(setup.region, Region::Channel { .. }) { 0.0 } else { velocity.y };
        Self::from_profile(setup, profile, [velocity.x, across, 0.0], false)
    }

    fn from_profile(setup: &Setup, profile: &Profile, frame: FrameMotion, mirror: bool) -> Result<Self, SteadyError> {
        // The nodes of the first serve the start, those of the second what was found.
        let (system, point, _) = Self::newton(setup, profile, frame, mirror, CROWDING)?;
        let (system, point, outcome) = Self::newton(setup, &system.profile(&point), point.frame, mirror, CROWDING)?;
        Self::of(&system, point, outcome, mirror)
    }

    fn newton(
        setup: &Setup,
        profile: &Profile,
        frame: FrameMotion,
        mirror: bool,
        crowding: f64,
    ) -> Result<(System, Point, Outcome), SteadyError> {
        let mut system = System::new(setup)?;
        let mut profile = centred(profile.resampled(system.model.nodes(), crowding)?)?;
        if mirror {
            profile = profile.mean_with_image();
        }
        has_room(setup, &profile)?;
        let mut point = system.point(&profile, frame)?;
        let part = if mirror { Part::Even } else { Part::Full };
        let outcome = system.newton(&mut point, part, None)?;
        Ok((system, point, outcome))
    }

    pub(crate) fn of(system: &System, point: Point, outcome: Outcome, mirror: bool) -> Result<Self, SteadyError> {
        let profile = system.profile(&point);
        let tails = profile.tails()?;
        if let Some((what, tail)) = tails.into_iter().find(|(_, tail)| *tail > LONGEST_TAIL) {
            return Err(SteadyError::Unresolved { what, nodes: profile.nodes(), tail });
        }
        let tail = tails.into_iter().fold(0.0, |largest, (_, tail)| tail.max(largest));
        let rate = system.model.diffusion_rate();
        let [x, y, turn] = point.frame;
        let velocity = Vec2::new(x, y) + turn * profile.moments()?.centroid.perp();
        Ok(Self { setup: system.model.setup.clone(), point, profile, outcome, mirror, tail, velocity, rate })
    }

    /// This state with another description, nearby, over the same nodes.
    pub(crate) fn moved_to(&self, setup: &Setup) -> Result<Self, SteadyError> {
        let mut system = System::new(setup)?;
        let mut point = self.point.clone();
        let part = if self.mirror { Part::Even } else { Part::Full };
        let outcome = system.newton(&mut point, part, None)?;
        if !system.is_far(&point) {
            return Self::of(&system, point, outcome, self.mirror);
        }
        Self::from_profile(setup, &system.profile(&point), point.frame, self.mirror)
    }

    pub(crate) fn point(&self) -> &Point {
        &self.point
    }

    /// The rate D/R^2 (1/time).
    pub(crate) fn diffusion_rate(&self) -> f64 {
        self.rate
    }

    /// The description.
    #[must_use]
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The droplet.
    #[must_use]
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Velocity of the droplet's centroid (length per time).
    #[must_use]
    pub fn velocity(&self) -> Vec2 {
        self.velocity
    }

    /// Rate at which the droplet turns, counter-clockwise (1/time): in the plane it may swim in a circle, whose radius
    /// is the speed over it.
    #[must_use]
    pub fn turning_rate(&self) -> f64 {
        self.point.frame[2]
    }

    /// Whether it is its own mirror image at the x axis.
    #[must_use]
    pub fn is_mirror_symmetric(&self) -> bool {
        self.mirror
    }

    /// Largest rate of change that is left of any Fourier coefficient of shape and density over their size (1/time).
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.outcome.residual
    }

    /// Size of the last Fourier modes over that of all, of shape or concentration, whichever is larger: measured values
    /// have errors of about a tenth of it or less.
    #[must_use]
    pub fn tail(&self) -> f64 {
        self.tail
    }

    /// Newton iterations.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.outcome.iterations
    }

    /// Condition number of the linear equations in the 1-norm, rows being scaled.
    #[must_use]
    pub fn condition(&self) -> f64 {
        self.outcome.condition
    }

    /// Eigenvalues of the linearised equations.
    ///
    /// # Errors
    /// Eigenvalues that do not converge.
    pub fn spectrum(&self) -> Result<Spectrum, SteadyError> {
        System::new(&self.setup)?.spectrum(&self.point, self.mirror)
    }

    /// The shape of a mode of [`SteadyState::spectrum`].
    ///
    /// # Errors
    /// A value that is no eigenvalue.
    pub fn mode_shape(&self, mode: &Eigenmode) -> Result<ModeShape, SteadyError> {
        System::new(&self.setup)?.mode_shape(&self.point, mode)
    }

    /// What is measured, to spectral accuracy.
    ///
    /// # Errors
    /// A flow that cannot be solved for.
    pub fn measured(&self) -> Result<Measured, SteadyError> {
        let mut system = System::new(&self.setup)?;
        system.load(&self.point)?;
        let moments = self.profile.moments()?;
        let step = TAU / self.profile.nodes() as f64;
        let model = &system.model;
        let contrast = model.viscosities[1] - model.viscosities[0];
        let tangents = self.profile.tangents()?;
        let mut dipole = [[0.0; 2]; 2];
        for (k, x) in self.profile.positions.iter().enumerate() {
            let (r, f, v, n) =
                (*x - moments.centroid, model.forces[k], model.velocities[k], -tangents[k].perp() * step);
            let (r, f, v, n) = (r.to_array(), f.to_array(), v.to_array(), n.to_array());
            for i in 0..2 {
                for j in 0..2 {
                    dipole[i][j] += f[i] * r[j] + contrast * (v[j] * n[i] + v[i] * n[j]);
                }
            }
        }
        // Turned into axes along the motion.
        let heading = self.velocity().try_normalize().unwrap_or(Vec2::X);
        let (cos, sin) = (heading.x * heading.x - heading.y * heading.y, 2.0 * heading.x * heading.y);
        let (xx, xy) = (0.5 * (dipole[0][0] - dipole[1][1]), 0.5 * (dipole[0][1] + dipole[1][0]));
        Ok(Measured {
            speed: self.velocity().length(),
            stresslet: if self.profile.nuclei.is_empty() { cos * xx + sin * xy } else { f64::NAN },
            aspect_ratio: moments.aspect_ratio,
            concentration: self.profile.extrema()?.map(|c| c / model.concentration),
            perimeter: tangents.iter().map(|t| t.length() * step).sum(),
            centroid: moments.centroid,
            least_curvature: self.profile.least_curvature()?,
        })
    }

    /// Velocity, its gradient and the pressure at points (length), inside the droplet and outside of it, at any
    /// distance from the interface, in the frame of the laboratory, to spectral accuracy. Which side of the interface a
    /// point on it is on is not defined: take points 1e-5 radii beside it.
    ///
    /// # Errors
    /// Points that are not finite; a flow that cannot be solved for.
    pub fn sample(&self, points: &[Vec2]) -> Result<Vec<FlowSample>, SteadyError> {
        let mut system = System::new(&self.setup)?;
        system.load(&self.point)?;
        system.model.sample(points)
    }

    /// All observables of a run ([`Observables::get`] has them by name), from markers between the nodes, of second
    /// order in their spacing: 16 for each node.
    ///
    /// # Errors
    /// A flow that cannot be solved for; a droplet with a nucleus, whose force moments are not known.
    pub fn observables(&self) -> Result<Observables, SteadyError> {
        if !self.profile.nuclei.is_empty() {
            return Err(SteadyError::Unsupported {
                what: "force moments of a droplet with a nucleus are not known".to_owned(),
                remedy: "use what is measured, or observe a run",
            });
        }
        let mut system = System::new(&self.setup)?;
        system.load(&self.point)?;
        let nodes = self.profile.nodes();
        let fine = REFINEMENT * nodes;
        let model = &system.model;
        let of =
            |vectors: &[Vec2]| Profile { positions: vectors.to_vec(), density: vec![0.0; nodes], nuclei: Vec::new() };
        let velocities = of(&model.velocities);
        let scaled = nodes as f64 / fine as f64;
        let forces = of(&model.forces);
        let [curve, velocity, force] = [&self.profile, &velocities, &forces].map(Sampler::new);
        let (curve, velocity, force) = (curve?, velocity?, force?);
        let parameter = |k: f64| TAU * k / fine as f64;
        let at = |sampler: &Sampler, k: usize| sampler.at(parameter(k as f64)).position;
        let numbers: Vec<f64> =
            (0..fine).map(|k| curve.at(parameter(k as f64 + 0.5)).density * TAU / fine as f64).collect();
        Ok(observe(
            &InterfaceState {
                markers: &(0..fine).map(|k| at(&curve, k)).collect::<Vec<_>>(),
                forces: &(0..fine).map(|k| at(&force, k) * scaled).collect::<Vec<_>>(),
                velocities: &(0..fine).map(|k| at(&velocity, k)).collect::<Vec<_>>(),
                numbers: &numbers,
                viscosities: model.viscosities,
                inside: None,
                filled: None,
                stresslet: None,
            },
            Convention::FarField,
        )?)
    }
}

/// How strongly nodes crowd where the concentration is steep.
pub(crate) const CROWDING: f64 = 0.8;

/// The nodes of a description.
pub(crate) fn nodes_of(setup: &Setup) -> Result<usize, SteadyError> {
    Ok(System::new(setup)?.model.nodes())
}

/// The same description with other nodes.
pub(crate) fn with_nodes(setup: &Setup, nodes: usize) -> Setup {
    let method = motile::Method::Integral(motile::IntegralMethod { nodes, cells: 4 * nodes });
    Setup { method, ..setup.clone() }
}

/// The droplet that a run of this description starts from.
fn start(setup: &Setup) -> Result<Profile, SteadyError> {
    let fine = with_nodes(setup, nodes_of(setup)?.max(2 * COARSE));
    let droplet = fine.droplet(&fine.droplets[0])?;
    let nuclei = setup.rigid_bodies.iter().map(|body| Vec2::from(body.centre)).collect();
    Ok(Profile::from_markers(droplet.markers(), droplet.particle_numbers())?.with_nuclei(nuclei))
}

/// Refuses a droplet that reaches beyond a wall or its own periodic image, or that has not all of its discs inside.
fn has_room(setup: &Setup, profile: &Profile) -> Result<(), SteadyError> {
    let extent = |way: Vec2| profile.positions.iter().map(|x| x.dot(way)).fold(f64::NEG_INFINITY, f64::max);
    let [left, right, top, bottom] = [-Vec2::X, Vec2::X, Vec2::Y, -Vec2::Y].map(extent);
    let fits = match setup.region {
        Region::Plane => true,
        Region::Box { lengths: [x, y] } => left + right < x && top + bottom < y,
        Region::Channel { length, width, .. } => left + right < length && top.max(bottom) < 0.5 * width,
    };
    let refused = || SteadyError::Unsupported {
        what: format!(
            "the droplet does not fit: it reaches from {:.3} to {top:.3} across and is {:.3} long",
            -bottom,
            left + right
        ),
        remedy: "give a larger region, a smaller droplet or another place for it",
    };
    fits.then_some(()).ok_or_else(refused)?;
    same_length("the nuclei of the profile", setup.rigid_bodies.len(), profile.nuclei.len())?;
    for (body, centre) in setup.rigid_bodies.iter().zip(&profile.nuclei) {
        let DropletShape::Round { radius } = body.shape else { continue };
        let arms = || profile.positions.iter().map(|x| *x - *centre);
        let turn: f64 = arms().zip(arms().cycle().skip(1)).map(|(a, b)| a.angle_to(b)).sum();
        if turn.abs() < 0.5 * TAU || !arms().all(|arm| arm.length() > radius) {
            return Err(SteadyError::Unsupported {
                what: format!("the disc of radius {radius} at ({:.3}, {:.3}) is not inside", centre.x, centre.y),
                remedy: "give a smaller disc or another place in the droplet",
            });
        }
    }
    Ok(())
}

/// Whether a droplet is its own mirror image at the x axis.
fn is_mirror(profile: &Profile) -> bool {
    let other = profile.mirrored();
    let size = profile.density.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let same = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6 * size;
    let places = || profile.positions.iter().chain(&profile.nuclei);
    places().zip(other.positions.iter().chain(&other.nuclei)).all(|(a, b)| a.distance(*b) < 1e-6)
        && profile.density.iter().zip(&other.density).all(same)
}
