//! Distances to walls.

use crate::Vec2;

/// The smallest distance of the points to the nearer of two walls at the heights `walls` (below, above): the gap that
/// is left between an interface and the walls (length).
///
/// Negative where a point lies beyond a wall, infinite without points, not a number where a height or the y coordinate
/// of a point is not one. For a polygon this is the exact distance, since the nearest point of a polygon to a straight
/// wall is a corner.
///
/// ```
/// use ib_core::{Vec2, gap::wall_gap};
/// let markers = [Vec2::new(0.0, -1.0), Vec2::new(5.0, 0.5)];
/// assert_eq!(wall_gap(&markers, [-1.5, 1.25]), 0.5);
/// ```
#[must_use]
pub fn wall_gap(positions: &[Vec2], walls: [f64; 2]) -> f64 {
    let [bottom, top] = walls;
    positions.iter().fold(f64::INFINITY, |least, position| {
        let [below, above] = [position.y - bottom, top - position.y];
        // Unlike `f64::min`, this keeps what is not a number.
        [below, above].into_iter().fold(least, |least, gap| if gap < least || gap.is_nan() { gap } else { least })
    })
}

#[cfg(test)]
mod tests;
