//! Transforms along x.

use fourier::{InputError, RealTransform};
use num_complex::Complex64;

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

    /// Complex numbers in a transformed row.
    pub(crate) fn width(&self) -> usize {
        self.plan.spectrum_len()
    }

    /// Transforms the row that `fill` writes.
    pub(crate) fn forward(&mut self, fill: impl FnOnce(&mut [f64]), out: &mut [Complex64]) {
        fill(&mut self.row);
        // The lengths are this plan's own, so that the call cannot fail.
        let _ = self.plan.forward(&mut self.row, out);
    }

    /// The row of a spectrum, which is lost.
    pub(crate) fn inverse(&mut self, spectrum: &mut [Complex64]) -> &[f64] {
        let _ = self.plan.inverse(spectrum, &mut self.row);
        &self.row
    }
}
