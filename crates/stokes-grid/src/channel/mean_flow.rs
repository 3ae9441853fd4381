//! Flow along a channel averaged over x.

use crate::Grid;
use motile_base::Drive;

/// Solver for the x velocities averaged over x: `eta (u[j+1] - 2 u[j] + u[j-1]) / h^2 - alpha u[j] = g - f[j]` between
/// walls, with the mean force density f, the mean pressure gradient g and the friction alpha.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeanFlow {
    /// h^2 / eta.
    scale: f64,
    pivots: Vec<f64>,
    h: f64,
    /// Flow of a unit force density, without friction `(y (H - y) / 2 + h^2 / 8) / eta`; the constant comes from the
    /// no-slip condition half a cell from the wall.
    poiseuille: Vec<f64>,
    /// Flux of that flow.
    flux: f64,
    /// Velocity gradients at the bottom and the top wall over those without slip.
    stick: [f64; 2],
}

impl MeanFlow {
    pub(crate) fn new(grid: &Grid, viscosity: f64, friction: f64, stick: [f64; 2]) -> Self {
        let (ny, h) = (grid.ny(), grid.spacing());
        let screening = h * h * friction / viscosity;
        let mut pivots = Vec::with_capacity(ny);
        let mut pivot = 0.0;
        for j in 0..ny {
            // The ghost behind a wall is 2 U - u without slip, 2 s U + (1 - 2 s) u for a gradient of s times that.
            let bottom = if j == 0 { stick[0] } else { 0.5 };
            let top = if j + 1 == ny { stick[1] } else { 0.5 };
            let diagonal = -2.0 - (2.0 * bottom - 1.0) - (2.0 * top - 1.0);
            pivot = 1.0 / (diagonal - screening - pivot);
            pivots.push(pivot);
        }
        let width = grid.lengths()[1];
        let at = |y: f64| (0.5 * y * (width - y) + 0.125 * h * h) / viscosity;
        let parabola = (0..ny).map(|j| at((j as f64 + 0.5) * h)).collect();
        let mut mean = Self { scale: h * h / viscosity, pivots, h, poiseuille: parabola, flux: 0.0, stick };
        if friction > 0.0 || stick != [1.0; 2] {
            let mut flow = vec![1.0; ny];
            mean.substitute([0.0; 2], &mut flow);
            mean.poiseuille = flow;
        }
        mean.flux = h * mean.poiseuille.iter().sum::<f64>();
        mean
    }

    /// Turns the mean force density on each row into its mean velocity, for the mean velocities of the bottom and the
    /// top wall, and returns the mean pressure gradient.
    pub(crate) fn solve(&self, drive: Drive, walls: [f64; 2], u: &mut [f64]) -> f64 {
        self.substitute(walls, u);
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

    /// Turns forces into velocities without a mean pressure gradient.
    fn substitute(&self, walls: [f64; 2], u: &mut [f64]) {
        for u in u.iter_mut() {
            *u *= -self.scale;
        }
        let last = u.len() - 1;
        u[0] -= 2.0 * self.stick[0] * walls[0];
        u[last] -= 2.0 * self.stick[1] * walls[1];
        let mut below = 0.0;
        for (u, pivot) in u.iter_mut().zip(&self.pivots) {
            *u = (*u - below) * pivot;
            below = *u;
        }
        for j in (0..last).rev() {
            u[j] -= self.pivots[j] * u[j + 1];
        }
    }
}
