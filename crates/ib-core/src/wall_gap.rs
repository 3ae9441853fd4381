//! Distances to walls.

use crate::Vec2;

/// The smallest distance of the points to the nearer of two walls at the heights `walls` (below, above): the gap that is
/// left between an interface and the walls (length).
///
/// Negative where a point lies beyond a wall, infinite without points, not a number where a height or the y coordinate of a
/// point is not one. For a polygon this is the exact distance, since the nearest point of a polygon to a straight wall is a corner.
///
/// ```
/// use ib_core::{Vec2, wall_gap};
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
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn extremes() {
        assert_eq!(wall_gap(&[], [-1.0, 1.0]), f64::INFINITY);
        assert_eq!(wall_gap(&[Vec2::new(0.0, 1.125)], [-1.0, 1.0]), -0.125);
        for markers in [[Vec2::new(0.0, f64::NAN), Vec2::zeros()], [Vec2::zeros(), Vec2::new(0.0, f64::NAN)]] {
            assert!(wall_gap(&markers, [-1.0, 1.0]).is_nan());
        }
    }

    proptest! {
        #[test]
        fn a_circle(x in -9.0..9.0f64, y in -0.9..0.9f64, radius in 0.1..2.0f64) {
            let circle: Vec<Vec2> = (0..360).map(|k| {
                let (sin, cos) = (f64::from(k)).to_radians().sin_cos();
                Vec2::new(x + radius * cos, y + radius * sin)
            }).collect();
            let expected = (1.5 - y.abs()) - radius;
            prop_assert!((wall_gap(&circle, [-1.5, 1.5]) - expected).abs() < 1e-14);
        }
    }
}
