//! The surface of a body as the body describes it.

use super::Boundary;
use motile_base::Vec2;

/// A curve of the surface of a body: a closed one, or one that meets itself after periods in x. Its points follow each
/// other at roughly equal distances, the inside of the body to its left.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SurfaceCurve {
    /// The points in order, each with the periods in x that are added to its place so that the curve is continuous.
    pub points: Vec<(SurfacePoint, i32)>,
    /// Periods in x after which it meets itself: 0 for a closed curve, 1 or -1 for a wall's.
    pub periods: i32,
}

/// A point of a [`SurfaceCurve`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SurfacePoint {
    /// A marker, by its number in the body.
    Marker(usize),
    /// A place (length) at which the surface is held, such as a pinned point of a solid.
    Fixed(Vec2),
}

impl SurfaceCurve {
    /// Creates the curve through markers in their order, which meets itself after some periods in x.
    #[must_use]
    pub fn through(markers: impl IntoIterator<Item = usize>, periods: i32) -> Self {
        Self { points: markers.into_iter().map(|marker| (SurfacePoint::Marker(marker), 0)).collect(), periods }
    }

    /// Returns the markers in order, by their numbers in the body, each with the periods in x that are added to its
    /// place.
    pub fn markers(&self) -> impl Iterator<Item = (usize, i32)> {
        self.points.iter().filter_map(|&(point, shift)| Some((point.marker()?, shift)))
    }

    /// Adds its sides to a boundary, from the positions of the markers of its body (length) and the period in x
    /// (length; 0 if there is none).
    pub(super) fn add_to(&self, boundary: &mut Boundary, positions: &[Vec2], period: f64) {
        let along = |periods: i32| Vec2::new(f64::from(periods) * period, 0.0);
        let mut places = self.points.iter().map(|&(point, shift)| {
            let place = match point {
                SurfacePoint::Marker(marker) => positions[marker],
                SurfacePoint::Fixed(place) => place,
            };
            place + along(shift)
        });
        let Some(first) = places.next() else { return };
        let last = places.fold(first, |start, end| {
            boundary.push(start, end);
            end
        });
        boundary.push(last, first + along(self.periods));
    }
}

impl SurfacePoint {
    /// Returns the number of the marker, if it is one.
    pub(super) fn marker(self) -> Option<usize> {
        match self {
            Self::Marker(marker) => Some(marker),
            Self::Fixed(_) => None,
        }
    }
}
