use super::*;

/// An ellipse of half axes 1.5 and 0.8 by its angle, about a centre, in fluid that turns it along itself at the rate 2
/// while it drifts.
#[test]
fn an_ellipse_has_its_half_axes_by_both_definitions() {
    let (long, short, rate) = (1.5, 0.8, 2.0);
    let (centre, drift) = (Vec2::new(30.0, -20.0), Vec2::new(0.3, 0.7));
    for angle in [0.0, 0.4, 1.5, -0.9] {
        let (axis, across) = (Vec2::from_angle(angle), Vec2::from_angle(angle + 0.5 * PI));
        let parameters = || (0..48).map(|k| TAU * f64::from(k) / 48.0 + 0.05);
        let markers: Vec<Vec2> =
            parameters().map(|t| centre + long * t.cos() * axis + short * t.sin() * across).collect();
        let velocities: Vec<Vec2> =
            parameters().map(|t| drift + rate * (short * t.cos() * across - long * t.sin() * axis)).collect();
        let seen = Deformation::of(&markers, &velocities).unwrap();
        let expected = (long - short) / (long + short);
        for (found, expected) in [
            (seen.by_moments, expected),
            (seen.by_extents, expected),
            (seen.angle_of_moments.unwrap(), angle),
            (seen.angle_of_extents.unwrap(), angle),
            (seen.extents[0], long),
            (seen.extents[1], short),
            (seen.area, PI * long * short),
            (seen.centroid.distance(centre), 0.0),
            (seen.velocity.distance(drift), 0.0),
            (seen.tip_curvature, long / (short * short)),
            (seen.tip_speed, rate * short),
            (seen.waist_speed, rate * long),
            (seen.largest_speed, rate * long),
            (seen.period.unwrap(), TAU / rate),
        ] {
            assert!((found - expected).abs() < 1e-11, "{angle}: {found} {expected} {seen:?}");
        }
    }
    assert!(Deformation::of(&[Vec2::ZERO; 7], &[Vec2::ZERO; 7]).is_err());
}

/// A circle in fluid at rest has no direction; a square is round by its moments, but has corners.
#[test]
fn a_round_curve_has_no_angle() {
    let curve = |corners: f64| {
        let at = |k: i32| {
            let t = TAU * f64::from(k) / 64.0;
            Vec2::new(3.0, 2.0) + (1.0 + corners * (4.0 * (t - 0.5)).cos()) * Vec2::from_angle(t)
        };
        Deformation::of(&(0..64).map(at).collect::<Vec<_>>(), &[Vec2::ZERO; 64]).unwrap()
    };
    let (circle, square) = (curve(0.0), curve(0.05));
    assert_eq!([circle.angle_of_moments, circle.angle_of_extents], [None; 2]);
    assert_eq!(square.angle_of_moments, None);
    let turned = (square.angle_of_extents.unwrap() - 0.5).rem_euclid(0.5 * PI);
    assert!(turned.min(0.5 * PI - turned) < 1e-9, "{square:?}");
}
