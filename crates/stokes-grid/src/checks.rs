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
