//! Truncation of vectors along a closed curve to its lowest Fourier modes.

use fourier::ComplexTransform;
use num_complex::Complex;

use crate::Vec2;

/// Truncates periodic samples of a vector to the wave numbers |m| <= (modes - 1)/2, in place and without allocation.
///
/// Where the flow is resolved by fewer modes than a body has markers ([`crate::Medium::shape_modes`]), the body passes
/// the velocities of its markers through this, so that nothing moves in a way that the flow does not see.
#[derive(Debug, Clone)]
pub struct BandLimit {
    transform: ComplexTransform,
    samples: Vec<Complex<f64>>,
    modes: usize,
}

impl BandLimit {
    /// A plan for `len` samples of which `modes` modes are kept (all of them where there are as many or more; at least
    /// the mean).
    #[must_use]
    pub fn new(len: usize, modes: usize) -> Self {
        let len = len.max(1);
        Self { transform: ComplexTransform::new(len), samples: vec![Complex::default(); len], modes }
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
        // The lengths are this plan's own, so that the calls cannot fail.
        let _ = self.transform.forward(&mut self.samples);
        let largest = self.modes.saturating_sub(1) / 2;
        self.samples[largest + 1..len - largest].fill(Complex::default());
        let _ = self.transform.inverse(&mut self.samples);
        let scale = 1.0 / len as f64;
        for (value, sample) in values.iter_mut().zip(&self.samples) {
            *value = Vec2::new(scale * sample.re, scale * sample.im);
        }
    }
}

#[cfg(test)]
mod tests;
