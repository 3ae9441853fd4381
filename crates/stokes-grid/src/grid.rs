//! Rectangular grids of square cells.

use motile_base::{finite, internal::all_finite, positive};

use crate::StokesError;

/// A rectangle of `nx` x `ny` square cells of width `h`, periodic in x, and in y either periodic or bounded by two
/// walls.
///
/// Quantities are staggered (marker-and-cell layout). With the lower left corner at `origin`:
///
/// | quantity | position of entry (i, j) | rows, periodic | rows, channel |
/// |---|---|---|---|
/// | x velocity, x force | (i h, (j + 1/2) h) | ny | ny |
/// | y velocity, y force | ((i + 1/2) h, j h) | ny | ny + 1, the first and the last on the walls |
/// | centres (pressure) | ((i + 1/2) h, (j + 1/2) h) | ny | ny |
/// | nodes (streamfunction, vorticity) | (i h, j h) | ny | ny + 1, the first and the last on the walls |
///
/// Every row has `nx` entries, contiguous in memory; entry (i, j) is number `j * nx + i`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("MAC grid", "staggered grid", "marker and cell"))]
pub struct Grid {
    nx: usize,
    ny: usize,
    h: f64,
    origin: [f64; 2],
    walls: bool,
}

impl Grid {
    /// Minimum number of cells in each direction: with one cell a periodic difference is zero.
    pub const MINIMUM_CELLS: usize = 2;

    /// Largest number of cells in all: the velocities take 1 GB, and a scene has about ten such fields.
    pub const MAXIMUM_CELLS: usize = 1 << 26;

    /// Creates a doubly periodic box of `nx` x `ny` cells of width `h` (length), centred on the origin of coordinates.
    ///
    /// # Errors
    /// Returns an error for fewer than [`Grid::MINIMUM_CELLS`] cells in a direction, more than [`Grid::MAXIMUM_CELLS`]
    /// in all, a width that is not positive and finite, or extents that are not finite.
    pub fn periodic(nx: usize, ny: usize, h: f64) -> Result<Self, StokesError> {
        Self::new(nx, ny, h, false)
    }

    /// Creates a channel of `nx` x `ny` cells of width `h` (length), periodic in x with walls at the first and last row
    /// of nodes, centred on the origin of coordinates (walls at y = -ny h/2 and y = ny h/2).
    ///
    /// # Errors
    /// Returns the errors of [`Grid::periodic`].
    pub fn channel(nx: usize, ny: usize, h: f64) -> Result<Self, StokesError> {
        Self::new(nx, ny, h, true)
    }

    fn new(nx: usize, ny: usize, h: f64, walls: bool) -> Result<Self, StokesError> {
        if nx < Self::MINIMUM_CELLS || ny < Self::MINIMUM_CELLS {
            return Err(StokesError::grid_too_small(nx, ny, Self::MINIMUM_CELLS));
        }
        positive("grid spacing", h)?;
        Self::check_size(nx, ny)?;
        let lengths = [nx, ny].map(|cells| cells as f64 * h);
        all_finite("the extents of the grid", &lengths)?;
        let origin = lengths.map(|length| -0.5 * length);
        Ok(Self { nx, ny, h, origin, walls })
    }

    /// Refuses more than [`Grid::MAXIMUM_CELLS`] values.
    pub(crate) fn check_size(nx: usize, ny: usize) -> Result<(), StokesError> {
        let maximum = Self::MAXIMUM_CELLS;
        let fits = ny.checked_mul(nx).is_some_and(|cells| cells <= maximum);
        if fits { Ok(()) } else { Err(StokesError::grid_too_large(nx, ny, maximum)) }
    }

    /// Refuses fields that belong to another grid, by the name of the first.
    pub(crate) fn check<const N: usize>(&self, fields: [(&'static str, &Self); N]) -> Result<(), StokesError> {
        match fields.into_iter().find(|(_, grid)| *grid != self) {
            None => Ok(()),
            Some((name, _)) => Err(StokesError::grid_mismatch(name)),
        }
    }

    /// Returns a copy of the grid with its lower left corner at `origin` (length).
    ///
    /// # Errors
    /// Returns an error for a coordinate that is not finite.
    pub fn with_origin(mut self, origin: [f64; 2]) -> Result<Self, StokesError> {
        self.origin = [finite("grid origin", origin[0])?, finite("grid origin", origin[1])?];
        Ok(self)
    }

    /// Returns the cells in x.
    #[must_use]
    pub fn nx(&self) -> usize {
        self.nx
    }

    /// Returns the cells in y.
    #[must_use]
    pub fn ny(&self) -> usize {
        self.ny
    }

    /// Returns the cell width h (length).
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.h
    }

    /// Returns the lower left corner (length).
    #[must_use]
    pub fn origin(&self) -> [f64; 2] {
        self.origin
    }

    /// Returns the extents `[nx h, ny h]` (length).
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        [self.nx as f64 * self.h, self.ny as f64 * self.h]
    }

    /// Returns true if y is bounded by no-slip walls, false if it is periodic.
    #[must_use]
    pub fn has_walls(&self) -> bool {
        self.walls
    }

    /// Returns the rows of x velocities and of centres: `ny`.
    #[must_use]
    pub fn centre_rows(&self) -> usize {
        self.ny
    }

    /// Returns the rows of y velocities and of nodes: `ny`, or `ny + 1` with walls.
    #[must_use]
    pub fn node_rows(&self) -> usize {
        self.ny + usize::from(self.walls)
    }
}

#[cfg(test)]
mod tests;
