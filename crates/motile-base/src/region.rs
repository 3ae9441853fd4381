//! Regions that the fluid fills.

use serde::{Deserialize, Serialize};

use crate::{Drive, InputError, positive};

/// Region that the fluid fills, centred on the origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Region {
    /// The unbounded plane, the fluid at rest far away.
    Plane,
    /// A box that is periodic in x and y; the mean velocity is zero.
    Box {
        /// Periods in x and y (length).
        lengths: [f64; 2],
    },
    /// A channel between rigid no-slip walls at y = -width/2 and width/2, periodic in x.
    Channel {
        /// Period in x (length).
        length: f64,
        /// Distance between the walls (length).
        width: f64,
        /// Mean pressure gradient or flux that is prescribed along the channel.
        #[serde(default)]
        drive: Drive,
    },
}

impl Region {
    /// Refuses lengths that are not positive and finite, and a drive that is not finite.
    ///
    /// # Errors
    /// [`InputError::NotPositive`], [`InputError::NotFinite`].
    pub fn check(&self) -> Result<(), InputError> {
        match *self {
            Self::Plane => Ok(()),
            Self::Box { lengths: [lx, ly] } => {
                positive("the period in x", lx)?;
                positive("the period in y", ly).map(drop)
            }
            Self::Channel { length, width, drive } => {
                positive("the period of the channel", length)?;
                positive("the width of the channel", width)?;
                drive.check()
            }
        }
    }

    /// Lengths in x and y (length), a channel's width in y; infinite where the fluid is unbounded.
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        match *self {
            Self::Plane => [f64::INFINITY; 2],
            Self::Box { lengths } => lengths,
            Self::Channel { length, width, .. } => [length, width],
        }
    }

    /// Periods in x and y (length); `None` where the fluid is unbounded or ends at a wall.
    #[must_use]
    pub fn periods(&self) -> [Option<f64>; 2] {
        match *self {
            Self::Plane => [None; 2],
            Self::Box { lengths } => lengths.map(Some),
            Self::Channel { length, .. } => [Some(length), None],
        }
    }

    /// Drive of a channel; `None` for other regions.
    #[must_use]
    pub fn drive(&self) -> Option<Drive> {
        if let Self::Channel { drive, .. } = *self { Some(drive) } else { None }
    }
}

#[cfg(test)]
mod tests;
