//! What drives the flow along a channel.

use input_checks::{InputError, finite};
use serde::{Deserialize, Serialize};

/// What is held fixed along a channel, beside the forces and the walls' motion: the mean pressure gradient or the flux.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drive {
    /// No mean pressure gradient: the pressure is periodic in x, fluid may stream through (Cowley's channel).
    #[default]
    ZeroGradient,
    /// A mean pressure gradient dp/dx (force per volume); a negative one drives fluid to positive x.
    Gradient(f64),
    /// No net flux, as in a closed channel: the mean pressure gradient is what this takes.
    ZeroFlux,
    /// A net flux, the integral of u over the width (area per time); the mean pressure gradient is what this takes.
    Flux(f64),
}

impl Drive {
    pub(crate) fn check(self) -> Result<(), InputError> {
        match self {
            Self::ZeroGradient | Self::ZeroFlux => Ok(()),
            Self::Gradient(value) => finite("imposed pressure gradient", value).map(drop),
            Self::Flux(value) => finite("imposed flux", value).map(drop),
        }
    }
}
