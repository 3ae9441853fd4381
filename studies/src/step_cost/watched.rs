//! Bodies, solvers and flows that note how long they take, so that the library need not.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use motile::base::{FlowSample, SolveReport, Vec2};
use motile::scene::{
    Body, BodyError, FlowError, FlowWork, FluidView, Hydrodynamics, InteriorBody, MarkerKind, Markers, StepInfo,
    StepLimit,
};
use motile::stokes_grid::{CentreField, Grid, StaggeredField, StokesError, StokesSolver, WallMotion, Work};

/// Nanoseconds spent so far, shared between a scene and who looks on.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stopwatch(Arc<AtomicU64>);

impl Stopwatch {
    fn time<T>(&self, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.0.fetch_add(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
        result
    }

    /// Seconds since it was last taken.
    pub(crate) fn take(&self) -> f64 {
        1e-9 * self.0.swap(0, Ordering::Relaxed) as f64
    }
}

/// Times of the parts of a step.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stopwatches {
    /// Geometry, tension and forces of bodies.
    pub(crate) forces: Stopwatch,
    /// Rates of bodies and the implicit parts.
    pub(crate) transport: Stopwatch,
    /// Work of bodies before and after a step.
    pub(crate) upkeep: Stopwatch,
    /// Everything between forces and velocities.
    pub(crate) flow: Stopwatch,
    /// Solves of one viscosity on the grid.
    pub(crate) solve: Stopwatch,
}

/// A body that is watched.
#[derive(Debug)]
pub(crate) struct Watched<B>(pub(crate) B, pub(crate) Stopwatches);

impl<B: Body> Body for Watched<B> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn kind(&self) -> MarkerKind {
        self.0.kind()
    }

    fn marker_count(&self) -> usize {
        self.0.marker_count()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        self.1.forces.time(|| self.0.write_markers(positions));
    }

    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.1.forces.time(|| self.0.write_forces(view, forces))
    }

    fn state_len(&self) -> usize {
        self.0.state_len()
    }

    fn write_state(&self, state: &mut [f64]) {
        self.0.write_state(state);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        self.1.forces.time(|| self.0.read_state(state))
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.1.transport.time(|| self.0.rate(velocities, rate));
    }

    fn begin_step(&mut self, view: &FluidView, step: StepInfo) -> Result<(), BodyError> {
        self.1.upkeep.time(|| self.0.begin_step(view, step))
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        self.1.transport.time(|| self.0.add_implicit(state, factor, out));
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        self.1.transport.time(|| self.0.solve_implicit(factor, state));
    }

    fn end_step(&mut self, view: &FluidView, dt: f64) -> Result<(), BodyError> {
        self.1.upkeep.time(|| self.0.end_step(view, dt))
    }

    fn keep_step(&mut self) {
        self.0.keep_step();
    }

    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        self.0.step_limits(view, limits);
    }

    fn as_interior_body(&mut self) -> Option<&mut dyn InteriorBody> {
        self.0.as_interior_body()
    }
}

impl<H: Hydrodynamics> Hydrodynamics for Watched<H> {
    fn fluid_view(&self) -> FluidView {
        self.0.fluid_view()
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.1.flow.time(|| self.0.velocities(markers))
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        self.0.sample(markers, points, out)
    }

    fn work(&self) -> FlowWork {
        self.0.work()
    }
}

impl<S: StokesSolver> StokesSolver for Watched<S> {
    fn grid(&self) -> &Grid {
        self.0.grid()
    }

    fn viscosity(&self) -> f64 {
        self.0.viscosity()
    }

    fn walls(&self) -> &WallMotion {
        self.0.walls()
    }

    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError> {
        self.1.solve.time(|| self.0.solve(force, velocity))
    }

    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError> {
        self.0.pressure(force, velocity, pressure)
    }

    fn work(&self) -> Work {
        self.0.work()
    }
}
