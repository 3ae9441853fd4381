use super::*;
use crate::error::refused;
use std::f64::consts::{PI, TAU};

/// Errors of area and of the points between for a circle through n points.
fn errors(n: usize) -> (f64, f64) {
    let points: Vec<Vec2> = (0..n)
        .map(|k| {
            let (s, c) = (TAU * k as f64 / n as f64).sin_cos();
            Vec2::new(3.0 + c, s)
        })
        .collect();
    let spline = PeriodicSpline::new(&points, Vec2::ZERO).unwrap();
    let off = (0..1000)
        .map(|i| ((spline.point(f64::from(i) / 1000.0) - Vec2::new(3.0, 0.0)).length() - 1.0).abs())
        .fold(0.0, f64::max);
    ((spline.area() - PI).abs(), off)
}

#[test]
fn fourth_order_on_a_circle() {
    let (coarse, fine) = (errors(20), errors(40));
    assert!((coarse.0 / fine.0).log2() > 3.8, "{coarse:?} {fine:?}");
    assert!((coarse.1 / fine.1).log2() > 3.8, "{coarse:?} {fine:?}");
    assert!(fine.1 < 1e-5);
}

#[test]
fn goes_through_its_points_and_refuses_doubles() {
    let mut points: Vec<Vec2> =
        [[0.0, 0.0], [2.0, 0.1], [2.2, 1.5], [0.4, 1.1]].iter().map(|&[x, y]| Vec2::new(x, y)).collect();
    let spline = PeriodicSpline::new(&points, Vec2::ZERO).unwrap();
    for (point, knot) in points.iter().zip(&spline.knots) {
        assert!((spline.point(knot / spline.knots[4]) - point).length() < 1e-14);
    }
    assert!((spline.point(1.0) - points[0]).length() < 1e-14);
    points[2] = points[1];
    let error = PeriodicSpline::new(&points, Vec2::ZERO).err().unwrap();
    assert!(refused(&error, "point 1 of the curve coincides with the next one"), "{error}");
}
