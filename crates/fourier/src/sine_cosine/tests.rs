use std::f64::consts::PI;

use super::*;

fn column(n: usize) -> Vec<Complex64> {
    (0..n).map(|j| Complex64::new((3.0 * j as f64).sin() + 0.1, (1.0 + j as f64).powi(2).cos())).collect()
}

fn assert_close(a: &[Complex64], b: &[Complex64]) {
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).norm() < 2e-13, "{a} and {b}");
    }
}

#[test]
fn synthesis_is_the_sum_it_says_and_analysis_undoes_it() {
    for n in (1..=64).chain([97, 100, 120, 240]) {
        let mut transform = SineCosine::new(n);
        let sum = |coefficients: &[Complex64], rows: usize, wave: &dyn Fn(usize, usize) -> f64| -> Vec<Complex64> {
            (0..rows).map(|j| coefficients.iter().enumerate().map(|(k, c)| c * wave(k, j)).sum()).collect()
        };
        // pi k half_rows / (2 n), reduced exactly.
        let angle = |k: usize, half_rows: usize| 0.5 * PI * (k * half_rows % (4 * n)) as f64 / n as f64;
        let start = column(n);

        let mut values = start.clone();
        transform.synthesise_sines(&mut values).unwrap();
        assert_close(&values, &sum(&start, n, &|k, j| angle(k + 1, 2 * j + 1).sin()));
        transform.analyse_sines(&mut values).unwrap();
        assert_close(&values, &start);

        transform.synthesise_cosines(&mut values).unwrap();
        assert_close(&values, &sum(&start, n, &|k, j| angle(k, 2 * j + 1).cos()));
        transform.analyse_cosines(&mut values).unwrap();
        assert_close(&values, &start);

        let start = column(n - 1);
        let mut values = start.clone();
        transform.synthesise_node_sines(&mut values).unwrap();
        assert_close(&values, &sum(&start, n - 1, &|k, j| angle(k + 1, 2 * j + 2).sin()));
        transform.analyse_node_sines(&mut values).unwrap();
        assert_close(&values, &start);
    }
}

#[test]
fn wrong_lengths_are_errors() {
    let mut transform = SineCosine::new(6);
    let mut values = column(7);
    let expected = Err(InputError::WrongLength { name: "the values in cells", expected: 6, found: 7 });
    assert_eq!(transform.analyse_cosines(&mut values), expected);
    assert_eq!(transform.synthesise_cosines(&mut values), expected);
    assert_eq!(transform.analyse_sines(&mut values), expected);
    assert_eq!(transform.synthesise_sines(&mut values), expected);
    let expected = Err(InputError::WrongLength { name: "the values on nodes", expected: 5, found: 7 });
    assert_eq!(transform.analyse_node_sines(&mut values), expected);
    assert_eq!(transform.synthesise_node_sines(&mut values), expected);
}
