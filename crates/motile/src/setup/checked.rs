//! Values of descriptions with their keys, refused where they are out of range.

use std::fmt::Display;

use crate::SetupError;

/// Least and largest magnitude of a value, whose fourth powers are numbers too.
const MAGNITUDES: [f64; 2] = [1e-50, 1e50];

/// Most amplitudes of the waves of a shape, about as many as half of the most nodes resolve.
const MOST_WAVES: usize = 2000;

/// Most characters of a number that is printed as it was given.
const MOST_DIGITS: usize = 20;

/// Returns a number as it was given, but not with hundreds of digits.
pub(super) fn short(value: f64) -> String {
    let text = value.to_string();
    if text.len() > MOST_DIGITS { format!("{value:e}") } else { text }
}

/// Values with their place in the description.
pub(super) struct Checked<'a> {
    pub(super) place: &'a str,
}

impl Checked<'_> {
    pub(super) fn refuse<T>(&self, key: &str, value: &dyn Display, remedy: impl Into<String>) -> Result<T, SetupError> {
        let key = if self.place.is_empty() { key.to_owned() } else { format!("{}.{key}", self.place) };
        let text = value.to_string();
        let value = text.parse().map_or(text, short);
        Err(SetupError::Value { key, value, remedy: remedy.into() })
    }

    pub(super) fn refuse_if(
        &self,
        wrong: bool,
        key: &str,
        value: impl Display,
        remedy: impl Into<String>,
    ) -> Result<(), SetupError> {
        if wrong { self.refuse(key, &value, remedy) } else { Ok(()) }
    }

    pub(super) fn require(&self, holds: bool, key: &str, value: f64, remedy: &str) -> Result<(), SetupError> {
        self.refuse_if(!holds, key, value, remedy)
    }

    pub(super) fn positive(&self, key: &str, value: impl Into<Option<f64>>) -> Result<(), SetupError> {
        let Some(value) = value.into() else { return Ok(()) };
        self.require(value.is_finite() && value > 0.0, key, value, "use a positive finite number")?;
        let [least, most] = MAGNITUDES;
        self.require((least..=most).contains(&value), key, value, &format!("use a number from {least:e} to {most:e}"))
    }

    /// Returns a length of a region.
    pub(super) fn length(&self, key: &str, value: f64) -> Result<(), SetupError> {
        let [least, most] = MAGNITUDES;
        let plane = if value > most { ", or the region plane if nothing is near" } else { "" };
        let remedy = format!("use a number from {least:e} to {most:e}{plane}");
        self.require((least..=most).contains(&value), key, value, &remedy)
    }

    pub(super) fn not_negative(&self, key: &str, value: impl Into<Option<f64>>) -> Result<(), SetupError> {
        let Some(value) = value.into() else { return Ok(()) };
        self.require(value >= 0.0, key, value, "use a finite number that is not negative")?;
        self.finite(key, value)
    }

    pub(super) fn finite(&self, key: &str, value: impl Into<Option<f64>>) -> Result<(), SetupError> {
        let Some(value) = value.into() else { return Ok(()) };
        self.require(value.is_finite(), key, value, "use a finite number")?;
        let [_, most] = MAGNITUDES;
        self.require(value.abs() <= most, key, value, &format!("use a number from -{most:e} to {most:e}"))
    }

    /// Names the first entry that is refused by its number.
    pub(super) fn all_finite(&self, key: &str, values: &[f64]) -> Result<(), SetupError> {
        values.iter().enumerate().try_for_each(|(k, &value)| self.finite(&format!("{key}[{k}]"), value))
    }

    /// Names the first coordinate that is refused by the numbers of its point and its axis.
    pub(super) fn all_points_finite(&self, key: &str, points: &[[f64; 2]]) -> Result<(), SetupError> {
        points.iter().enumerate().try_for_each(|(k, point)| self.all_finite(&format!("{key}[{k}]"), point))
    }

    /// Amplitudes of the waves of a shape.
    pub(super) fn amplitudes(&self, key: &str, values: &[f64]) -> Result<(), SetupError> {
        if values.len() > MOST_WAVES {
            let remedy = format!("no method resolves so many modes. Use at most {MOST_WAVES}");
            return self.refuse(key, &format!("{} amplitudes", values.len()), remedy);
        }
        self.all_finite(key, values)
    }
}
