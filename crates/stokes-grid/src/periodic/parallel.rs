//! Transforms of a large periodic box on several threads.

use motile_base::{InputError, internal::sum};
use num_complex::Complex64;
use rayon::prelude::*;

use crate::transform::{ColumnTransform, RowTransform};
use crate::{StaggeredField, Symbol, stencil};

/// Pieces of work, whatever the number of threads, so that results do not depend on it: two for each of eight threads.
const SHARES: usize = 16;

/// Rows that are gathered from the columns at a time: eight complex numbers are two cache lines of each column.
const BATCH: usize = 8;

/// Minimum number of cells for which several threads are used: their spectrum takes 6 MB, more than the cache of a
/// core.
const LEAST_CELLS: usize = 800_000;

/// A real forward and inverse transform in shares that any thread may take, with its working memory.
///
/// Rows go into `spectrum`, columns of that into `columns` (each column contiguous), rows of those into the velocity:
/// no share writes where another one does, and every number comes from the same operations in the same order as on one
/// thread.
#[derive(Debug, Clone)]
pub(crate) struct ParallelTransform {
    nx: usize,
    ny: usize,
    width: usize,
    spectrum: Vec<Complex64>,
    columns: Vec<Complex64>,
    rows: Vec<RowShare>,
    column_shares: Vec<ColumnTransform>,
    totals: Vec<[f64; 2]>,
}

/// Working memory for the rows of one share.
#[derive(Debug, Clone)]
struct RowShare {
    transform: RowTransform,
    batch: Vec<Complex64>,
    previous: Vec<f64>,
    finite: bool,
}

/// Returns true if there are several threads and enough cells for them.
pub(crate) fn pays(cells: usize) -> bool {
    cells >= LEAST_CELLS && rayon::current_num_threads() > 1
}

impl ParallelTransform {
    pub(crate) fn new(nx: usize, ny: usize) -> Result<Self, InputError> {
        let width = nx / 2 + 1;
        let share = || {
            let (batch, previous) = (vec![Complex64::ZERO; BATCH * width], vec![0.0; nx]);
            Ok(RowShare { transform: RowTransform::new(nx)?, batch, previous, finite: true })
        };
        Ok(Self {
            nx,
            ny,
            width,
            spectrum: vec![Complex64::ZERO; width * ny],
            columns: vec![Complex64::ZERO; width * ny],
            rows: (0..SHARES).map(|_| share()).collect::<Result<_, _>>()?,
            column_shares: (0..SHARES).map(|_| ColumnTransform::new(ny)).collect::<Result<_, _>>()?,
            totals: vec![[0.0; 2]; ny],
        })
    }

    /// Returns the number of rows of a share; the last one may have fewer.
    fn rows_of_share(&self) -> usize {
        self.ny.div_ceil(SHARES)
    }

    /// Transforms the rows that `curl(j, row)` writes along x, and returns the sums of the components of `force`.
    pub(crate) fn forward(&mut self, force: &StaggeredField, curl: impl Fn(usize, &mut [f64]) + Sync) -> [f64; 2] {
        let (nx, width, count) = (self.nx, self.width, self.rows_of_share());
        let (fx, fy) = (force.x(), force.y());
        let shares = self.spectrum.par_chunks_mut(count * width).zip(self.totals.par_chunks_mut(count));
        shares.zip(self.rows.par_iter_mut()).enumerate().for_each(|(index, ((spectrum, totals), share))| {
            for (k, (out, total)) in spectrum.chunks_exact_mut(width).zip(totals).enumerate() {
                let j = index * count + k;
                share.transform.forward(|row| curl(j, row), out);
                *total = [sum(&fx[j * nx..][..nx]), sum(&fy[j * nx..][..nx])];
            }
        });
        self.totals.iter().fold([0.0; 2], |[x, y], row| [x + row[0], y + row[1]])
    }

    /// Transforms the rows that `input(j, row)` writes, applies the operator with this symbol, and writes the rows of
    /// the result.
    pub(crate) fn filter(&mut self, symbol: &Symbol, input: impl Fn(usize, &mut [f64]) + Sync, out: &mut [f64]) {
        self.forward_rows(input);
        self.filter_columns(symbol);
        self.inverse_rows(out);
    }

    /// Transforms the rows that `input(j, row)` writes along x.
    fn forward_rows(&mut self, input: impl Fn(usize, &mut [f64]) + Sync) {
        let (width, count) = (self.width, self.rows_of_share());
        let shares = self.spectrum.par_chunks_mut(count * width).zip(self.rows.par_iter_mut());
        shares.enumerate().for_each(|(index, (spectrum, share))| {
            for (k, out) in spectrum.chunks_exact_mut(width).enumerate() {
                share.transform.forward(|row| input(index * count + k, row), out);
            }
        });
    }

    /// Transforms the columns back along x.
    fn inverse_rows(&mut self, out: &mut [f64]) {
        let (nx, ny, width, count) = (self.nx, self.ny, self.width, self.rows_of_share());
        let columns = &self.columns;
        let shares = out.par_chunks_mut(count * nx).zip(self.rows.par_iter_mut());
        shares.enumerate().for_each(|(index, (out, RowShare { transform, batch, .. }))| {
            for (b, rows) in out.chunks_mut(BATCH * nx).enumerate() {
                gather(columns, ny, index * count + b * BATCH, rows.len() / nx, batch, width);
                for (row, spectrum) in rows.chunks_exact_mut(nx).zip(batch.chunks_exact_mut(width)) {
                    row.copy_from_slice(transform.inverse(spectrum));
                }
            }
        });
    }

    /// Transforms along y, multiplies by `symbol` and transforms back.
    pub(crate) fn filter_columns(&mut self, symbol: &Symbol) {
        let (width, ny) = (self.width, self.ny);
        let count = width.div_ceil(SHARES);
        let spectrum = &self.spectrum;
        let shares = self.columns.par_chunks_mut(count * ny).zip(self.column_shares.par_iter_mut());
        shares.enumerate().for_each(|(index, (columns, share))| {
            share.filter_into(spectrum, width, index * count, columns, |m, column| symbol.apply(m, column));
        });
    }

    /// Transforms psi / h back along x and writes its differences, the velocity; false if they are not finite.
    pub(crate) fn velocity(&mut self, [mean_u, mean_v]: [f64; 2], velocity: &mut StaggeredField) -> bool {
        let (nx, ny, width, count) = (self.nx, self.ny, self.width, self.rows_of_share());
        let columns = &self.columns;
        let (u, v) = velocity.components_mut();
        let shares = u.par_chunks_mut(count * nx).zip(v.par_chunks_mut(count * nx));
        shares.zip(self.rows.par_iter_mut()).enumerate().for_each(|(index, ((u, v), share))| {
            let RowShare { transform, batch, previous, finite } = share;
            let (start, rows) = (index * count, v.len() / nx);
            *finite = true;
            // One row more than the share has, for the difference to it.
            for k in 0..=rows {
                let in_batch = k % BATCH;
                if in_batch == 0 {
                    gather(columns, ny, start + k, (rows + 1 - k).min(BATCH), batch, width);
                }
                let psi = transform.inverse(&mut batch[in_batch * width..][..width]);
                // An overflow anywhere in the transforms reaches every value of every row.
                *finite &= psi[0].is_finite();
                if !*finite {
                    return;
                }
                if k > 0 {
                    stencil::along(&mut u[(k - 1) * nx..][..nx], previous, psi, mean_u);
                }
                if k < rows {
                    stencil::across(&mut v[k * nx..][..nx], psi, mean_v);
                    previous.copy_from_slice(psi);
                }
            }
        });
        self.rows.iter().all(|share| share.finite)
    }
}

/// Copies `count` rows from `first` on, in a box of `ny` rows, out of contiguous columns.
fn gather(columns: &[Complex64], ny: usize, first: usize, count: usize, rows: &mut [Complex64], width: usize) {
    for (m, column) in columns.chunks_exact(ny).enumerate() {
        if let Some(values) = column.get(first..first + count) {
            for (k, value) in values.iter().enumerate() {
                rows[k * width + m] = *value;
            }
        } else {
            for k in 0..count {
                rows[k * width + m] = column[(first + k) % ny];
            }
        }
    }
}

#[cfg(test)]
mod tests;
