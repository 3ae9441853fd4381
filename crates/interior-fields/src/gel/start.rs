//! Directors to start from.

use std::f64::consts::{FRAC_PI_2, PI};

use active_interface::concentration::SplitMix64;
use ib_core::Vec2;
use ib_core::input::{finite, not_negative};

use crate::InteriorError;

/// A director to start from.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum DirectorStart {
    /// The same direction everywhere (angle to x), each node turned by a random angle of up to `noise` to either side
    /// that the seed decides.
    Uniform {
        /// Angle to x.
        angle: f64,
        /// Largest random angle.
        #[serde(default)]
        noise: f64,
        /// Seed of the random angles.
        #[serde(default)]
        seed: u64,
    },
    /// Outwards from the centroid.
    Aster,
    /// Counter-clockwise around the centroid.
    Vortex,
    /// Every direction as likely, node by node.
    Random {
        /// Seed.
        seed: u64,
    },
}

impl DirectorStart {
    /// Angles of the director at nodes (length), about their centre.
    ///
    /// # Errors
    /// Angles that are not finite, a negative noise.
    pub(super) fn angles(&self, nodes: &[Vec2], centre: Vec2) -> Result<Vec<f64>, InteriorError> {
        let around = |turn: f64| nodes.iter().map(|node| (*node - centre).to_angle() + turn).collect();
        let random = |angle: f64, noise: f64, seed: u64| {
            let mut random = SplitMix64::new(seed);
            nodes.iter().map(|_| angle + noise * (2.0 * random.uniform() - 1.0)).collect()
        };
        Ok(match *self {
            Self::Uniform { angle, noise, seed } => {
                finite("the angle of the director", angle)?;
                random(angle, not_negative("the noise of the director", noise)?, seed)
            }
            Self::Aster => around(0.0),
            Self::Vortex => around(FRAC_PI_2),
            Self::Random { seed } => random(0.0, PI, seed),
        })
    }
}
