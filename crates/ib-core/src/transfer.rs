//! Spreading forces to the grid and interpolating velocities from it.

mod anywhere;
mod inside;
mod lanes;

use stokes_grid::{Grid, StaggeredField};

use crate::{Kernel, Vec2};
use anywhere::Anywhere;
use inside::{Interpolation, Spreading};

/// Transfer between markers and a staggered grid, the adjoint pair of the immersed boundary method (thesis (2.33),
/// (2.34)):
///
/// * spreading: `f(x) = sum_k F_k delta_h(x - X_k)`, F_k the force (not density) of marker k;
/// * interpolation: `U_k = sum over grid points u(x) delta_h(x - X_k) h^2`.
///
/// Both use the same weights at the places given to [`Transfer::locate`], so that `sum_k F_k . U_k` equals
/// `sum f . u h^2` to round-off. Positions are wrapped into a periodic box; at a wall the weights beyond it are folded
/// back, odd for the x component and even for the y component, so that the interpolated velocity vanishes on the
/// wall (docs/method.md, section 2).
///
/// Weights are not kept but computed twice: for the kernels that are polynomials ([`Kernel::pieces`]) that is faster than
/// to read them from memory.
#[derive(Debug, Clone)]
pub struct Transfer<K> {
    kernel: K,
    grid: Grid,
    /// In units of h from the origin of the grid, wrapped where the box is periodic.
    places: Vec<[f64; 2]>,
}

impl<K: Kernel> Transfer<K> {
    /// A transfer between markers and the fields of `grid`.
    #[must_use]
    pub fn new(grid: Grid, kernel: K) -> Self {
        Self { kernel, grid, places: Vec::new() }
    }

    /// The kernel.
    #[must_use]
    pub fn kernel(&self) -> &K {
        &self.kernel
    }

    /// Takes the `positions` of markers (length, not wrapped). They must be finite: what is not lands somewhere in
    /// the box ([`crate::ImmersedBoundary`] refuses it).
    pub fn locate(&mut self, positions: &[Vec2]) {
        let (scale, [x0, y0]) = (1.0 / self.grid.spacing(), self.grid.origin());
        let [columns, rows] = [self.grid.nx() as f64, self.grid.ny() as f64];
        let wraps = !self.grid.has_walls();
        // Wrapping before the weights keeps the column arithmetic exact for droplets that have travelled far.
        let wrapped = |x: f64, period: f64| if (0.0..period).contains(&x) { x } else { x.rem_euclid(period) };
        self.places.clear();
        self.places.extend(positions.iter().map(|position| {
            let y = scale * (position.y - y0);
            [wrapped(scale * (position.x - x0), columns), if wraps { wrapped(y, rows) } else { y }]
        }));
    }

    /// Adds the force density of the located markers to `density` (force per volume), thesis (2.33). `forces` (force) has an
    /// entry for each of them.
    pub fn spread(&self, forces: &[Vec2], density: &mut StaggeredField) {
        let scale = 1.0 / (self.grid.spacing() * self.grid.spacing());
        let anywhere = Anywhere::new(&self.kernel, &self.grid);
        let (fx, fy) = density.components_mut();
        if let Some(pieces) = self.kernel.pieces() {
            lanes::dispatch(Spreading { anywhere, pieces, places: &self.places, forces, scale, fx, fy });
        } else {
            for (place, force) in self.places.iter().zip(forces) {
                anywhere.add(*place, [scale * force.x, scale * force.y], fx, fy);
            }
        }
    }

    /// The velocities at the located markers (length per time), thesis (2.34). `velocities` has an entry for each of them.
    pub fn interpolate(&self, velocity: &StaggeredField, velocities: &mut [Vec2]) {
        let anywhere = Anywhere::new(&self.kernel, &self.grid);
        let (u, v) = (velocity.x(), velocity.y());
        if let Some(pieces) = self.kernel.pieces() {
            lanes::dispatch(Interpolation { anywhere, pieces, places: &self.places, u, v, velocities });
        } else {
            for (place, out) in self.places.iter().zip(velocities) {
                *out = anywhere.gather(*place, u, v).into();
            }
        }
    }
}
