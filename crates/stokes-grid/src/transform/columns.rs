//! Fourier transforms along y.

use motile_base::{ComplexTransform, InputError};
use num_complex::Complex64;

/// Columns that are gathered, changed and put back together: eight complex numbers are two cache lines of each row.
const BATCH: usize = 8;

/// Complex numbers between gathered columns, one cache line, so that columns of a power of two do not compete for the
/// same places in the cache.
const GAP: usize = 4;

/// A plan for changes of the transformed columns of an array of `ny` rows of complex numbers, not normalised.
///
/// Columns are gathered a few at a time into a buffer that stays in the cache, so that no pass walks through memory
/// with a large stride and nothing is transposed as a whole.
#[derive(Debug, Clone)]
pub(crate) struct ColumnTransform {
    plan: ComplexTransform,
    batch: Vec<Complex64>,
}

impl ColumnTransform {
    pub(crate) fn new(ny: usize) -> Result<Self, InputError> {
        Ok(Self { plan: ComplexTransform::new(ny)?, batch: vec![Complex64::ZERO; BATCH * (ny + GAP)] })
    }

    /// Transforms each column, lets `change(m, column)` change it and transforms it back.
    pub(crate) fn filter(&mut self, rows: &mut [Complex64], width: usize, change: impl Fn(usize, &mut [Complex64])) {
        let (ny, mut m) = (self.plan.len(), 0);
        while m < width {
            let count = if m + BATCH <= width { BATCH } else { 1 };
            let mut columns = self.batch.chunks_exact_mut(ny + GAP).map(|column| &mut column[..ny]);
            if count == BATCH {
                let mut batch: [&mut [Complex64]; BATCH] = std::array::from_fn(|_| columns.next().unwrap_or_default());
                gather(&rows[m..], width, &mut batch);
                for (k, column) in batch.iter_mut().enumerate() {
                    filter(&mut self.plan, column, |column| change(m + k, column));
                }
                scatter(&batch, &mut rows[m..], width);
            } else {
                let mut batch = [columns.next().unwrap_or_default()];
                gather(&rows[m..], width, &mut batch);
                filter(&mut self.plan, batch[0], |column| change(m, column));
                scatter(&batch, &mut rows[m..], width);
            }
            m += count;
        }
    }

    /// Transforms the columns from `first` on, lets `change(m, column)` change them and writes them, transformed back,
    /// one after another into `columns`.
    #[cfg(feature = "rayon")]
    pub(crate) fn filter_into(
        &mut self,
        rows: &[Complex64],
        width: usize,
        first: usize,
        columns: &mut [Complex64],
        change: impl Fn(usize, &mut [Complex64]),
    ) {
        let ny = self.plan.len();
        for (b, batch) in columns.chunks_mut(BATCH * ny).enumerate() {
            let m = first + b * BATCH;
            let mut parts = batch.chunks_exact_mut(ny);
            if parts.len() == BATCH {
                let mut columns: [&mut [Complex64]; BATCH] = std::array::from_fn(|_| parts.next().unwrap_or_default());
                gather(&rows[m..], width, &mut columns);
            } else {
                for (k, column) in parts.enumerate() {
                    gather(&rows[m + k..], width, &mut [column]);
                }
            }
            for (k, column) in batch.chunks_exact_mut(ny).enumerate() {
                filter(&mut self.plan, column, |column| change(m + k, column));
            }
        }
    }
}

/// Transforms a column, changes it and transforms it back; it has the length of the plan, so that no call can fail.
fn filter(plan: &mut ComplexTransform, column: &mut [Complex64], change: impl FnOnce(&mut [Complex64])) {
    let _ = plan.forward(column);
    change(column);
    let _ = plan.inverse(column);
}

/// Copies the leading `N` columns of rows of length `width` into contiguous ones. With a constant number the copies of
/// one row need no loop, which halves the time.
fn gather<const N: usize>(rows: &[Complex64], width: usize, columns: &mut [&mut [Complex64]; N]) {
    for (j, row) in rows.chunks(width).enumerate() {
        if let Some(row) = row.first_chunk::<N>() {
            for (column, value) in columns.iter_mut().zip(row) {
                column[j] = *value;
            }
        }
    }
}

/// Copies contiguous columns back into the leading columns of rows, the reverse of [`gather`].
fn scatter<const N: usize>(columns: &[&mut [Complex64]; N], rows: &mut [Complex64], width: usize) {
    for (j, row) in rows.chunks_mut(width).enumerate() {
        if let Some(row) = row.first_chunk_mut::<N>() {
            for (column, value) in columns.iter().zip(row) {
                *value = column[j];
            }
        }
    }
}
