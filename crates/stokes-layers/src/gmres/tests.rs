use proptest::prelude::*;

use super::*;

proptest! {
    #[test]
    fn solves_diagonally_dominant_systems(
        entries in proptest::collection::vec(-1.0..1.0f64, 20 * 20),
        expected in proptest::collection::vec(-1.0..1.0f64, 20),
        guess in proptest::collection::vec(-1.0..1.0f64, 20),
    ) {
        let product = |x: &[f64], out: &mut [f64], _: f64| {
            for (i, out) in out.iter_mut().enumerate() {
                *out = 22.0 * x[i] + dot(&entries[20 * i..20 * (i + 1)], x);
            }
        };
        let mut b = vec![0.0; 20];
        product(&expected, &mut b, 0.0);
        let mut x = guess;
        let outcome = Gmres::default().solve(product, &b, &mut x, 1e-13, 200);
        prop_assert!(outcome.residual <= 1e-13);
        for (x, expected) in x.iter().zip(&expected) {
            prop_assert!((x - expected).abs() < 1e-10);
        }
    }
}

#[test]
fn ends_after_as_many_products_as_there_are_different_eigenvalues() {
    let product = |x: &[f64], out: &mut [f64], _: f64| {
        for (i, out) in out.iter_mut().enumerate() {
            *out = [1.0, 2.0, 5.0][i % 3] * x[i];
        }
    };
    let b: Vec<f64> = (0..90).map(|i| 1.0 + (f64::from(i)).sin()).collect();
    let mut x = vec![0.0; 90];
    let outcome = Gmres::default().solve(product, &b, &mut x, 1e-12, 100);
    assert_eq!(outcome.iterations, 3);
    let again = Gmres::default().solve(product, &b, &mut x, 1e-12, 100);
    assert_eq!(again.iterations, 0);
}

#[test]
fn tells_when_it_has_not_converged() {
    // A cyclic shift: the residual stays until the basis is complete.
    let product = |x: &[f64], out: &mut [f64], _: f64| {
        for (i, out) in out.iter_mut().enumerate() {
            *out = x[(i + 1) % x.len()];
        }
    };
    let mut b = vec![0.0; 100];
    b[0] = 1.0;
    let mut x = vec![0.0; 100];
    let outcome = Gmres::default().solve(product, &b, &mut x, 1e-12, 90);
    assert_eq!(outcome.iterations, 90);
    assert!(outcome.residual > 0.5);
}
