//! Transforms along x.

use std::fmt;
use std::sync::Arc;

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

/// A plan for the transform of single real rows of `nx` values to `nx / 2 + 1` complex ones and back, not normalised.
pub(crate) struct RowTransform {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    row: Vec<f64>,
    scratch: Vec<Complex64>,
}

impl fmt::Debug for RowTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RowTransform").field("nx", &self.row.len()).finish_non_exhaustive()
    }
}

impl RowTransform {
    pub(crate) fn new(nx: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(nx), planner.plan_fft_inverse(nx));
        let scratch = forward.get_scratch_len().max(inverse.get_scratch_len());
        Self { forward, inverse, row: vec![0.0; nx], scratch: vec![Complex64::ZERO; scratch] }
    }

    /// Complex numbers in a transformed row.
    pub(crate) fn width(&self) -> usize {
        self.row.len() / 2 + 1
    }

    /// Transforms the row that `fill` writes.
    pub(crate) fn forward(&mut self, fill: impl FnOnce(&mut [f64]), out: &mut [Complex64]) {
        fill(&mut self.row);
        let scratch = &mut self.scratch[..self.forward.get_scratch_len()];
        // The lengths are this plan's own, so that the call cannot fail.
        let _ = self.forward.process_with_scratch(&mut self.row, out, scratch);
    }

    /// The row of a spectrum, which is lost.
    pub(crate) fn inverse(&mut self, spectrum: &mut [Complex64]) -> &[f64] {
        let scratch = &mut self.scratch[..self.inverse.get_scratch_len()];
        // These are real but for round-off, and must be exactly so.
        spectrum[0].im = 0.0;
        if self.row.len().is_multiple_of(2) {
            spectrum[self.row.len() / 2].im = 0.0;
        }
        let _ = self.inverse.process_with_scratch(spectrum, &mut self.row, scratch);
        &self.row
    }
}
