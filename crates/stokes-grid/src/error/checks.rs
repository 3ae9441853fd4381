//! What is checked before any work.

use crate::{Grid, StokesError};

pub(crate) fn check_viscosity(value: f64) -> Result<(), StokesError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(StokesError::NotPositive { name: "viscosity", value }) }
}

/// An error that names the first of `fields` that lives on another grid.
pub(crate) fn check_grids(own: &Grid, fields: &[(&'static str, &Grid)]) -> Result<(), StokesError> {
    match fields.iter().find(|(_, grid)| *grid != own) {
        None => Ok(()),
        Some(&(name, _)) => Err(StokesError::GridMismatch { name }),
    }
}

pub(crate) fn check_finite(name: &'static str, value: f64) -> Result<(), StokesError> {
    if value.is_finite() { Ok(()) } else { Err(StokesError::NotFinite { name, value }) }
}

/// Why `result` is not finite: something given that is not, or else an overflow.
pub(crate) fn not_finite(result: &'static str, given: &[(&'static str, &[f64])]) -> StokesError {
    for (name, values) in given {
        if let Some(&value) = values.iter().find(|value| !value.is_finite()) {
            return StokesError::NotFinite { name, value };
        }
    }
    StokesError::Overflow { name: result }
}
