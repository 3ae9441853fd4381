//! Checks of the numbers and lists that constructors are given.

use crate::Vec2;

/// A number or list that cannot be used, with the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// A quantity that must be positive and finite is not.
    #[error("{name} is {value}: give a positive finite number")]
    NotPositive {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity that must be finite and at least zero is not.
    #[error("{name} is {value}: give a finite number that is not negative")]
    Negative {
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
    /// A quantity outside its range.
    #[error("{name} is {value}: give a number from {minimum} to {maximum}")]
    OutOfRange {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value.
        minimum: f64,
        /// Largest value.
        maximum: f64,
    },
    /// Too few of something.
    #[error("{found} {name} are too few: give at least {minimum}")]
    TooFew {
        /// Of what.
        name: &'static str,
        /// How many there are.
        found: usize,
        /// The least number.
        minimum: usize,
    },
    /// Slices of different length.
    #[error("{name} has {found} entries: give {expected}")]
    WrongLength {
        /// The slice.
        name: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
    /// An entry of a list that must be finite is not.
    #[error("entry {index} of {name} is {value}: give finite numbers")]
    EntryNotFinite {
        /// The list.
        name: &'static str,
        /// Which entry.
        index: usize,
        /// Its value, of a point that of the first component that is not finite.
        value: f64,
    },
}

crate::debug_as_explanation!(InputError);

/// `value` if it is positive and finite.
///
/// # Errors
/// [`InputError::NotPositive`].
pub fn positive(name: &'static str, value: f64) -> Result<f64, InputError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(InputError::NotPositive { name, value }) }
}

/// `value` if it is finite and not negative.
///
/// # Errors
/// [`InputError::Negative`].
pub fn not_negative(name: &'static str, value: f64) -> Result<f64, InputError> {
    if value >= 0.0 && value.is_finite() { Ok(value) } else { Err(InputError::Negative { name, value }) }
}

/// `value` if it is finite.
///
/// # Errors
/// [`InputError::NotFinite`].
pub fn finite(name: &'static str, value: f64) -> Result<f64, InputError> {
    if value.is_finite() { Ok(value) } else { Err(InputError::NotFinite { name, value }) }
}

/// `value` if it lies in the closed range.
///
/// # Errors
/// [`InputError::OutOfRange`].
pub fn within(name: &'static str, value: f64, minimum: f64, maximum: f64) -> Result<f64, InputError> {
    let inside = value >= minimum && value <= maximum;
    if inside { Ok(value) } else { Err(InputError::OutOfRange { name, value, minimum, maximum }) }
}

/// `found` if it is at least `minimum`.
///
/// # Errors
/// [`InputError::TooFew`].
pub fn at_least(name: &'static str, found: usize, minimum: usize) -> Result<usize, InputError> {
    if found >= minimum { Ok(found) } else { Err(InputError::TooFew { name, found, minimum }) }
}

/// Refuses a slice of another length than needed.
///
/// # Errors
/// [`InputError::WrongLength`].
pub fn same_length(name: &'static str, expected: usize, found: usize) -> Result<(), InputError> {
    if expected == found { Ok(()) } else { Err(InputError::WrongLength { name, expected, found }) }
}

/// Refuses entries that are not finite.
///
/// # Errors
/// [`InputError::EntryNotFinite`].
pub fn all_finite(name: &'static str, values: &[f64]) -> Result<(), InputError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(InputError::EntryNotFinite { name, index, value: values[index] }),
    }
}

/// Refuses points that are not finite.
///
/// # Errors
/// [`InputError::EntryNotFinite`].
pub fn all_points_finite(name: &'static str, points: &[Vec2]) -> Result<(), InputError> {
    points.iter().enumerate().try_for_each(|(index, point)| {
        match point.to_array().iter().find(|value| !value.is_finite()) {
            None => Ok(()),
            Some(&value) => Err(InputError::EntryNotFinite { name, index, value }),
        }
    })
}

#[cfg(test)]
mod tests;
