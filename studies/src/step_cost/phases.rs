//! The time of a step by its phases.

use std::time::{Duration, Instant};

use anyhow::Result;
use motile::base::Vec2;
use motile::ib_core::{AnyKernel, Transfer};
use motile::scene::{FlowWork, Hydrodynamics, Scene};
use motile::stokes_grid::{Grid, RealFft2, StaggeredField, Symbol};
use motile_cli::run::Summary;
use motile_timing::{PlainPair, median};

use crate::step_cost::watched::Stopwatches;

/// A scene to be measured.
pub(crate) struct Case<H> {
    /// Description.
    pub(crate) kind: &'static str,
    pub(crate) scene: Scene<H>,
    pub(crate) watches: Stopwatches,
    /// Its grid, or one of usual size beside a method without a grid.
    pub(crate) grid: Grid,
    pub(crate) kernel: AnyKernel,
    pub(crate) dt: f64,
    /// True if the grid is only a measure.
    pub(crate) without_grid: bool,
    /// Unknowns along the interface, without a grid.
    pub(crate) nodes: usize,
}

/// The phases, in the order of a step.
pub(crate) const PHASES: [&str; 9] =
    ["forces", "spread", "transforms", "rest_of_solve", "interpolate", "coupling", "transport", "upkeep", "integrator"];

/// Steps before anything is measured.
const WARM_UP: usize = 5;

impl<H: Hydrodynamics> Case<H> {
    /// Steps the scene for about `budget` by turns with the bare transforms of its grid; medians over the third of the
    /// steps that went fastest.
    pub(crate) fn measure(mut self, budget: Duration) -> Result<Summary> {
        for _ in 0..WARM_UP {
            self.scene.step(self.dt)?;
        }
        let mut pieces = Pieces::new(self.grid, self.kernel)?;
        let walls = self.grid.has_walls();
        let mut pair = PlainPair::new(self.grid.nx(), self.grid.ny());
        let mut phases: Vec<[f64; PHASES.len()]> = Vec::new();
        let mut times = (Vec::new(), Vec::new());
        let before = self.scene.system().hydrodynamics().work();
        let start = Instant::now();
        while phases.len() < 5 || start.elapsed() < budget {
            let bare = seconds(|| pair.run()).min(seconds(|| pair.run()));
            let markers = self.scene.system_mut().evaluate()?;
            let own = if self.without_grid { [0.0; 3] } else { pieces.measure(markers.positions(), markers.forces()) };
            // What the markers' forces are known from is not part of the step that follows.
            let _ = self.take();
            // A step changes the state, so that the first evaluation of the next is remade, as in a run nobody looks
            // at.
            self.scene.step(self.dt)?;
            let _ = self.take();
            let work = self.scene.system().hydrodynamics().work();
            let total = seconds_of(|| self.scene.step(self.dt))?;
            let [forces, transport, upkeep, flow, solve] = self.take();
            let after = self.scene.system().hydrodynamics().work();
            let per_step = |count: fn(&FlowWork) -> usize| (count(&after) - count(&work)) as f64;
            let evaluations =
                if self.without_grid { 0.0 } else { per_step(|work| work.markers_spread) / self.markers() };
            let [spread, transform, interpolate] = own;
            let plain = if walls { seconds(|| pair.rows()).min(seconds(|| pair.rows())) } else { transform };
            // Solves of the solver of one viscosity: a pair of transforms each.
            let transforms = plain * per_step(|work| work.transforms) / 2.0;
            let transforms = transforms.min(solve);
            let (spread, interpolate) = (spread * evaluations, interpolate * evaluations);
            let coupling = flow - solve - spread - interpolate;
            let integrator = total - forces - transport - upkeep - flow;
            phases.push([
                forces,
                spread,
                transforms,
                solve - transforms,
                interpolate,
                coupling,
                transport,
                upkeep,
                integrator,
            ]);
            times.0.push(total);
            times.1.push(bare);
        }
        let after = self.scene.system().hydrodynamics().work();
        Ok(self.summary(
            &phases,
            times,
            (after.iterations - before.iterations) as f64,
            after.evaluations - before.evaluations,
        ))
    }

    fn markers(&self) -> f64 {
        self.scene.system().markers().positions().len() as f64
    }

    fn take(&self) -> [f64; 5] {
        let Stopwatches { forces, transport, upkeep, flow, solve } = &self.watches;
        [forces, transport, upkeep, flow, solve].map(crate::step_cost::watched::Stopwatch::take)
    }

    fn summary(
        &self,
        phases: &[[f64; PHASES.len()]],
        (steps, pairs): (Vec<f64>, Vec<f64>),
        iterations: f64,
        evaluations: usize,
    ) -> Summary {
        let mut summary = Summary::default();
        let fast = fastest(&steps);
        let (step, pair) = (median_of(&fast, &steps), median_of(&fastest(&pairs), &pairs));
        summary.put("scene", self.kind, "");
        summary.put("nx", self.grid.nx(), "");
        summary.put("ny", self.grid.ny(), "");
        summary.put("grid", !self.without_grid, "");
        summary.put("nodes", self.nodes, "");
        summary.put("markers", self.markers() as usize, "");
        summary.put("steps_measured", phases.len(), "");
        summary.put("dt", self.dt, "");
        summary.put("pair_us", 1e6 * pair, "");
        summary.put("step_us", 1e6 * step, "");
        summary.put("step_pairs", step / pair, "");
        summary.put("iterations_per_evaluation", iterations / evaluations.max(1) as f64, "");
        for (index, name) in PHASES.iter().enumerate() {
            let times: Vec<f64> = phases.iter().map(|phases| phases[index]).collect();
            summary.put(&format!("{name}_us"), 1e6 * median_of(&fast, &times), "");
        }
        summary
    }
}

/// Parts of a step on a grid that can be run by themselves.
struct Pieces {
    transfer: Transfer<AnyKernel>,
    density: StaggeredField,
    velocities: Vec<Vec2>,
    transform: RealFft2,
    symbol: Symbol,
    field: Vec<f64>,
}

impl Pieces {
    fn new(grid: Grid, kernel: AnyKernel) -> Result<Self> {
        let (nx, ny) = (grid.nx(), grid.ny());
        let scale = 1.0 / (nx * ny) as f64;
        Ok(Self {
            transfer: Transfer::new(grid, kernel),
            density: StaggeredField::zeros(grid),
            velocities: Vec::new(),
            transform: RealFft2::new(nx, ny)?,
            symbol: Symbol::new(nx, ny, |_, _| scale)?,
            field: (0..nx * ny).map(|i| ((i * i) as f64).sin()).collect(),
        })
    }

    /// Seconds of one spreading, one forward and one inverse real FFT, and one interpolation.
    fn measure(&mut self, positions: &[Vec2], forces: &[Vec2]) -> [f64; 3] {
        self.velocities.resize(positions.len(), Vec2::ZERO);
        let Self { transfer, density, velocities, transform, symbol, field } = self;
        let nx = density.grid().nx();
        let spread = twice(|| {
            transfer.locate(positions);
            density.fill(0.0);
            drop(transfer.spread(forces, density));
        });
        let interpolate = twice(|| drop(transfer.interpolate(density, velocities)));
        let transform = twice(|| {
            let mut sum = 0.0;
            let read = |j: usize, row: &mut [f64]| row.copy_from_slice(&field[j * nx..][..nx]);
            drop(transform.filter(symbol, read, |_, row| sum += row[0]));
            std::hint::black_box(sum);
        });
        [spread, transform, interpolate]
    }
}

/// The fastest third of the samples: those that the rest of the machine disturbed least.
fn fastest(times: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|&a, &b| times[a].total_cmp(&times[b]));
    order.truncate(times.len().div_ceil(3));
    order
}

fn median_of(chosen: &[usize], times: &[f64]) -> f64 {
    median(&mut chosen.iter().map(|&k| times[k]).collect::<Vec<_>>())
}

/// The shorter time of two runs: the first may find the caches cold.
fn twice(mut work: impl FnMut()) -> f64 {
    seconds(&mut work).min(seconds(&mut work))
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

fn seconds_of<E>(work: impl FnOnce() -> Result<(), E>) -> Result<f64, E> {
    let start = Instant::now();
    work().map(|()| start.elapsed().as_secs_f64())
}
