use super::*;
use crate::error::refused;
use approx::assert_relative_eq;
use motile_base::InputError;
use proptest::prelude::*;

/// Largest relative deviation of a chord from the mean.
fn unevenness(markers: &[Vec2]) -> f64 {
    let chords: Vec<f64> = edges(markers).map(|(a, b)| (b - a).length()).collect();
    let mean = chords.iter().sum::<f64>() / chords.len() as f64;
    chords.iter().map(|chord| (chord / mean - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn a_circle() {
    let curve = Curve::circle(2.0).unwrap().translated(Vec2::new(3.0, -1.0));
    let markers = curve.markers(100).unwrap();
    assert!(unevenness(&markers) < 1e-13);
    assert_relative_eq!(polygon_area(&markers).unwrap(), 4.0 * PI, max_relative = 1e-14);
    assert!((polygon_moments(&markers).unwrap().centroid - Vec2::new(3.0, -1.0)).length() < 1e-14);
    assert!(markers[0].x > 5.0 && markers[0].y == -1.0);
    assert!(markers[1].y > markers[0].y);
    assert_relative_eq!(curve.perimeter(), 4.0 * PI, max_relative = 1e-13);
}

#[test]
fn the_perimeter_of_the_reference_ellipse() {
    // reference/fixed_shape_moments_equal_viscosity.csv, column length
    let curve = Curve::ellipse(1.3, 1.0 / 1.3).unwrap();
    assert_relative_eq!(curve.perimeter(), 6.608_055_560_670_5, max_relative = 1e-13);
    assert_relative_eq!(curve.area(), PI, max_relative = 1e-15);
    let errors = [100, 200].map(|count| {
        let markers = curve.markers(count).unwrap();
        assert!(unevenness(&markers) < 1e-12);
        (polygon_perimeter(&markers).unwrap() - curve.perimeter()).abs()
    });
    assert!((errors[0] / errors[1]).log2() > 1.9, "{errors:?}");
}

#[test]
fn all_sources_agree_on_an_ellipse() {
    let exact = Curve::ellipse(1.3, 0.8).unwrap();
    // Clockwise, and with an uneven parameter.
    let parametric = Curve::parametric(|t| {
        let u = -(t + 0.3 * t.sin());
        Vec2::new(1.3 * u.cos(), 0.8 * u.sin())
    })
    .unwrap();
    assert_relative_eq!(parametric.area(), exact.area(), max_relative = 1e-12);
    assert_relative_eq!(parametric.perimeter(), exact.perimeter(), max_relative = 1e-12);
    let (a, b) = (exact.markers(150).unwrap(), parametric.markers(150).unwrap());
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).length() < 1e-11, "{a} {b}");
    }
    let list: Vec<Vec2> = (0..300).map(|k| exact.point(f64::from(k) / 300.0)).collect();
    let spline = Curve::through_points(&list).unwrap();
    assert_relative_eq!(spline.area(), exact.area(), max_relative = 1e-8);
    assert_relative_eq!(spline.perimeter(), exact.perimeter(), max_relative = 1e-8);
    let polygon = Curve::polygon(&list).unwrap();
    assert_eq!(polygon.area(), polygon_area(&list).unwrap());
    assert!((polygon.markers(40).unwrap()[13] - exact.markers(40).unwrap()[13]).abs().max_element() <= 1e-3);
}

#[test]
fn a_fourier_shape_has_its_area() {
    let curve = Curve::fourier(1.5, &[0.0, 0.1, 0.05], &[0.0, 0.0, -0.02]).unwrap();
    let same = Curve::parametric(|t| {
        let r = 1.5 * (1.0 + 0.1 * (2.0 * t).cos() + 0.05 * (3.0 * t).cos() - 0.02 * (3.0 * t).sin());
        Vec2::new(r * t.cos(), r * t.sin())
    })
    .unwrap();
    assert_relative_eq!(curve.area(), same.area(), max_relative = 1e-13);
    let markers = curve.markers(500).unwrap();
    assert!(unevenness(&markers) < 1e-12);
    assert_relative_eq!(polygon_area(&markers).unwrap(), curve.area(), max_relative = 1e-14);
}

#[test]
fn corners_are_no_obstacle() {
    let corners =
        [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]].map(|[x, y]| Vec2::new(x, y));
    let curve = Curve::polygon(&corners).unwrap();
    assert_relative_eq!(curve.area(), 4.0);
    for count in [37, 100, 333] {
        let markers = curve.markers(count).unwrap();
        assert!(unevenness(&markers) < 1e-12);
        assert_relative_eq!(polygon_area(&markers).unwrap(), 4.0, max_relative = 1e-13);
    }
}

#[test]
fn rotation_is_about_the_origin() {
    let curve = Curve::ellipse(2.0, 1.0).unwrap().translated(Vec2::new(1.0, 0.0)).rotated(0.5 * PI);
    assert!((curve.point(0.0) - Vec2::new(0.0, 3.0)).abs().max_element() <= 1e-15);
    assert!((curve.point(0.25) - Vec2::new(-1.0, 1.0)).abs().max_element() <= 1e-15);
}

#[test]
fn points_as_they_are() {
    let clockwise: Vec<Vec2> = (0..9).map(|k| Vec2::from_angle(-TAU * f64::from(k) / 9.0)).collect();
    let markers = markers_from_points(&clockwise).unwrap();
    assert_eq!(markers[0], clockwise[0]);
    assert_eq!(markers[1], clockwise[8]);
    assert!(polygon_area(&markers).unwrap() > 0.0);
    assert!(markers_from_points(&clockwise[..7]).is_err());
    let mut uneven = clockwise.clone();
    uneven[4] = uneven[3].lerp(uneven[4], 0.2);
    assert!(refused(&markers_from_points(&uneven).unwrap_err(), "spaced too unevenly"));
}

#[test]
fn bad_curves_are_refused() {
    assert!(matches!(Curve::circle(-1.0), Err(InterfaceError::Input(InputError::NotPositive { .. }))));
    assert!(Curve::ellipse(1.0, f64::NAN).is_err());
    assert!(refused(&Curve::fourier(1.0, &[0.0, 1.5], &[]).unwrap_err(), "at the polar angle"));
    let open = Curve::parametric(|t| Vec2::new(t, t.sin())).unwrap_err();
    assert!(refused(&open, "the curve is not closed: its end is 6.283e0 away"), "{open}");
    let eight = Curve::parametric(|t| Vec2::new(t.cos() + 0.1, (2.0 * t).sin() + 0.3 * t.cos() * t.sin().powi(2)));
    let eight = eight.unwrap_err();
    let crossing = matches!(eight, InterfaceError::SelfCrossing { .. });
    assert!(crossing || refused(&eight, "the curve encloses no area"), "{eight}");
    let line = Curve::parametric(|t| Vec2::new(t.cos(), t.cos())).unwrap_err();
    assert!(refused(&line, "the curve encloses no area"), "{line}");
    assert!(Curve::parametric(|t| Vec2::new(t.cos(), 1.0 / (t - 1.0).max(0.0))).is_err());
    let twice = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| Vec2::new(x, y));
    assert!(refused(&Curve::polygon(&twice).unwrap_err(), "point 1 of the curve coincides with the next one"));
    assert!(matches!(Curve::circle(1.0).unwrap().markers(7), Err(InterfaceError::Input(InputError::TooFew { .. }))));
    assert!(Curve::circle(1.0).unwrap().markers_with_spacing(0.0).is_err());
    assert!(matches!(
        Curve::circle(1.0).unwrap().markers_with_spacing(1e-300),
        Err(InterfaceError::Input(InputError::OutOfRange { .. }))
    ));
    // Finite at the points that are checked at first, but not between them.
    let hole = Curve::parametric(|t| {
        if (1.0003..1.0008).contains(&t) { Vec2::new(f64::NAN, 0.0) } else { Vec2::new(t.cos(), t.sin()) }
    });
    assert!(hole.is_ok_and(|curve| curve.markers(5000).is_err()));
    assert!(Curve::circle(1.0).unwrap().translated(Vec2::new(f64::NAN, 0.0)).markers(20).is_err());
}

proptest! {
    #[test]
    fn markers_are_even_and_have_the_area(
        modes in proptest::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 6),
        count in 24usize..400,
        angle in -3.0..3.0f64,
    ) {
        let cosines: Vec<f64> = modes.iter().zip(1..).map(|(m, k)| 0.3 * m.0 / f64::from(k * k)).collect();
        let sines: Vec<f64> = modes.iter().zip(1..).map(|(m, k)| 0.3 * m.1 / f64::from(k * k)).collect();
        let curve = Curve::fourier(1.0, &cosines, &sines).unwrap().rotated(angle).translated(Vec2::new(2.0, 5.0));
        let markers = curve.markers(count).unwrap();
        prop_assert_eq!(markers.len(), count);
        prop_assert!(unevenness(&markers) < 2e-12);
        prop_assert!((polygon_area(&markers).unwrap() / curve.area() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_stadium_is_two_half_circles_and_straight_sides() {
    for (straight, radius) in [(0.7, 0.4), (0.0, 2.0)] {
        let curve = Curve::stadium(straight, radius).unwrap();
        // The corners lie on the curve, at the angles that its half circles are divided into evenly.
        let step = TAU / 720.0;
        let area = 4.0 * straight * radius * (0.5 * step).cos() + 360.0 * radius * radius * step.sin();
        let perimeter = 4.0 * straight + 1440.0 * radius * (0.5 * step).sin();
        assert_relative_eq!(curve.area(), area, max_relative = 1e-13);
        assert_relative_eq!(curve.perimeter(), perimeter, max_relative = 1e-13);
        assert_relative_eq!(curve.area(), 4.0 * straight * radius + PI * radius * radius, max_relative = 2e-5);
        // Markers are their own mirror image.
        let markers = curve.markers(96).unwrap();
        for (k, marker) in markers.iter().enumerate() {
            let image = markers[(96 - k) % 96];
            assert!((*marker - Vec2::new(image.x, -image.y)).length() < 1e-13, "{k}: {marker}");
        }
    }
    assert!(Curve::stadium(-0.1, 1.0).is_err() && Curve::stadium(1.0, 0.0).is_err());
    assert!(Curve::stadium(f64::INFINITY, 1.0).is_err());
}

/// Round-off of coordinates and of the parameter grows with the number of markers relative to their distances.
#[test]
fn ellipses_take_any_number_of_markers() {
    for axis in [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.9] {
        for count in [512, 768, 1000, 1024, 1536, 2048, 3072, 4096, 10_000, 30_000] {
            for (angle, shift) in [(0.0, 0.0), (0.4, 3.0)] {
                let curve = Curve::ellipse(1.0, axis).unwrap().rotated(angle).translated(Vec2::new(shift, 0.3 * shift));
                let markers = curve.markers(count).unwrap();
                let round_off = 16.0 * f64::EPSILON * (7.0 + shift) * count as f64 / 4.0;
                assert!(unevenness(&markers) < 2.0 * round_off.max(1e-12), "{axis} {count} {angle}");
            }
        }
    }
}
