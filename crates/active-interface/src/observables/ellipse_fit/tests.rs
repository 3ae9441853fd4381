use super::*;
use crate::Curve;
use approx::assert_relative_eq;
use proptest::prelude::*;

proptest! {
    #[test]
    fn ellipses_are_exact(
        a in 0.3..3.0f64, b in 0.3..3.0f64, angle in -3.0..3.0f64, x in -5.0..5.0f64, count in 8usize..90,
    ) {
        let curve = Curve::ellipse(a, b).unwrap().rotated(angle).translated(Vec2::new(x, 1.0));
        // Points on the ellipse itself, unevenly spaced.
        let markers: Vec<Vec2> = (0..count).map(|k| curve.point(k as f64 / count as f64)).collect();
        let frame = Frame::new(Vec2::new(x, 1.0), angle).unwrap();
        let fit = fit_ellipse(&markers, &frame).unwrap();
        prop_assert!((fit.along - a).abs() < 1e-11 * a && (fit.across - b).abs() < 1e-11 * b);
        prop_assert!(fit.centre.length() < 1e-11 && fit.residual < 1e-11);
        prop_assert!((fit.aspect_ratio() - a / b).abs() < 1e-10);
    }
}

#[test]
fn higher_modes_do_not_bias_the_axes() {
    // r = 1 + 0.02 cos 2 theta + 0.02 cos 3 theta: a/b = 1.02/0.98 to first order.
    let markers = Curve::fourier(1.0, &[0.0, 0.02, 0.02], &[]).unwrap().markers(400).unwrap();
    let frame = Frame::new(Vec2::ZERO, 0.0).unwrap();
    let fit = fit_ellipse(&markers, &frame).unwrap();
    assert_relative_eq!(fit.aspect_ratio(), 1.02 / 0.98, max_relative = 1e-3);
    assert_relative_eq!(fit.residual, 0.02 / 2f64.sqrt(), max_relative = 0.05);
    assert!(fit_ellipse(&markers[..3], &frame).is_err());
    assert!(fit_ellipse(&[Vec2::ZERO; 9], &frame).is_err());
}
