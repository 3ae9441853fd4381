//! Regions as they are written in data.

use serde::{Deserialize, Serialize};

use super::{Region, TubeShape};
use crate::Drive;

/// A region in data, where a channel with slip has one key more.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", rename = "Region")]
pub(super) enum Described {
    Plane,
    Box {
        lengths: Sides,
    },
    Channel {
        length: f64,
        width: f64,
        #[serde(default)]
        drive: Drive,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        slip: Option<Slip>,
    },
    Space,
    Tube {
        radius: f64,
        #[serde(default)]
        shape: TubeShape,
        #[serde(default = "no_flux")]
        drive: Drive,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        length: Option<f64>,
    },
    Slit {
        lower: f64,
        upper: f64,
    },
}

/// The sides of a box in two dimensions, or in three. In data, a list, so that each side has a key.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub(super) enum Sides {
    Plane([f64; 2]),
    Space([f64; 3]),
}

impl TryFrom<Vec<f64>> for Sides {
    type Error = String;

    fn try_from(lengths: Vec<f64>) -> Result<Self, String> {
        match lengths[..] {
            [x, y] => Ok(Self::Plane([x, y])),
            [x, y, z] => Ok(Self::Space([x, y, z])),
            // As serde says it of lists with a fixed number of entries.
            _ => Err(format!(
                "invalid length {}, expected two lengths, [x, y], or three in three dimensions, [x, y, z]",
                lengths.len()
            )),
        }
    }
}

impl From<Sides> for Vec<f64> {
    fn from(sides: Sides) -> Self {
        match sides {
            Sides::Plane(lengths) => lengths.to_vec(),
            Sides::Space(lengths) => lengths.to_vec(),
        }
    }
}

/// One slip length for both walls, or one for each, the lower one first.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected one slip length, or two: [lower, upper]")]
pub(super) enum Slip {
    Both(f64),
    Each([f64; 2]),
}

fn no_flux() -> Drive {
    Drive::ZeroFlux
}

impl From<Described> for Region {
    fn from(described: Described) -> Self {
        match described {
            Described::Plane => Self::Plane,
            Described::Box { lengths: Sides::Plane(lengths) } => Self::Box { lengths },
            Described::Box { lengths: Sides::Space(lengths) } => Self::SpaceBox { lengths },
            Described::Channel { length, width, drive, slip } => {
                let slip = slip.map_or([0.0; 2], |slip| match slip {
                    Slip::Both(slip) => [slip; 2],
                    Slip::Each(slip) => slip,
                });
                Self::Channel { length, width, drive }.with_slip(slip)
            }
            Described::Space => Self::Space,
            Described::Tube { radius, shape, drive, length } => Self::Tube { radius, shape, drive, length },
            Described::Slit { lower, upper } => Self::Slit { lower, upper },
        }
    }
}

impl From<Region> for Described {
    fn from(region: Region) -> Self {
        match region {
            Region::Plane => Self::Plane,
            Region::Box { lengths } => Self::Box { lengths: Sides::Plane(lengths) },
            Region::SpaceBox { lengths } => Self::Box { lengths: Sides::Space(lengths) },
            Region::Channel { length, width, drive } => Self::Channel { length, width, drive, slip: None },
            Region::SlipChannel { length, width, drive, slip } => {
                Self::Channel { length, width, drive, slip: Some(Slip::Each(slip)) }
            }
            Region::Space => Self::Space,
            Region::Tube { radius, shape, drive, length } => Self::Tube { radius, shape, drive, length },
            Region::Slit { lower, upper } => Self::Slit { lower, upper },
        }
    }
}
