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

    /// The concentration (particles per length) at which B(c) = `pull` (tension times length), or `None` where B stays below it. At the
    /// activity `-pull` the tension has its maximum there: particles gather to about that concentration, somewhat beyond it
    /// where the flow presses them.
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
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn thesis() -> StepExcludedVolume {
        StepExcludedVolume::thesis(10.0, 100.0).unwrap()
    }

    #[test]
    fn step_slope_is_equation_2_41() {
        let law = thesis();
        for c in [0.0, 1.0, 50.0, 100.0, 180.0, 199.0, 200.0, 230.0, 400.0, 1500.0] {
            let printed = 10.0 - 10.0 * 20f64.sinh() / (20f64.cosh() + (20.0 * c / 200.0_f64).cosh());
            assert!((law.slope(c) - printed).abs() < 1e-14 * 10.0, "c = {c}");
        }
        assert_relative_eq!(law.slope(200.0), 5.0, epsilon = 1e-7);
    }

    #[test]
    fn step_pressure_is_the_integral_of_the_slope() {
        // Composite Simpson, 2000 intervals: an independent value of (2.40).
        let law = thesis();
        for c in [80.0, 200.0, 260.0, 700.0] {
            let n = 2000;
            let h = c / f64::from(n);
            let sum: f64 = (0..=n)
                .map(|i| {
                    let weight = if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                    weight * law.slope(f64::from(i) * h)
                })
                .sum();
            assert_relative_eq!(law.pressure(c), sum * h / 3.0, max_relative = 1e-9);
        }
    }

    #[test]
    fn nothing_overflows_far_above_the_threshold() {
        let law = StepExcludedVolume::new(10.0, 200.0, 300.0).unwrap();
        assert_relative_eq!(law.pressure(1e9), 10.0 * (1e9 - 200.0), max_relative = 1e-14);
        assert_relative_eq!(law.slope(1e9), 10.0);
        assert_eq!(law.pressure(0.0), 0.0);
    }

    #[test]
    fn plateau_is_where_the_slope_equals_the_pull() {
        for law in [thesis(), StepExcludedVolume::new(8.0, 90.0, 300.0).unwrap()] {
            for pull in [0.5, 2.0, 4.0, 7.9] {
                let c = law.plateau(pull).unwrap();
                assert_relative_eq!(law.slope(c), pull, max_relative = 1e-11);
            }
            assert_eq!(law.plateau(10.0), None);
        }
        assert_eq!(QuadraticExcludedVolume::new(0.02).unwrap().plateau(3.0), Some(150.0));
        assert_eq!(NoExcludedVolume.plateau(1.0), None);
    }

    #[test]
    fn bad_values_are_refused() {
        assert!(StepExcludedVolume::new(-1.0, 200.0, 20.0).is_err());
        assert!(StepExcludedVolume::new(1.0, 0.0, 20.0).is_err());
        assert!(StepExcludedVolume::new(1.0, 200.0, f64::NAN).is_err());
        assert!(StepExcludedVolume::new(1.0, 200.0, 301.0).is_err());
        assert!(StepExcludedVolume::thesis(1.0, -100.0).is_err());
        assert!(QuadraticExcludedVolume::new(f64::INFINITY).is_err());
    }

    proptest! {
        #[test]
        fn pressure_and_slope_agree(c in 0.0..3000.0f64, a in 1.0..60.0f64, strength in 0.0..50.0f64) {
            let law = StepExcludedVolume::new(strength, 200.0, a).unwrap();
            let step = 1e-3;
            let difference = (law.pressure(c + step) - law.pressure(c - step)) / (2.0 * step);
            prop_assert!((difference - law.slope(c)).abs() < 1e-6 * (1.0 + strength));
            prop_assert!(law.slope(c) >= 0.0 && law.slope(c) <= strength);
        }
    }
}
