//! From forces at markers to velocities at markers.

mod body_flow;
mod markers;
mod prescribed_flow;
mod substrate;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use body_flow::Everything;
pub use body_flow::{BodyFlow, Enclosed};
pub use markers::{MarkerGroup, MarkerKind, Markers};
pub use prescribed_flow::PrescribedFlow;
pub use substrate::Substrate;

use std::borrow::Cow;

use motile_base::{Drive, FlowSample, ImposedFlow, Region, SolveReport, Vec2, boxes::Periods};
use serde::{Deserialize, Serialize};

use crate::{FlowError, Warning, gap::Boundary, saved_state::SavedState};

/// Extents, periods and straight walls of the region that the fluid fills.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Lower left corner (length).
    pub origin: [f64; 2],
    /// Periods in x and y (length); `None` if the fluid is unbounded or ends at a wall.
    pub periods: Periods,
    /// Heights of the no-slip walls below and above (length).
    pub walls: Option<[f64; 2]>,
}

/// Extents, periods and walls of a region about the origin.
impl From<Region> for Domain {
    fn from(region: Region) -> Self {
        let [_, height] = region.lengths();
        let walls = (region.drive().is_some() || height < f64::INFINITY && region.is_axisymmetric())
            .then_some([-0.5 * height, 0.5 * height]);
        let origin = region.lengths().map(|length| if length.is_finite() { -0.5 * length } else { 0.0 });
        Self { origin, periods: region.periods().into(), walls }
    }
}

/// Load of the fluid on an obstacle at rest, a closed rigid wall, per unit of depth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[doc(alias("drag", "lift", "torque"))]
pub struct ObstacleLoad {
    /// Centroid of its area (length).
    pub centroid: Vec2,
    /// Force of the fluid on it (force).
    pub force: Vec2,
    /// Torque of the fluid on it about its centroid (force times length), counter-clockwise.
    pub torque: f64,
    /// First moment about the height of its centroid of the forces along x on it (force times length).
    pub shear: f64,
}

/// Outline of a rigid wall at rest, besides the straight walls of the domain.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WallOutline {
    /// Points at equally spaced parameters of a smooth curve, of one period if it is open (length). The fluid is on the
    /// left of an open wall, and on the right of a closed one.
    pub points: Vec<Vec2>,
    /// Advance over one period (length); zero for a closed wall.
    pub period: Vec2,
}

/// The fluid as a body sees it: its region, the viscosity around the body, and its resolution.
#[derive(Debug, Clone, PartialEq)]
pub struct FluidView {
    /// The region.
    pub domain: Domain,
    /// Viscosity of the exterior fluid, or, for a body inside an interface, the viscosity of the fluid around it
    /// (stress times time).
    pub viscosity: f64,
    /// Grid spacing (length); `None` if there is no grid.
    pub spacing: Option<f64>,
    /// `true` if the error of the velocities of interfaces is of second order in the spacing or better, `false` for the
    /// first.
    pub second_order: bool,
    /// Fourier modes along an interface that the flow resolves; `None` if the markers themselves are the resolution.
    pub shape_modes: Option<usize>,
    /// Nodes of an interface, as the description has them: as many as modes, or more where the flow leaves out the
    /// largest waves. Warnings speak of nodes. `None` if the markers themselves are the resolution.
    pub nodes: Option<usize>,
    /// Fastest relaxation of an interface in this discretisation, in units of tension/viscosity (1/length): a marker
    /// displacement normal to an interface of tension gamma decays at most at the rate `stiffness * gamma / viscosity`,
    /// with the mean of the viscosities on both sides. It is a quarter of the largest wave number on a flat interface.
    pub interface_stiffness: f64,
}

impl FluidView {
    /// Returns the view of a body in fluid of that viscosity (stress times time); `None` for the exterior fluid.
    pub(crate) fn in_fluid(&self, viscosity: Option<f64>) -> Cow<'_, Self> {
        match viscosity {
            Some(viscosity) => Cow::Owned(Self { viscosity, ..self.clone() }),
            None => Cow::Borrowed(self),
        }
    }
}

/// Work done since the start, for reports and for tests that pin it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct FlowWork {
    /// Evaluations of marker velocities.
    pub evaluations: usize,
    /// Stokes solves on a grid.
    pub stokes_solves: usize,
    /// Forward and inverse two-dimensional transforms on a grid.
    pub transforms: usize,
    /// Markers spread to a grid.
    pub markers_spread: usize,
    /// Mobility corrections of an interface.
    pub corrections: usize,
    /// Iterations of iterative solvers.
    pub iterations: usize,
    /// The most iterations that one evaluation took.
    pub most_iterations: usize,
}

impl FlowWork {
    /// Adds one evaluation, during which the work of a flow went from `before` to `after`.
    pub(crate) fn add(&mut self, before: Self, after: Self) {
        self.evaluations += after.evaluations - before.evaluations;
        self.stokes_solves += after.stokes_solves - before.stokes_solves;
        self.transforms += after.transforms - before.transforms;
        self.markers_spread += after.markers_spread - before.markers_spread;
        self.corrections += after.corrections - before.corrections;
        let iterations = after.iterations - before.iterations;
        self.iterations += iterations;
        self.most_iterations = self.most_iterations.max(iterations);
    }
}

/// Computes velocities at the markers of all bodies from the forces they put on the fluid. Implement this trait for
/// your own flow.
///
/// An implementation owns its scratch memory, and allocates nothing per call while the numbers of markers stay the
/// same.
#[doc(alias("Stokes flow", "mobility", "flow solver"))]
pub trait Hydrodynamics: std::fmt::Debug + Send {
    /// Returns the fluid as bodies see it.
    fn fluid_view(&self) -> FluidView;

    /// Returns the mean pressure gradient or flux that drives the flow along a channel; by default none is stated.
    fn drive(&self) -> Option<Drive> {
        None
    }

    /// Imposes a flow in place of the one that there was, with images that it has displaced by a strain (no dimension),
    /// the time integral of the shear rate; by default only none is possible.
    ///
    /// # Errors
    /// Returns an error for a flow that the method or the region does not have.
    fn impose(&mut self, flow: ImposedFlow, strain: f64) -> Result<(), FlowError> {
        if flow.is_none() && strain == 0.0 {
            return Ok(());
        }
        Err(FlowError::unsupported("an imposed flow", "Use boundary integrals (the method `integral`)"))
    }

    /// Returns the imposed flow. Velocities and samples are the sum of it and of the flow of the bodies. The flow that
    /// the drive of a channel causes is not part of it.
    fn imposed(&self) -> ImposedFlow {
        ImposedFlow::NONE
    }

    /// Returns the strain by which images are displaced (no dimension): one above by that times the period across.
    fn strain(&self) -> f64 {
        0.0
    }

    /// Returns the rigid walls and obstacles at rest that there are besides the straight walls of the domain, sorted,
    /// with what is rigid to the left of their sides; by default none.
    fn walls(&self) -> Option<&Boundary> {
        None
    }

    /// Returns the distance of the nodes of [`Hydrodynamics::walls`] at each of their sides (length), which shows
    /// whether gaps at the walls are resolved; by default empty, which means unknown.
    fn wall_spacings(&self) -> &[f64] {
        &[]
    }

    /// Returns the slip lengths of the lower and the upper straight wall (length), zero without slip, if the forces on
    /// these walls follow from the forces on the fluid ([`crate::ChannelForces`]). For this, the walls have to be
    /// straight and at rest apart from an imposed flow. Nothing else may hold the fluid than obstacles and friction,
    /// which are stated. By default `None`.
    fn wall_slip(&self) -> Option<[f64; 2]> {
        None
    }

    /// Returns what the fluid does to each rigid wall besides the straight walls of the domain, in the last evaluation.
    /// It is `None` for a wall that is not closed, behind which there is fluid too. By default there are no such walls.
    fn obstacle_loads(&self) -> Vec<Option<ObstacleLoad>> {
        Vec::new()
    }

    /// Returns the outlines of the rigid walls besides the straight walls of the domain, in the order of
    /// [`Hydrodynamics::obstacle_loads`]. By default there are none.
    fn wall_outlines(&self) -> Vec<WallOutline> {
        Vec::new()
    }

    /// Returns the friction alpha of the fluid with plates below and above it (stress times time per length squared),
    /// zero by default.
    fn friction(&self) -> f64 {
        0.0
    }

    /// Returns true if bodies are of revolution about the x axis, whose markers lie on the meridian and its mirror
    /// image, with the forces on halves of rings; by default false.
    fn axisymmetric(&self) -> bool {
        false
    }

    /// Fills `markers.velocities` from `markers.positions` and `markers.forces`, and reports the force dipoles by which
    /// it keeps bodies rigid ([`Markers::set_rigid_dipole`]).
    ///
    /// # Errors
    /// Returns an error for positions or forces that are not finite, markers beyond a wall, no convergence.
    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError>;

    /// Writes the flow at `points` for the positions and forces in `markers` (whose velocities must come from
    /// [`Hydrodynamics::velocities`]); `out` has as many entries as `points`. Use it for pictures and files, not for
    /// steps. Points beyond a wall get the continuation of the flow by the method, which has no physical meaning.
    ///
    /// # Errors
    /// Returns the errors of [`Hydrodynamics::velocities`], and an error for slices of different length.
    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError>;

    /// Returns the work done since the start.
    fn work(&self) -> FlowWork;

    /// Returns the settings of the flow with which results may be off by more than 1 %; by default none.
    fn warnings(&self) -> Vec<Warning> {
        Vec::new()
    }

    /// Returns the state on which the next evaluation depends besides its arguments, such as the last solution, from
    /// which an iteration starts; by default nothing.
    fn save(&self) -> SavedState {
        SavedState::default()
    }

    /// Takes back what [`Hydrodynamics::save`] wrote. What another flow wrote is of no use and ignored.
    fn load(&mut self, _saved: &SavedState) {}

    /// Takes the last evaluation back, so that the next one, with the same markers, repeats it; by default nothing has
    /// to be taken back, because evaluations do not depend on each other beyond a tolerance.
    fn rewind(&mut self) {}
}

/// Hydrodynamics that were chosen at run time.
impl<H: Hydrodynamics + ?Sized> Hydrodynamics for Box<H> {
    motile_base::forwarded! {
        by &self:
        fn fluid_view() -> FluidView;
        fn drive() -> Option<Drive>;
        fn imposed() -> ImposedFlow;
        fn strain() -> f64;
        fn walls() -> Option<&Boundary>;
        fn wall_spacings() -> &[f64];
        fn wall_slip() -> Option<[f64; 2]>;
        fn obstacle_loads() -> Vec<Option<ObstacleLoad>>;
        fn wall_outlines() -> Vec<WallOutline>;
        fn friction() -> f64;
        fn axisymmetric() -> bool;
        fn work() -> FlowWork;
        fn warnings() -> Vec<Warning>;
        fn save() -> SavedState;
        by &mut self:
        fn impose(flow: ImposedFlow, strain: f64) -> Result<(), FlowError>;
        fn velocities(markers: &mut Markers) -> Result<SolveReport, FlowError>;
        fn sample(markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError>;
        fn load(saved: &SavedState);
        fn rewind();
    }
}
