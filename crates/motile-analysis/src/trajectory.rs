//! Motion of a droplet across a channel: lateral amplitude, period, growth, and the regime that they make.

mod classify;
mod extrema;
mod linear_mode;
mod recorder;
mod regime;
mod regression;
mod separable;
mod swings;

use motile_base::{internal::all_finite, not_negative, same_length};

use crate::AnalysisError;
use crate::error::increasing;

pub use extrema::{Extremum, extrema};
pub use linear_mode::{LinearMode, fit_linear_mode};
pub use recorder::{TrajectoryRecord, TrajectoryRecorder};
pub use regime::{Doubt, Evidence, Regime, RegimeCriteria, RegimeReport};
pub use regression::Estimate;

/// Trajectory of a droplet across a channel: heights and speeds at increasing times, not necessarily evenly spaced.
///
/// [`Trajectory::regime`] classifies the motion; [`Trajectory::linear_mode`] fits the growth rate and the frequency of
/// a small lateral motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    times: Vec<f64>,
    heights: Vec<f64>,
    speeds: Vec<f64>,
    velocities: Option<Vec<f64>>,
}

impl Trajectory {
    /// Creates a trajectory from times, heights of the centroid above the centre line (length) and speeds (of the
    /// centroid, along and across the channel; length per time).
    ///
    /// # Errors
    /// Returns an error for lists of different length, values that are not finite, times that do not increase, negative
    /// speeds.
    pub fn new(times: Vec<f64>, heights: Vec<f64>, speeds: Vec<f64>) -> Result<Self, AnalysisError> {
        same_length("the heights", times.len(), heights.len())?;
        same_length("the speeds", times.len(), speeds.len())?;
        increasing("the times", &times)?;
        all_finite("the heights", &heights)?;
        for &speed in &speeds {
            not_negative("a speed", speed)?;
        }
        Ok(Self { times, heights, speeds, velocities: None })
    }

    /// Adds the lateral velocities (length per time), which make fits to short records better.
    ///
    /// # Errors
    /// Returns an error for a list of another length, values that are not finite.
    pub fn with_lateral_velocities(mut self, velocities: Vec<f64>) -> Result<Self, AnalysisError> {
        same_length("the lateral velocities", self.times.len(), velocities.len())?;
        all_finite("the lateral velocities", &velocities)?;
        self.velocities = Some(velocities);
        Ok(self)
    }

    /// Returns the times of the samples (time).
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the heights above the centre line (length).
    #[must_use]
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Returns the speeds (length per time).
    #[must_use]
    pub fn speeds(&self) -> &[f64] {
        &self.speeds
    }

    /// Returns the lateral velocities (length per time), if they are known.
    #[must_use]
    pub fn lateral_velocities(&self) -> Option<&[f64]> {
        self.velocities.as_deref()
    }

    /// Returns the duration from the first to the last sample (time); 0 without samples.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.times.last().zip(self.times.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// Returns the part of the trajectory from time `start` to time `end`, both included.
    #[must_use]
    pub fn between(&self, start: f64, end: f64) -> Self {
        let range = self.times.partition_point(|&t| t < start)..self.times.partition_point(|&t| t <= end);
        let range = range.start.min(range.end)..range.end;
        Self {
            times: self.times[range.clone()].to_vec(),
            heights: self.heights[range.clone()].to_vec(),
            speeds: self.speeds[range.clone()].to_vec(),
            velocities: self.velocities.as_ref().map(|velocities| velocities[range].to_vec()),
        }
    }

    /// Returns the growth rate and frequency of a small lateral motion, with the lateral velocities if they are known;
    /// see [`fit_linear_mode`].
    ///
    /// # Errors
    /// Returns an error for fewer than eight samples, heights that determine no rate.
    pub fn linear_mode(&self) -> Result<LinearMode, AnalysisError> {
        fit_linear_mode(&self.times, &self.heights, self.lateral_velocities())
    }
}

#[cfg(test)]
mod tests;
