//! Images of droplets in periodic directions.

use crate::Vec2;

/// A box, or a channel that is periodic along x alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Images {
    /// Period along x (length).
    pub(crate) along: f64,
    /// Period along y (length), none between walls.
    pub(crate) across: Option<f64>,
}

impl Images {
    /// The shortest of the periodically equivalent distances.
    pub(crate) fn wrap(&self, distance: Vec2) -> Vec2 {
        let wrap = |value: f64, period: f64| value - period * (value / period).round();
        Vec2::new(wrap(distance.x, self.along), self.across.map_or(distance.y, |period| wrap(distance.y, period)))
    }

    /// Area of a doubly periodic box (length squared).
    pub(crate) fn area(&self) -> Option<f64> {
        self.across.map(|across| self.along * across)
    }
}
