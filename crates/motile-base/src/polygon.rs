//! Area and centroid of a closed polygon, what lies within it, and where it crosses itself.

mod crossing;

pub use crossing::{CrossingFinder, first_crossing};

use crate::Vec2;

/// Returns the edges of the closed polygon through points, as pairs of end points.
pub fn edges(points: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    points.iter().zip(points.iter().cycle().skip(1)).map(|(&a, &b)| (a, b))
}

/// Returns the signed area of the closed polygon through points (length squared), positive for counter-clockwise order;
/// exact.
#[must_use]
pub fn area(points: &[Vec2]) -> f64 {
    area_and_arm(points).0
}

/// Returns the signed area of the closed polygon through points (length squared), and the arm from the first point to
/// the centroid of that area (length), which is not a number if there is no area: exact sums over the triangles that
/// the first point makes with the edges.
#[must_use]
pub fn area_and_arm(points: &[Vec2]) -> (f64, Vec2) {
    let origin = points.first().copied().unwrap_or_default();
    let (area, first) = edges(points).fold((0.0, Vec2::ZERO), |(area, first), (a, b)| {
        let (a, b) = (a - origin, b - origin);
        let twice = a.perp_dot(b);
        (area + 0.5 * twice, first + (a + b) * (twice / 6.0))
    });
    (area, first / area)
}

/// Returns true if a point lies within the closed polygon through points, of either order; on an edge either answer.
#[must_use]
pub fn contains(points: &[Vec2], point: Vec2) -> bool {
    let crossed = edges(points).filter(|(a, b)| {
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests;
