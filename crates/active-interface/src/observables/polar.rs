//! Markers in polar coordinates.

use motile_base::Vec2;

use super::frame::Frame;

/// A marker in polar coordinates about the origin of a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Polar {
    /// Unit vector towards the marker, in the axes of the frame.
    pub(super) direction: Vec2,
    /// Distance from the origin (length).
    pub(super) radius: f64,
    /// Angle from this marker to the next (radians).
    pub(super) turn: f64,
}

/// All markers of a closed curve in polar coordinates.
#[derive(Debug, Clone)]
pub(super) struct PolarMarkers(Vec<Polar>);

impl PolarMarkers {
    pub(super) fn new(markers: &[Vec2], frame: &Frame) -> Self {
        let mut list: Vec<_> = markers
            .iter()
            .map(|marker| {
                let at = frame.coordinates(*marker);
                let radius = at.length();
                // The polar angle of the origin is taken to be zero.
                let direction = if radius > 0.0 { at / radius } else { Vec2::X };
                Polar { direction, radius, turn: 0.0 }
            })
            .collect();
        for k in 0..list.len() {
            let next = list[if k + 1 == list.len() { 0 } else { k + 1 }];
            list[k].turn = list[k].direction.angle_to(next.direction);
        }
        Self(list)
    }

    /// Returns the markers, each with its weight in integrals over the polar angle.
    pub(super) fn weighted(&self) -> impl Iterator<Item = (Polar, f64)> {
        let before = self.0.last().map_or(0.0, |last| last.turn);
        self.0.iter().scan(before, |before, polar| {
            let weight = 0.5 * (*before + polar.turn);
            *before = polar.turn;
            Some((*polar, weight))
        })
    }

    /// Returns the unit vectors towards the middles of the segments, in polar angle, and the angles that the segments
    /// take.
    pub(super) fn segments(&self) -> impl Iterator<Item = (Vec2, f64)> {
        self.0.iter().map(|&Polar { direction: Vec2 { x, y }, turn, .. }| {
            let (sin, cos) = (0.5 * turn).sin_cos();
            (Vec2::new(x * cos - y * sin, x * sin + y * cos), turn)
        })
    }
}
