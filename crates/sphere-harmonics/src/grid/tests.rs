use super::*;
use crate::{evaluate, harmonics, index};

/// Coefficients without any symmetry.
fn coefficients(degree: usize) -> Vec<f64> {
    (0..count(degree)).map(|k| ((k * 7919 % 101) as f64 / 101.0 - 0.5) / (1.0 + k as f64).sqrt()).collect()
}

#[test]
fn harmonics_are_orthonormal() {
    for (degree, rows, columns) in [(4, 5, 9), (11, 14, 26), (48, 49, 98)] {
        let mut grid = Grid::new(degree, rows, columns).unwrap();
        let start = coefficients(degree);
        let (mut values, mut end) = (vec![0.0; grid.len()], vec![0.0; start.len()]);
        grid.backward(&start, &mut values).unwrap();
        grid.forward(&values, &mut end).unwrap();
        for (start, end) in start.iter().zip(&end) {
            assert!((start - end).abs() < 3e-14, "degree {degree}: {start} became {end}");
        }
        let area = grid.weights().sum::<f64>();
        assert!((area / (2.0 * TAU) - 1.0).abs() < 1e-14);
    }
}

#[test]
fn low_degrees_are_coordinates() {
    let point = Point { theta: 0.7, phi: -2.1 };
    let [x, y, z] = point.direction();
    let values = harmonics(2, point).unwrap();
    let norm = (3.0 / (2.0 * TAU)).sqrt();
    let of_degree_two = (15.0 / (2.0 * TAU)).sqrt();
    let exact = [
        (index(1, 1), norm * x),
        (index(1, -1), norm * y),
        (index(1, 0), norm * z),
        (index(2, -2), of_degree_two * x * y),
        (index(2, 1), of_degree_two * x * z),
    ];
    for (place, value) in exact {
        assert!((values[place] - value).abs() < 1e-15, "{place}");
    }
}

#[test]
fn derivatives_agree_with_differences_of_values_between_grid_points() {
    let degree = 9;
    let mut grid = Grid::gauss(degree).unwrap();
    let f = coefficients(degree);
    let (mut along_theta, mut along_phi) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
    grid.backward_theta(&f, &mut along_theta).unwrap();
    grid.backward_phi(&f, &mut along_phi).unwrap();
    let value = |theta, phi| evaluate(&f, Point { theta, phi }).unwrap();
    let h = 1e-3;
    // Differences of fourth order.
    let slope = |at: &dyn Fn(f64) -> f64| (8.0 * (at(h) - at(-h)) - at(2.0 * h) + at(-2.0 * h)) / (12.0 * h);
    for (k, Point { theta, phi }) in grid.points().enumerate() {
        let exact = slope(&|d| value(theta + d, phi));
        assert!((along_theta[k] - exact).abs() < 1e-8, "{} {exact}", along_theta[k]);
        let exact = slope(&|d| value(theta, phi + d)) / theta.sin();
        assert!((along_phi[k] - exact).abs() < 1e-7, "{} {exact}", along_phi[k]);
        let here = crate::derivatives(&f, Point { theta, phi }).unwrap();
        let found = [value(theta, phi), along_theta[k], along_phi[k]];
        assert!(here.iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-13), "{here:?} {found:?}");
    }
}

#[test]
fn integrals_against_gradients_are_those_of_laplacians() {
    // The gradient of f against the gradients of the harmonics: l (l + 1) f_lm.
    let degree = 12;
    let mut grid = Grid::gauss(degree).unwrap();
    let f = coefficients(degree);
    let (mut along_theta, mut along_phi) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
    grid.backward_theta(&f, &mut along_theta).unwrap();
    grid.backward_phi(&f, &mut along_phi).unwrap();
    let mut found = vec![0.0; f.len()];
    grid.forward_gradient([&along_theta, &along_phi], &mut found).unwrap();
    for (place, (found, f)) in found.iter().zip(&f).enumerate() {
        let l = place.isqrt() as f64;
        assert!((found - l * (l + 1.0) * f).abs() < 1e-12, "{place}: {found} {f}");
    }
}

#[test]
fn bad_input_is_refused_in_words() {
    let degree = Grid::gauss(0).unwrap_err();
    assert_eq!(degree.to_string(), "the degree 0 is out of range. Use a degree from 1 to 256");
    assert!(matches!(Grid::new(4, 4, 9), Err(HarmonicsError::Grid { rows: 4, .. })));
    assert!(matches!(Grid::new(4, 5, 8), Err(HarmonicsError::Grid { columns: 8, .. })));
    let mut grid = Grid::gauss(2).unwrap();
    let error = grid.backward(&[0.0; 4], &mut [0.0; 18]).unwrap_err();
    assert_eq!(error.to_string(), "coefficients have 4 entries, but the grid or degree needs 9");
    assert!(matches!(evaluate(&[0.0; 5], Point { theta: 0.0, phi: 0.0 }), Err(HarmonicsError::NotSquare { found: 5 })));
    assert!(matches!(evaluate(&[0.0; 4], Point { theta: f64::NAN, phi: 0.0 }), Err(HarmonicsError::Angle { .. })));
}
