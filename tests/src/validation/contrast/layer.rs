//! A viscosity that is no droplet's: a smooth layer, with a flow that is known.

use std::f64::consts::TAU;

use motile::stokes_grid::{
    CentreField, ChannelStokes, Grid, PeriodicStokes, StaggeredField, StokesSolver, TwoPhaseStokes,
};

use crate::validation::StudyError;

/// Errors of the flow in a layered fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerErrors {
    /// Largest error of the velocity, relative to the fastest velocity.
    pub velocity: f64,
    /// Largest error of the pressure, relative to the viscous stress of the thin fluid.
    pub pressure: f64,
    /// Iterations to a residual of 1e-10.
    pub iterations: usize,
}

/// A layer `ratio` times as viscous as the rest, with edges about a tenth of the height wide, in the flow of
/// `psi = y^2 (1-y)^2 (2 + sin 2 pi x)` between walls at y = 0 and 1 or `psi = sin 2 pi y (2 + sin 2 pi x)` in a unit
/// box, driven by the forces that this takes.
#[derive(Debug, Clone, Copy)]
struct Layer {
    ratio: f64,
    walls: bool,
}

/// Central differences, good to nine digits.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    let e = 1e-3;
    (8.0 * (f(e) - f(-e)) - (f(2.0 * e) - f(-2.0 * e))) / (12.0 * e)
}

impl Layer {
    fn viscosity(self, y: f64) -> f64 {
        // Periodic, one in the middle of the box.
        let inside = 0.5 * (1.0 - ((TAU * y).cos() / 0.5).tanh() / (2.0_f64).tanh());
        self.ratio.powf(inside)
    }

    fn velocity(self, x: f64, y: f64) -> [f64; 2] {
        let (shape, slope) = if self.walls {
            (y * y * (1.0 - y) * (1.0 - y), 2.0 * y * (1.0 - y) * (1.0 - 2.0 * y))
        } else {
            ((TAU * y).sin() / TAU, (TAU * y).cos())
        };
        [slope * (2.0 + (TAU * x).sin()), -shape * TAU * (TAU * x).cos()]
    }

    fn pressure(self, x: f64, y: f64) -> f64 {
        (TAU * x).sin() * (TAU * y).cos()
    }

    /// Components xx, xy and yy of `2 eta D - p`.
    fn stress(self, x: f64, y: f64) -> [f64; 3] {
        let dx = |c: usize| slope(|e| self.velocity(x + e, y)[c]);
        let dy = |c: usize| slope(|e| self.velocity(x, y + e)[c]);
        let (eta, p) = (self.viscosity(y), self.pressure(x, y));
        [2.0 * eta * dx(0) - p, eta * (dy(0) + dx(1)), 2.0 * eta * dy(1) - p]
    }

    fn force(self, x: f64, y: f64) -> [f64; 2] {
        let dx = |c: usize| slope(|e| self.stress(x + e, y)[c]);
        let dy = |c: usize| slope(|e| self.stress(x, y + e)[c]);
        [-dx(0) - dy(1), -dx(1) - dy(2)]
    }

    fn errors<S: StokesSolver>(self, solver: S) -> Result<LayerErrors, StudyError> {
        let grid = *solver.grid();
        let mut flow = TwoPhaseStokes::new(solver)?.with_tolerance(1e-10)?;
        flow.set_viscosity(|_, y| self.viscosity(y))?;
        let force = fill(&grid, |x, y| self.force(x, y));
        let mut velocity = StaggeredField::zeros(grid);
        let iterations = flow.solve(&force, &mut velocity)?.iterations;
        let exact = fill(&grid, |x, y| self.velocity(x, y));
        let pairs = velocity.x().iter().zip(exact.x()).chain(velocity.y().iter().zip(exact.y()));
        let fastest = exact.x().iter().chain(exact.y()).fold(0.0_f64, |most, u| most.max(u.abs()));
        let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / fastest;
        let mut pressure = CentreField::zeros(grid);
        flow.pressure(&force, &velocity, &mut pressure)?;
        let (nx, h) = (grid.nx(), grid.spacing());
        let differences: Vec<f64> = pressure
            .values()
            .iter()
            .enumerate()
            .map(|(k, p)| p - self.pressure(((k % nx) as f64 + 0.5) * h, ((k / nx) as f64 + 0.5) * h))
            .collect();
        let mean = differences.iter().sum::<f64>() / differences.len() as f64;
        let pressure = differences.iter().map(|d| (d - mean).abs()).fold(0.0, f64::max) / (fastest * TAU);
        Ok(LayerErrors { velocity: error, pressure, iterations })
    }
}

fn fill(grid: &Grid, value: impl Fn(f64, f64) -> [f64; 2]) -> StaggeredField {
    let (nx, h) = (grid.nx(), grid.spacing());
    let mut field = StaggeredField::zeros(*grid);
    let (x, y) = field.components_mut();
    for (k, x) in x.iter_mut().enumerate() {
        *x = value((k % nx) as f64 * h, ((k / nx) as f64 + 0.5) * h)[0];
    }
    for (k, y) in y.iter_mut().enumerate() {
        *y = value(((k % nx) as f64 + 0.5) * h, (k / nx) as f64 * h)[1];
    }
    field
}

/// Errors with `cells` cells each way, in a unit box or between walls.
///
/// # Errors
/// No convergence.
pub fn layer_errors(ratio: f64, walls: bool, cells: usize) -> Result<LayerErrors, StudyError> {
    let (layer, h) = (Layer { ratio, walls }, 1.0 / cells as f64);
    if walls {
        layer.errors(ChannelStokes::new(Grid::channel(cells, cells, h)?.with_origin([0.0; 2])?, 1.0)?)
    } else {
        layer.errors(PeriodicStokes::new(Grid::periodic(cells, cells, h)?.with_origin([0.0; 2])?, 1.0)?)
    }
}
