//! What the parts of a calculation take.

use std::time::Instant;

use crate::modes::Part;
use crate::spectrum::eigenvalues;
use crate::system::System;
use crate::{SteadyError, SteadyState};

/// Time (seconds) of the parts of a Newton iteration and of a spectrum, for disturbances of the symmetry of the state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// The derivative of the rates, by differences.
    pub jacobian: f64,
    /// Bordering and factorising it.
    pub factorisation: f64,
    /// Its eigenvalues.
    pub eigenvalues: f64,
    /// Unknowns.
    pub unknowns: usize,
}

impl SteadyState {
    /// Does each part once more and takes the time.
    ///
    /// # Errors
    /// As [`SteadyState::spectrum`].
    pub fn cost(&self) -> Result<Cost, SteadyError> {
        let mut system = System::new(self.setup())?;
        let part = if self.is_mirror_symmetric() { Part::Even } else { Part::Full };
        let started = Instant::now();
        let matrix = system.jacobian(self.point(), part)?;
        let jacobian = started.elapsed().as_secs_f64();
        let unknowns = system.border(self.point(), part, &matrix, None)?.len();
        let factorisation = started.elapsed().as_secs_f64() - jacobian;
        eigenvalues(&matrix)?;
        let eigenvalues = started.elapsed().as_secs_f64() - jacobian - factorisation;
        Ok(Cost { jacobian, factorisation, eigenvalues, unknowns })
    }
}
