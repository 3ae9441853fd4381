//! States that bodies, integrators and flows keep from step to step, as plain numbers.

use motile_base::{InputError, internal::all_finite, same_length};
use serde::{Deserialize, Serialize};

/// Numbers from which an object makes its state again, bitwise; only the object knows what they mean.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SavedState {
    /// Real numbers.
    pub reals: Vec<f64>,
    /// Counts, lengths and flags.
    pub counts: Vec<u64>,
}

/// Record that an observer keeps with a system ([`crate::System::record_mut`]); only the observer knows what it means.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Names and other texts.
    pub texts: Vec<String>,
    /// Numbers.
    pub numbers: Vec<f64>,
}

/// Name of a saved state of another length in messages.
const FOREIGN: &str = "a saved state, of another body or scene,";

impl SavedState {
    /// Returns the counts, if there are N of them.
    ///
    /// # Errors
    /// Returns an error for another number of counts.
    pub fn counts_of<const N: usize>(&self) -> Result<[u64; N], InputError> {
        let wrong = |_| InputError::WrongLength { name: FOREIGN, expected: N, found: self.counts.len() };
        self.counts.as_slice().try_into().map_err(wrong)
    }

    /// Returns the real numbers, if there are `expected` of them and all are finite.
    ///
    /// # Errors
    /// Returns an error for another number of them, or one that is not finite.
    pub fn reals_of(&self, expected: usize) -> Result<&[f64], InputError> {
        same_length(FOREIGN, expected, self.reals.len())?;
        all_finite("a saved state", &self.reals)?;
        Ok(&self.reals)
    }
}
