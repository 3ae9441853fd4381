//! Fourier transforms of periodic samples of one length.

use fourier::ComplexTransform;
use num_complex::Complex64;

/// Forward and inverse transforms of one length with their scratch. The forward one carries the factor 1/length, so
/// that it gives Fourier coefficients.
#[derive(Debug, Clone)]
pub(crate) struct Transform(ComplexTransform);

impl Transform {
    pub(crate) fn new(len: usize) -> Self {
        Self(ComplexTransform::new(len))
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

/// Largest wave number of a band of `modes` modes; the unpaired one of an even number of modes is left out.
pub(crate) fn largest_wave(modes: usize) -> usize {
    modes.saturating_sub(1) / 2
}

/// Wave number of entry `index` of a spectrum of `len` coefficients; zero for the unpaired one of an even length.
pub(crate) fn wave(index: usize, len: usize) -> f64 {
    if 2 * index < len {
        index as f64
    } else if 2 * index == len {
        0.0
    } else {
        index as f64 - len as f64
    }
}

/// Copies the waves up to `largest` from one spectrum to another of any length and clears the rest.
pub(crate) fn copy_band(from: &[Complex64], to: &mut [Complex64], largest: usize) {
    to.fill(Complex64::default());
    to[..=largest].copy_from_slice(&from[..=largest]);
    let (n, m) = (from.len(), to.len());
    to[m - largest..].copy_from_slice(&from[n - largest..]);
}

/// Multiplies a spectrum by i times the wave number: the derivative by the parameter.
pub(crate) fn differentiate(spectrum: &mut [Complex64]) {
    let len = spectrum.len();
    for (index, value) in spectrum.iter_mut().enumerate() {
        *value = Complex64::new(-value.im, value.re) * wave(index, len);
    }
}
