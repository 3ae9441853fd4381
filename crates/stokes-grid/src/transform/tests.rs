use std::f64::consts::PI;

use super::*;
use crate::InputError;

const SIZES: [(usize, usize); 10] =
    [(1, 1), (1, 6), (6, 1), (2, 2), (16, 8), (15, 9), (7, 13), (20, 17), (17, 20), (37, 24)];

fn field(nx: usize, ny: usize) -> Vec<f64> {
    (0..nx * ny).map(|k| ((k * k) as f64 * 0.37).sin() + 0.2).collect()
}

/// The sum of the definition, with exactly reduced angles.
fn definition(f: &[f64], nx: usize, ny: usize, m: usize, n: usize) -> Complex64 {
    let term = |(k, value): (usize, &f64)| {
        let angle = (m * (k % nx) % nx) as f64 / nx as f64 + (n * (k / nx) % ny) as f64 / ny as f64;
        Complex64::from_polar(*value, -2.0 * PI * angle)
    };
    f.iter().enumerate().map(term).sum()
}

#[test]
fn the_spectrum_is_the_sum_it_says() {
    for (nx, ny) in SIZES {
        let mut transform = RealFft2::new(nx, ny).unwrap();
        let width = transform.spectrum_width();
        let f = field(nx, ny);
        let mut spectrum = vec![Complex64::ZERO; width * ny];
        transform.forward(&f, &mut spectrum).unwrap();
        for (k, value) in spectrum.iter().enumerate() {
            let expected = definition(&f, nx, ny, k % width, k / width);
            assert!((value - expected).norm() < 1e-12, "{nx} x {ny}, entry {k}: {value} and {expected}");
        }
        let mut back = vec![0.0; nx * ny];
        transform.inverse(&spectrum, &mut back).unwrap();
        for (a, b) in back.iter().zip(&f) {
            assert!((a / (nx * ny) as f64 - b).abs() < 1e-14, "{nx} x {ny}: {a} and {b}");
        }
    }
}

#[test]
fn a_filter_multiplies_each_wave_number() {
    for (nx, ny) in SIZES {
        let mut transform = RealFft2::new(nx, ny).unwrap();
        let width = transform.spectrum_width();
        let factor = |m: usize, n: usize| 1.0 / (1.0 + (m * m) as f64 + 3.0 * n as f64);
        let symbol = Symbol::new(nx, ny, factor);
        let (f, mut filtered) = (field(nx, ny), vec![0.0; nx * ny]);
        let rows = |j: usize| j * nx..(j + 1) * nx;
        transform.filter(
            &symbol,
            |j, row| row.copy_from_slice(&f[rows(j)]),
            |j, row| filtered[rows(j)].copy_from_slice(row),
        );
        let mut spectrum = vec![Complex64::ZERO; width * ny];
        transform.forward(&filtered, &mut spectrum).unwrap();
        for (k, value) in spectrum.iter().enumerate() {
            let (m, n) = (k % width, k / width);
            let expected = definition(&f, nx, ny, m, n) * factor(m, n.min(ny - n));
            assert!((value - expected).norm() < 1e-12, "{nx} x {ny}, entry {k}: {value} and {expected}");
        }
    }
}

#[test]
fn wrong_lengths_are_errors() {
    let mut transform = RealFft2::new(6, 4).unwrap();
    let mut spectrum = vec![Complex64::ZERO; 16];
    let found = transform.forward(&[0.0; 23], &mut spectrum);
    assert_eq!(
        found,
        Err(StokesError::Input(InputError::WrongLength { name: "a field to transform", expected: 24, found: 23 }))
    );
    let found = transform.inverse(&spectrum[..15], &mut [0.0; 24]);
    assert_eq!(found, Err(StokesError::Input(InputError::WrongLength { name: "a spectrum", expected: 16, found: 15 })));
    assert!(matches!(RealFft2::new(0, 4), Err(StokesError::GridTooSmall { .. })));
}
