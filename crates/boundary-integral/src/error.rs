//! What can go wrong when a solver or a plan is made.

/// An error of this crate, with the offending value and the remedy. Evaluations return [`ib_core::FlowError`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BoundaryIntegralError {
    /// A quantity that must be positive and finite is not.
    #[error("{name} is {value}: give a positive finite number")]
    NotPositive {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity that must be finite is not.
    #[error("{name} is {value}: give a finite number")]
    NotFinite {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity outside the range in which the method works.
    #[error("{name} is {value}: give a value between {least} and {most}")]
    OutOfRange {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least value that works.
        least: f64,
        /// The largest value that works.
        most: f64,
    },
    /// Too few samples or nodes.
    #[error("{name} is {found}: give at least {least}")]
    TooFew {
        /// What is counted.
        name: &'static str,
        /// The number given.
        found: usize,
        /// The least number that works.
        least: usize,
    },
    /// A band wider than the samples can carry.
    #[error("{modes} modes do not fit into {len} samples: keep at most {len} modes or give more samples")]
    BandTooWide {
        /// Modes asked for.
        modes: usize,
        /// Number of samples.
        len: usize,
    },
    /// Slices of different length.
    #[error("{name} has {found} entries where {expected} are needed")]
    WrongLength {
        /// The slice.
        name: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
}

/// Refuses what is not a positive finite number.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), BoundaryIntegralError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(BoundaryIntegralError::NotPositive { name, value }) }
}

/// Refuses what is not a finite number.
pub(crate) fn finite(name: &'static str, value: f64) -> Result<(), BoundaryIntegralError> {
    if value.is_finite() { Ok(()) } else { Err(BoundaryIntegralError::NotFinite { name, value }) }
}

/// Refuses a slice of another length.
pub(crate) fn same_length(name: &'static str, found: usize, expected: usize) -> Result<(), BoundaryIntegralError> {
    if found == expected { Ok(()) } else { Err(BoundaryIntegralError::WrongLength { name, expected, found }) }
}
