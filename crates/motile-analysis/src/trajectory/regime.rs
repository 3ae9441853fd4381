//! Long-time regimes of a droplet in a channel, and the evidence for a regime.

use std::fmt;

use motile_base::{positive, within};

use super::{Estimate, Extremum, LinearMode};
use crate::AnalysisError;

/// Long-time regime of the motion of a droplet across a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[doc(alias("zigzag", "oscillation"))]
pub enum Regime {
    /// Swimming on the centre line, at most [`RegimeCriteria::centre`] off it.
    CentreLine,
    /// Exponential return to the centre line, with or without oscillations.
    Decaying,
    /// Exponential departure from the centre line, with or without oscillations.
    Growing,
    /// Oscillation of constant amplitude.
    SteadyOscillation,
    /// No motion.
    AtRest,
    /// Motion to one side, towards a wall, or along a line on one side of the centre line.
    Drifting,
    /// A record that does not show the regime.
    Undecided(Doubt),
}

/// Reason for which a record does not show the regime.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// Too few samples after the transient.
    TooFewSamples {
        /// Number of samples found.
        found: usize,
    },
    /// The record contains too little of a period or of a decay: make the run longer.
    TooShort {
        /// Number of periods in the record, as far as it is known; 0 without a turning point.
        periods: f64,
    },
    /// An amplitude that goes up and down.
    Irregular {
        /// Largest over smallest amplitude of the swings.
        ratio: f64,
    },
    /// A change of the amplitude that may be zero or not, by its error: make the run longer.
    Uncertain {
        /// Relative change per period (no dimension).
        change: f64,
        /// Its standard error (no dimension).
        error: f64,
    },
    /// A small speed that is growing: make the run longer.
    SpeedingUp {
        /// Growth rate of the speed (1/time).
        rate: f64,
    },
}

impl fmt::Display for Regime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::CentreLine => "centre line",
            Self::Decaying => "decaying",
            Self::Growing => "growing",
            Self::SteadyOscillation => "steady oscillation",
            Self::AtRest => "at rest",
            Self::Drifting => "drifting",
            Self::Undecided(doubt) => return write!(f, "undecided: {doubt}"),
        })
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewSamples { found } => write!(f, "only {found} samples"),
            Self::TooShort { periods } if *periods > 0.0 => write!(f, "only {periods:.1} periods"),
            Self::TooShort { .. } => f.write_str("the record is too short"),
            Self::Irregular { ratio } => write!(f, "the amplitude goes up and down, by a factor of {ratio:.2}"),
            Self::Uncertain { change, error } => {
                write!(
                    f,
                    "the amplitude changes by {change:.2e} of it per period, with a standard error of {error:.1e}"
                )
            }
            Self::SpeedingUp { rate } => write!(f, "hardly moving, but speeding up at the rate {rate:.2e}"),
        }
    }
}

/// Thresholds of [`Trajectory::regime`](crate::trajectory::Trajectory::regime).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegimeCriteria {
    /// Fraction of the record, from its beginning, that is left out as a transient (no dimension, at least 0 and below
    /// 1).
    pub transient: f64,
    /// Distance from the centre line up to which a droplet is on it (length). The default is far above the round-off of
    /// a symmetric run and far below any perturbation made on purpose.
    pub centre: f64,
    /// Speed up to which a droplet is at rest (length per time).
    pub rest: f64,
    /// Smallest return of the motion after a turning point that counts, over the range of heights (no dimension).
    pub hysteresis: f64,
    /// Relative change of the amplitude per period, and standard error of that, up to which an oscillation is steady
    /// (no dimension).
    pub steady: f64,
    /// Shortest path without a turning point that is called a drift (length); on a shorter one the droplet may as well
    /// be about to turn.
    pub travel: f64,
    /// Relative residual of a [`LinearMode`] up to which the motion counts as linear (no dimension). Used if there are
    /// fewer than four turning points.
    pub linear: f64,
}

impl Default for RegimeCriteria {
    /// For droplets of radius 1 and speeds of order 0.1, as in Cowley's units.
    fn default() -> Self {
        Self { transient: 0.2, centre: 1e-6, rest: 1e-3, hysteresis: 0.02, steady: 0.01, travel: 10.0, linear: 3e-3 }
    }
}

impl RegimeCriteria {
    /// Creates the default thresholds for droplets of the radius `radius` (length) whose speeds are of the order of
    /// `speed` (length per time).
    ///
    /// # Errors
    /// Returns an error for values that are not positive and finite.
    pub fn scaled(radius: f64, speed: f64) -> Result<Self, AnalysisError> {
        positive("the radius", radius)?;
        positive("the speed", speed)?;
        let unit = Self::default();
        Ok(Self { centre: unit.centre * radius, rest: 10.0 * unit.rest * speed, travel: unit.travel * radius, ..unit })
    }

    pub(super) fn check(&self) -> Result<(), AnalysisError> {
        within("the transient's part of the record", self.transient, 0.0, 1.0 - f64::EPSILON)?;
        positive("the tolerance of the centre line", self.centre)?;
        positive("the speed of rest", self.rest)?;
        positive("the hysteresis", self.hysteresis)?;
        positive("the change of a steady amplitude", self.steady)?;
        positive("the path of a drift", self.travel)?;
        positive("the residual of a linear motion", self.linear)?;
        Ok(())
    }
}

/// Measurements that a regime follows from, all on the record without its transient.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Evidence {
    /// First and last time (time).
    pub window: [f64; 2],
    /// Number of samples.
    pub samples: usize,
    /// Mean speed over the last quarter of the window (length per time).
    pub speed: f64,
    /// Largest distance from the centre line (length).
    pub largest: f64,
    /// Cowley's amplitude (section 3.1.2): largest distance from the centre line over the last period, or over the last
    /// quarter of the window if there is no period (length).
    pub amplitude: f64,
    /// Half of the height difference between the last two turning points (length).
    pub half_height: Option<f64>,
    /// Height midway between the last two turning points (length).
    pub midline: Option<f64>,
    /// Height at the end (length).
    pub last_height: f64,
    /// Slope of the least squares line through all heights (length per time).
    pub drift: Estimate,
    /// Turning points.
    pub extrema: Vec<Extremum>,
    /// Number of periods in the record: between the first and the last turning point, or, where these are few, by the
    /// linear fit.
    pub periods: f64,
    /// Period (time) of the last part of the motion, in which the amplitude is exponential or constant.
    pub period: Option<Estimate>,
    /// Growth rate of the amplitude in that part, negative for a decay (1/time).
    pub growth_rate: Option<Estimate>,
    /// The linear fit, if there are too few turning points.
    pub mode: Option<LinearMode>,
}

/// A regime and the evidence for it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RegimeReport {
    /// The regime.
    pub regime: Regime,
    /// Measurements that it follows from.
    pub evidence: Evidence,
}

#[cfg(test)]
mod tests;
