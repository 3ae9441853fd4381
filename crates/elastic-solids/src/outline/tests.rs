//! Lengths, spacings and what is refused.

use crate::error::refused;
use std::f64::consts::PI;

use motile_base::InputError;

use super::*;

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

fn spacings(points: &[Vec2], last: Vec2) -> (f64, f64) {
    let mut closed = points.to_vec();
    closed.push(last);
    closed.windows(2).map(|p| (p[1] - p[0]).length()).fold((f64::INFINITY, 0.0), |(a, b), d| (a.min(d), b.max(d)))
}

#[test]
fn points_lie_on_the_exact_curve_at_equal_spacing() {
    let circle = Outline::circle(v(1.0, -2.0), 1.5).unwrap();
    assert!((circle.length() - 3.0 * PI).abs() < 1e-5);
    let points = circle.resampled(0.1).unwrap();
    assert_eq!(points.len(), 94);
    assert!(points.iter().all(|p| ((p - v(1.0, -2.0)).length() - 1.5).abs() < 1e-14));
    let (least, most) = spacings(&points, points[0]);
    assert!(most / least < 1.0 + 1e-6);
    // An ellipse, whose parameter is not its arc length.
    let ellipse = Outline::ellipse(v(0.0, 0.0), [3.0, 1.0]).unwrap();
    let (least, most) = {
        let p = ellipse.resampled(0.1).unwrap();
        spacings(&p, p[0])
    };
    assert!(most / least < 1.01, "{least} {most}");
}

#[test]
fn corners_are_kept() {
    let corners = [v(0.0, 0.0), v(1.03, 0.1), v(0.4, 0.9)];
    let points = Outline::polygon(&corners).unwrap().resampled(0.1).unwrap();
    assert!(corners.iter().all(|corner| points.contains(corner)));
    // A profile with a kink, and its other side.
    let roof = |x: f64| 1.0 - (x - 1.0).abs();
    let profile = Outline::profile_with_corners(0.0, 2.0, &[1.0], roof).unwrap();
    assert!((profile.length() - 8.0_f64.sqrt()).abs() < 1e-12);
    let points = profile.resampled(0.07).unwrap();
    assert!(points.contains(&v(1.0, 1.0)) && points.contains(&v(0.0, 0.0)));
    let points = profile.mirrored(2.0).unwrap().resampled(0.07).unwrap();
    assert!(points.contains(&v(1.0, 3.0)));
}

#[test]
fn corners_are_rounded_to_the_radius() {
    for (radius, turned) in [(0.2, 0.0), (0.5, 0.3)] {
        let square = Outline::rectangle(v(0.0, 0.0), v(1.0, 1.0)).unwrap().rotated(turned, v(0.5, 0.5)).unwrap();
        let rounded = square.rounded(radius).unwrap();
        assert!((rounded.length() - (4.0 - 8.0 * radius + 2.0 * PI * radius)).abs() < 1e-5);
        let (least, most) = {
            let p = rounded.resampled(0.02).unwrap();
            spacings(&p, p[0])
        };
        assert!(most / least < 1.001, "one smooth line: {least} {most}");
    }
    let zigzag = Outline::polyline(&[v(0.0, 0.0), v(1.0, 1.0)], 2.0).unwrap().rounded(0.1).unwrap();
    // Each of two corners of 90 degrees loses 2 r and gains an arc of pi r / 2.
    assert!((zigzag.length() - (8.0_f64.sqrt() + 0.1 * (PI - 4.0))).abs() < 1e-6);
    let points = zigzag.resampled(0.05).unwrap();
    let (least, most) = spacings(&points, points[0] + v(2.0, 0.0));
    assert!(most / least < 1.02 && points.iter().all(|p| p.y > 0.04 && p.y < 0.96));
    let square = Outline::rectangle(v(0.0, 0.0), v(1.0, 1.0)).unwrap();
    let error = square.rounded(0.6).unwrap_err();
    assert!(refused(&error, "a corner of radius 0.6 does not fit on the side from ("), "{error}");
    assert!(error.to_string().ends_with("Use a radius of at most 0.5000"), "{error}");
    assert!(square.rounded(0.5).is_ok() && square.rounded(0.5 + 1e-11).is_err());
}

#[test]
fn bad_outlines_are_refused() {
    assert!(matches!(Outline::polygon(&[v(0.0, 0.0), v(1.0, 0.0)]), Err(SolidError::Input(InputError::TooFew { .. }))));
    let twice = [v(0.0, 0.0), v(1.0, 0.0), v(1.0, 0.0)];
    assert!(refused(&Outline::polygon(&twice).unwrap_err(), "a side of the outline at (1.0000, 0.0000) has no length"));
    let nowhere = [v(0.0, 0.0), v(1.0, f64::NAN), v(1.0, 1.0)];
    assert!(matches!(Outline::polygon(&nowhere), Err(SolidError::Input(InputError::EntryNotFinite { .. }))));
    assert!(matches!(Outline::circle(v(0.0, 0.0), -1.0), Err(SolidError::Input(InputError::NotPositive { .. }))));
    let open = "the outline is not closed: it ends at (";
    assert!(refused(&Outline::closed(|t| v(t, 0.0)).unwrap_err(), open));
    assert!(matches!(
        Outline::closed(|t| v(1.0 / (t - 0.5), 0.0)),
        Err(SolidError::Input(InputError::EntryNotFinite { .. }))
    ));
    assert!(refused(&Outline::profile(0.0, 2.0, |x| x).unwrap_err(), open));
    assert!(matches!(Outline::profile(0.0, -2.0, |_| 0.0), Err(SolidError::Input(InputError::NotPositive { .. }))));
    assert!(matches!(
        Outline::profile(0.0, 2.0, |x| 1.0 / (x - 1.0)),
        Err(SolidError::Input(InputError::EntryNotFinite { .. }))
    ));
    for corners in [[0.5, 0.5], [0.7, 0.5], [0.0, 1.0], [1.0, 2.0], [f64::NAN, 1.0]] {
        let outline = Outline::profile_with_corners(0.0, 2.0, &corners, |_| 0.0);
        let error = outline.unwrap_err();
        assert!(refused(&error, "the corners of the curve are out of order"), "{corners:?}: {error}");
    }
    let flat = Outline::flat(0.0, 1.0, 0.0).unwrap();
    let error = flat.rotated(1.0, v(0.0, 0.0)).unwrap_err();
    assert!(refused(&error, "turning a periodic outline is not possible"), "{error}");
    assert!(matches!(flat.resampled(0.0), Err(SolidError::Input(InputError::NotPositive { .. }))));
    assert!(matches!(flat.resampled(1e-12), Err(SolidError::Input(InputError::OutOfRange { .. }))));
}
