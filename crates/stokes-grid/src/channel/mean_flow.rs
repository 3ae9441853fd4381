//! Flow along a channel averaged over x.

use crate::Grid;
use motile_base::Drive;

/// Solver for the x velocities averaged over x: `eta (u[j+1] - 2 u[j] + u[j-1]) / h^2 = g - f[j]` between walls, with
/// the mean force density f and the mean pressure gradient g.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeanFlow {
    /// h^2 / eta.
    scale: f64,
    pivots: Vec<f64>,
    h: f64,
    /// Flow of a unit force density, `(y (H - y) / 2 + h^2 / 8) / eta`; the constant comes from the no-slip condition
    /// half a cell from the wall.
    poiseuille: Vec<f64>,
    /// Flux of that flow.
    flux: f64,
}

impl MeanFlow {
    pub(crate) fn new(grid: &Grid, viscosity: f64) -> Self {
        let ny = grid.ny();
        let mut pivots = Vec::with_capacity(ny);
        let mut pivot = 0.0;
        for j in 0..ny {
            // The ghost behind a wall is 2 U - u.
            let diagonal = if j == 0 || j + 1 == ny { -3.0 } else { -2.0 };
            pivot = 1.0 / (diagonal - pivot);
            pivots.push(pivot);
        }
        let (h, width) = (grid.spacing(), grid.lengths()[1]);
        let at = |y: f64| (0.5 * y * (width - y) + 0.125 * h * h) / viscosity;
        let poiseuille: Vec<f64> = (0..ny).map(|j| at((j as f64 + 0.5) * h)).collect();
        let flux = h * poiseuille.iter().sum::<f64>();
        Self { scale: h * h / viscosity, pivots, h, poiseuille, flux }
    }

    /// Turns the mean force density on each row into its mean velocity, for the mean velocities of the bottom and the
    /// top wall, and returns the mean pressure gradient.
    pub(crate) fn solve(&self, drive: Drive, walls: [f64; 2], u: &mut [f64]) -> f64 {
        for u in u.iter_mut() {
            *u *= -self.scale;
        }
        let last = u.len() - 1;
        u[0] -= 2.0 * walls[0];
        u[last] -= 2.0 * walls[1];
        let mut below = 0.0;
        for (u, pivot) in u.iter_mut().zip(&self.pivots) {
            *u = (*u - below) * pivot;
            below = *u;
        }
        for j in (0..last).rev() {
            u[j] -= self.pivots[j] * u[j + 1];
        }
        let found = self.h * u.iter().sum::<f64>();
        let gradient = drive.flux().map_or(drive.gradient(), |flux| (found - flux) / self.flux);
        if gradient == 0.0 {
            return 0.0;
        }
        for (u, response) in u.iter_mut().zip(&self.poiseuille) {
            *u -= gradient * response;
        }
        gradient
    }
}
