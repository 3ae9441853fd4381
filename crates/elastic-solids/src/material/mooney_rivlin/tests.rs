use super::*;

#[test]
fn bad_parameters_are_refused() {
    assert!(matches!(MooneyRivlin::new(3.0, 0.9, 0.5), Err(SolidError::BulkTooSmall { minimum: 1.0, .. })));
    assert!(matches!(MooneyRivlin::new(1.0, 2.0, 1.1), Err(SolidError::OutOfRange { .. })));
    assert!(matches!(MooneyRivlin::new(1.0, 2.0, f64::NAN), Err(SolidError::OutOfRange { .. })));
    assert!(matches!(MooneyRivlin::new(-1.0, 2.0, 0.5), Err(SolidError::NotPositive { .. })));
}
