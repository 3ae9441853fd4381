//! Symbols of symmetric operators with constant coefficients: a factor for each wave number.

use num_complex::Complex64;

use crate::{Grid, StokesError};

/// Symbol of a symmetric linear operator with constant coefficients: a real factor for each pair of wave numbers, even
/// in both. [`crate::RealFft2::filter`] applies it.
#[derive(Debug, Clone, PartialEq)]
pub struct Symbol {
    nx: usize,
    ny: usize,
    values: Vec<f64>,
}

impl Symbol {
    /// Creates a symbol of minus the inverse of h^2 times the five-point Laplacian, times `factor`; for constants it is
    /// zero.
    pub(crate) fn inverse_laplacian(nx: usize, ny: usize, factor: f64) -> Self {
        Self::of_size(nx, ny, |m, n| if m == 0 && n == 0 { 0.0 } else { factor / laplacian(m, n, nx, ny) })
    }

    /// Creates a symbol of the inverse of `L (L - screening)`, times `factor`, where L is h^2 times the five-point
    /// Laplacian; for constants it is zero.
    pub(crate) fn inverse_biharmonic(nx: usize, ny: usize, factor: f64, screening: f64) -> Self {
        Self::of_size(nx, ny, |m, n| {
            let k2 = laplacian(m, n, nx, ny);
            if m == 0 && n == 0 { 0.0 } else { factor / (k2 * (k2 + screening)) }
        })
    }

    /// Returns a symbol with the factors `factor(m, n)` for m = 0..=nx/2 and n = 0..=ny/2; all others follow by
    /// symmetry. The normalisation `1 / (nx ny)` of the transforms is included, so that factors of one give the
    /// identity.
    ///
    /// # Errors
    /// Returns an error for more than [`crate::Grid::MAXIMUM_CELLS`] values.
    pub fn new(nx: usize, ny: usize, factor: impl Fn(usize, usize) -> f64) -> Result<Self, StokesError> {
        Grid::check_size(nx, ny)?;
        Ok(Self::of_size(nx, ny, factor))
    }

    fn of_size(nx: usize, ny: usize, factor: impl Fn(usize, usize) -> f64) -> Self {
        let scale = 1.0 / (nx as f64 * ny as f64);
        let mut values = Vec::with_capacity((nx / 2 + 1) * (ny / 2 + 1));
        for m in 0..=nx / 2 {
            values.extend((0..=ny / 2).map(|n| scale * factor(m, n)));
        }
        Self { nx, ny, values }
    }

    /// Returns true for transforms of that size.
    pub(crate) fn fits(&self, nx: usize, ny: usize) -> bool {
        self.nx == nx && self.ny == ny
    }

    fn column(&self, m: usize) -> &[f64] {
        let rows = self.ny / 2 + 1;
        &self.values[m * rows..(m + 1) * rows]
    }

    /// Multiplies one column of a spectrum: entries n and ny - n by the same factor.
    pub(crate) fn apply(&self, m: usize, column: &mut [Complex64]) {
        let factors = self.column(m);
        let (low, high) = column.split_at_mut(factors.len());
        for (value, &factor) in low.iter_mut().zip(factors) {
            *value *= factor;
        }
        for (value, &factor) in high.iter_mut().rev().zip(&factors[1..]) {
            *value *= factor;
        }
    }
}

/// Minus h^2 times the symbol of the three-point second difference, `(2 sin(pi m / n))^2`.
pub(crate) fn second_difference(m: usize, n: usize) -> f64 {
    let s = 2.0 * (std::f64::consts::PI * m as f64 / n as f64).sin();
    s * s
}

/// Minus h^2 times the symbol of the five-point Laplacian, Cowley (2.28).
fn laplacian(m: usize, n: usize, nx: usize, ny: usize) -> f64 {
    second_difference(m, nx) + second_difference(n, ny)
}
