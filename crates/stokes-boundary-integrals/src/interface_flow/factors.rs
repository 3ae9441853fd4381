//! Factors of a dense matrix that is solved with many times.

use motile_base::internal::widely;
use nalgebra::{DMatrix, Dim, Dyn, LU, Matrix, PermutationSequence, VecStorage};

/// Columns that are taken off the right-hand side together, so that it is read and written once for all of them.
const COLUMNS: usize = 4;

/// Columns that are eliminated before the rest of the matrix is updated, by a product of matrices.
const PANEL: usize = 48;

/// The lower and upper factor of a dense matrix by Gaussian elimination with row exchanges.
///
/// Use it to solve with one matrix for many right-hand sides. Each solution reads the whole matrix and runs in the
/// widest vector registers of the processor.
#[derive(Debug, Clone)]
pub struct DenseFactors {
    /// Exchanges of rows, counted from the first of a panel.
    exchanges: Vec<PermutationSequence<Dyn>>,
    /// The upper factor, and below the diagonal the lower one, whose diagonal is 1.
    entries: DMatrix<f64>,
}

impl DenseFactors {
    /// Factorises a square matrix.
    #[must_use]
    pub fn new(mut entries: DMatrix<f64>) -> Self {
        let count = entries.nrows();
        let eliminate = |start: usize| {
            let (rows, width) = (count - start, PANEL.min(count - start));
            let panel = LU::new(entries.view((start, start), (rows, width)).into_owned());
            let beside = [(0, start), (start + width, rows - width)];
            for (column, columns) in beside {
                panel.p().permute_rows(&mut entries.view_mut((start, column), (rows, columns)));
            }
            entries.view_mut((start, start), (rows, width)).copy_from(panel.lu_internal());
            let (lower, mut right) = entries.columns_range_pair_mut(start..start + width, start + width..);
            let (mut above, mut rest) = right.rows_range_pair_mut(start..start + width, start + width..);
            lower.rows(start, width).solve_lower_triangular_with_diag_mut(&mut above, 1.0);
            rest.gemm(-1.0, &lower.rows_range(start + width..), &above, 1.0);
            panel.p().clone()
        };
        let exchanges = (0..count).step_by(PANEL).map(eliminate).collect();
        Self { exchanges, entries }
    }

    /// Returns true if the matrix has an inverse.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.entries.diagonal().iter().all(|value| *value != 0.0 && value.is_finite())
    }

    /// Replaces right-hand sides, one per column, with the solutions. If the matrix is singular, values are not finite.
    pub fn solve<C: Dim>(&self, values: &mut Matrix<f64, Dyn, C, VecStorage<f64, Dyn, C>>) {
        for (panel, exchanges) in self.exchanges.iter().enumerate() {
            exchanges.permute_rows(&mut values.rows_range_mut(panel * PANEL..));
        }
        let (entries, count) = (self.entries.as_slice(), self.entries.nrows());
        for column in values.as_mut_slice().chunks_exact_mut(count.max(1)) {
            widely(
                #[inline(always)]
                || substitute(entries, column),
            );
        }
    }
}

/// Forward and backward substitution with a matrix by columns.
#[inline(always)]
fn substitute(entries: &[f64], values: &mut [f64]) {
    let count = values.len();
    let column = |j: usize| &entries[j * count..(j + 1) * count];
    let (blocks, rest) = (count / COLUMNS, count % COLUMNS);
    for block in 0..blocks + rest.min(1) {
        let start = block * COLUMNS;
        let end = (start + COLUMNS).min(count);
        for j in start..end {
            for i in j + 1..end {
                values[i] -= column(j)[i] * values[j];
            }
        }
        let (known, below) = values.split_at_mut(end);
        take_off(below, &known[start..], |j| &column(start + j)[end..]);
    }
    for block in (0..blocks + rest.min(1)).rev() {
        let start = block * COLUMNS;
        let end = (start + COLUMNS).min(count);
        for j in (start..end).rev() {
            values[j] /= column(j)[j];
            for i in start..j {
                values[i] -= column(j)[i] * values[j];
            }
        }
        let (above, known) = values.split_at_mut(start);
        take_off(above, &known[..end - start], |j| &column(start + j)[..start]);
    }
}

/// Subtracts columns times known values.
#[inline(always)]
fn take_off<'a>(values: &mut [f64], known: &[f64], column: impl Fn(usize) -> &'a [f64]) {
    if let &[w, x, y, z] = known {
        let columns = column(0).iter().zip(column(1)).zip(column(2).iter().zip(column(3)));
        for (value, ((a, b), (c, d))) in values.iter_mut().zip(columns) {
            *value -= (a * w + b * x) + (c * y + d * z);
        }
    } else {
        for (j, factor) in known.iter().enumerate() {
            values.iter_mut().zip(column(j)).for_each(|(value, entry)| *value -= entry * factor);
        }
    }
}

#[cfg(test)]
mod tests;
