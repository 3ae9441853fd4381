use super::*;
use std::f64::consts::PI;

fn ellipse(centre: Vec2, [long, short]: [f64; 2], angle: f64) -> Vec<Vec2> {
    let at = |k: i32| {
        let (sin, cos) = (TAU * f64::from(k) / 48.0 + 0.05).sin_cos();
        centre + Vec2::from_angle(angle).rotate(Vec2::new(long * cos, short * sin))
    };
    (0..48).map(at).collect()
}

#[test]
fn axes_of_an_ellipse() {
    let centre = Vec2::new(30.0, -20.0);
    for angle in [0.0, 0.4, 1.5, -0.9] {
        let seen = MomentEllipse::of(&ellipse(centre, [1.5, 0.8], angle)).unwrap();
        let exact = [(seen.area, PI * 1.2), (seen.half_axes[0], 1.5), (seen.half_axes[1], 0.8)];
        let exact = exact.into_iter().chain([(seen.angle.unwrap(), angle), (seen.deformation(), 0.7 / 2.3)]);
        assert!(exact.into_iter().all(|(found, exact)| (found - exact).abs() < 1e-11), "{seen:?}");
        assert!(seen.centroid.distance(centre) < 1e-12);
    }
    assert!(MomentEllipse::of(&[Vec2::ZERO; 7]).is_err());
}

/// The angle of a circle is round-off, near the origin and far from it, in any unit.
#[test]
fn a_circle_has_no_angle() {
    for size in [1e-6, 1.0, 1e6] {
        for place in [0.0, 0.3, 1e4] {
            let centre = size * place * Vec2::new(0.6, -0.8);
            let round = MomentEllipse::of(&ellipse(centre, [size; 2], 0.3)).unwrap();
            assert!(round.angle.is_none() && round.deformation() < 1e-10, "{size} {place} {round:?}");
            let long = MomentEllipse::of(&ellipse(centre, [size * (1.0 + 1e-6), size], 0.3)).unwrap();
            assert!((long.angle.unwrap() - 0.3).abs() < 1e-2, "{size} {place} {long:?}");
        }
    }
}
