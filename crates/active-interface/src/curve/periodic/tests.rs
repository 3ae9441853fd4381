use super::*;
use crate::error::refused as is_refused;

#[test]
fn waves_are_equidistant_and_enclose_their_area() {
    for advance in [5.0, -5.0] {
        let markers = wave(0.7, advance, &[0.3, 0.1], &[0.2], 96).unwrap();
        let next = |k: usize| if k == 95 { markers[0] + Vec2::new(advance, 0.0) } else { markers[k + 1] };
        let chords: Vec<f64> = (0..96).map(|k| (next(k) - markers[k]).length()).collect();
        assert!(chords.iter().all(|chord| (chord / chords[0] - 1.0).abs() < 1e-11));
        assert!((area(&markers, advance) + 0.7 * advance).abs() < 1e-12, "{advance}");
    }
}

/// A cubic spline errs by the fourth order of the distance of its points.
#[test]
fn lines_through_points_of_a_wave_are_that_wave() {
    let error = |count: usize| {
        let points: Vec<Vec2> = (0..count)
            .map(|k| 5.0 * k as f64 / count as f64)
            .map(|x| Vec2::new(x, 0.3 * (TAU * x / 5.0).cos()))
            .collect();
        let markers = line_through(&points, 5.0, 64).unwrap();
        markers.iter().fold(0.0_f64, |most, p| most.max((p.y - 0.3 * (TAU * p.x / 5.0).cos()).abs()))
    };
    let (coarse, fine) = (error(16), error(32));
    let order = (coarse / fine).log2();
    assert!(fine < 1e-4 && (3.5..4.6).contains(&order), "{coarse:e} {fine:e} {order}");
}

#[test]
fn lines_that_are_none_are_refused() {
    let flat: Vec<Vec2> = (0..16).map(|k| Vec2::new(0.25 * f64::from(k), 0.0)).collect();
    assert!(check_period(&flat, 4.0).is_ok());
    let refused = |points: &[Vec2], advance: f64| check_period(points, advance).unwrap_err();
    for advance in [8.0, -4.0, 3.75, 3.8] {
        assert!(is_refused(&refused(&flat, advance), "the curve does not close across the period"), "{advance}");
    }
    for advance in [0.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(&flat, advance), InterfaceError::Input(_)), "{advance}");
    }
    let changed = |k: usize, point: Vec2| {
        let mut points = flat.clone();
        points[k] = point;
        points
    };
    assert!(matches!(refused(&changed(3, Vec2::new(f64::NAN, 0.0)), 4.0), InterfaceError::Input(_)));
    assert!(is_refused(&refused(&changed(3, flat[2]), 4.0), "point 2 of the curve coincides with the next one"));
    assert!(is_refused(&refused(&changed(3, Vec2::new(0.75, 2.0)), 4.0), "spaced too unevenly"));
    assert!(matches!(refused(&flat[..7], 1.75), InterfaceError::Input(_)));
    let mut swapped = flat.clone();
    swapped.swap(5, 7);
    assert!(matches!(refused(&swapped, 4.0), InterfaceError::SelfCrossing { .. }));
}
