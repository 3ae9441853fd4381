use proptest::prelude::*;

use super::ln;

proptest! {
    #[test]
    fn agrees_with_the_library(exponent in -600.0..600.0f64) {
        let x = exponent.exp();
        prop_assert!((ln(x) - x.ln()).abs() <= 3e-16 * x.ln().abs().max(1.0));
    }

    #[test]
    fn agrees_with_the_library_near_one(offset in -0.5..0.5f64) {
        let x = 1.0 + offset;
        prop_assert!((ln(x) - x.ln()).abs() <= 5e-16 * x.ln().abs());
    }
}

#[test]
fn powers_of_two() {
    for k in -1000..1000 {
        let x = 2f64.powi(k);
        assert!((ln(x) - x.ln()).abs() <= f64::EPSILON * x.ln().abs(), "{k}");
    }
}
