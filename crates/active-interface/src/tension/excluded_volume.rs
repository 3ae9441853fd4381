//! Excluded volume: the repulsion that keeps particles on the interface apart.

use motile_base::{not_negative, positive, within};
use serde::{Deserialize, Serialize};

use crate::InterfaceError;

/// The excluded-volume term Pi(c) of the tension (Cowley, eq. 2.39), a function of the concentration c.
///
/// Pi has the dimension of a tension, its slope B = dPi/dc (Cowley, eq. 2.40) the unit of tension times length (tension
/// per concentration), as the activity. Values are checked where a [`ContractileTension`](crate::ContractileTension) is
/// made of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
#[doc(alias("surface pressure", "crowding"))]
pub enum ExcludedVolume {
    /// Pi = 0.
    None,
    /// Cowley's step-like excluded volume of strength A (tension times length), with her threshold of twice the mean
    /// concentration and her steepness of 20 (eq. 2.41).
    Step(f64),
    /// The step-like excluded volume of Cowley, eqs. (2.40) and (2.41), with your own threshold and steepness:
    /// negligible below a concentration c_T and a repulsion of constant strength A above it.
    ///
    /// With x = a c / c_T and the steepness a,
    /// ```text
    /// B(c)  = A - A sinh a / (cosh a + cosh x) = A (e^-a + cosh x) / (cosh a + cosh x)
    /// Pi(c) = A c - A (c_T / a) ln[ cosh((x + a)/2) / cosh((x - a)/2) ] = A (c_T / a) [ L(x - a) - L(-x - a) ]
    /// ```
    /// where L(y) = max(y, 0) + ln(1 + e^-|y|). The second forms are the ones evaluated: nothing overflows and nothing
    /// cancels, at any concentration.
    StepAt {
        /// A >= 0 (tension times length).
        strength: f64,
        /// c_T > 0 (particles per length; T c0 in Cowley).
        threshold: f64,
        /// a in (0, 300] (no dimension).
        steepness: f64,
    },
    /// Pi = B c^2 / 2 with the strength B >= 0 (tension times length squared), of earlier versions of the model
    /// (Cowley, section 2.2.3).
    Quadratic(f64),
}

/// Largest steepness a: cosh a, which the plateau is computed from, overflows beyond 710.
const STEEPEST: f64 = 300.0;

/// ln(1 + e^y) without overflow.
fn softplus(y: f64) -> f64 {
    y.max(0.0) + (-y.abs()).exp().ln_1p()
}

impl ExcludedVolume {
    /// Returns the law for particles of this mean concentration (particles per length).
    pub(super) fn law(self, mean_concentration: f64) -> Law {
        match self {
            Self::None => Law::None,
            Self::Step(strength) => Law::Step { strength, threshold: 2.0 * mean_concentration, steepness: 20.0 },
            Self::StepAt { strength, threshold, steepness } => Law::Step { strength, threshold, steepness },
            Self::Quadratic(strength) => Law::Quadratic(strength),
        }
    }

    /// Checks that all values are in their ranges.
    ///
    /// # Errors
    /// Returns [`InterfaceError::Input`] for the first value that is not.
    pub fn check(self) -> Result<(), InterfaceError> {
        if let Self::StepAt { threshold, steepness, .. } = self {
            positive("the threshold concentration", threshold)?;
            let name = "the steepness of the excluded volume";
            within(name, positive(name, steepness)?, 0.0, STEEPEST)?;
        }
        if let Self::StepAt { strength, .. } | Self::Step(strength) | Self::Quadratic(strength) = self {
            not_negative("the strength of the excluded volume", strength)?;
        }
        Ok(())
    }
}

/// An excluded volume whose threshold is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Law {
    None,
    Step { strength: f64, threshold: f64, steepness: f64 },
    Quadratic(f64),
}

impl Law {
    /// Pi(c) (tension) at the concentration `c` (particles per length).
    pub(super) fn pressure(self, c: f64) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Step { strength, threshold, steepness: a } => {
                let x = a * c / threshold;
                strength * (threshold / a) * (softplus(x - a) - softplus(-x - a))
            }
            Self::Quadratic(strength) => 0.5 * strength * c * c,
        }
    }

    /// B(c) = dPi/dc (tension times length) at the concentration `c` (particles per length).
    pub(super) fn slope(self, c: f64) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Step { strength, threshold, steepness: a } => {
                let x = (a * c / threshold).abs();
                // Numerator and denominator divided by e^m / 2, m the larger of the two exponents.
                let m = x.max(a);
                let cosh_x = (x - m).exp() + (-x - m).exp();
                let small = (-a - m).exp();
                strength * (2.0 * small + cosh_x) / ((a - m).exp() + small + cosh_x)
            }
            Self::Quadratic(strength) => strength * c,
        }
    }

    /// Returns the concentration (particles per length) at which B(c) = `pull` (tension times length), or `None` where
    /// B stays below it. At the activity `-pull` the tension has its maximum there: particles gather to about that
    /// concentration, somewhat beyond it where the flow presses them.
    pub(super) fn plateau(self, pull: f64) -> Option<f64> {
        if pull <= self.slope(0.0) {
            return Some(0.0);
        }
        match self {
            Self::Step { strength, threshold, steepness: a } if pull < strength => {
                let ratio = pull / strength;
                let cosh_x = (ratio * a.cosh() - (-a).exp()) / (1.0 - ratio);
                Some(threshold / a * cosh_x.max(1.0).acosh())
            }
            Self::Quadratic(strength) if strength > 0.0 => Some(pull / strength),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
