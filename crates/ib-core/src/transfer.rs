//! Spreading forces to the grid and interpolating velocities from it.

#[cfg(feature = "rayon")]
mod bands;
mod general;
mod lanes;
mod locations;
mod order;
mod polynomial;
mod weights;

use motile_base::same_length;
use stokes_grid::{Grid, StaggeredField, StokesError};

use crate::Kernel;
use general::GeneralTransfer;
use locations::Locations;
use motile_base::Vec2;
use order::{Band, Markers, stride};
use polynomial::{interpolate, spread};

/// Transfer between markers and a staggered grid, the adjoint pair of the immersed boundary method (Cowley (2.33),
/// (2.34)):
///
/// * spreading: `f(x) = sum_k F_k delta_h(x - X_k)`, F_k the force (not density) of marker k;
/// * interpolation: `U_k = sum over grid points u(x) delta_h(x - X_k) h^2`.
///
/// Both use the same weights at the places given to [`Transfer::locate`], so that `sum_k F_k . U_k` equals `sum f . u
/// h^2` to round-off. Positions are wrapped into a periodic box. At a wall the weights beyond it are folded back, odd
/// for the x component and even for the y component, so that the interpolated velocity vanishes on the wall
/// (docs/explanation/grid.md).
///
/// Weights are not kept but computed twice: for the kernels that are polynomials ([`Kernel::pieces`]) that is faster
/// than reading them from memory. If the machine has fused multiply-add, it is used, so that results differ between
/// machines by round-off; on one machine they do not depend on the number of threads (feature `rayon`).
///
/// ```
/// use ib_core::{Grid, Peskin4, StaggeredField, StokesError, Transfer, Vec2};
///
/// # fn main() -> Result<(), StokesError> {
/// let grid = Grid::periodic(32, 32, 0.1)?;
/// let mut transfer = Transfer::new(grid, Peskin4);
/// transfer.locate(&[Vec2::new(0.3, 0.4), Vec2::new(-1.2, 0.7)]);
/// let mut density = StaggeredField::zeros(grid);
/// transfer.spread(&[Vec2::new(2.0, 0.0), Vec2::new(1.0, -1.0)], &mut density)?;
/// // The force density has the total force of the markers, 3 along x.
/// let total = 0.1 * 0.1 * density.x().iter().sum::<f64>();
/// println!("total force {total:.3}");
/// assert!((total - 3.0).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
#[doc(alias("spreading", "interpolation", "delta function", "immersed boundary"))]
pub struct Transfer<K> {
    kernel: K,
    grid: Grid,
    locations: Locations,
    #[cfg(feature = "rayon")]
    bands: bands::Bands,
}

impl<K: Kernel> Transfer<K> {
    /// Creates a transfer between markers and the fields of `grid`.
    #[must_use]
    pub fn new(grid: Grid, kernel: K) -> Self {
        Self {
            kernel,
            grid,
            locations: Locations::new(grid),
            #[cfg(feature = "rayon")]
            bands: bands::Bands::default(),
        }
    }

    /// Returns the kernel.
    #[must_use]
    pub fn kernel(&self) -> &K {
        &self.kernel
    }

    fn general(&self) -> GeneralTransfer<'_, K> {
        GeneralTransfer { kernel: &self.kernel, grid: &self.grid }
    }

    /// Takes the `positions` of markers (length, not wrapped). They must be finite, because any other value lands
    /// somewhere in the box ([`crate::ImmersedBoundary`] refuses it).
    pub fn locate(&mut self, positions: &[Vec2]) {
        self.locations.find(self.kernel.pieces(), positions);
        #[cfg(feature = "rayon")]
        self.bands.find(GeneralTransfer { kernel: &self.kernel, grid: &self.grid }, &self.locations);
    }

    /// Adds the force density of the located markers to `density` (force per volume), Cowley (2.33). `forces` (force)
    /// has an entry for each of them.
    ///
    /// # Errors
    /// Returns an error for another number of forces than of markers, a field on another grid.
    pub fn spread(&self, forces: &[Vec2], density: &mut StaggeredField) -> Result<(), StokesError> {
        self.check("the forces", forces.len(), "the force density", density)?;
        let (general, scale) = (self.general(), 1.0 / (self.grid.spacing() * self.grid.spacing()));
        let (fx, fy) = density.components_mut();
        #[cfg(feature = "rayon")]
        if self.bands.are_used() {
            self.bands.spread(general, &self.locations, forces, scale, [fx, fy]);
            return Ok(());
        }
        let Locations { all: locations, irregular, .. } = &self.locations;
        let markers = Markers { locations, forces, stride: stride(&self.kernel), irregular };
        spread(general, scale, markers, Band { first_row: 0, fx, fy });
        Ok(())
    }

    /// Writes the velocities at the located markers (length per time), Cowley (2.34). `velocities` has an entry for
    /// each of them.
    ///
    /// # Errors
    /// Returns an error for another number of velocities than of markers, a field on another grid.
    pub fn interpolate(&self, velocity: &StaggeredField, velocities: &mut [Vec2]) -> Result<(), StokesError> {
        self.check("the velocities", velocities.len(), "the velocity", velocity)?;
        let (general, Locations { all: locations, irregular, .. }) = (self.general(), &self.locations);
        #[cfg(feature = "rayon")]
        if self.bands.are_used() {
            bands::interpolate(general, locations, irregular, velocity, velocities);
            return Ok(());
        }
        interpolate(general, locations, irregular, velocity, velocities);
        Ok(())
    }

    fn check(
        &self,
        list: &'static str,
        entries: usize,
        name: &'static str,
        field: &StaggeredField,
    ) -> Result<(), StokesError> {
        same_length(list, self.locations.all.len(), entries)?;
        if *field.grid() == self.grid { Ok(()) } else { Err(StokesError::grid_mismatch(name)) }
    }
}
