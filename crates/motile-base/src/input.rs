//! Checks of the numbers and lists that constructors are given.

use crate::{Vec2, internal::given};

/// A number or list that cannot be used, with the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// A quantity that must be positive and finite is not.
    #[error("{name} is {value}. Use a positive finite number", value = given(*value))]
    NotPositive {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity that must be finite and at least zero is not.
    #[error("{name} is {value}. Use a finite number that is not negative", value = given(*value))]
    Negative {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity that must be finite is not.
    #[error("{name} is {value}. Use a finite number", value = given(*value))]
    NotFinite {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity outside its range.
    #[error(
        "{name} is {value}. Use a number from {minimum} to {maximum}",
        value = given(*value), minimum = given(*minimum), maximum = given(*maximum)
    )]
    OutOfRange {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Minimum value.
        minimum: f64,
        /// Largest value.
        maximum: f64,
    },
    /// Too few of something.
    #[error("{found} {name} are too few. Use at least {minimum}")]
    TooFew {
        /// Of what.
        name: &'static str,
        /// How many there are.
        found: usize,
        /// The minimum.
        minimum: usize,
    },
    /// Slices of different length.
    #[error("the number of entries of {name} is {found}, but it must be {expected}")]
    WrongLength {
        /// The slice.
        name: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
    /// An entry of a list that must be finite is not.
    #[error("entry {index} of {name} is {value}. Use finite numbers", value = given(*value))]
    EntryNotFinite {
        /// The list.
        name: &'static str,
        /// Which entry.
        index: usize,
        /// Its value; for a point, the first component that is not finite.
        value: f64,
    },
}

crate::debug_as_explanation!(InputError);

/// Returns `value` if it is positive and finite.
///
/// # Errors
/// Returns [`InputError::NotPositive`] if it is not.
pub fn positive(name: &'static str, value: f64) -> Result<f64, InputError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(InputError::NotPositive { name, value }) }
}

/// Returns `value` if it is finite and not negative.
///
/// # Errors
/// Returns [`InputError::Negative`] if it is not.
pub fn not_negative(name: &'static str, value: f64) -> Result<f64, InputError> {
    if value >= 0.0 && value.is_finite() { Ok(value) } else { Err(InputError::Negative { name, value }) }
}

/// Returns `value` if it is finite.
///
/// # Errors
/// Returns [`InputError::NotFinite`] if it is not.
pub fn finite(name: &'static str, value: f64) -> Result<f64, InputError> {
    if value.is_finite() { Ok(value) } else { Err(InputError::NotFinite { name, value }) }
}

/// Returns `value` if it lies in the closed range.
///
/// # Errors
/// Returns [`InputError::OutOfRange`] if it does not.
pub fn within(name: &'static str, value: f64, minimum: f64, maximum: f64) -> Result<f64, InputError> {
    let inside = value >= minimum && value <= maximum;
    if inside { Ok(value) } else { Err(InputError::OutOfRange { name, value, minimum, maximum }) }
}

/// Returns `found` if it is at least `minimum`.
///
/// # Errors
/// Returns [`InputError::TooFew`] if it is less.
pub fn at_least(name: &'static str, found: usize, minimum: usize) -> Result<usize, InputError> {
    if found >= minimum { Ok(found) } else { Err(InputError::TooFew { name, found, minimum }) }
}

/// Refuses a slice of another length than needed.
///
/// # Errors
/// Returns [`InputError::WrongLength`] if the lengths differ.
pub fn same_length(name: &'static str, expected: usize, found: usize) -> Result<(), InputError> {
    if expected == found { Ok(()) } else { Err(InputError::WrongLength { name, expected, found }) }
}

/// Refuses entries that are not finite.
///
/// # Errors
/// Returns [`InputError::EntryNotFinite`] for the first entry that is not finite.
pub fn all_finite(name: &'static str, values: &[f64]) -> Result<(), InputError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(InputError::EntryNotFinite { name, index, value: values[index] }),
    }
}

/// Refuses points that are not finite.
///
/// # Errors
/// Returns [`InputError::EntryNotFinite`] for the first entry that is not finite.
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
