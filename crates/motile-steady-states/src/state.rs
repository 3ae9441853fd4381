//! Steady states and their measured properties.

use std::f64::consts::{PI, TAU};
use std::time::Instant;

use motile::active_interface::observables::{Convention, Frame, InterfaceState, Observables, observe};
use motile::base::FlowSample;
use motile::base::Region;
use motile::scene::Deformation;
use motile::scene::Enclosed;
use motile::setup::Setup;
use motile_base::Vec2;

use crate::iteration::Outcome;
use crate::model::FrameMotion;
use crate::modes::Part;
use crate::profile::{CROWDING, Sampler};
use crate::revolution::{Rings, VolumeMoments};
use crate::settling::check_axis;
use crate::spectrum::{Eigenmode, ModeShape, Spectrum, eigenvalues};
use crate::system::{Point, System};
use crate::{Profile, SteadyError};

/// Markers for each node in observables, which are of second order in the spacing of markers.
const REFINEMENT: usize = 16;
/// Tail of the Fourier series above which a state is not resolved: measured values would be off by one part in a
/// thousand.
const LONGEST_TAIL: f64 = 0.01;

/// Steady state of a droplet: shape and concentration are constant in a frame that moves, and may turn, with it.
///
/// Found by Newton's method. Both are trigonometric polynomials on the nodes of [`motile::setup::IntegralMethod`] (its
/// cells have no part in this), so errors fall faster than any power of the number of nodes.
#[derive(Debug, Clone)]
#[doc(alias("Newton method", "fixed point"))]
pub struct SteadyState {
    setup: Setup,
    point: Point,
    profile: Profile,
    outcome: Outcome,
    mirror: bool,
    tail: f64,
    /// Velocity of the centroid (length per time).
    velocity: Vec2,
    /// Rate D/R^2 (1/time).
    rate: f64,
}

/// Measured properties of a steady state, to spectral accuracy.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Measured {
    /// Speed relative to the imposed flow at the centroid (length per time).
    pub speed: f64,
    /// Stresslet S_uu along the direction u of motion (force times length), which the flow far away shows: the
    /// traceless part of the dipole of all forces on the fluid in and on the droplet, a disc inside among them (in
    /// three dimensions force times length too); along x at rest.
    pub stresslet: f64,
    /// Aspect ratio: square root of the second moment of the area along the motion over that across it, as in
    /// [`Observables::aspect_ratio_moments`]; along x at rest.
    pub aspect_ratio: f64,
    /// Largest and smallest concentration over the mean c0 on the circle at rest (no dimension); zero without
    /// particles.
    pub concentration: [f64; 2],
    /// Perimeter of the interface (length); in three dimensions its area (length squared).
    pub perimeter: f64,
    /// Centroid of the area or volume (length).
    pub centroid: Vec2,
    /// Least curvature of the interface (1/length): negative where it is concave.
    pub least_curvature: f64,
}

impl Measured {
    /// Returns speed, stresslet, aspect ratio, largest and smallest concentration and perimeter.
    pub(crate) fn list(&self) -> [f64; 6] {
        let [most, least] = self.concentration;
        [self.speed, self.stresslet, self.aspect_ratio, most, least, self.perimeter]
    }
}

/// Time (seconds) of the parts of a Newton iteration and of a spectrum, for disturbances of the state's own symmetry.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Cost {
    /// Jacobian: derivatives of the rates by central differences, two solutions of the flow a column.
    pub jacobian: f64,
    /// Bordering the Jacobian and factorising it.
    pub factorisation: f64,
    /// Eigenvalues of the Jacobian.
    pub eigenvalues: f64,
    /// Number of unknowns of the bordered equations.
    pub unknowns: usize,
}

impl SteadyState {
    /// Creates the state of rest of a description: a circle of uniform concentration, steady wherever it has room.
    ///
    /// # Errors
    /// Returns the errors of [`SteadyState::find`].
    pub fn uniform(setup: &Setup) -> Result<Self, SteadyError> {
        let model = System::new(setup)?.model;
        if !model.imposed().is_none() {
            let what = "a circle is deformed by the imposed flow";
            return Err(SteadyError::unsupported(what, "Use `SteadyState::find`"));
        }
        let (nodes, radius, mean) = (model.nodes(), model.radius, model.concentration);
        let positions = (0..nodes).map(|k| radius * Vec2::from_angle(TAU * k as f64 / nodes as f64)).collect();
        let centre = Vec2::from(setup.droplets[0].centre);
        let nuclei = setup.rigid_bodies.iter().map(|body| Vec2::from(body.centre) - centre).collect();
        let profile = Profile { positions, density: vec![radius * mean; nodes], nuclei };
        let (system, point, outcome) = Self::newton(setup, &profile, [0.0; 3], Part::Even, 0.0)?;
        Self::of(&system, point, outcome, Part::Even)
    }

    /// Finds the steady state near a droplet, such as one from a run ([`Profile::from_markers`]) or of a neighbouring
    /// state ([`SteadyState::profile`]), with its velocity (length per time), by Newton's method. With `mirror`, it
    /// looks only for states that are their own mirror image at the x axis, starting from the mean of the droplet and
    /// its image.
    ///
    /// # Errors
    /// Returns the errors of [`SteadyState::find`].
    pub fn near(setup: &Setup, profile: &Profile, velocity: Vec2, mirror: bool) -> Result<Self, SteadyError> {
        if mirror && !System::new(setup)?.model.is_mirror_symmetric() {
            let what = "the imposed flow has no mirror symmetry";
            return Err(SteadyError::unsupported(what, "Search without `mirror`, for states of any symmetry"));
        }
        if mirror {
            return Self::from_profile(setup, &profile.symmetrised()?, [velocity.x, 0.0, 0.0], Part::Even);
        }
        check_axis(setup, Part::Full)?;
        // No state moves steadily across a channel.
        let across = if matches!(setup.region.without_slip(), Region::Channel { .. }) { 0.0 } else { velocity.y };
        Self::from_profile(setup, profile, [velocity.x, across, 0.0], Part::Full)
    }

    /// Runs Newton's method twice: on nodes that suit the start, then on nodes that suit the result.
    pub(crate) fn from_profile(
        setup: &Setup,
        profile: &Profile,
        frame: FrameMotion,
        part: Part,
    ) -> Result<Self, SteadyError> {
        let (system, point, _) = Self::newton(setup, profile, frame, part, CROWDING)?;
        let (system, point, outcome) = Self::newton(setup, &system.profile(&point), point.frame, part, CROWDING)?;
        Self::of(&system, point, outcome, part)
    }

    fn newton(
        setup: &Setup,
        profile: &Profile,
        frame: FrameMotion,
        part: Part,
        crowding: f64,
    ) -> Result<(System, Point, Outcome), SteadyError> {
        let mut system = System::new(setup)?;
        let mut profile = profile.resampled(system.model.nodes(), crowding)?.centred()?;
        if part == Part::Even {
            profile = profile.mean_with_image();
        }
        profile.check_room(setup)?;
        let mut point = system.point(&profile, frame)?;
        let outcome = system.newton(&mut point, part, None)?;
        Ok((system, point, outcome))
    }

    /// Creates the state of a point to which Newton's method has converged. It refuses a point that the nodes do not
    /// resolve.
    pub(crate) fn of(system: &System, point: Point, outcome: Outcome, part: Part) -> Result<Self, SteadyError> {
        let profile = system.profile(&point);
        let tails = profile.tails()?;
        if let Some((what, tail)) = tails.into_iter().find(|(_, tail)| *tail > LONGEST_TAIL) {
            return Err(SteadyError::unresolved(what, profile.nodes(), tail));
        }
        let tail = tails.into_iter().fold(0.0, |largest, (_, tail)| tail.max(largest));
        let rate = system.model.rate_unit();
        let [x, y, turn] = point.frame;
        let velocity = Vec2::new(x, y) + turn * profile.moments()?.centroid.perp();
        let setup = system.model.setup.clone();
        Ok(Self { setup, point, profile, outcome, mirror: part == Part::Even, tail, velocity, rate })
    }

    /// Finds the steady state of a similar description, on the branch of this one, by Newton's method from this state.
    ///
    /// Nodes stay where they are unless the droplet changes much, so that results change smoothly with parameters. If
    /// the description has another number of nodes or rigid bodies, this is [`SteadyState::near`].
    ///
    /// # Errors
    /// Returns the errors of [`SteadyState::near`].
    pub fn follow(&self, setup: &Setup) -> Result<Self, SteadyError> {
        let model = System::new(setup)?.model;
        let same = model.nodes() == self.profile.nodes() && setup.rigid_bodies.len() == self.profile.nuclei.len();
        let mirror = self.mirror && model.is_mirror_symmetric();
        if !same || mirror != self.mirror {
            return Self::near(setup, &self.profile, self.velocity, mirror);
        }
        check_axis(setup, self.part())?;
        self.profile.check_room(setup)?;
        self.moved_to(setup)
    }

    /// Returns the state of a neighbouring description, over the same nodes unless the droplet changes much. If the
    /// description has no mirror symmetry, neither has the state.
    pub(crate) fn moved_to(&self, setup: &Setup) -> Result<Self, SteadyError> {
        let mut system = System::new(setup)?;
        let part = if system.model.is_mirror_symmetric() { self.part() } else { Part::Full };
        let mut point = self.point.clone();
        let outcome = system.newton(&mut point, part, None)?;
        if !system.is_far(&point) {
            return Self::of(&system, point, outcome, part);
        }
        Self::from_profile(setup, &system.profile(&point), point.frame, part)
    }

    /// Returns the part of the state space that the state was found in.
    pub(crate) fn part(&self) -> Part {
        if self.mirror { Part::Even } else { Part::Full }
    }

    pub(crate) fn point(&self) -> &Point {
        &self.point
    }

    pub(crate) fn outcome(&self) -> Outcome {
        self.outcome
    }

    /// Returns the rate D/R^2 (1/time).
    pub(crate) fn diffusion_rate(&self) -> f64 {
        self.rate
    }

    /// Returns the description of the scene.
    #[must_use]
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Returns the shape and density of particles.
    #[must_use]
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Returns the velocity of the droplet's centroid (length per time).
    #[must_use]
    pub fn velocity(&self) -> Vec2 {
        self.velocity
    }

    /// Returns the rate at which the droplet turns (1/time), counter-clockwise. In the plane it then swims in a circle,
    /// of a radius of the speed over this rate.
    #[must_use]
    pub fn turning_rate(&self) -> f64 {
        self.point.frame[2]
    }

    /// Returns the smallest distance of the nodes from the walls of a channel or a straight tube (length); `None` for
    /// other regions.
    #[must_use]
    pub fn wall_gap(&self) -> Option<f64> {
        self.profile.film(&self.setup)
    }

    /// Returns true for a state that is its own mirror image at the x axis.
    #[must_use]
    pub fn is_mirror_symmetric(&self) -> bool {
        self.mirror
    }

    /// Returns the residual (1/time). It is the largest rate of change of a Fourier coefficient of shape or density, in
    /// units of the radius and the mean density.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.outcome.residual
    }

    /// Returns the tail of the Fourier series (no dimension). It is the ratio of the last coefficients to the largest,
    /// of shape or density, whichever is larger. Measured values are off by a tenth of it or less.
    #[must_use]
    pub fn tail(&self) -> f64 {
        self.tail
    }

    /// Returns the number of Newton iterations.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.outcome.iterations
    }

    /// Returns the condition number of the last linear equations in the 1-norm, rows being scaled to a largest entry
    /// of 1.
    #[must_use]
    pub fn condition(&self) -> f64 {
        self.outcome.condition
    }

    /// Returns the spectrum of the equations linearised about this state: growth rates and frequencies of small
    /// disturbances.
    ///
    /// With a cortex in three dimensions, the spectrum leaves out the two largest waves of the shape, which would make
    /// up modes at the poles that the droplet lacks.
    ///
    /// # Errors
    /// Returns an error if the eigenvalues do not converge or the flow cannot be solved for.
    pub fn spectrum(&self) -> Result<Spectrum, SteadyError> {
        System::new(&self.setup)?.spectrum(&self.point, self.part())
    }

    /// Returns the shape of a mode of [`SteadyState::spectrum`]: displacements and changes of concentration at the
    /// nodes.
    ///
    /// # Errors
    /// Returns an error for a mode that cannot be found at its eigenvalue; a flow that cannot be solved for.
    pub fn mode_shape(&self, mode: &Eigenmode) -> Result<ModeShape, SteadyError> {
        System::new(&self.setup)?.mode_shape(&self.point, mode)
    }

    /// Returns the speed, stresslet, shape and concentration, to spectral accuracy.
    ///
    /// # Errors
    /// Returns an error for a flow that cannot be solved for.
    pub fn measured(&self) -> Result<Measured, SteadyError> {
        let mut system = System::new(&self.setup)?;
        system.load(&self.point)?;
        self.measured_in(&system)
    }

    /// Returns the velocity relative to the imposed flow at the centroid (length per time).
    pub(crate) fn relative_velocity(&self, system: &System) -> Result<Vec2, SteadyError> {
        Ok(self.velocity - system.model.imposed().velocity_at(self.profile.moments()?.centroid))
    }

    /// Returns the measured properties from a system that the state is loaded in.
    pub(crate) fn measured_in(&self, system: &System) -> Result<Measured, SteadyError> {
        let tangents = self.profile.tangents()?;
        let model = &system.model;
        let around = InterfaceState {
            markers: &self.profile.positions,
            forces: &model.forces,
            velocities: &model.velocities,
            imposed: model.imposed(),
            numbers: &[],
            viscosities: model.viscosities,
            inside: None,
            membrane: None,
            axisymmetric: model.is_axisymmetric(),
            on_grid: false,
            enclosed: Vec::new(),
        };
        let velocity = self.relative_velocity(system)?;
        let heading = Frame::of_motion(Vec2::ZERO, velocity, around.rest_speed()?)?.direction();
        let (centroid, aspect_ratio, perimeter, stresslet) = if model.is_axisymmetric() {
            let VolumeMoments { centroid, aspect_ratio, surface } = VolumeMoments::of(&self.profile)?;
            let centroid = Vec2::new(centroid, 0.0);
            let [along, across] = self.axial_dipoles(system, centroid, &tangents);
            (centroid, aspect_ratio, surface, 2.0 / 3.0 * (along - across))
        } else {
            let moments = self.profile.moments()?;
            let [xx, xy] = self.force_dipole(system, moments.centroid, &tangents);
            // The component of the traceless, symmetric part along the motion.
            let (cos, sin) = (heading.x * heading.x - heading.y * heading.y, 2.0 * heading.x * heading.y);
            let perimeter = tangents.iter().map(|t| t.length() * TAU / tangents.len() as f64).sum();
            (moments.centroid, moments.aspect_ratio(heading), perimeter, cos * xx + sin * xy)
        };
        Ok(Measured {
            speed: velocity.length(),
            stresslet,
            aspect_ratio,
            concentration: if model.carries() {
                self.profile.extrema()?.map(|c| c / model.concentration)
            } else {
                [0.0; 2]
            },
            perimeter,
            centroid,
            least_curvature: self.profile.least_curvature()?,
        })
    }

    /// Returns the moments along the axis and along a direction across it of the forces of a body of revolution about
    /// its centre, with `2 (eta_ext - eta_in) INT u n dS`, from which the stresslet is two thirds of their difference.
    fn axial_dipoles(&self, system: &System, centre: Vec2, tangents: &[Vec2]) -> [f64; 2] {
        let (model, rings) = (&system.model, Rings::new(tangents.len()));
        let contrast = model.viscosities[1] - model.viscosities[0];
        let node = |(k, x): (usize, &Vec2)| {
            let (r, f, n) = (*x - centre, rings.of_forces(k) * model.forces[k], -tangents[k].perp());
            let (u, weight) = (model.velocities[k], 2.0 * contrast * model.weight(k));
            [f.x * r.x + weight * u.x * n.x, 0.5 * (f.y * r.y + weight * u.y * n.y)]
        };
        let nodes = self.profile.positions.iter().enumerate().map(node);
        nodes.fold([0.0; 2], |[along, across], [a, b]| [along + a, across + b])
    }

    /// Returns the components xx and xy of the stresslet about a centre:
    /// [`motile::active_interface::observables::ForceMoments`] as integrals over the interface, with what keeps the
    /// discs inside rigid.
    fn force_dipole(&self, system: &System, centre: Vec2, tangents: &[Vec2]) -> [f64; 2] {
        let model = &system.model;
        let contrast = model.viscosities[1] - model.viscosities[0];
        let step = TAU / tangents.len() as f64;
        let (mut xx, mut xy) = (0.0, 0.0);
        for (k, x) in self.profile.positions.iter().enumerate() {
            let (r, f, v, n) = (*x - centre, model.forces[k], model.velocities[k], -tangents[k].perp() * step);
            xx += 0.5 * (f.x * r.x - f.y * r.y) + contrast * (v.x * n.x - v.y * n.y);
            xy += 0.5 * (f.x * r.y + f.y * r.x) + contrast * (v.x * n.y + v.y * n.x);
        }
        for [[dxx, dxy], [_, dyy]] in model.rigid_dipoles() {
            xx += 0.5 * (dxx - dyy);
            xy += dxy;
        }
        [xx, xy]
    }

    /// Returns the deformation of the droplet, and its motion along its interface: the period of tank-treading in a
    /// shear.
    ///
    /// # Errors
    /// Returns an error for a flow that cannot be solved for.
    pub fn deformation(&self) -> Result<Deformation, SteadyError> {
        let mut system = System::new(&self.setup)?;
        system.load(&self.point)?;
        Ok(Deformation::of(&self.profile.positions, &system.model.velocities)?)
    }

    /// Returns the particle stress of the droplet with what is inside, symmetric and without trace (force times
    /// length), of Batchelor's sign as in [`motile::scene::Stress`].
    ///
    /// # Errors
    /// Returns an error for a flow that cannot be solved for.
    pub fn particle_stress(&self) -> Result<[[f64; 2]; 2], SteadyError> {
        let mut system = System::new(&self.setup)?;
        system.load(&self.point)?;
        let [xx, xy] = self.force_dipole(&system, self.profile.moments()?.centroid, &self.profile.tangents()?);
        Ok([[-xx, -xy], [-xy, xx]])
    }

    /// Returns the flow at points (length), inside the droplet or outside of it, at any distance from the interface:
    /// velocity, its gradient and the pressure in the frame of the laboratory, to spectral accuracy. Gradient and
    /// pressure jump at the interface: take points 1e-5 radii away from it.
    ///
    /// # Errors
    /// Returns an error for points that are not finite; a flow that cannot be solved for.
    pub fn sample(&self, points: &[Vec2]) -> Result<Vec<FlowSample>, SteadyError> {
        let mut system = System::new(&self.setup)?;
        system.load(&self.point)?;
        system.model.sample(points)
    }

    /// Returns the cost of a Newton iteration and a spectrum at this state, by doing each part once more.
    ///
    /// # Errors
    /// Returns the errors of [`SteadyState::spectrum`].
    pub fn cost(&self) -> Result<Cost, SteadyError> {
        let mut system = System::new(self.setup())?;
        let part = self.part();
        let started = Instant::now();
        let matrix = system.jacobian(self.point(), part)?;
        let jacobian = started.elapsed().as_secs_f64();
        let unknowns = system.border(self.point(), part, &matrix, None)?.len();
        let factorisation = started.elapsed().as_secs_f64() - jacobian;
        eigenvalues(&matrix)?;
        let eigenvalues = started.elapsed().as_secs_f64() - jacobian - factorisation;
        Ok(Cost { jacobian, factorisation, eigenvalues, unknowns })
    }

    /// Returns the observables of a run (by name: [`Observables::get`]), from 16 markers for each node, of second order
    /// in their spacing.
    ///
    /// # Errors
    /// Returns an error for a flow that cannot be solved for.
    pub fn observables(&self) -> Result<Observables, SteadyError> {
        let mut system = System::new(&self.setup)?;
        system.residual(&self.point)?;
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
        let axisymmetric = model.is_axisymmetric();
        // Segments are halves of rings in three dimensions.
        let width = |y: f64| if axisymmetric { PI * y.abs() } else { 1.0 };
        let number = |k: usize| {
            let middle = curve.at(parameter(k as f64 + 0.5));
            middle.density * width(middle.position.y) * TAU / fine as f64
        };
        let numbers: Vec<f64> = (0..fine).map(number).collect();
        let mut seen = observe(
            &InterfaceState {
                markers: &(0..fine).map(|k| at(&curve, k)).collect::<Vec<_>>(),
                forces: &(0..fine).map(|k| at(&force, k) * scaled).collect::<Vec<_>>(),
                velocities: &(0..fine).map(|k| at(&velocity, k)).collect::<Vec<_>>(),
                imposed: model.imposed(),
                numbers: if model.carries() { &numbers } else { &[] },
                viscosities: model.viscosities,
                inside: model.inside(),
                membrane: None,
                axisymmetric,
                on_grid: false,
                enclosed: model
                    .rigid_dipoles()
                    .map(|dipole| Enclosed { rigid_dipole: Some(dipole), ..Enclosed::default() })
                    .collect(),
            },
            Convention::FarField,
        )?;
        if axisymmetric {
            // Sums over rings are of low order at the axis.
            let dipoles = self.axial_dipoles(&system, seen.centroid, &self.profile.tangents()?);
            (seen.moments.dipole[0][0], seen.moments.dipole[1][1]) = (dipoles[0], dipoles[1]);
        }
        Ok(seen)
    }
}
