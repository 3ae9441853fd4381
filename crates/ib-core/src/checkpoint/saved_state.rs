//! What bodies, integrators and flows keep from step to step, as plain numbers.

use serde::{Deserialize, Serialize};

use crate::{BodyError, SceneError};

/// Numbers from which an object makes its state again, bit for bit; only the object knows what they mean.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SavedState {
    /// Real numbers.
    pub reals: Vec<f64>,
    /// Counts, lengths and flags.
    pub counts: Vec<u64>,
}

/// A state of something else.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "a saved state of {found} counts is not one of {what}, which has {expected}: resume the scene that it was saved from"
)]
pub struct ForeignState {
    /// What it should be of.
    pub what: &'static str,
    /// Counts needed.
    pub expected: usize,
    /// Counts found.
    pub found: usize,
}

impl From<ForeignState> for BodyError {
    fn from(error: ForeignState) -> Self {
        Self::Other(Box::new(error))
    }
}

impl From<ForeignState> for SceneError {
    fn from(source: ForeignState) -> Self {
        Self::ForeignCheckpoint { problem: source.to_string() }
    }
}

impl SavedState {
    /// The counts, if there are N of them.
    ///
    /// # Errors
    /// Another number of counts: the state of something else than `what`.
    pub fn counts_of<const N: usize>(&self, what: &'static str) -> Result<[u64; N], ForeignState> {
        let found = self.counts.len();
        self.counts.as_slice().try_into().map_err(|_| ForeignState { what, expected: N, found })
    }
}
