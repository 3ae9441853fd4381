//! Traced circles, ellipses and lines, whose area is known.

use std::f64::consts::{PI, TAU};

use super::*;

/// Returns the outline of all pixels whose middle lies in a shape, along the sides of the pixels, as ImageJ traces it.
fn traced(size: i32, inside: impl Fn(f64, f64) -> bool) -> Vec<Vec2> {
    let full = |x: i32, y: i32| inside(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let first = (-size..size).flat_map(|y| (-size..size).map(move |x| (x, y))).find(|&(x, y)| full(x, y)).unwrap();
    let (mut at, mut step, mut points) = (first, (1, 0), Vec::new());
    // The shape on the left: along its lower side first.
    loop {
        points.push(Vec2::new(f64::from(at.0), f64::from(at.1)));
        at = (at.0 + step.0, at.1 + step.1);
        let pixel = |left: bool| {
            let side = if left { (-step.1, step.0) } else { (step.1, -step.0) };
            let corner = |along: i32, across: i32| if along + across > 0 { 0 } else { -1 };
            full(at.0 + corner(step.0, side.0), at.1 + corner(step.1, side.1))
        };
        step = match (pixel(true), pixel(false)) {
            (true, true) => (step.1, -step.0),
            (true, false) => step,
            _ => (-step.1, step.0),
        };
        if at == first {
            return points;
        }
    }
}

/// A traced circle of 50 pixels, smoothed by one: its area to 0.5 %, its perimeter to 1 %, in any unit, and no point is
/// further than a pixel from the circle.
#[test]
fn a_traced_circle_becomes_round() {
    for (scale, x) in [(1.0, 0.3), (1e-6, 0.0), (1e7, 0.45)] {
        let points = traced(60, |a, b| (a - x).hypot(b + 0.1) < 50.0);
        assert!(points.len() > 390);
        let points: Vec<Vec2> = points.into_iter().map(|point| point * scale).collect();
        let steps = tidy::around(&points).unwrap();
        assert!(steps.perimeter > 1.2 * TAU * 50.0 * scale);
        let Smoothed { points: smooth, distance } = smooth(&points, None, scale).unwrap();
        assert!(distance <= scale && distance > 0.5 * scale, "{distance}");
        let found = tidy::around(&smooth).unwrap();
        let area = found.area / (PI * 2500.0 * scale * scale) - 1.0;
        let perimeter = found.perimeter / (TAU * 50.0 * scale) - 1.0;
        println!("area off by {area:.2e}, perimeter by {perimeter:.2e}, {} points", smooth.len());
        assert!(area.abs() < 5e-3 && perimeter.abs() < 1e-2, "{area} {perimeter}");
        let off = |point: &Vec2| ((*point / scale - Vec2::new(x, -0.1)).length() - 50.0).abs();
        assert!(smooth.iter().all(|point| off(point) < 1.0));
    }
}

/// Fewer waves are left, the further the curve may pass.
#[test]
fn a_larger_distance_gives_a_smoother_curve() {
    let flower = |a: f64, b: f64| a.hypot(b) < 40.0 + 6.0 * (5.0 * b.atan2(a)).cos();
    let points = traced(60, flower);
    let exact = PI * (1600.0 + 18.0);
    let perimeters = [1.0, 3.0, 8.0].map(|distance| {
        let smoothed = smooth(&points, None, distance).unwrap();
        assert!(smoothed.distance <= distance);
        let found = tidy::around(&smoothed.points).unwrap();
        assert!((found.area / exact - 1.0).abs() < 1e-2, "{}", found.area / exact);
        found.perimeter
    });
    assert!(perimeters.is_sorted_by(|a, b| a > b), "{perimeters:?}");
}

/// A wave of a line that was traced in steps, with its mean height.
#[test]
fn a_traced_line_becomes_smooth() {
    let height = |x: f64| 10.0 * (TAU * x / 200.0).sin();
    let points: Vec<Vec2> = (0..200)
        .flat_map(|x| [0, 1].map(|end| Vec2::new(f64::from(x + end), height(f64::from(x) + 0.5).round())))
        .collect();
    let Smoothed { points: smooth, distance } = smooth(&points[..points.len() - 1], Some(200.0), 1.0).unwrap();
    assert!(distance <= 1.0);
    assert!(smooth.iter().all(|point| (point.y - height(point.x)).abs() < 1.0));
    let mean = smooth.iter().map(|point| point.y).sum::<f64>() / smooth.len() as f64;
    assert!(mean.abs() < 0.1, "{mean}");
}

#[test]
fn distances_that_are_none_are_refused() {
    let points = traced(20, |a, b| a.hypot(b) < 10.0);
    for distance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(smooth(&points, None, distance).is_err());
    }
    assert!(smooth(&points[..2], None, 1.0).is_err());
    // Corners of steps of a pixel are not passed at a thousandth of it by a smooth curve.
    let error = smooth(&points, None, 1e-4).unwrap_err();
    assert!(matches!(error, OutlineError::TooClose { .. }), "{error}");
}
