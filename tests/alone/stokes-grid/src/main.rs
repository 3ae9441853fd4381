//! The flow of a known force in a periodic box, and the order of its error.

use std::f64::consts::TAU;

use stokes_grid::{Grid, PeriodicStokes, StaggeredField, StokesError, StokesSolver, Vec2};

/// Returns the largest error of the velocity on n × n cells of the unit square.
fn error(n: usize) -> Result<f64, StokesError> {
    let grid = Grid::periodic(n, n, 1.0 / n as f64)?.with_origin([0.0; 2])?;
    // This velocity has no divergence, and its Laplacian is -2 k² times itself.
    let exact = |x: Vec2| Vec2::new((TAU * x.x).sin() * (TAU * x.y).cos(), -(TAU * x.x).cos() * (TAU * x.y).sin());
    let pressure_gradient = |x: Vec2| TAU * Vec2::new((TAU * x.x).cos(), (TAU * x.y).cos());
    let viscosity = 3.0;
    let force = |x: Vec2| 2.0 * TAU * TAU * viscosity * exact(x) + pressure_gradient(x);

    let mut solver = PeriodicStokes::new(grid, viscosity)?;
    let mut velocity = StaggeredField::zeros(grid);
    solver.solve(&StaggeredField::from_fn(grid, force), &mut velocity)?;
    let exact = StaggeredField::from_fn(grid, exact);
    let pairs = velocity.x().iter().zip(exact.x()).chain(velocity.y().iter().zip(exact.y()));
    Ok(pairs.map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max))
}

fn main() -> Result<(), StokesError> {
    let [coarse, fine] = [error(32)?, error(64)?];
    let order = (coarse / fine).log2();
    println!("error {fine:.2e} on 64 x 64 cells, order {order:.3}");
    assert!(fine < 1e-3 && (order - 2.0).abs() < 0.01);
    Ok(())
}
