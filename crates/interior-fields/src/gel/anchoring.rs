//! The director at the interface.

/// How the director meets the interface of its droplet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Anchoring {
    /// Along the outward normal.
    Homeotropic,
    /// Along the tangent, counter-clockwise.
    Planar,
    /// At any angle: nothing turns it there.
    #[default]
    Free,
}

impl Anchoring {
    /// Angle from the counter-clockwise tangent to the director; `None` where it is free.
    pub(super) fn angle_from_tangent(self) -> Option<f64> {
        match self {
            Self::Homeotropic => Some(-std::f64::consts::FRAC_PI_2),
            Self::Planar => Some(0.0),
            Self::Free => None,
        }
    }
}
