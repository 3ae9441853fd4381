//! Errors of the analysis.

use motile_base::{
    InputError, Refusal,
    internal::{Refuse, all_finite},
};

/// An error of this crate. Its text has the offending value and says what to do.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A list that does not increase, or points that do not determine what is fitted to them.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(AnalysisError);

impl AnalysisError {
    /// Returns the error for an entry that is not above the entry before it, in a list that must increase.
    pub(crate) fn not_increasing(name: &str, index: usize, value: f64) -> Self {
        let what = format!("entry {index} of {name} is {value}, not above the entry before it");
        Self::refused(what, "", format!("Sort {name} and remove repeated ones"))
    }

    /// Returns the error for points that do not determine what is fitted to them.
    pub(crate) fn no_fit(fit: &str, points: usize) -> Self {
        let what = format!("these {points} points do not determine a fit of {fit}");
        let remedy = "Use more points, or a longer part of the record".to_owned();
        Self::refused(what, "", remedy)
    }
}

/// Checks that all entries are finite and each is above the entry before it.
pub(crate) fn increasing(name: &'static str, values: &[f64]) -> Result<(), AnalysisError> {
    all_finite(name, values)?;
    match values.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(before) => Err(AnalysisError::not_increasing(name, before + 1, values[before + 1])),
    }
}
