//! Regions that the fluid fills.

use boundary_integral::{Geometry, forcing};
use serde::{Deserialize, Serialize};
use stokes_grid::Drive;

/// The region that the fluid fills, centred on the origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Region {
    /// Unbounded fluid, at rest far away. Without a grid only.
    Plane,
    /// A box that is periodic in x and y; the mean velocity is zero.
    Box {
        /// Periods in x and y (length).
        lengths: [f64; 2],
    },
    /// A channel between rigid no-slip walls at y = -width/2 and width/2, periodic in x. Elastic walls fill it from
    /// these walls inwards.
    Channel {
        /// Period in x (length).
        length: f64,
        /// Distance of the rigid walls (length).
        width: f64,
        /// What drives the flow along the channel.
        #[serde(default)]
        drive: Drive,
    },
}

impl Default for Region {
    fn default() -> Self {
        Self::Box { lengths: [6.0, 6.0] }
    }
}

impl Region {
    /// Its lengths in x and y (length); infinite where it is unbounded.
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        match *self {
            Self::Plane => [f64::INFINITY; 2],
            Self::Box { lengths } => lengths,
            Self::Channel { length, width, .. } => [length, width],
        }
    }

    /// The region as boundary integrals have it.
    #[must_use]
    pub fn geometry(&self) -> Geometry {
        match *self {
            Self::Plane => Geometry::Plane,
            Self::Box { lengths } => Geometry::Box { lengths },
            Self::Channel { length, width, drive } => Geometry::Channel { length, width, forcing: forcing(drive) },
        }
    }
}
