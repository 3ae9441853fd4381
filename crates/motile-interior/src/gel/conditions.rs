//! Conditions on the director: anchoring at the interface, angles at the start.

use std::f64::consts::{FRAC_PI_2, PI};

use active_interface::internal::SplitMix64;
use motile_base::{Vec2, finite, not_negative};

use crate::InteriorError;

/// Anchoring: the angle at which the director meets the interface of its droplet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Anchoring {
    /// Along the outward normal.
    Homeotropic,
    /// Along the tangent, counter-clockwise.
    Planar,
    /// The director may have any angle: the interface exerts no couple on the director.
    #[default]
    Free,
}

impl Anchoring {
    /// Returns the angle from the counter-clockwise tangent to the director (radians); `None` if it is free.
    pub(super) fn angle_from_tangent(self) -> Option<f64> {
        match self {
            Self::Homeotropic => Some(-FRAC_PI_2),
            Self::Planar => Some(0.0),
            Self::Free => None,
        }
    }
}

/// Initial director.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[non_exhaustive]
pub enum DirectorStart {
    /// Uniform direction, with each node turned by a random angle of up to `noise` to either side.
    Uniform {
        /// Angle to x (radians).
        angle: f64,
        /// Largest random angle (radians).
        #[serde(default)]
        noise: f64,
        /// Seed of the random angles.
        #[serde(default)]
        seed: u64,
    },
    /// Outwards from the centre.
    Aster,
    /// Counter-clockwise around the centre.
    Vortex,
    /// Random direction at each node, all equally likely.
    Random {
        /// Seed of the random angles.
        seed: u64,
    },
}

impl DirectorStart {
    /// Returns the angle of the director to x (radians) as a function of position (length), around a centre; random
    /// ones are drawn call by call.
    ///
    /// # Errors
    /// Returns an error for angles that are not finite, or a negative noise.
    pub fn angles(&self, centre: Vec2) -> Result<impl FnMut(Vec2) -> f64 + use<>, InteriorError> {
        let (around, turn, noise, seed) = match *self {
            Self::Uniform { angle, noise, seed } => {
                finite("the angle of the director", angle)?;
                (0.0, angle, not_negative("the noise of the director", noise)?, seed)
            }
            Self::Aster => (1.0, 0.0, 0.0, 0),
            Self::Vortex => (1.0, FRAC_PI_2, 0.0, 0),
            Self::Random { seed } => (0.0, 0.0, PI, seed),
        };
        let mut random = SplitMix64::new(seed);
        Ok(move |node: Vec2| around * (node - centre).to_angle() + turn + noise * (2.0 * random.uniform() - 1.0))
    }
}
