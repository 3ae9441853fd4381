//! The gap between two bodies.

use super::Boundary;
use crate::{Body, Vec2};

/// What is measured of a body: corners of its boundary, or markers where it has none.
#[derive(Debug)]
pub(crate) struct Outline {
    boundary: Boundary,
    points: Vec<Vec2>,
    holds_fluid: bool,
}

impl Outline {
    pub(crate) fn of(body: &dyn Body) -> Self {
        let boundary = Boundary::of(body);
        let mut points: Vec<Vec2> = boundary.corners().collect();
        if boundary.is_empty() {
            points.resize(body.marker_count(), Vec2::ZERO);
            body.write_markers(&mut points);
        }
        Self { boundary, points, holds_fluid: body.kind().holds_fluid() }
    }

    /// The smallest signed distance of the points of another body from the boundary (length), positive for most of
    /// those inside an interface: what lies in it is measured from within.
    fn smallest(&self, other: &Self, periods: [Option<f64>; 2]) -> Option<f64> {
        let distances = || other.points.iter().map(|&point| self.boundary.distance(point, periods));
        let within = self.holds_fluid && 2 * distances().filter(|d| *d < 0.0).count() > other.points.len();
        let smallest = distances().map(|distance| if within { -distance } else { distance }).reduce(f64::min);
        smallest.filter(|_| !self.boundary.is_empty())
    }

    /// The gap to another body; see [`crate::System::gap`].
    pub(crate) fn gap(&self, other: &Self, periods: [Option<f64>; 2]) -> Option<f64> {
        [self.smallest(other, periods), other.smallest(self, periods)].into_iter().flatten().reduce(f64::min)
    }
}
