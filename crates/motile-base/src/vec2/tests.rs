use std::f64::consts::{FRAC_PI_2, PI};

use super::*;

const A: Vec2 = Vec2::new(3.0, -4.0);
const B: Vec2 = Vec2::new(-0.5, 2.0);

#[test]
fn operators_work_on_each_component() {
    assert_eq!(A + B, Vec2::new(2.5, -2.0));
    assert_eq!(A - B, Vec2::new(3.5, -6.0));
    assert_eq!(A * B, Vec2::new(-1.5, -8.0));
    assert_eq!(A / B, Vec2::new(-6.0, -2.0));
    assert_eq!((2.0 * A, A * 2.0, A / 2.0), (Vec2::new(6.0, -8.0), Vec2::new(6.0, -8.0), Vec2::new(1.5, -2.0)));
    assert_eq!((-A, -&A), (Vec2::new(-3.0, 4.0), Vec2::new(-3.0, 4.0)));
    let (a, b) = (&A, &B);
    assert_eq!([a + b, a + B, A + b, [A, B].iter().sum(), [A, B].into_iter().sum()], [A + B; 5]);
    let mut c = A;
    c += B;
    c -= &A;
    assert_eq!(c, B);
    c *= 4.0;
    c /= 2.0;
    assert_eq!(c, Vec2::new(-1.0, 4.0));
}

#[test]
fn lengths_and_products() {
    assert_eq!((A.length(), A.length_squared(), A.distance(A + A)), (5.0, 25.0, 5.0));
    assert_eq!((A.dot(B), A.perp_dot(B), A.perp().dot(B)), (-9.5, 4.0, 4.0));
    assert_eq!(A.normalize(), Vec2::new(3.0, -4.0) * 0.2);
    assert_eq!(A.try_normalize(), Some(A.normalize()));
    for none in [Vec2::ZERO, Vec2::NAN, Vec2::new(f64::INFINITY, 0.0)] {
        assert_eq!(none.try_normalize(), None);
    }
    assert!(A.is_finite() && !Vec2::NAN.is_finite() && !Vec2::new(0.0, f64::INFINITY).is_finite());
}

#[test]
fn angles_run_counter_clockwise() {
    assert_eq!((Vec2::X.to_angle(), Vec2::Y.to_angle(), Vec2::new(-1.0, 0.0).to_angle()), (0.0, FRAC_PI_2, PI));
    assert_eq!((Vec2::X.angle_to(Vec2::Y), Vec2::Y.angle_to(Vec2::X)), (FRAC_PI_2, -FRAC_PI_2));
    for k in -7..7 {
        let angle = 0.4 * f64::from(k);
        assert!((Vec2::from_angle(angle).to_angle() - angle).abs() < 1e-15);
        let turned = Vec2::from_angle(angle).rotate(A);
        assert!((turned.length() - 5.0).abs() < 1e-14 && (A.angle_to(turned) - angle).abs() < 1e-15);
    }
    assert_eq!(Vec2::Y.rotate(A), A.perp());
}

#[test]
fn components_are_compared_one_by_one() {
    assert_eq!((A.min(B), A.max(B)), (Vec2::new(-0.5, -4.0), Vec2::new(3.0, 2.0)));
    assert_eq!((A.abs(), A.abs().max_element()), (Vec2::new(3.0, 4.0), 4.0));
    assert_eq!(Vec2::new(-0.5, 1.4).round(), Vec2::new(-1.0, 1.0));
    assert_eq!((A.lerp(B, 0.0), A.lerp(B, 1.0), A.lerp(B, 0.5)), (A, B, Vec2::new(1.25, -1.0)));
}

#[test]
fn a_vector_is_a_pair() {
    assert_eq!((Vec2::from([3.0, -4.0]), Vec2::from((3.0, -4.0))), (A, A));
    assert_eq!((<[f64; 2]>::from(A), <(f64, f64)>::from(A), A.to_array()), ([3.0, -4.0], (3.0, -4.0), [3.0, -4.0]));
    assert_eq!((A.to_string(), format!("{B:.2}")), ("[3, -4]".to_owned(), "[-0.50, 2.00]".to_owned()));
    let mut turned = A;
    turned[0] += B[1];
    turned[1] -= B[0];
    assert_eq!(turned, Vec2::new(5.0, -3.5));
}
