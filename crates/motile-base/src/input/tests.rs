use super::*;

/// The ends of a closed range belong to it, and zero is not negative but not positive either.
#[test]
fn ends_of_ranges_belong_to_them() {
    let fits = |value| within("the number", value, -1.0, 2.0).is_ok();
    assert!([-1.0, 0.0, 2.0].into_iter().all(fits));
    assert!(![-1.000_001, 2.000_001, f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().any(fits));
    assert!(within("the number", f64::INFINITY, 0.0, f64::INFINITY).is_ok());
    assert!(not_negative("the number", 0.0).is_ok() && not_negative("the number", -1e-300).is_err());
    assert!(positive("the number", 1e-300).is_ok() && positive("the number", 0.0).is_err());
    assert!(at_least("numbers", 3, 3).is_ok() && at_least("numbers", 2, 3).is_err());
}
