//! Regions that the fluid fills.

use serde::{Deserialize, Serialize};

use crate::{Drive, InputError, finite, not_negative, positive, within};
use described::Described;

mod described;

/// Region that the fluid fills, centred on the origin.
///
/// In data, a channel with slip is a `channel` with the key `slip`: two lengths, or one for both walls. A box in three
/// dimensions is a `box` with three lengths.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "Described", into = "Described")]
#[non_exhaustive]
#[doc(alias("domain", "periodic box", "channel", "tube", "boundary conditions"))]
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
        drive: Drive,
    },
    /// A channel as [`Region::Channel`], along whose walls the fluid slips: `u = b du/dn` and `v = 0` at a wall with
    /// the slip length b and the normal n into the fluid (Navier's condition). [`Region::with_slip`] makes one.
    #[doc(alias("slip length", "Navier slip", "partial slip"))]
    SlipChannel {
        /// Period in x (length).
        length: f64,
        /// Distance between the walls (length).
        width: f64,
        /// Mean pressure gradient or flux that is prescribed along the channel.
        drive: Drive,
        /// Slip lengths of the lower and the upper wall (length), not negative.
        slip: [f64; 2],
    },
    /// Unbounded fluid in three dimensions, at rest far away, around bodies of revolution about the x axis: curves are
    /// their meridians with the mirror images, y the distance from the axis.
    Space,
    /// A tube in three dimensions with a rigid no-slip wall around the x axis, around bodies of revolution as in
    /// [`Region::Space`].
    Tube {
        /// Radius of the tube (length), the radius of its ends if it is not straight.
        radius: f64,
        /// Shape of the wall.
        shape: TubeShape,
        /// Flux, or mean pressure gradient over the length, that is prescribed along the tube.
        drive: Drive,
        /// Length of the tube (length): between closed ends where it is not straight, 16 radii without; of a straight
        /// one, which continues beyond, the length over which the pressure falls by the prescribed gradient times it,
        /// as in a tube with a droplet in every such length, a radius or more from the next one; infinite without.
        length: Option<f64>,
    },
    /// The fluid in three dimensions between two plane rigid no-slip walls at z = lower and z = upper. It has no end
    /// along x and y, and is at rest far away.
    #[doc(alias("parallel plates", "Hele-Shaw cell"))]
    Slit {
        /// Height of the lower wall (length).
        lower: f64,
        /// Height of the upper wall (length).
        upper: f64,
    },
    /// A box in three dimensions that is periodic in x, y and z; the mean velocity is zero.
    SpaceBox {
        /// Periods in x, y and z (length).
        lengths: [f64; 3],
    },
}

/// Shape of the wall of a tube.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", rename_all_fields = "kebab-case")]
#[non_exhaustive]
pub enum TubeShape {
    /// Straight.
    #[default]
    Straight,
    /// A narrow passage around x = 0.
    Constriction {
        /// Radius of the throat (length).
        throat: f64,
        /// Length of the throat (length).
        throat_length: f64,
        /// Length of the ramp at either end of it (length).
        ramp: f64,
    },
    /// The radius `radius + amplitude cos(2 pi x/period)`, but within two radii of the ends.
    Sinusoidal {
        /// Amplitude (length).
        amplitude: f64,
        /// Period (length).
        period: f64,
    },
}

/// Length of a tube that is not straight over its radius, if none is given.
const USUAL_LENGTH: f64 = 16.0;

impl TubeShape {
    /// Returns the radius of the wall at a place x (length) of a tube whose ends have the radius `end` (length) and are
    /// at the distance `half_length` from the middle (length). Ramps are hyperbolic tangents of x.
    #[must_use]
    pub fn radius(self, end: f64, half_length: f64, x: f64) -> f64 {
        // From 0 to 1 over a length around the place 0.
        let step = |x: f64, length: f64| 0.5 * (1.0 + (4.0 * x / length).tanh());
        match self {
            Self::Straight => end,
            Self::Constriction { throat, throat_length, ramp } => {
                let half = 0.5 * (throat_length + ramp);
                end - (end - throat) * step(x + half, ramp) * step(half - x, ramp)
            }
            Self::Sinusoidal { amplitude, period } => {
                let place = half_length - 2.0 * end;
                let within = step(x + place, end) * step(place - x, end);
                end + amplitude * within * (std::f64::consts::TAU * x / period).cos()
            }
        }
    }

    /// Returns the minimum radius of the wall (length), of a tube whose ends have the radius `end` (length).
    #[must_use]
    pub fn least_radius(self, end: f64) -> f64 {
        match self {
            Self::Straight => end,
            Self::Constriction { throat, .. } => throat.min(end),
            Self::Sinusoidal { amplitude, .. } => end - amplitude.abs(),
        }
    }

    /// Returns the spacing of nodes (length) that resolves the ramps or waves of the wall, whose ends have the radius
    /// `end` (length); infinite for a straight wall.
    #[must_use]
    pub fn finest_spacing(self, end: f64) -> f64 {
        match self {
            Self::Straight => f64::INFINITY,
            Self::Constriction { ramp, .. } => ramp / 10.0,
            Self::Sinusoidal { amplitude, period } => {
                (period / 24.0).min(0.06 * period * self.least_radius(end) / amplitude.abs())
            }
        }
    }

    /// Refuses lengths that are not positive and finite, walls that touch the axis, and tubes shorter than their shape
    /// with two radii at both ends.
    fn check(self, end: f64, length: f64) -> Result<(), InputError> {
        match self {
            Self::Straight => Ok(()),
            Self::Constriction { throat, throat_length, ramp } => {
                positive("the radius of the throat", throat)?;
                positive("the length of the throat", throat_length)?;
                positive("the length of the ramps", ramp)?;
                let least = 4.0 * end + throat_length + 2.0 * ramp;
                within("the length of a tube with throat and ramps", length, least, f64::INFINITY).map(drop)
            }
            Self::Sinusoidal { amplitude, period } => {
                positive("the period of the wall", period)?;
                within("the amplitude of the wall over the radius", amplitude / end, -0.95, 0.95)?;
                within("the length of a tube with one period", length, 4.0 * end + period, f64::INFINITY).map(drop)
            }
        }
    }
}

impl Region {
    /// Minimum distance of bodies in neighbouring lengths of a straight tube that a pressure is given for, over its
    /// radius. The flows that they cause on one another, which are not counted, fall by `exp(-4.47)` over it.
    pub const LENGTHS_APART: f64 = 1.0;

    /// Refuses lengths that are not positive and finite, and a drive that is not finite.
    ///
    /// # Errors
    /// Returns [`InputError::NotPositive`], [`InputError::NotFinite`].
    pub fn check(&self) -> Result<(), InputError> {
        match *self {
            Self::Plane | Self::Space => Ok(()),
            Self::Tube { radius, shape, drive, length } => {
                positive("the radius of the tube", radius)?;
                length.map_or(Ok(0.0), |length| positive("the length of the tube", length))?;
                shape.check(radius, length.unwrap_or(USUAL_LENGTH * radius))?;
                drive.check()
            }
            Self::Box { lengths: [lx, ly] } => {
                positive("the period in x", lx)?;
                positive("the period in y", ly).map(drop)
            }
            Self::Slit { lower, upper } => {
                finite("the height of the lower wall", lower)?;
                finite("the height of the upper wall", upper)?;
                positive("the distance of the upper wall from the lower one", upper - lower).map(drop)
            }
            Self::SpaceBox { lengths: [lx, ly, lz] } => {
                positive("the period in x", lx)?;
                positive("the period in y", ly)?;
                positive("the period in z", lz).map(drop)
            }
            Self::Channel { length, width, drive } | Self::SlipChannel { length, width, drive, .. } => {
                positive("the period of the channel", length)?;
                positive("the width of the channel", width)?;
                for slip in self.slip() {
                    not_negative("the slip length of a wall", slip)?;
                }
                drive.check()
            }
        }
    }

    /// Creates a straight, infinitely long tube of this radius (length) without flux.
    #[must_use]
    pub const fn tube(radius: f64) -> Self {
        Self::Tube { radius, shape: TubeShape::Straight, drive: Drive::ZeroFlux, length: None }
    }

    /// Returns half of the length (length) of a tube between its closed ends; `None` for straight tubes, which have no
    /// ends, and for other regions.
    #[must_use]
    pub fn half_length(&self) -> Option<f64> {
        match *self {
            Self::Tube { radius, shape, length, .. } if shape != TubeShape::Straight => {
                Some(0.5 * length.unwrap_or(USUAL_LENGTH * radius))
            }
            _ => None,
        }
    }

    /// Returns true for three dimensions with rotational symmetry about the x axis.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        matches!(self, Self::Space | Self::Tube { .. })
    }

    /// Returns the lengths in x and y (length), a channel's width and a tube's largest diameter in y; infinite if the
    /// fluid is unbounded.
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        match *self {
            Self::Plane | Self::Space | Self::Slit { .. } => [f64::INFINITY; 2],
            Self::SpaceBox { lengths: [lx, ly, _] } => [lx, ly],
            Self::Tube { radius, shape, .. } => {
                let widest = if let TubeShape::Sinusoidal { amplitude, .. } = shape { amplitude.abs() } else { 0.0 };
                [self.half_length().map_or(f64::INFINITY, |half| 2.0 * half), 2.0 * (radius + widest)]
            }
            Self::Box { lengths } => lengths,
            Self::Channel { length, width, .. } | Self::SlipChannel { length, width, .. } => [length, width],
        }
    }

    /// Returns the periods in x and y (length); `None` if the fluid is unbounded or ends at a wall.
    #[must_use]
    pub fn periods(&self) -> [Option<f64>; 2] {
        match *self {
            Self::Plane | Self::Space | Self::Tube { .. } | Self::Slit { .. } => [None; 2],
            Self::SpaceBox { lengths: [lx, ly, _] } => [Some(lx), Some(ly)],
            Self::Box { lengths } => lengths.map(Some),
            Self::Channel { length, .. } | Self::SlipChannel { length, .. } => [Some(length), None],
        }
    }

    /// Returns the drive of a channel; `None` for other regions.
    #[must_use]
    pub fn drive(&self) -> Option<Drive> {
        if let Self::Channel { drive, .. } | Self::SlipChannel { drive, .. } = *self { Some(drive) } else { None }
    }

    /// Returns the slip lengths of the lower and the upper straight wall of a channel (length); zero without slip, and
    /// for other regions.
    #[must_use]
    pub fn slip(&self) -> [f64; 2] {
        if let Self::SlipChannel { slip, .. } = *self { slip } else { [0.0; 2] }
    }

    /// Returns the region with these slip lengths of the lower and the upper wall (length). Regions other than channels
    /// stay as they are.
    #[must_use]
    pub fn with_slip(self, slip: [f64; 2]) -> Self {
        match self.without_slip() {
            Self::Channel { length, width, drive } if slip != [0.0; 2] => {
                Self::SlipChannel { length, width, drive, slip }
            }
            region => region,
        }
    }

    /// Returns the region with no-slip walls.
    #[must_use]
    pub fn without_slip(self) -> Self {
        match self {
            Self::SlipChannel { length, width, drive, .. } => Self::Channel { length, width, drive },
            region => region,
        }
    }
}

#[cfg(test)]
mod tests;
