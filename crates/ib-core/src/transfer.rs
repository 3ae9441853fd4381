//! Spreading forces to the grid and interpolating velocities from it.

mod anywhere;
#[cfg(feature = "rayon")]
mod bands;
mod inside;
mod lanes;
mod spots;
mod visits;

use stokes_grid::{Grid, StaggeredField};

use crate::kernel::CUBIC_QUADRATIC;
use crate::{Kernel, Vec2};
use anywhere::Anywhere;
use inside::{CubicQuadratics, Interpolation, Spreading};
use spots::{Spot, Spots};
use visits::STRIDE;

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
/// Weights are not kept but computed twice: for the kernels that are polynomials ([`Kernel::pieces`]) that is faster
/// than to read them from memory. Where the machine has fused multiply-add it is used, so that results differ between
/// machines by round-off; on one machine they do not depend on the number of threads (feature `rayon`).
#[derive(Debug, Clone)]
pub struct Transfer<K> {
    kernel: K,
    grid: Grid,
    spots: Spots,
    #[cfg(feature = "rayon")]
    bands: bands::Bands,
}

impl<K: Kernel> Transfer<K> {
    /// A transfer between markers and the fields of `grid`.
    #[must_use]
    pub fn new(grid: Grid, kernel: K) -> Self {
        Self {
            kernel,
            grid,
            spots: Spots::new(&grid),
            #[cfg(feature = "rayon")]
            bands: bands::Bands::default(),
        }
    }

    /// The kernel.
    #[must_use]
    pub fn kernel(&self) -> &K {
        &self.kernel
    }

    /// Takes the `positions` of markers (length, not wrapped). They must be finite: what is not lands somewhere in
    /// the box ([`crate::ImmersedBoundary`] refuses it).
    pub fn locate(&mut self, positions: &[Vec2]) {
        self.spots.find(self.kernel.pieces(), positions);
        #[cfg(feature = "rayon")]
        self.bands.find(Anywhere::new(&self.kernel, &self.grid), &self.spots);
    }

    /// Adds the force density of the located markers to `density` (force per volume), thesis (2.33). `forces` (force)
    /// has an entry for each of them.
    pub fn spread(&self, forces: &[Vec2], density: &mut StaggeredField) {
        let scale = 1.0 / (self.grid.spacing() * self.grid.spacing());
        let anywhere = Anywhere::new(&self.kernel, &self.grid);
        let (fx, fy) = density.components_mut();
        #[cfg(feature = "rayon")]
        if self.bands.are_used() {
            self.bands.spread(anywhere, &self.spots, forces, scale, [fx, fy]);
            return;
        }
        let markers = Markers {
            spots: self.spots.all(),
            forces,
            stride: stride(&self.kernel),
            elsewhere: self.spots.elsewhere(),
        };
        spread(anywhere, scale, markers, Band { first_row: 0, fx, fy });
    }

    /// The velocities at the located markers (length per time), thesis (2.34). `velocities` has an entry for each of
    /// them.
    pub fn interpolate(&self, velocity: &StaggeredField, velocities: &mut [Vec2]) {
        let anywhere = Anywhere::new(&self.kernel, &self.grid);
        let elsewhere = self.spots.elsewhere();
        #[cfg(feature = "rayon")]
        if self.bands.are_used() {
            bands::interpolate(anywhere, self.spots.all(), elsewhere, velocity, velocities);
            return;
        }
        interpolate(anywhere, self.spots.all(), elsewhere, velocity, velocities);
    }
}

/// Markers to be spread.
#[derive(Debug)]
struct Markers<'a> {
    spots: &'a [Spot],
    forces: &'a [Vec2],
    /// Distance within a block from one marker to that which is added next.
    stride: usize,
    elsewhere: &'a [[f64; 2]],
}

/// Some rows of both components.
#[derive(Debug)]
struct Band<'a> {
    first_row: usize,
    fx: &'a mut [f64],
    fy: &'a mut [f64],
}

/// The distance between markers that are added one after another.
fn stride<K: Kernel>(kernel: &K) -> usize {
    // Other kernels take so long that it does not matter.
    if kernel.pieces().is_some() { STRIDE } else { 1 }
}

fn spread<K: Kernel>(anywhere: Anywhere<'_, K>, scale: f64, markers: Markers<'_>, band: Band<'_>) {
    if let Some(pieces) = anywhere.kernel().pieces() {
        if *pieces == CUBIC_QUADRATIC {
            lanes::dispatch(Spreading { anywhere, pieces: CubicQuadratics, scale, markers, band });
        } else {
            lanes::dispatch(Spreading { anywhere, pieces, scale, markers, band });
        }
    } else {
        for (spot, force) in markers.spots.iter().zip(markers.forces) {
            if let Some(place) = markers.elsewhere.get(spot.kind as usize) {
                anywhere.add(*place, (scale * force).into(), band.first_row, band.fx, band.fy);
            }
        }
    }
}

fn interpolate<K: Kernel>(
    anywhere: Anywhere<'_, K>,
    spots: &[Spot],
    elsewhere: &[[f64; 2]],
    velocity: &StaggeredField,
    velocities: &mut [Vec2],
) {
    let (u, v) = (velocity.x(), velocity.y());
    if let Some(pieces) = anywhere.kernel().pieces() {
        if *pieces == CUBIC_QUADRATIC {
            let pieces = CubicQuadratics;
            lanes::dispatch(Interpolation { anywhere, pieces, spots, elsewhere, u, v, velocities });
        } else {
            lanes::dispatch(Interpolation { anywhere, pieces, spots, elsewhere, u, v, velocities });
        }
    } else {
        for (spot, out) in spots.iter().zip(velocities) {
            if let Some(place) = elsewhere.get(spot.kind as usize) {
                *out = anywhere.gather(*place, u, v).into();
            }
        }
    }
}
