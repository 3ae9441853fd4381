use num_complex::Complex64;
use proptest::prelude::*;

use super::{half_turns, ln, row_of_turns, row_singularities};

/// Singular functions of a row from exponentials of source and target and from circular functions of their distance,
/// down to distances where the exponentials have lost all digits.
#[test]
fn singular_functions_of_a_row_from_exponentials() {
    let (k, source) = (0.6, Complex64::new(2.3, -1.1));
    for distance in [1e-9, 1e-4, 0.01, 0.1, 0.2, 0.5, 1.0, 2.5] {
        for angle in 0..12 {
            let d = Complex64::from_polar(distance, 0.3 + f64::from(angle));
            let (log, c) = row_of_turns(d, k, half_turns(source, k), half_turns(source - d, k));
            let (exact_log, exact) = row_singularities(d, k);
            assert!((log - exact_log).abs() < 1e-14 * (1.0 + exact_log.abs()), "{d}: {log} {exact_log}");
            for (c, exact) in c.iter().zip(exact) {
                assert!((c - exact).norm() < 3e-14 * (k * k + exact.norm()), "{d}: {c} {exact}");
            }
        }
    }
}

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
