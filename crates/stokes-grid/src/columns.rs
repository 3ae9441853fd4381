//! Transforms along y.

use std::fmt;
use std::sync::Arc;

use num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

/// Columns that are gathered, changed and put back together: two cache lines of each row.
const BATCH: usize = 8;

/// Room between gathered columns, so that those of a power of two do not compete for the same places in the cache.
const GAP: usize = 4;

/// A plan for the transform of the columns of an array of `ny` rows of complex numbers and back, not normalised.
///
/// Columns are gathered a few at a time into a buffer that stays in the cache, so that no pass walks through memory
/// with a large stride and nothing is transposed as a whole.
pub(crate) struct ColumnTransform {
    ny: usize,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    batch: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl fmt::Debug for ColumnTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ColumnTransform").field("ny", &self.ny).finish_non_exhaustive()
    }
}

impl ColumnTransform {
    pub(crate) fn new(ny: usize) -> Self {
        let mut planner = FftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(ny), planner.plan_fft_inverse(ny));
        let scratch = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        Self {
            ny,
            forward,
            inverse,
            batch: vec![Complex64::ZERO; BATCH * (ny + GAP)],
            scratch: vec![Complex64::ZERO; scratch],
        }
    }

    /// Transforms the columns of `rows`, each `width` long.
    pub(crate) fn forward(&mut self, rows: &mut [Complex64], width: usize) {
        let plan = self.forward.clone();
        self.for_each(rows, width, |_, column, scratch| run(&*plan, column, scratch));
    }

    /// Transforms the columns of `rows` back.
    pub(crate) fn inverse(&mut self, rows: &mut [Complex64], width: usize) {
        let plan = self.inverse.clone();
        self.for_each(rows, width, |_, column, scratch| run(&*plan, column, scratch));
    }

    /// Transforms each column, lets `change(m, column)` change it and transforms it back.
    pub(crate) fn filter(&mut self, rows: &mut [Complex64], width: usize, change: impl Fn(usize, &mut [Complex64])) {
        let (forward, inverse) = (self.forward.clone(), self.inverse.clone());
        self.for_each(rows, width, |m, column, scratch| {
            run(&*forward, column, scratch);
            change(m, column);
            run(&*inverse, column, scratch);
        });
    }

    /// Does the same for the columns from `first` on and puts them, one after another, into `columns`.
    #[cfg(feature = "rayon")]
    pub(crate) fn filter_into(
        &mut self,
        rows: &[Complex64],
        width: usize,
        first: usize,
        columns: &mut [Complex64],
        change: impl Fn(usize, &mut [Complex64]),
    ) {
        for (b, batch) in columns.chunks_mut(BATCH * self.ny).enumerate() {
            let m = first + b * BATCH;
            let mut parts = batch.chunks_exact_mut(self.ny);
            if parts.len() == BATCH {
                let mut columns: [&mut [Complex64]; BATCH] = std::array::from_fn(|_| parts.next().unwrap_or_default());
                gather(&rows[m..], width, &mut columns);
            } else {
                for (k, column) in parts.enumerate() {
                    gather(&rows[m + k..], width, &mut [column]);
                }
            }
            for (k, column) in batch.chunks_exact_mut(self.ny).enumerate() {
                run(&*self.forward, column, &mut self.scratch);
                change(m + k, column);
                run(&*self.inverse, column, &mut self.scratch);
            }
        }
    }

    fn for_each(
        &mut self,
        rows: &mut [Complex64],
        width: usize,
        mut work: impl FnMut(usize, &mut [Complex64], &mut [Complex64]),
    ) {
        let mut m = 0;
        while m < width {
            let count = if m + BATCH <= width { BATCH } else { 1 };
            let mut columns = self.batch.chunks_exact_mut(self.ny + GAP).map(|column| &mut column[..self.ny]);
            if count == BATCH {
                let mut batch: [&mut [Complex64]; BATCH] = std::array::from_fn(|_| columns.next().unwrap_or_default());
                gather(&rows[m..], width, &mut batch);
                for (k, column) in batch.iter_mut().enumerate() {
                    work(m + k, column, &mut self.scratch);
                }
                scatter(&batch, &mut rows[m..], width);
            } else {
                let mut batch = [columns.next().unwrap_or_default()];
                gather(&rows[m..], width, &mut batch);
                work(m, batch[0], &mut self.scratch);
                scatter(&batch, &mut rows[m..], width);
            }
            m += count;
        }
    }
}

fn run(plan: &dyn Fft<f64>, column: &mut [Complex64], scratch: &mut [Complex64]) {
    plan.process_with_scratch(column, &mut scratch[..plan.get_inplace_scratch_len()]);
}

/// Copies the leading `N` columns of rows of length `width` into contiguous ones. (The number is a constant because the
/// copies of one row then need no loop, which halves the time.)
fn gather<const N: usize>(rows: &[Complex64], width: usize, columns: &mut [&mut [Complex64]; N]) {
    for (j, row) in rows.chunks(width).enumerate() {
        if let Some(row) = row.first_chunk::<N>() {
            for (column, value) in columns.iter_mut().zip(row) {
                column[j] = *value;
            }
        }
    }
}

/// The way back from [`gather`].
fn scatter<const N: usize>(columns: &[&mut [Complex64]; N], rows: &mut [Complex64], width: usize) {
    for (j, row) in rows.chunks_mut(width).enumerate() {
        if let Some(row) = row.first_chunk_mut::<N>() {
            for (column, value) in columns.iter().zip(row) {
                *value = column[j];
            }
        }
    }
}
