//! Values of descriptions with their keys, refused where they are out of range.

use crate::SetupError;

/// Lengths of a region.
const LENGTHS: [f64; 2] = [1e-100, 1e100];

/// Values with their place in the description.
pub(super) struct Checked<'a> {
    pub(super) place: &'a str,
}

impl Checked<'_> {
    pub(super) fn refuse<T>(
        &self,
        key: &str,
        value: &dyn std::fmt::Display,
        remedy: impl Into<String>,
    ) -> Result<T, SetupError> {
        let key = if self.place.is_empty() { key.to_owned() } else { format!("{}.{key}", self.place) };
        Err(SetupError::Value { key, value: value.to_string(), remedy: remedy.into() })
    }

    pub(super) fn require(&self, holds: bool, key: &str, value: f64, remedy: &str) -> Result<(), SetupError> {
        if holds { Ok(()) } else { self.refuse(key, &value, remedy) }
    }

    pub(super) fn positive(&self, key: &str, value: f64) -> Result<(), SetupError> {
        self.require(value.is_finite() && value > 0.0, key, value, "give a positive finite number")
    }

    /// A length of a region, whose products are numbers.
    pub(super) fn length(&self, key: &str, value: f64) -> Result<(), SetupError> {
        let [least, most] = LENGTHS;
        let remedy = format!("give a number from {least:e} to {most:e}, or the region plane where nothing is near");
        if (least..=most).contains(&value) {
            return Ok(());
        }
        // Not with hundreds of digits.
        let text = if value.abs() > 1e9 || value.abs() < 1e-9 { format!("{value:e}") } else { value.to_string() };
        self.refuse(key, &text, remedy)
    }

    pub(super) fn not_negative(&self, key: &str, value: f64) -> Result<(), SetupError> {
        self.require(value.is_finite() && value >= 0.0, key, value, "give a finite number that is not negative")
    }

    pub(super) fn finite(&self, key: &str, value: f64) -> Result<(), SetupError> {
        self.require(value.is_finite(), key, value, "give a finite number")
    }

    pub(super) fn all_finite(&self, key: &str, values: &[f64]) -> Result<(), SetupError> {
        values.iter().try_for_each(|&value| self.finite(key, value))
    }
}
