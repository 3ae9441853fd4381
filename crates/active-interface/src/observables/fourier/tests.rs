use super::*;
use crate::{Curve, InitialConcentration};
use approx::assert_relative_eq;

#[test]
fn shape_modes_are_those_the_curve_was_made_of() {
    let errors = [100, 200].map(|count| {
        let curve = Curve::fourier(2.0, &[0.0, 0.05, 0.0, 0.02], &[0.0, 0.0, -0.03]).unwrap();
        let markers = curve.rotated(0.5).translated(Vec2::new(1.0, 1.0)).markers(count).unwrap();
        let frame = Frame::new(Vec2::new(1.0, 1.0), 0.5).unwrap();
        let modes = shape_modes(&markers, &frame, 6).unwrap();
        assert!((modes.amplitude(3) - 0.06).abs() < 1e-3);
        assert!(modes.amplitude(7) == 0.0);
        let exact = [0.0, 0.1, 0.0, 0.04, 0.0, 0.0];
        (modes.mean - 2.0).abs() + modes.cosines.iter().zip(exact).map(|(a, b)| (a - b).abs()).sum::<f64>()
    });
    assert!((errors[0] / errors[1]).log2() > 1.9, "{errors:?}");
    assert!(errors[1] < 2e-3, "{errors:?}");
}

#[test]
fn the_polarised_state_is_one_mode() {
    let markers = Curve::circle(1.0).unwrap().markers(60).unwrap();
    let numbers = InitialConcentration::polarised(100.0, 0.7).unwrap().particle_numbers(&markers).unwrap();
    let frame = Frame::new(Vec2::ZERO, 0.7).unwrap();
    let modes = concentration_modes(&markers, &numbers, &frame, 5).unwrap();
    assert_relative_eq!(modes.amplitude(0), 100.0, max_relative = 1e-12);
    assert_relative_eq!(modes.cosines[0], -100.0, max_relative = 1e-12);
    assert!(modes.sines[0].abs() < 1e-11);
    for k in 2..=5 {
        assert!(modes.amplitude(k) < 1e-11, "{k}: {}", modes.amplitude(k));
    }
    assert!(concentration_modes(&markers, &numbers[1..], &frame, 5).is_err());
    assert!(shape_modes(&markers[..2], &frame, 5).is_err());
}
