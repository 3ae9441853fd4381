//! Transforms of real numbers.

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use crate::{InputError, same_length, transform::transform};

transform! {
    /// A plan for the discrete Fourier transform of N real numbers to N/2 + 1 complex ones and its inverse,
    ///
    /// `F[m] = sum over k of f[k] exp(-2 pi I m k / N)`, `F[N - m] = conj(F[m])`,
    ///
    /// not normalised: one after the other multiplies by N.
    RealTransform, RealFftPlanner, [RealToComplex, ComplexToReal], get_scratch_len
}

impl RealTransform {
    /// Returns N/2 + 1, the number of complex values of a spectrum.
    #[must_use]
    pub fn spectrum_len(&self) -> usize {
        self.len() / 2 + 1
    }

    /// Writes the spectrum of `values`, which are lost.
    ///
    /// # Errors
    /// Returns an error for slices of other lengths than planned for.
    pub fn forward(&mut self, values: &mut [f64], spectrum: &mut [Complex64]) -> Result<(), InputError> {
        self.check(values.len(), spectrum.len())?;
        // The lengths fit, so that the call cannot fail.
        let _ = self.forward.process_with_scratch(values, spectrum, &mut self.scratch);
        Ok(())
    }

    /// Writes the values of `spectrum`, which is lost. The imaginary parts of the mean and, for even N, of the highest
    /// wave number belong to no real values and are ignored.
    ///
    /// # Errors
    /// Returns an error for slices of other lengths than planned for.
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
