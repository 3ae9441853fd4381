//! Fourier transforms of periodic samples of one length.

use fourier::{ComplexTransform, InputError};
use num_complex::Complex64;

/// Forward and inverse transforms of one length with their scratch. The forward one carries the factor 1/length, so
/// that it gives Fourier coefficients.
#[derive(Debug, Clone)]
pub(crate) struct Transform(ComplexTransform);

impl Transform {
    pub(crate) fn new(len: usize) -> Result<Self, InputError> {
        ComplexTransform::new(len).map(Self)
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Samples to Fourier coefficients, in place.
    pub(crate) fn forward(&mut self, buffer: &mut [Complex64]) {
        // The lengths are this plan's own, so that the call cannot fail.
        let _ = self.0.forward(buffer);
        let factor = 1.0 / buffer.len() as f64;
        buffer.iter_mut().for_each(|value| *value *= factor);
    }

    /// Fourier coefficients to samples, in place.
    pub(crate) fn inverse(&mut self, buffer: &mut [Complex64]) {
        let _ = self.0.inverse(buffer);
    }
}
