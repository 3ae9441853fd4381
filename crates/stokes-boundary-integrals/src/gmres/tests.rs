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

/// A shift of the entries, which takes as many products as there are entries: the first cycle may use products that are
/// less exact as the residual falls, those after it may not.
#[test]
fn only_the_first_cycle_relies_on_products_that_are_not_exact() {
    let mut accuracies = Vec::new();
    let product = |x: &[f64], out: &mut [f64], accuracy: f64| {
        accuracies.push(accuracy);
        out[1..].copy_from_slice(&x[..199]);
        out[0] = x[199];
    };
    let mut b = vec![0.0; 200];
    b[0] = 1.0;
    let outcome = Gmres::default().solve(product, &b, &mut vec![0.0; 200], 1e-3, 100);
    assert_eq!(outcome.iterations, 100);
    // The residual of the guess, a cycle, the residual again.
    assert!(accuracies[1..=BASIS].iter().all(|&accuracy| (accuracy - 1e-3).abs() < 1e-15), "{accuracies:?}");
    assert_eq!(accuracies[BASIS + 1], 1e-3);
    assert_eq!(accuracies[BASIS + 2..102], vec![0.0; 40]);
}

#[test]
fn recycled_directions_invert_the_matrix_on_their_images() {
    let len = 12;
    let matrix = |x: &[f64]| -> Vec<f64> {
        (0..len).map(|i| 2.0 * x[i] + (0..len).map(|j| ((3 * i + 5 * j) as f64).sin() * x[j]).sum::<f64>()).collect()
    };
    let directions: Vec<Vec<f64>> =
        (1..=5).map(|k| (0..len).map(|i| 1.0 + (0.3 * (k * i) as f64).cos()).collect()).collect();
    let images: Vec<Vec<f64>> = directions.iter().map(|u| matrix(u)).collect();
    let mut recycled = Recycled::default();
    recycled.fit(len);
    recycled.renew(&mut directions.concat(), &images.concat());
    for (direction, image) in directions.iter().zip(&images) {
        let mut out = vec![0.0; len];
        recycled.apply(image, &mut out);
        let error = out.iter().zip(direction).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 1e-9, "{error:e}");
    }
}

/// Of a second system with the same matrix the directions of the first are known.
#[test]
fn a_neighbouring_system_takes_fewer_products() {
    let product = |x: &[f64], out: &mut [f64], _: f64| {
        for (i, out) in out.iter_mut().enumerate() {
            *out = (1.0 + 0.3 * (i % 12) as f64) * x[i];
        }
    };
    let b: Vec<f64> = (0..96).map(|i| 1.0 + (f64::from(i)).sin()).collect();
    let beside: Vec<f64> = b.iter().enumerate().map(|(i, b)| b * (1.0 + 0.1 * (i % 12) as f64)).collect();
    let mut keeps = Gmres::recycling();
    let (mut x, mut y) = (vec![0.0; 96], vec![0.0; 96]);
    let first = keeps.solve(product, &b, &mut x, 1e-10, 100).iterations;
    let second = keeps.solve(product, &beside, &mut y, 1e-10, 100).iterations;
    assert!(first >= 10 && second <= first / 2, "{first} {second}");
}
