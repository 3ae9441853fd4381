//! Transforms of complex numbers.

use std::fmt;
use std::sync::Arc;

use num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use crate::{InputError, check_length, same_length};

/// A plan for the discrete Fourier transform of N complex numbers and its inverse,
///
/// `F[m] = sum over k of f[k] exp(-2 pi I m k / N)`, `f[k] = sum over m of F[m] exp(2 pi I m k / N)`,
///
/// not normalised: one after the other multiplies by N.
#[derive(Clone)]
pub struct ComplexTransform {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    scratch: Vec<Complex64>,
}

impl fmt::Debug for ComplexTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ComplexTransform").field("len", &self.len()).finish_non_exhaustive()
    }
}

impl ComplexTransform {
    /// A plan for `len` numbers.
    ///
    /// # Errors
    /// More than 67,108,864.
    pub fn new(len: usize) -> Result<Self, InputError> {
        check_length(len)?;
        let mut planner = FftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(len), planner.plan_fft_inverse(len));
        let scratch = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        Ok(Self { forward, inverse, scratch: vec![Complex64::ZERO; scratch] })
    }

    /// N, the numbers it transforms.
    #[must_use]
    pub fn len(&self) -> usize {
        self.forward.len()
    }

    /// Whether it is a plan for no numbers, which does nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Transforms every N numbers of `values` in place.
    ///
    /// # Errors
    /// Not a whole multiple of N; `values` are then left as they were.
    pub fn forward(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        self.check(values.len())?;
        self.forward.process_with_scratch(values, &mut self.scratch);
        Ok(())
    }

    /// Transforms every N numbers of `values` back in place.
    ///
    /// # Errors
    /// Not a whole multiple of N; `values` are then left as they were.
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
