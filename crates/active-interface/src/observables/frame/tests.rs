use super::*;
use crate::Curve;
use proptest::prelude::*;

#[test]
fn aspect_ratio_of_an_ellipse() {
    let errors = [50, 100].map(|count| {
        let markers = Curve::ellipse(1.3, 1.0 / 1.3).unwrap().rotated(0.7).markers(count).unwrap();
        let along = Frame::new(Vec2::ZERO, 0.7).unwrap();
        (aspect_ratio_of(&polygon_moments(&markers).unwrap(), &along).unwrap() - 1.69).abs()
    });
    assert!(errors[1] < 1e-3 && (errors[0] / errors[1]).log2() > 1.9, "{errors:?}");
}

#[test]
fn velocity_of_a_circle_that_deforms() {
    // v = (1 + x) e_x: the centroid moves with 1, the area grows with it.
    let markers = Curve::circle(1.0).unwrap().markers(400).unwrap();
    let velocities: Vec<Vec2> = markers.iter().map(|p| Vec2::new(1.0 + p.x, 0.0)).collect();
    let velocity = centroid_velocity(&markers, &velocities).unwrap();
    assert!((velocity - Vec2::new(1.0, 0.0)).length() < 1e-12);
}

#[test]
fn bad_input_is_refused() {
    let markers = Curve::circle(1.0).unwrap().markers(10).unwrap();
    assert!(centroid_velocity(&markers, &markers[..9]).is_err());
    assert!(centroid_velocity(&markers, &[Vec2::new(f64::NAN, 0.0); 10]).is_err());
    assert!(Frame::new(Vec2::ZERO, f64::INFINITY).is_err());
    assert_eq!(Frame::of_motion(Vec2::ZERO, Vec2::ZERO, 0.0).unwrap().heading(), 0.0);
    assert_eq!(Frame::of_motion(Vec2::ZERO, Vec2::new(-1e-18, 1e-18), 1e-12).unwrap().heading(), 0.0);
    assert!(Frame::of_motion(Vec2::ZERO, Vec2::X, f64::NAN).is_err());
}

proptest! {
    #[test]
    fn uniform_motion_is_exact(x in -5.0..5.0f64, y in -5.0..5.0f64, slide in -5.0..5.0f64, count in 8usize..80) {
        let markers = Curve::fourier(1.0, &[0.1, 0.1], &[0.0, -0.1, 0.1]).unwrap().markers(count).unwrap();
        let velocity = Vec2::new(x, y);
        // A velocity along the half chords changes nothing.
        let velocities: Vec<Vec2> = half_chords(&markers).map(|d| velocity + d * slide).collect();
        prop_assert!((centroid_velocity(&markers, &velocities).unwrap() - velocity).length() < 1e-12);
        let frame = Frame::of_motion(Vec2::new(1.0, 2.0), velocity, 0.0).unwrap();
        prop_assert!((frame.components(velocity) - Vec2::new(velocity.length(), 0.0)).length() < 1e-13);
    }
}
