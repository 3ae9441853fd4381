//! Truncation of vectors along a closed curve to its lowest Fourier modes.

use std::sync::Arc;

use num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::Vec2;

/// Truncates periodic samples of a vector to the wave numbers |m| <= (modes - 1)/2, in place and without allocation.
///
/// Where the flow is resolved by fewer modes than a body has markers ([`crate::Medium::shape_modes`]), the body passes
/// the velocities of its markers through this, so that nothing moves in a way that the flow does not see.
pub struct BandLimit {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    samples: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    modes: usize,
}

impl std::fmt::Debug for BandLimit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BandLimit").field("len", &self.len()).field("modes", &self.modes).finish_non_exhaustive()
    }
}

impl BandLimit {
    /// A plan for `len` samples of which `modes` modes are kept (all of them where there are as many or more; at least
    /// the mean).
    #[must_use]
    pub fn new(len: usize, modes: usize) -> Self {
        let mut planner = FftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(len.max(1)), planner.plan_fft_inverse(len.max(1)));
        let needed = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        Self {
            forward,
            inverse,
            samples: vec![Complex::default(); len.max(1)],
            scratch: vec![Complex::default(); needed],
            modes,
        }
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Always false.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Number of modes kept.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Truncates `values`, of which there are [`BandLimit::len`]; other numbers are left alone.
    pub fn apply(&mut self, values: &mut [Vec2]) {
        let len = self.len();
        if values.len() != len || self.modes >= len {
            return;
        }
        for (sample, value) in self.samples.iter_mut().zip(values.iter()) {
            *sample = Complex::new(value.x, value.y);
        }
        self.forward.process_with_scratch(&mut self.samples, &mut self.scratch);
        let largest = self.modes.saturating_sub(1) / 2;
        self.samples[largest + 1..len - largest].fill(Complex::default());
        self.inverse.process_with_scratch(&mut self.samples, &mut self.scratch);
        let scale = 1.0 / len as f64;
        for (value, sample) in values.iter_mut().zip(&self.samples) {
            *value = Vec2::new(scale * sample.re, scale * sample.im);
        }
    }
}

#[cfg(test)]
mod tests;
