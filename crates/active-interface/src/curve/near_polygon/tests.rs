use std::f64::consts::TAU;

use super::*;
use crate::Curve;

fn points(list: &[[f64; 2]]) -> Vec<Vec2> {
    list.iter().copied().map(Vec2::from).collect()
}

/// A square of side 2 whose corners are cut by that length.
fn cut_square(cut: f64) -> Vec<Vec2> {
    let short = 1.0 - cut;
    let half = [[1.0, -short], [1.0, short], [short, 1.0], [-short, 1.0]];
    let other = half.map(|[x, y]| [-x, -y]);
    points(&[half, other].concat())
}

/// Twelve points, of which nine are next to two corners.
fn twelve() -> Vec<Vec2> {
    points(&[
        [-1.0094, -0.2086],
        [-1.0121, -0.2],
        [0.8806, 2.2696],
        [0.8919, 2.2637],
        [-0.268, -1.3264],
        [-0.2766, -1.3291],
        [-0.5753, -1.5817],
        [-0.5812, -1.5929],
        [-0.5872, -1.6042],
        [-0.5958, -1.6068],
        [-0.6044, -1.6095],
        [-0.6302, -1.6175],
    ])
}

/// The area is that of the polygon, by the shoelace formula, and the curve stays near it.
#[test]
fn curves_through_uneven_points_have_the_area_of_their_polygon() {
    for (list, area) in [(cut_square(0.1), 3.98), (cut_square(0.01), 3.9998), (twelve(), 2.3217)] {
        let curve = Curve::through_points(&list).unwrap();
        assert!((curve.area() / area - 1.0).abs() < 0.01, "{} {area}", curve.area());
        let next = list.iter().cycle().skip(1);
        let shortest = list.iter().zip(next).map(|(a, b)| a.distance(*b)).fold(f64::INFINITY, f64::min);
        // Nine of the twelve points are hundredths apart, the others units.
        let distance = curve.distance_from_polygon().unwrap();
        assert!(distance > 0.0 && distance < 0.2 * shortest.max(0.02), "{distance} {shortest}");
        // From the points' side: each of them is on the curve.
        let samples: Vec<Vec2> = (0..200_000).map(|k| curve.point(f64::from(k) / 2e5)).collect();
        for point in &list {
            let off = samples.iter().map(|sample| sample.distance(*point)).fold(f64::INFINITY, f64::min);
            assert!(off < 1e-4, "{point:?} {off}");
        }
    }
}

/// Even points of a smooth curve are joined by the spline through them alone.
#[test]
fn even_points_are_joined_by_the_plain_spline() {
    for count in [8, 12, 40] {
        for [a, b] in [[1.0, 1.0], [1.5, 0.5]] {
            let list: Vec<Vec2> = (0..count)
                .map(|k| TAU * f64::from(k) / f64::from(count))
                .map(|t| Vec2::new(a * t.cos(), b * t.sin()))
                .collect();
            let curve = NearPolygon::new(&list, Vec2::ZERO, |_| Ok(None)).unwrap();
            assert_eq!(curve.sides, (0..list.len()).collect::<Vec<_>>());
        }
    }
}

/// A deep notch of a few points, in which the plain spline crosses itself, and points that do cross: by their numbers.
#[test]
fn crossings_are_told_by_the_numbers_of_the_points() {
    let narrow =
        points(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.1, 1.0], [1.02, 0.1], [0.98, 0.1], [0.9, 1.0], [0.0, 1.0]]);
    let curve = Curve::through_points(&narrow).unwrap();
    let exact = crate::polygon_area(&narrow).unwrap();
    assert!((curve.area() / exact - 1.0).abs() < 0.1, "{} {exact}", curve.area());
    let mut crossed = cut_square(0.1);
    crossed.swap(2, 5);
    let error = Curve::through_points(&crossed).unwrap_err();
    let InterfaceError::SelfCrossing { place, .. } = &error else { panic!("{error}") };
    let numbers: Vec<usize> = place.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
    assert!(numbers.len() == 2 && numbers.iter().all(|number| *number < 8), "{error}");
}

/// An outline that was traced from a picture, through whose points the plain spline crosses itself, and on whose sharp
/// corners there are no equal chords.
#[test]
fn a_traced_outline_has_markers() {
    let list: Vec<Vec2> = include_str!("starfish.txt")
        .lines()
        .map(|line| line.split_once(' ').unwrap())
        .map(|(x, y)| Vec2::new(x.parse().unwrap(), y.parse().unwrap()))
        .collect();
    assert_eq!(list.len(), 96);
    let plain = PeriodicSpline::new(&list, Vec2::ZERO).unwrap();
    let samples: Vec<Vec2> = (0..2048).map(|k| plain.point(f64::from(k) / 2048.0)).collect();
    assert!(crate::curve::first_crossing(&samples).unwrap().is_some());
    let (curve, exact) = (Curve::through_points(&list).unwrap(), crate::polygon_area(&list).unwrap());
    assert!((curve.area() / exact - 1.0).abs() < 0.01, "{} {exact}", curve.area());
    for count in [512_u16, 1024] {
        let markers = curve.markers(count.into()).unwrap();
        let next = markers.iter().cycle().skip(1);
        let chords: Vec<f64> = markers.iter().zip(next).map(|(a, b)| a.distance(*b)).collect();
        let mean = chords.iter().sum::<f64>() / f64::from(count);
        assert!(chords.iter().all(|chord| (0.3..2.0).contains(&(chord / mean))), "{count}");
        assert!((crate::polygon_area(&markers).unwrap() / curve.area() - 1.0).abs() < 1e-9);
    }
}

/// Beside a far point round-off is larger than the distances that are allowed: an error, after little work.
#[test]
fn points_that_no_curve_is_near_are_refused() {
    for far in [1e20, 1e30, 1e100] {
        let mut octagon: Vec<Vec2> = (0..8).map(|k| Vec2::from_angle(TAU * f64::from(k) / 8.0)).collect();
        octagon[3] = Vec2::new(-far, 0.7 * far);
        assert!(Curve::through_points(&octagon).is_err(), "{far}");
    }
}

/// Sides of rectangles that reach a limit exactly are parted alike: the curve has the symmetry of its points, wherever
/// they start.
#[test]
fn curves_through_rectangles_are_symmetric() {
    for aspect in [1.0, 1.5, 2.0, 3.0, 4.0, 6.0] {
        let corners = [[0.0, 0.0], [aspect, 0.0], [aspect, 1.0], [0.0, 1.0]];
        let mut areas = Vec::new();
        for first in 0..4 {
            for turned in [false, true] {
                let at = |k: usize| Vec2::from(corners[(first + k) % 4]);
                let turn = |p: Vec2| if turned { Vec2::from_angle(0.7).rotate(p) } else { p };
                let points: Vec<Vec2> = (0..4).map(|k| turn(at(k))).collect();
                let curve = Curve::through_points(&points).unwrap();
                let samples: Vec<Vec2> = (0..1024).map(|k| curve.point(f64::from(k) / 1024.0)).collect();
                let centroid = samples[0] + motile_base::polygon::area_and_arm(&samples).1;
                let apart = centroid.distance(turn(0.5 * Vec2::new(aspect, 1.0)));
                assert!(apart < 1e-5 * aspect, "{aspect} from {first}: {apart:e}");
                areas.push(curve.area());
            }
        }
        assert!(areas.iter().all(|area| (area / areas[0] - 1.0).abs() < 1e-9), "{aspect}: {areas:?}");
    }
}
