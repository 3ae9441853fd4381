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
            (seen.angle_of_moments, angle),
            (seen.angle_of_extents, angle),
            (seen.extents[0], long),
            (seen.extents[1], short),
            (seen.area, PI * long * short),
            (seen.centroid.distance(centre), 0.0),
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
