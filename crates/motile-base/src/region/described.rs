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
        lengths: [f64; 2],
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
            Described::Box { lengths } => Self::Box { lengths },
            Described::Channel { length, width, drive, slip } => {
                let slip = slip.map_or([0.0; 2], |slip| match slip {
                    Slip::Both(slip) => [slip; 2],
                    Slip::Each(slip) => slip,
                });
                Self::Channel { length, width, drive }.with_slip(slip)
            }
            Described::Space => Self::Space,
            Described::Tube { radius, shape, drive, length } => Self::Tube { radius, shape, drive, length },
        }
    }
}

impl From<Region> for Described {
    fn from(region: Region) -> Self {
        match region {
            Region::Plane => Self::Plane,
            Region::Box { lengths } => Self::Box { lengths },
            Region::Channel { length, width, drive } => Self::Channel { length, width, drive, slip: None },
            Region::SlipChannel { length, width, drive, slip } => {
                Self::Channel { length, width, drive, slip: Some(Slip::Each(slip)) }
            }
            Region::Space => Self::Space,
            Region::Tube { radius, shape, drive, length } => Self::Tube { radius, shape, drive, length },
        }
    }
}
