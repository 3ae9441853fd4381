//! Times of the solvers, in units of plain transforms measured in the same run.

mod channel;
mod periodic;

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use motile::stokes_grid::{Grid, StaggeredField, StokesSolver};

/// A force with all wave numbers in it.
fn random_force(grid: Grid) -> StaggeredField {
    let wave = |count: usize, k: f64| (0..count).map(|i| (k * (i * i) as f64).sin()).collect();
    let (nx, ny) = (grid.nx(), grid.ny());
    let force = StaggeredField::from_components(grid, wave(nx * ny, 1.0), wave(nx * grid.node_rows(), 2.0));
    force.expect("as many values as the grid has points")
}

/// A solve ready to be timed.
fn solve(mut solver: impl StokesSolver) -> impl FnMut() {
    let force = random_force(*solver.grid());
    let mut velocity = StaggeredField::zeros(*solver.grid());
    move || {
        black_box(solver.solve(black_box(&force), &mut velocity)).expect("a good force");
    }
}

/// Short runs: what matters are ratios, which are measured by turns.
fn short() -> Criterion {
    let time = Duration::from_millis(500);
    Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(100)).measurement_time(time)
}

criterion_group! {
    name = solvers;
    config = short();
    targets = periodic::benches, channel::benches
}
criterion_main!(solvers);
