//! One step of each kind of scene, beside the transforms it contains: `cargo bench --bench step`.

use criterion::{Criterion, criterion_group, criterion_main};
use motile::Swimmer;
use motile::ib_core::{Hydrodynamics, Integrator, Scene};
use motile::stokes_grid::{Drive, Grid, PeriodicStokes, StaggeredField, StokesSolver};

fn step<H: Hydrodynamics, I: Integrator>(group: &mut Criterion, name: &str, mut scene: Scene<H, I>) {
    // A step small enough that thousands of them stay in the same regime.
    scene.step(1e-4).expect("a good scene");
    group.bench_function(name, |b| b.iter(|| scene.step(1e-4).expect("a good scene")));
}

fn scenes(c: &mut Criterion) {
    for cells in [120, 240] {
        let spacing = 6.0 / f64::from(cells);
        let grid = Grid::periodic(cells as usize, cells as usize, spacing).expect("a good grid");
        let mut solver = PeriodicStokes::new(grid, 1.0).expect("a good viscosity");
        let (force, mut velocity) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
        c.bench_function(&format!("two solves, {cells} x {cells}"), |b| {
            b.iter(|| (0..2).for_each(|_| drop(solver.solve(&force, &mut velocity))));
        });
        let swimmer = Swimmer { spacing, ..Swimmer::default() };
        step(c, &format!("box, {cells} x {cells}"), swimmer.build_on_grid().expect("a good swimmer").0);
    }
    let swimmer = Swimmer { lengths: [12.0, 2.0], ..Swimmer::default() };
    step(c, "channel, 240 x 40", swimmer.build_on_grid_in_channel(Drive::ZeroGradient).expect("a good swimmer").0);
    step(c, "box without a grid, 64 nodes", Swimmer::default().build_without_grid().expect("a good swimmer").0);
    let thick = Swimmer { viscosity_inside: Some(1e4), ..Swimmer::default() };
    step(c, "the same at viscosity ratio 100", thick.build_without_grid().expect("a good swimmer").0);
}

criterion_group!(benches, scenes);
criterion_main!(benches);
