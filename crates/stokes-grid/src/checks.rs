//! What is checked before any work.

use crate::{Grid, StokesError};

pub(crate) fn check_viscosity(value: f64) -> Result<(), StokesError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(StokesError::NotPositive { name: "viscosity", value }) }
}

pub(crate) fn check_grid(solver: &Grid, field: &Grid, name: &'static str) -> Result<(), StokesError> {
    if solver == field { Ok(()) } else { Err(StokesError::GridMismatch { name }) }
}

pub(crate) fn check_finite(name: &'static str, value: f64) -> Result<(), StokesError> {
    if value.is_finite() { Ok(()) } else { Err(StokesError::NotFinite { name, value }) }
}

/// Why a velocity is not finite: a force that is not, or else an overflow.
pub(crate) fn not_finite(fx: &[f64], fy: &[f64]) -> StokesError {
    match fx.iter().chain(fy).find(|f| !f.is_finite()) {
        Some(&value) => StokesError::NotFinite { name: "the force", value },
        None => StokesError::Overflow { name: "the velocity" },
    }
}
