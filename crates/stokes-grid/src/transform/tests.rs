use std::f64::consts::PI;

use super::*;
use crate::Grid;
use crate::error::refused;

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
fn a_filter_multiplies_each_wave_number() {
    for (nx, ny) in SIZES {
        let mut transform = RealFft2::new(nx, ny).unwrap();
        let factor = |m: usize, n: usize| 1.0 / (1.0 + (m * m) as f64 + 3.0 * n as f64);
        let symbol = Symbol::new(nx, ny, factor).unwrap();
        let (f, mut filtered) = (field(nx, ny), vec![0.0; nx * ny]);
        let rows = |j: usize| j * nx..(j + 1) * nx;
        let read = |j: usize, row: &mut [f64]| row.copy_from_slice(&f[rows(j)]);
        transform.filter(&symbol, read, |j, row| filtered[rows(j)].copy_from_slice(row)).unwrap();
        for (m, n) in (0..nx * ny).map(|k| (k % nx, k / nx)) {
            let expected = definition(&f, nx, ny, m, n) * factor(m.min(nx - m), n.min(ny - n));
            let value = definition(&filtered, nx, ny, m, n);
            assert!((value - expected).norm() < 1e-12, "{nx} x {ny}, entry {m}, {n}: {value} and {expected}");
        }
    }
}

#[test]
fn plans_for_nothing_and_for_other_sizes_are_refused() {
    assert!(refused(&RealFft2::new(0, 4), "the grid is too small: 0 x 4 cells. Use at least 1"));
    let mut transform = RealFft2::new(6, 4).unwrap();
    let found = transform.filter(&Symbol::new(4, 6, |_, _| 1.0).unwrap(), |_, _| (), |_, _| ());
    assert!(refused(&found, "the symbol belongs to another grid"));
}

/// Sizes are looked at before anything is allocated.
#[test]
fn sizes_beyond_memory_are_refused() {
    for (nx, ny) in [(1 << 18, 1 << 18), (usize::MAX, 2), (usize::MAX, usize::MAX)] {
        let text = format!("too large for the memory: {nx} x {ny} cells. Use at most {}", Grid::MAXIMUM_CELLS);
        assert!(refused(&RealFft2::new(nx, ny), &text));
        assert!(refused(&Symbol::new(nx, ny, |_, _| 1.0), &text));
    }
}
