//! Spreading forces to the grid and interpolating velocities from it.

mod anywhere;
#[cfg(feature = "rayon")]
mod bands;
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
            places: Vec::new(),
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
        let (scale, [x0, y0]) = (1.0 / self.grid.spacing(), self.grid.origin());
        let [columns, rows] = [self.grid.nx() as f64, self.grid.ny() as f64];
        let wraps = !self.grid.has_walls();
        // Wrapping before the weights keeps the column arithmetic exact for droplets that have travelled far.
        let wrapped = |x: f64, period: f64| if (0.0..period).contains(&x) { x } else { x.rem_euclid(period) };
        let place = |position: &Vec2| {
            let y = scale * (position.y - y0);
            [wrapped(scale * (position.x - x0), columns), if wraps { wrapped(y, rows) } else { y }]
        };
        self.places.clear();
        self.places.extend(positions.iter().map(place));
        #[cfg(feature = "rayon")]
        self.bands.find(Anywhere::new(&self.kernel, &self.grid), &self.places);
    }

    /// Adds the force density of the located markers to `density` (force per volume), thesis (2.33). `forces` (force) has an
    /// entry for each of them.
    pub fn spread(&self, forces: &[Vec2], density: &mut StaggeredField) {
        let scale = 1.0 / (self.grid.spacing() * self.grid.spacing());
        let anywhere = Anywhere::new(&self.kernel, &self.grid);
        let (fx, fy) = density.components_mut();
        #[cfg(feature = "rayon")]
        if self.bands.are_used() {
            self.bands.spread(anywhere, &self.places, forces, scale, [fx, fy]);
            return;
        }
        spread(anywhere, scale, Band { markers: self.places.iter().zip(forces), first_row: 0, fx, fy });
    }

    /// The velocities at the located markers (length per time), thesis (2.34). `velocities` has an entry for each of them.
    pub fn interpolate(&self, velocity: &StaggeredField, velocities: &mut [Vec2]) {
        let anywhere = Anywhere::new(&self.kernel, &self.grid);
        #[cfg(feature = "rayon")]
        if self.bands.are_used() {
            bands::interpolate(anywhere, &self.places, velocity, velocities);
            return;
        }
        interpolate(anywhere, &self.places, velocity, velocities);
    }
}

/// Some rows of both components and the markers that reach them.
struct Band<'a, M> {
    markers: M,
    first_row: usize,
    fx: &'a mut [f64],
    fy: &'a mut [f64],
}

fn spread<'a, K: Kernel, M: Iterator<Item = (&'a [f64; 2], &'a Vec2)>>(
    anywhere: Anywhere<'_, K>,
    scale: f64,
    band: Band<'_, M>,
) {
    let Band { markers, first_row, fx, fy } = band;
    if let Some(pieces) = anywhere.kernel().pieces() {
        lanes::dispatch(Spreading { anywhere, pieces, scale, markers, first_row, fx, fy });
    } else {
        for (place, force) in markers {
            anywhere.add(*place, (scale * force).into(), first_row, fx, fy);
        }
    }
}

fn interpolate<K: Kernel>(anywhere: Anywhere<'_, K>, places: &[[f64; 2]], velocity: &StaggeredField, out: &mut [Vec2]) {
    let (u, v) = (velocity.x(), velocity.y());
    if let Some(pieces) = anywhere.kernel().pieces() {
        lanes::dispatch(Interpolation { anywhere, pieces, places, u, v, velocities: out });
    } else {
        for (place, out) in places.iter().zip(out) {
            *out = anywhere.gather(*place, u, v).into();
        }
    }
}
