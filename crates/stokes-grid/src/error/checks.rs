//! Checks of grids and of results.

use input_checks::finite;

use crate::{Grid, StokesError};

/// An error that names the first of `fields` that lives on another grid.
pub(crate) fn check_grids(own: &Grid, fields: &[(&'static str, &Grid)]) -> Result<(), StokesError> {
    match fields.iter().find(|(_, grid)| *grid != own) {
        None => Ok(()),
        Some(&(name, _)) => Err(StokesError::GridMismatch { name }),
    }
}

/// Refuses fields that do not fit into memory.
pub(crate) fn check_size(nx: usize, ny: usize) -> Result<(), StokesError> {
    let maximum = Grid::MAXIMUM_CELLS;
    let fits = ny.checked_mul(nx).is_some_and(|cells| cells <= maximum);
    if fits { Ok(()) } else { Err(StokesError::GridTooLarge { nx, ny, maximum }) }
}

/// Why `result` is not finite: something given that is not, or else an overflow.
pub(crate) fn not_finite(result: &'static str, given: &[(&'static str, &[f64])]) -> StokesError {
    let found = given.iter().find_map(|&(name, values)| values.iter().find_map(|&value| finite(name, value).err()));
    found.map_or(StokesError::Overflow { name: result }, StokesError::Input)
}
