//! Velocities on fixed shapes against boundary-integral values: the order of the method with the mobility correction.

use motile::ib_core::{BSpline, Peskin4};
use motile_tests::validation::{Case, fixed_shapes, order};

const SPACINGS: [f64; 3] = [0.1, 0.05, 0.025];

fn maxima(corrected: bool, case: Case) -> Vec<f64> {
    let error = |&h: &f64| fixed_shapes::errors(&BSpline::<4>, corrected, h, case);
    SPACINGS.iter().map(|h| error(h).expect("a case of the reference table").maximum).collect()
}

#[test]
fn second_order_with_the_correction() {
    for case in Case::ALL {
        let errors = maxima(true, case);
        assert!(order(&SPACINGS, &errors) > 1.75, "{}: {errors:?}", case.name());
        assert!(errors[1] < 1.3e-3, "{}: {errors:?}", case.name());
    }
}

/// Reason for the correction: without it the tangential velocity is wrong by a tenth at h = 0.05.
#[test]
fn first_order_without_it() {
    for case in [Case::Circle, Case::EllipseGradient] {
        let errors = maxima(false, case);
        let order = order(&SPACINGS, &errors);
        assert!((0.9..1.1).contains(&order), "{}: {order}", case.name());
        assert!(errors[1] > 0.02);
    }
}

#[test]
fn other_kernels_are_corrected_too() {
    let raw = fixed_shapes::errors(&Peskin4, false, 0.05, Case::Circle).unwrap();
    let corrected = fixed_shapes::errors(&Peskin4, true, 0.05, Case::Circle).unwrap();
    assert!(corrected.maximum < 0.015 * raw.maximum, "{corrected:?} {raw:?}");
}
