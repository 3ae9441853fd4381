//! Areas and lengths in closed form, and radii that are too large.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::Curve;

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];

fn scaled(points: &[[f64; 2]], scale: f64) -> Vec<Vec2> {
    points.iter().map(|&[x, y]| Vec2::new(x, y) * scale).collect()
}

/// A square loses (4 - pi) r^2 of its area and (8 - 2 pi) r of its perimeter, in any unit.
#[test]
fn a_rounded_square_has_the_area_of_the_closed_form() {
    for scale in [1.0, 1e-6, 1e6] {
        for part in [0.1, 0.5, 1.0] {
            let (points, radius) = (scaled(&SQUARE, scale), part * scale);
            let curve = Curve::rounded_polygon(&points, radius).unwrap();
            let (area, perimeter) = (4.0 - (4.0 - PI) * part * part, 8.0 - (8.0 - 2.0 * PI) * part);
            assert!((curve.area() / (area * scale * scale) - 1.0).abs() < 1e-14, "{scale} {part}");
            assert!((curve.perimeter() / (perimeter * scale) - 1.0).abs() < 1e-14, "{scale} {part}");
            // Markers have the area of the curve, and lie on it up to the spacing squared.
            let markers = curve.markers(400).unwrap();
            assert!((crate::polygon_area(&markers).unwrap() / curve.area() - 1.0).abs() < 1e-12);
            let inside = |p: &Vec2| p.x.min(p.y) > -1e-3 * scale && p.max_element() < 2.001 * scale;
            assert!(markers.iter().all(inside));
        }
    }
}

/// Corners that turn right and points on straight sides: an L, clockwise and counter-clockwise.
#[test]
fn corners_of_either_hand_are_rounded() {
    let mut corners =
        scaled(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]], 1.0);
    for _ in 0..2 {
        let curve = Curve::rounded_polygon(&corners, 0.2).unwrap();
        // Five corners to the left and one to the right.
        assert!((curve.area() - (5.0 - 4.0 * (1.0 - 0.25 * PI) * 0.04)).abs() < 1e-14, "{}", curve.area());
        assert!((curve.perimeter() - (12.0 - 6.0 * (2.0 - 0.5 * PI) * 0.2)).abs() < 1e-14);
        // The curve has no kink: steps between 8000 points turn by at most step/r.
        let step = curve.perimeter() / 8000.0;
        let points: Vec<Vec2> = (0..8000).map(|k| curve.point(f64::from(k) / 8000.0)).collect();
        for k in 0..8000 {
            let [a, b, c] = [points[k], points[(k + 1) % 8000], points[(k + 2) % 8000]];
            assert!((b - a).angle_to(c - b).abs() < 1.01 * step / 0.2, "{k}");
        }
        corners.reverse();
    }
}

#[test]
fn radii_that_do_not_fit_are_refused_with_the_largest_one() {
    let error = Curve::rounded_polygon(&scaled(&SQUARE, 1.0), 1.2).unwrap_err().to_string();
    assert!(error.contains("1.2") && error.contains("at most 1 "), "{error}");
    assert!(Curve::rounded_polygon(&scaled(&SQUARE, 1.0), 0.0).is_err());
    assert!(Curve::rounded_polygon(&scaled(&SQUARE, 1.0), f64::NAN).is_err());
    assert!(Curve::rounded_polygon(&scaled(&SQUARE[..2], 1.0), 0.1).is_err());
}

proptest! {
    /// Star-shaped polygons of any corners: the area of many samples is the exact one.
    #[test]
    fn samples_agree_with_the_exact_area(radii in proptest::collection::vec(0.6f64..1.4, 5..9)) {
        let count = radii.len() as f64;
        let points: Vec<Vec2> =
            radii.iter().enumerate().map(|(k, r)| Vec2::from_angle(2.0 * PI * k as f64 / count) * *r).collect();
        if let Ok(curve) = Curve::rounded_polygon(&points, 0.02) {
            let samples: Vec<Vec2> = (0..20_000).map(|k| curve.point(f64::from(k) / 20_000.0)).collect();
            prop_assert!((crate::polygon_area(&samples).unwrap() / curve.area() - 1.0).abs() < 1e-6);
        }
    }
}
