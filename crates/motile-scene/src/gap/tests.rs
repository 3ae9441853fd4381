use super::*;
use proptest::prelude::*;

#[test]
fn extremes() {
    assert_eq!(wall_gap(&[], [-1.0, 1.0]), f64::INFINITY);
    assert_eq!(wall_gap(&[Vec2::new(0.0, 1.125)], [-1.0, 1.0]), -0.125);
    for markers in [[Vec2::new(0.0, f64::NAN), Vec2::ZERO], [Vec2::ZERO, Vec2::new(0.0, f64::NAN)]] {
        assert!(wall_gap(&markers, [-1.0, 1.0]).is_nan());
    }
}

proptest! {
    #[test]
    fn a_circle(x in -9.0..9.0f64, y in -0.9..0.9f64, radius in 0.1..2.0f64) {
        let circle: Vec<Vec2> = (0..360).map(|k| {
            let (sin, cos) = (f64::from(k)).to_radians().sin_cos();
            Vec2::new(x + radius * cos, y + radius * sin)
        }).collect();
        let expected = (1.5 - y.abs()) - radius;
        prop_assert!((wall_gap(&circle, [-1.5, 1.5]) - expected).abs() < 1e-14);
    }
}
