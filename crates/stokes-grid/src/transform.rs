//! Fourier transforms of real fields: along x alone and in two dimensions.

mod columns;
mod symbol;

use motile_base::{InputError, RealTransform};
use num_complex::Complex64;

use crate::{Grid, StokesError};
pub(crate) use columns::ColumnTransform;
pub use symbol::Symbol;
pub(crate) use symbol::second_difference;

/// A plan for operators that multiply the discrete Fourier transform of real `nx` x `ny` arrays (row after row, x
/// contiguous).
///
/// The spectrum has `ny` rows of `nx / 2 + 1` complex numbers; entry (m, n) is
///
/// `F[m, n] = sum over i, j of f[i, j] exp(-2 pi I (m i / nx + n j / ny))`,
///
/// and entries with m > nx / 2 follow from `F[nx - m, ny - n] = conj(F[m, n])`. Neither direction is normalised:
/// forward and inverse transform together multiply by `nx ny`.
///
/// Rows are transformed one by one. Columns are gathered a few at a time into a buffer that stays in the cache, so that
/// no pass walks through memory with a large stride and nothing is transposed as a whole.
///
/// Any sizes work. Those whose only prime factors are 2, 3, 5, 7 and 11 are fast. An odd `nx` takes about a third
/// longer, and other prime factors take two to nine times as long (measured from 235 to 1009).
#[derive(Debug, Clone)]
pub struct RealFft2 {
    nx: usize,
    ny: usize,
    rows: RowTransform,
    columns: ColumnTransform,
    spectrum: Vec<Complex64>,
}

impl RealFft2 {
    /// Creates a plan for arrays of `nx` x `ny` values.
    ///
    /// # Errors
    /// Returns an error for a size of zero, or more than [`crate::Grid::MAXIMUM_CELLS`] values.
    pub fn new(nx: usize, ny: usize) -> Result<Self, StokesError> {
        if nx == 0 || ny == 0 {
            return Err(StokesError::grid_too_small(nx, ny, 1));
        }
        Grid::check_size(nx, ny)?;
        let (rows, columns) = (RowTransform::new(nx)?, ColumnTransform::new(ny)?);
        let spectrum = vec![Complex64::ZERO; rows.width() * ny];
        Ok(Self { nx, ny, rows, columns, spectrum })
    }

    /// Returns the numbers of values along x and y.
    pub(crate) fn size(&self) -> [usize; 2] {
        [self.nx, self.ny]
    }

    /// Transforms the rows that `input(j, row)` writes, for j = 0, 1, ..., into the plan's own spectrum.
    pub(crate) fn forward_rows(&mut self, mut input: impl FnMut(usize, &mut [f64])) {
        let width = self.rows.width();
        for (j, out) in self.spectrum.chunks_exact_mut(width).enumerate() {
            self.rows.forward(|row| input(j, row), out);
        }
    }

    /// Transforms the columns of the plan's own spectrum, multiplies them by a symbol of this size and transforms them
    /// back.
    pub(crate) fn filter_columns(&mut self, symbol: &Symbol) {
        self.columns.filter(&mut self.spectrum, self.rows.width(), |m, column| symbol.apply(m, column));
    }

    /// Transforms the rows of the plan's own spectrum back and hands each to `output(j, row)`, for j = 0, 1, ...
    pub(crate) fn inverse_rows(&mut self, mut output: impl FnMut(usize, &[f64])) {
        let width = self.rows.width();
        for (j, row) in self.spectrum.chunks_exact_mut(width).enumerate() {
            output(j, self.rows.inverse(row));
        }
    }

    /// Applies the operator with this symbol to a field whose rows `input(j, row)` writes; `output(j, row)` gets the
    /// rows of the result. This takes one forward and one inverse transform, with the symbol applied to each column
    /// while it is in the cache.
    ///
    /// # Errors
    /// Returns an error for a symbol made for another size.
    pub fn filter(
        &mut self,
        symbol: &Symbol,
        input: impl FnMut(usize, &mut [f64]),
        output: impl FnMut(usize, &[f64]),
    ) -> Result<(), StokesError> {
        if !symbol.fits(self.nx, self.ny) {
            return Err(StokesError::grid_mismatch("the symbol"));
        }
        self.forward_rows(input);
        self.filter_columns(symbol);
        self.inverse_rows(output);
        Ok(())
    }
}

/// A plan for the transform of single real rows of `nx` values to `nx / 2 + 1` complex ones and back, not normalised.
#[derive(Debug, Clone)]
pub(crate) struct RowTransform {
    plan: RealTransform,
    row: Vec<f64>,
}

impl RowTransform {
    pub(crate) fn new(nx: usize) -> Result<Self, InputError> {
        Ok(Self { plan: RealTransform::new(nx)?, row: vec![0.0; nx] })
    }

    /// Returns the number of complex numbers in a transformed row.
    pub(crate) fn width(&self) -> usize {
        self.plan.spectrum_len()
    }

    /// Transforms the row that `fill` writes.
    pub(crate) fn forward(&mut self, fill: impl FnOnce(&mut [f64]), out: &mut [Complex64]) {
        fill(&mut self.row);
        // Row and spectrum have the lengths of the plan, so that the call cannot fail.
        let _ = self.plan.forward(&mut self.row, out);
    }

    /// Transforms a spectrum, which is overwritten, back into a row.
    pub(crate) fn inverse(&mut self, spectrum: &mut [Complex64]) -> &[f64] {
        let _ = self.plan.inverse(spectrum, &mut self.row);
        &self.row
    }
}

#[cfg(test)]
mod tests;
