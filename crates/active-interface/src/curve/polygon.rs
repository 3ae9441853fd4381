//! Exact geometry of the polygon through the markers.

pub(crate) use motile_base::polygon::{area as raw_area, edges};
use motile_base::{
    Vec2,
    internal::{all_points_finite, at_least},
    polygon::area_and_arm,
};

use crate::InterfaceError;

/// Area, centroid and second moments of area of a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct AreaMoments {
    /// Area (length squared), positive for counter-clockwise order.
    pub area: f64,
    /// Centroid of the area (length).
    pub centroid: Vec2,
    /// Integral of x^2 over the area (length^4), x and y measured from the centroid.
    pub xx: f64,
    /// Integral of x y over the area (length^4).
    pub xy: f64,
    /// Integral of y^2 over the area (length^4).
    pub yy: f64,
}

pub(crate) fn raw_perimeter(points: &[Vec2]) -> f64 {
    edges(points).map(|(a, b)| (b - a).length()).sum()
}

/// Returns the area moments as exact sums over the triangles that the first point makes with the edges.
pub(crate) fn raw_moments(points: &[Vec2]) -> AreaMoments {
    let origin = points.first().copied().unwrap_or_default();
    let (area, centre) = area_and_arm(points);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (a, b) in edges(points) {
        let (a, b) = (a - origin, b - origin);
        let twice = a.perp_dot(b);
        xx += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12.0;
        yy += twice * (a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
        xy += twice * (2.0 * (a.x * a.y + b.x * b.y) + a.x * b.y + b.x * a.y) / 24.0;
    }
    AreaMoments {
        area,
        centroid: origin + centre,
        xx: xx - area * centre.x * centre.x,
        xy: xy - area * centre.x * centre.y,
        yy: yy - area * centre.y * centre.y,
    }
}

fn check(points: &[Vec2]) -> Result<(), InterfaceError> {
    at_least("points of a polygon", points.len(), 3)?;
    Ok(all_points_finite("the points of the polygon", points)?)
}

/// Returns the signed area of the polygon through the points (length squared), exact; positive for counter-clockwise
/// order.
///
/// # Errors
/// Returns an error for fewer than three points, points that are not finite.
pub fn polygon_area(points: &[Vec2]) -> Result<f64, InterfaceError> {
    check(points)?;
    Ok(raw_area(points))
}

/// Returns the perimeter of the closed polygon through the points (length).
///
/// # Errors
/// Returns an error for fewer than three points, points that are not finite.
pub fn polygon_perimeter(points: &[Vec2]) -> Result<f64, InterfaceError> {
    check(points)?;
    Ok(raw_perimeter(points))
}

/// Returns the area, centroid and second moments of the area inside the polygon, exact.
///
/// # Errors
/// Returns an error for fewer than three points, points that are not finite, no area.
pub fn polygon_moments(points: &[Vec2]) -> Result<AreaMoments, InterfaceError> {
    check(points)?;
    let (area, length) = (raw_area(points), raw_perimeter(points));
    if !(area.abs() > 1e-14 * length * length && area.is_finite()) {
        return Err(InterfaceError::no_area(area, length));
    }
    Ok(raw_moments(points))
}

#[cfg(test)]
mod tests;
