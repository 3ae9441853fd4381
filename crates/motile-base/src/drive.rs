//! The mean pressure gradient or flux along a channel.

use serde::{Deserialize, Serialize};

use crate::{InputError, finite};

/// Mean pressure gradient or flux that is prescribed along a channel, besides the forces and the velocities of the
/// walls.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Drive {
    /// No mean pressure gradient: the pressure is periodic in x, fluid may stream through (Cowley's channel).
    #[default]
    ZeroGradient,
    /// A mean pressure gradient dp/dx (stress per length); a negative one drives fluid to positive x.
    Gradient(f64),
    /// No net flux, as in a closed channel; the mean pressure gradient follows.
    ZeroFlux,
    /// A net flux, the integral of u over the width (area per time); the mean pressure gradient follows.
    Flux(f64),
}

impl Drive {
    /// Returns the mean pressure gradient dp/dx (stress per length) that is held fixed; zero if the flux is held
    /// instead.
    #[must_use]
    pub fn gradient(self) -> f64 {
        if let Self::Gradient(gradient) = self { gradient } else { 0.0 }
    }

    /// Returns the flux, the integral of u over the width (area per time), that is held fixed. It is `None` if the mean
    /// pressure gradient is.
    #[must_use]
    pub fn flux(self) -> Option<f64> {
        match self {
            Self::ZeroFlux => Some(0.0),
            Self::Flux(flux) => Some(flux),
            Self::ZeroGradient | Self::Gradient(_) => None,
        }
    }

    /// Refuses numbers that are not finite.
    ///
    /// # Errors
    /// Returns [`InputError::NotFinite`] if the gradient or flux is not finite.
    pub fn check(self) -> Result<(), InputError> {
        match self {
            Self::ZeroGradient | Self::ZeroFlux => Ok(()),
            Self::Gradient(value) => finite("the imposed pressure gradient", value).map(drop),
            Self::Flux(value) => finite("the imposed flux", value).map(drop),
        }
    }
}
