//! Gaussian elimination in blocks, for matrices of thousands of rows.

use nalgebra::DMatrix;

/// Columns that are eliminated together: a block of rows then fits into the cache.
const BLOCK: usize = 48;

/// LU factors of a matrix, with exchanges of rows for the largest pivots.
pub(crate) struct Elimination {
    /// Lower triangle, whose diagonal is one, and upper triangle.
    triangles: DMatrix<f64>,
    /// Row that each row was exchanged with.
    exchanges: Vec<usize>,
}

impl Elimination {
    pub(crate) fn new(mut matrix: DMatrix<f64>) -> Self {
        let n = matrix.nrows();
        let mut exchanges = Vec::with_capacity(n);
        for start in (0..n).step_by(BLOCK) {
            let end = (start + BLOCK).min(n);
            for k in start..end {
                let pivot = k + matrix.column(k).rows(k, n - k).iamax();
                exchanges.push(pivot);
                matrix.swap_rows(k, pivot);
                let diagonal = matrix[(k, k)];
                let (mut left, mut right) = matrix.columns_range_pair_mut(k..=k, k + 1..end);
                let mut below = left.rows_mut(k + 1, n - k - 1);
                below /= diagonal;
                for mut column in right.column_iter_mut() {
                    let factor = column[k];
                    column.rows_mut(k + 1, n - k - 1).axpy(-factor, &below.column(0), 1.0);
                }
            }
            let (left, mut right) = matrix.columns_range_pair_mut(start..end, end..n);
            let mut upper = right.rows(start, end - start).into_owned();
            left.rows(start, end - start).solve_lower_triangular_with_diag_mut(&mut upper, 1.0);
            right.rows_mut(start, end - start).copy_from(&upper);
            right.rows_mut(end, n - end).gemm(-1.0, &left.rows(end, n - end), &upper, 1.0);
        }
        Self { triangles: matrix, exchanges }
    }

    /// Solutions for columns of right-hand sides; `None` if the matrix is singular.
    pub(crate) fn solve(&self, mut right: DMatrix<f64>) -> Option<DMatrix<f64>> {
        for (k, pivot) in self.exchanges.iter().enumerate() {
            right.swap_rows(k, *pivot);
        }
        self.triangles.solve_lower_triangular_with_diag_mut(&mut right, 1.0);
        self.triangles.solve_upper_triangular_mut(&mut right);
        right.iter().all(|value| value.is_finite()).then_some(right)
    }
}

#[cfg(test)]
mod tests;
