//! Transforms of real numbers.

use std::fmt;
use std::sync::Arc;

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use crate::{InputError, check_length, same_length};

/// A plan for the discrete Fourier transform of N real numbers to N/2 + 1 complex ones and its inverse,
///
/// `F[m] = sum over k of f[k] exp(-2 pi I m k / N)`, `F[N - m] = conj(F[m])`,
///
/// not normalised: one after the other multiplies by N.
#[derive(Clone)]
pub struct RealTransform {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    scratch: Vec<Complex64>,
}

impl fmt::Debug for RealTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RealTransform").field("len", &self.len()).finish_non_exhaustive()
    }
}

impl RealTransform {
    /// A plan for `len` numbers.
    ///
    /// # Errors
    /// More than 67,108,864.
    pub fn new(len: usize) -> Result<Self, InputError> {
        check_length(len)?;
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(len), planner.plan_fft_inverse(len));
        let scratch = forward.get_scratch_len().max(inverse.get_scratch_len());
        Ok(Self { forward, inverse, scratch: vec![Complex64::ZERO; scratch] })
    }

    /// N, the numbers it transforms.
    #[must_use]
    pub fn len(&self) -> usize {
        self.forward.len()
    }

    /// Whether it is a plan for no numbers.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// N/2 + 1, the complex numbers of a spectrum.
    #[must_use]
    pub fn spectrum_len(&self) -> usize {
        self.len() / 2 + 1
    }

    /// The spectrum of `values`, which are lost.
    ///
    /// # Errors
    /// Slices of other lengths than planned for.
    pub fn forward(&mut self, values: &mut [f64], spectrum: &mut [Complex64]) -> Result<(), InputError> {
        self.check(values.len(), spectrum.len())?;
        // The lengths fit, so that the call cannot fail.
        let _ = self.forward.process_with_scratch(values, spectrum, &mut self.scratch);
        Ok(())
    }

    /// The values of `spectrum`, which is lost. The imaginary parts of the mean and, for even N, of the highest wave
    /// number belong to no real values and are ignored.
    ///
    /// # Errors
    /// Slices of other lengths than planned for.
    pub fn inverse(&mut self, spectrum: &mut [Complex64], values: &mut [f64]) -> Result<(), InputError> {
        self.check(values.len(), spectrum.len())?;
        spectrum[0].im = 0.0;
        if self.len().is_multiple_of(2) {
            spectrum[self.len() / 2].im = 0.0;
        }
        // The lengths fit and the numbers above are real, so that the call cannot fail.
        let _ = self.inverse.process_with_scratch(spectrum, values, &mut self.scratch);
        Ok(())
    }

    fn check(&self, values: usize, spectrum: usize) -> Result<(), InputError> {
        same_length("the real numbers", self.len(), values)?;
        same_length("the spectrum", self.spectrum_len(), spectrum)
    }
}

#[cfg(test)]
mod tests;
