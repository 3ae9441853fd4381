//! Errors of the analysis.

use motile_base::{InputError, all_finite};

/// An error of this crate. Its text has the offending value and says what to do.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An entry that is not above the entry before it, in a list that must increase.
    #[error("entry {index} of {name} is {value}, not above the entry before it. Sort {name} and remove repeated ones")]
    NotIncreasing {
        /// Name of the list.
        name: &'static str,
        /// Index of the entry.
        index: usize,
        /// Value of the entry.
        value: f64,
    },
    /// Points that do not determine what is fitted to them.
    #[error("these {points} points do not determine a fit of {what}. Use more points, or a longer part of the record")]
    NoFit {
        /// Model of the fit.
        what: &'static str,
        /// Number of points.
        points: usize,
    },
}

motile_base::debug_as_explanation!(AnalysisError);

/// Checks that all entries are finite and each is above the entry before it.
pub(crate) fn increasing(name: &'static str, values: &[f64]) -> Result<(), AnalysisError> {
    all_finite(name, values)?;
    match values.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(before) => Err(AnalysisError::NotIncreasing { name, index: before + 1, value: values[before + 1] }),
    }
}
