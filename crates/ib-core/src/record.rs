//! What bodies, integrators and flows keep from step to step, as plain numbers.

use serde::{Deserialize, Serialize};

use crate::{BodyError, SceneError};

/// Numbers from which an object makes its state again, bit for bit; only the object knows what they mean.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Real numbers.
    pub reals: Vec<f64>,
    /// Counts, lengths and flags.
    pub counts: Vec<u64>,
}

/// A record of something else.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "a record of {found} counts is not one of {what}, which has {expected}: resume the scene that it was saved from"
)]
pub struct ForeignRecord {
    /// What it should be of.
    pub what: &'static str,
    /// Counts needed.
    pub expected: usize,
    /// Counts found.
    pub found: usize,
}

impl From<ForeignRecord> for BodyError {
    fn from(error: ForeignRecord) -> Self {
        Self::Other(Box::new(error))
    }
}

impl From<ForeignRecord> for SceneError {
    fn from(source: ForeignRecord) -> Self {
        Self::ForeignCheckpoint { problem: source.to_string() }
    }
}

impl Record {
    /// The counts, if there are N of them.
    ///
    /// # Errors
    /// Another number of counts: a record of something else than `what`.
    pub fn counts_of<const N: usize>(&self, what: &'static str) -> Result<[u64; N], ForeignRecord> {
        let found = self.counts.len();
        self.counts.as_slice().try_into().map_err(|_| ForeignRecord { what, expected: N, found })
    }
}
