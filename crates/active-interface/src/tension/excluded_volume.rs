//! The repulsion that keeps particles on the interface apart.

use std::fmt::Debug;

use crate::InterfaceError;
use crate::error::{not_negative, positive};

/// The excluded-volume term Pi(c) of the tension (thesis, eq. 2.39), a function of the concentration c.
///
/// Pi has the dimension of a tension, its slope B = dPi/dc (thesis, eq. 2.40) that of tension times length (tension per
/// concentration), as the activity.
pub trait ExcludedVolume: Debug + Send + Sync {
    /// Pi(c) (tension) at the concentration `c` (particles per length).
    fn pressure(&self, c: f64) -> f64;

    /// B(c) = dPi/dc (tension times length) at the concentration `c` (particles per length).
    fn slope(&self, c: f64) -> f64;

    /// The concentration (particles per length) at which B(c) = `pull` (tension times length), or `None` where B stays
    /// below it. At the activity `-pull` the tension has its maximum there: particles gather to about that
    /// concentration, somewhat beyond it where the flow presses them.
    fn plateau(&self, pull: f64) -> Option<f64>;
}

/// No excluded volume: Pi = 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoExcludedVolume;

impl ExcludedVolume for NoExcludedVolume {
    fn pressure(&self, _c: f64) -> f64 {
        0.0
    }

    fn slope(&self, _c: f64) -> f64 {
        0.0
    }

    fn plateau(&self, pull: f64) -> Option<f64> {
        (pull <= 0.0).then_some(0.0)
    }
}

/// The step-like excluded volume of the thesis, eqs. (2.40) and (2.41): negligible below a concentration c_T and a
/// repulsion of constant strength A above it.
///
/// With x = a c / c_T and the steepness a,
/// ```text
/// B(c)  = A - A sinh a / (cosh a + cosh x) = A (e^-a + cosh x) / (cosh a + cosh x)
/// Pi(c) = A c - A (c_T / a) ln[ cosh((x + a)/2) / cosh((x - a)/2) ] = A (c_T / a) [ L(x - a) - L(-x - a) ]
/// ```
/// where L(y) = max(y, 0) + ln(1 + e^-|y|). The second forms are the ones evaluated: nothing overflows and nothing
/// cancels, at any concentration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepExcludedVolume {
    strength: f64,
    threshold: f64,
    steepness: f64,
}

impl StepExcludedVolume {
    /// Strength A >= 0 (tension times length), threshold concentration c_T > 0 (particles per length; T c0 in the
    /// thesis) and steepness a in (0, 300].
    ///
    /// # Errors
    /// Values outside these ranges.
    pub fn new(strength: f64, threshold: f64, steepness: f64) -> Result<Self, InterfaceError> {
        let strength = not_negative("the strength of the excluded volume", strength)?;
        let threshold = positive("the threshold concentration", threshold)?;
        if !(steepness > 0.0 && steepness <= 300.0) {
            let name = "the steepness of the excluded volume";
            return Err(InterfaceError::OutOfRange { name, value: steepness, minimum: 0.0, maximum: 300.0 });
        }
        Ok(Self { strength, threshold, steepness })
    }

    /// The thesis' values (eq. 2.41): threshold 2 c0 and steepness 20, with the strength A (tension times length) and
    /// the mean concentration c0 (particles per length) given.
    ///
    /// # Errors
    /// A negative strength, or a concentration that is not positive.
    pub fn thesis(strength: f64, mean_concentration: f64) -> Result<Self, InterfaceError> {
        Self::new(strength, 2.0 * positive("the mean concentration", mean_concentration)?, 20.0)
    }

    /// The strength A (tension times length).
    #[must_use]
    pub fn strength(&self) -> f64 {
        self.strength
    }

    /// The threshold concentration c_T (particles per length).
    #[must_use]
    pub fn threshold(&self) -> f64 {
        self.threshold
    }

    /// The steepness a (no dimension).
    #[must_use]
    pub fn steepness(&self) -> f64 {
        self.steepness
    }
}

/// ln(1 + e^y) without overflow.
fn softplus(y: f64) -> f64 {
    y.max(0.0) + (-y.abs()).exp().ln_1p()
}

impl ExcludedVolume for StepExcludedVolume {
    fn pressure(&self, c: f64) -> f64 {
        let a = self.steepness;
        let x = a * c / self.threshold;
        self.strength * (self.threshold / a) * (softplus(x - a) - softplus(-x - a))
    }

    fn slope(&self, c: f64) -> f64 {
        let a = self.steepness;
        let x = (a * c / self.threshold).abs();
        // Numerator and denominator divided by e^m / 2, m the larger of the two exponents.
        let m = x.max(a);
        let cosh_x = (x - m).exp() + (-x - m).exp();
        let small = (-a - m).exp();
        self.strength * (2.0 * small + cosh_x) / ((a - m).exp() + small + cosh_x)
    }

    fn plateau(&self, pull: f64) -> Option<f64> {
        let a = self.steepness;
        if pull <= self.slope(0.0) {
            return Some(0.0);
        }
        if pull >= self.strength {
            return None;
        }
        let ratio = pull / self.strength;
        let cosh_x = (ratio * a.cosh() - (-a).exp()) / (1.0 - ratio);
        Some(self.threshold / a * cosh_x.max(1.0).acosh())
    }
}

/// Quadratic excluded volume, Pi = B c^2 / 2, of earlier versions of the model (thesis, section 2.2.3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraticExcludedVolume {
    strength: f64,
}

impl QuadraticExcludedVolume {
    /// Strength B >= 0 (tension times length squared).
    ///
    /// # Errors
    /// A negative or non-finite strength.
    pub fn new(strength: f64) -> Result<Self, InterfaceError> {
        Ok(Self { strength: not_negative("the strength of the excluded volume", strength)? })
    }

    /// The strength B (tension times length squared).
    #[must_use]
    pub fn strength(&self) -> f64 {
        self.strength
    }
}

impl ExcludedVolume for QuadraticExcludedVolume {
    fn pressure(&self, c: f64) -> f64 {
        0.5 * self.strength * c * c
    }

    fn slope(&self, c: f64) -> f64 {
        self.strength * c
    }

    fn plateau(&self, pull: f64) -> Option<f64> {
        if pull <= 0.0 {
            Some(0.0)
        } else if self.strength > 0.0 {
            Some(pull / self.strength)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests;
