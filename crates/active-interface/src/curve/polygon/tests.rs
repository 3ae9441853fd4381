use super::*;
use crate::error::refused;
use approx::assert_relative_eq;
use proptest::prelude::*;

#[test]
fn a_rectangle() {
    let points = [[1.0, 2.0], [5.0, 2.0], [5.0, 4.0], [1.0, 4.0]].map(|[x, y]| Vec2::new(x, y));
    let moments = polygon_moments(&points).unwrap();
    assert_relative_eq!(moments.area, 8.0);
    assert!((moments.centroid - Vec2::new(3.0, 3.0)).abs().max_element() <= 1e-15);
    assert_relative_eq!(moments.xx, 2.0 * 64.0 / 12.0, max_relative = 1e-14);
    assert_relative_eq!(moments.yy, 4.0 * 8.0 / 12.0, max_relative = 1e-14);
    assert!(moments.xy.abs() < 1e-13);
    assert_relative_eq!(polygon_perimeter(&points).unwrap(), 12.0);
    let reversed: Vec<Vec2> = points.iter().rev().copied().collect();
    assert_relative_eq!(polygon_area(&reversed).unwrap(), -8.0);
}

#[test]
fn bad_points_are_refused() {
    let line = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]].map(|[x, y]| Vec2::new(x, y));
    assert!(refused(&polygon_moments(&line).unwrap_err(), "the curve encloses no area: it is "));
    assert!(polygon_area(&line[..2]).is_err());
    assert!(polygon_perimeter(&[line[0], Vec2::new(f64::NAN, 0.0), line[2]]).is_err());
}

proptest! {
    #[test]
    fn moments_follow_rotation_and_translation(angle in -3.0..3.0f64, x in -9.0..9.0f64, y in -9.0..9.0f64) {
        let points = [[0.0, 0.0], [2.0, 0.3], [2.5, 1.4], [0.7, 1.9], [-0.4, 1.0]].map(Vec2::from).to_vec();
        let turn = Vec2::from_angle(angle);
        let moved: Vec<Vec2> = points.iter().map(|p| turn.rotate(*p) + Vec2::new(x, y)).collect();
        let (before, after) = (polygon_moments(&points).unwrap(), polygon_moments(&moved).unwrap());
        prop_assert!((before.area - after.area).abs() < 1e-12);
        prop_assert!((turn.rotate(before.centroid) + Vec2::new(x, y) - after.centroid).length() < 1e-12);
        let (s, c) = angle.sin_cos();
        let xx = c * c * before.xx - 2.0 * s * c * before.xy + s * s * before.yy;
        prop_assert!((xx - after.xx).abs() < 1e-11);
        prop_assert!((before.xx + before.yy - after.xx - after.yy).abs() < 1e-11);
    }
}
