//! Transforms of complex numbers.

use num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use crate::{InputError, same_length, transform::transform};

transform! {
    /// A plan for the discrete Fourier transform of N complex numbers and its inverse,
    ///
    /// `F[m] = sum over k of f[k] exp(-2 pi I m k / N)`, `f[k] = sum over m of F[m] exp(2 pi I m k / N)`,
    ///
    /// not normalised: one after the other multiplies by N.
    ComplexTransform, FftPlanner, [Fft, Fft], get_inplace_scratch_len
}

impl ComplexTransform {
    /// Transforms every N numbers of `values` in place.
    ///
    /// # Errors
    /// Returns an error if their number is not a whole multiple of N; `values` are then left as they were.
    pub fn forward(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        self.check(values.len())?;
        self.forward.process_with_scratch(values, &mut self.scratch);
        Ok(())
    }

    /// Transforms every N numbers of `values` back in place.
    ///
    /// # Errors
    /// Returns an error if their number is not a whole multiple of N; `values` are then left as they were.
    pub fn inverse(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        self.check(values.len())?;
        self.inverse.process_with_scratch(values, &mut self.scratch);
        Ok(())
    }

    fn check(&self, found: usize) -> Result<(), InputError> {
        if found.is_multiple_of(self.len()) { Ok(()) } else { same_length("the complex numbers", self.len(), found) }
    }
}

#[cfg(test)]
mod tests;
