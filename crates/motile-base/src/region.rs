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
    /// Unbounded fluid in three dimensions, at rest far away, around bodies of revolution about the x axis: curves are
    /// their meridians with the mirror images, y the distance from the axis.
    Space,
    /// A straight, infinitely long tube in three dimensions with a rigid no-slip wall at the distance `radius` from the
    /// x axis, without flux, around bodies of revolution as in [`Region::Space`].
    Tube {
        /// Radius of the tube (length).
        radius: f64,
    },
}

impl Region {
    /// Refuses lengths that are not positive and finite, and a drive that is not finite.
    ///
    /// # Errors
    /// [`InputError::NotPositive`], [`InputError::NotFinite`].
    pub fn check(&self) -> Result<(), InputError> {
        match *self {
            Self::Plane | Self::Space => Ok(()),
            Self::Tube { radius } => positive("the radius of the tube", radius).map(drop),
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

    /// True for three dimensions with rotational symmetry about the x axis.
    #[must_use]
    pub fn is_of_revolution(&self) -> bool {
        matches!(self, Self::Space | Self::Tube { .. })
    }

    /// Lengths in x and y (length), a channel's width and a tube's diameter in y; infinite where the fluid is
    /// unbounded.
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        match *self {
            Self::Plane | Self::Space => [f64::INFINITY; 2],
            Self::Tube { radius } => [f64::INFINITY, 2.0 * radius],
            Self::Box { lengths } => lengths,
            Self::Channel { length, width, .. } => [length, width],
        }
    }

    /// Periods in x and y (length); `None` where the fluid is unbounded or ends at a wall.
    #[must_use]
    pub fn periods(&self) -> [Option<f64>; 2] {
        match *self {
            Self::Plane | Self::Space | Self::Tube { .. } => [None; 2],
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
