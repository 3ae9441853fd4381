//! The tension of the interface as a function of the concentration on it.

mod excluded_volume;

use std::fmt::Debug;
use std::sync::Arc;

use motile_base::{finite, not_negative, positive};

use crate::InterfaceError;
pub use excluded_volume::ExcludedVolume;
use excluded_volume::Law;

/// A tension law: the tension gamma (force; a line tension in two dimensions) as a function of the concentration c
/// (particles per length).
///
/// Implement [`Tension::value`] and [`Tension::slope`] for your own law. [`Tension::values`] is compiled for every law,
/// so that a `dyn Tension` costs one indirect call per slice.
#[doc(alias("surface tension", "Marangoni", "equation of state", "surfactant"))]
pub trait Tension: Debug + Send + Sync {
    /// Returns the tension gamma(c) (force) at the concentration `c` (particles per length).
    fn value(&self, c: f64) -> f64;

    /// Returns the slope d gamma / d c (force times length) at the concentration `c` (particles per length).
    ///
    /// Forces follow from [`Tension::value`] alone. The slope sets the longest stable time step and the implicit part
    /// of a step, which damps crowded particles, and steady states use it for growth rates. If it differs from
    /// differences of `value` by more than 5 %, interfaces warn.
    fn slope(&self, c: f64) -> f64;

    /// Writes the tension (force) of every concentration (particles per length).
    fn values(&self, concentrations: &[f64], tensions: &mut [f64]) {
        for (tension, &c) in tensions.iter_mut().zip(concentrations) {
            *tension = self.value(c);
        }
    }

    /// Returns the warning, with its remedy, of a flaw of this law that no resolution mends
    /// ([`motile_scene::Warning`]). You need not implement it: interfaces look at the values of every law, and warn of
    /// a tension that grows in proportion to the concentration without leveling off, and of a negative one.
    fn warning(&self) -> Option<String> {
        None
    }
}

/// A constant tension: gamma = gamma0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantTension {
    bare: f64,
}

impl ConstantTension {
    /// Creates the tension gamma0 >= 0 (force).
    ///
    /// # Errors
    /// Returns an error for a negative or non-finite tension.
    pub fn new(bare: f64) -> Result<Self, InterfaceError> {
        Ok(Self { bare: not_negative("the bare tension", bare)? })
    }
}

impl Tension for ConstantTension {
    fn value(&self, _c: f64) -> f64 {
        self.bare
    }

    fn slope(&self, _c: f64) -> f64 {
        0.0
    }
}

/// The active tension gamma = gamma0 - zeta_dmu c - Pi(c) (Cowley, eqs. 2.38 and 2.39), with an excluded volume Pi.
///
/// The activity zeta_dmu is negative for particles that contract the interface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("surface tension", "cortex", "myosin", "actomyosin"))]
pub struct ContractileTension {
    bare: f64,
    activity: f64,
    excluded_volume: ExcludedVolume,
    law: Law,
}

impl ContractileTension {
    /// Makes a law from the bare tension gamma0 >= 0 (force), the activity zeta_dmu (force times length, of either
    /// sign), the excluded volume, and the mean concentration c0 (particles per length), which sets the threshold of
    /// [`ExcludedVolume::Step`] and is not used by other excluded volumes.
    ///
    /// # Errors
    /// Returns [`InterfaceError::Input`] if the bare tension is negative, if the mean concentration is not positive, if
    /// a value of the excluded volume is out of its range, or if a value is not finite.
    pub fn new(
        bare: f64,
        activity: f64,
        excluded_volume: ExcludedVolume,
        mean_concentration: f64,
    ) -> Result<Self, InterfaceError> {
        let bare = not_negative("the bare tension", bare)?;
        excluded_volume.check()?;
        let law = excluded_volume.law(positive("the mean concentration", mean_concentration)?);
        if let Law::Step { threshold, .. } = law {
            positive("the threshold of the excluded volume", threshold)?;
        }
        let activity = finite("the activity", activity)?;
        Ok(Self { bare, activity, excluded_volume, law })
    }

    /// Creates Cowley's law: step-like excluded volume of strength A (force times length), threshold 2 c0 and
    /// steepness 20.
    ///
    /// # Errors
    /// Returns the errors of [`ContractileTension::new`].
    pub fn thesis(bare: f64, activity: f64, strength: f64, mean_concentration: f64) -> Result<Self, InterfaceError> {
        Self::new(bare, activity, ExcludedVolume::Step(strength), mean_concentration)
    }

    /// Returns the bare tension gamma0 (force).
    #[must_use]
    pub fn bare(&self) -> f64 {
        self.bare
    }

    /// Returns the activity zeta_dmu (force times length).
    #[must_use]
    pub fn activity(&self) -> f64 {
        self.activity
    }

    /// Returns the excluded volume.
    #[must_use]
    pub fn excluded_volume(&self) -> ExcludedVolume {
        self.excluded_volume
    }

    /// Returns the concentration at which the tension is largest (particles per length): below it particles draw each
    /// other together, above it they drive each other apart. `None` if the tension grows without bound.
    #[must_use]
    pub fn plateau(&self) -> Option<f64> {
        self.law.plateau(-self.activity)
    }
}

impl Tension for ContractileTension {
    fn value(&self, c: f64) -> f64 {
        self.bare - self.activity * c - self.law.pressure(c)
    }

    fn slope(&self, c: f64) -> f64 {
        -self.activity - self.law.slope(c)
    }

    fn warning(&self) -> Option<String> {
        self.plateau().is_none().then(|| {
            format!(
                "the activity {} is not balanced by the excluded volume at any concentration, the particles collapse \
                 towards a point. Use |activity| below the strength of the excluded volume",
                self.activity
            )
        })
    }
}

// Laws that are shared, or chosen at run time, are laws too.
macro_rules! laws_behind_pointers {
    ($($pointer:ident),*) => {$(
        impl<T: Tension + ?Sized> Tension for $pointer<T> {
            motile_base::forwarded! {
                by &self:
                fn value(c: f64) -> f64;
                fn slope(c: f64) -> f64;
                fn values(concentrations: &[f64], tensions: &mut [f64]);
                fn warning() -> Option<String>;
                by &mut self:
            }
        }
    )*};
}

laws_behind_pointers!(Arc, Box);

#[cfg(test)]
mod tests;
