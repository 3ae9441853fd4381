use motile_base::InputError;

use super::*;

#[test]
fn bad_parameters_are_refused() {
    assert!(matches!(MooneyRivlin::new(3.0, 0.9, 0.5), Err(SolidError::Input(InputError::NotPositive { .. }))));
    assert!(matches!(MooneyRivlin::new(1.0, 2.0, 1.1), Err(SolidError::Input(InputError::OutOfRange { .. }))));
    assert!(matches!(MooneyRivlin::new(1.0, 2.0, f64::NAN), Err(SolidError::Input(InputError::OutOfRange { .. }))));
    assert!(matches!(MooneyRivlin::new(-1.0, 2.0, 0.5), Err(SolidError::Input(InputError::NotPositive { .. }))));
}
