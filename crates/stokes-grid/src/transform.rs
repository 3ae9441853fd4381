//! Two-dimensional transforms of real fields.

use num_complex::Complex64;

use crate::columns::ColumnTransform;
use crate::rows::RowTransform;
use crate::{StokesError, Symbol};

/// A plan for the discrete Fourier transform of real `nx` x `ny` arrays (row after row, x contiguous).
///
/// The spectrum has `ny` rows of `nx / 2 + 1` complex numbers; entry (m, n) is
///
/// `F[m, n] = sum over i, j of f[i, j] exp(-2 pi I (m i / nx + n j / ny))`,
///
/// and entries with m > nx / 2 follow from `F[nx - m, ny - n] = conj(F[m, n])`. Neither direction is normalised: forward and
/// inverse one after the other multiply by `nx ny`.
///
/// Rows are transformed by `realfft`; columns are gathered a few at a time into a buffer that stays in the cache, so that no
/// pass walks through memory with a large stride and nothing is transposed as a whole.
///
/// Every size is correct. Sizes whose only prime factors are 2, 3, 5, 7 and 11 are fast; an odd `nx` takes about a third longer,
/// and other prime factors take two to nine times as long (measured from 235 to 1009).
#[derive(Debug)]
pub struct RealFft2 {
    nx: usize,
    ny: usize,
    rows: RowTransform,
    columns: ColumnTransform,
    spectrum: Vec<Complex64>,
}

impl RealFft2 {
    /// A plan for arrays of `nx` x `ny` values.
    ///
    /// # Errors
    /// A size of zero.
    pub fn new(nx: usize, ny: usize) -> Result<Self, StokesError> {
        if nx == 0 || ny == 0 {
            return Err(StokesError::GridTooSmall { nx, ny, minimum: 1 });
        }
        let (rows, columns) = (RowTransform::new(nx), ColumnTransform::new(ny));
        let spectrum = vec![Complex64::ZERO; rows.width() * ny];
        Ok(Self { nx, ny, rows, columns, spectrum })
    }

    /// Complex numbers in a row of the spectrum: `nx / 2 + 1`.
    #[must_use]
    pub fn spectrum_width(&self) -> usize {
        self.rows.width()
    }

    /// Transforms the rows that `input(j, row)` writes, for j = 0, 1, ..., into the plan's own spectrum.
    pub(crate) fn forward_rows(&mut self, mut input: impl FnMut(usize, &mut [f64])) {
        let width = self.spectrum_width();
        for (j, out) in self.spectrum.chunks_exact_mut(width).enumerate() {
            self.rows.forward(|row| input(j, row), out);
        }
    }

    /// Transforms the columns of the plan's own spectrum, multiplies them and transforms them back.
    pub(crate) fn filter_columns(&mut self, symbol: &Symbol) {
        assert!(symbol.fits(self.nx, self.ny), "a symbol for another size than the transform's");
        self.columns.filter(&mut self.spectrum, self.rows.width(), |m, column| symbol.apply(m, column));
    }

    /// Transforms the rows of the plan's own spectrum back and hands each to `output(j, row)`, for j = 0, 1, ...
    pub(crate) fn inverse_rows(&mut self, mut output: impl FnMut(usize, &[f64])) {
        let width = self.spectrum_width();
        for (j, row) in self.spectrum.chunks_exact_mut(width).enumerate() {
            output(j, self.rows.inverse(row));
        }
    }

    /// The operator with this symbol applied to a field whose rows `input(j, row)` writes; `output(j, row)` gets the rows of the
    /// result. One forward and one inverse transform, with the symbol applied to each column while it is in the cache.
    ///
    /// # Panics
    /// A symbol made for another size.
    pub fn filter(&mut self, symbol: &Symbol, input: impl FnMut(usize, &mut [f64]), output: impl FnMut(usize, &[f64])) {
        self.forward_rows(input);
        self.filter_columns(symbol);
        self.inverse_rows(output);
    }

    /// The spectrum of a field.
    ///
    /// # Errors
    /// `input` without `nx ny` values, or `spectrum` without `ny (nx / 2 + 1)`.
    pub fn forward(&mut self, input: &[f64], spectrum: &mut [Complex64]) -> Result<(), StokesError> {
        self.check(input.len(), spectrum.len())?;
        let nx = self.nx;
        self.forward_rows(|j, row| row.copy_from_slice(&input[j * nx..(j + 1) * nx]));
        spectrum.copy_from_slice(&self.spectrum);
        self.columns.forward(spectrum, self.rows.width());
        Ok(())
    }

    /// The field of a spectrum, not normalised.
    ///
    /// # Errors
    /// `spectrum` without `ny (nx / 2 + 1)` values, or `output` without `nx ny`.
    pub fn inverse(&mut self, spectrum: &[Complex64], output: &mut [f64]) -> Result<(), StokesError> {
        self.check(output.len(), spectrum.len())?;
        self.spectrum.copy_from_slice(spectrum);
        self.columns.inverse(&mut self.spectrum, self.rows.width());
        let nx = self.nx;
        self.inverse_rows(|j, row| output[j * nx..(j + 1) * nx].copy_from_slice(row));
        Ok(())
    }

    fn check(&self, space: usize, spectrum: usize) -> Result<(), StokesError> {
        let sizes = [
            ("a field to transform", self.nx * self.ny, space),
            ("a spectrum", self.spectrum_width() * self.ny, spectrum),
        ];
        for (name, expected, found) in sizes {
            if expected != found {
                return Err(StokesError::WrongLength { name, expected, found });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

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
        assert_eq!(found, Err(StokesError::WrongLength { name: "a field to transform", expected: 24, found: 23 }));
        let found = transform.inverse(&spectrum[..15], &mut [0.0; 24]);
        assert_eq!(found, Err(StokesError::WrongLength { name: "a spectrum", expected: 16, found: 15 }));
        assert!(matches!(RealFft2::new(0, 4), Err(StokesError::GridTooSmall { .. })));
    }
}
