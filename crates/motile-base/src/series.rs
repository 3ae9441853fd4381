//! Fourier series of periodic functions.

use num_complex::Complex64;

use crate::{ComplexTransform, InputError, same_length, spectrum};

/// The Fourier series through N equally spaced samples of a function of period 2 pi, such as a closed curve,
///
/// `f(alpha) = sum over m of c[m] exp(I m alpha)`, sample k at `alpha = 2 pi k / N`,
///
/// with entry m of the N coefficients for `exp(I m alpha)` below N/2 and for `exp(I (m - N) alpha)` above. A vector of
/// the plane is the complex number x + I y. For a smooth function, everything is spectrally accurate: errors fall
/// faster than any power of N.
#[derive(Debug, Clone)]
pub struct PeriodicSeries {
    transform: ComplexTransform,
    coefficients: Vec<Complex64>,
    values: Vec<Complex64>,
}

impl PeriodicSeries {
    /// Creates a series through `len` samples, zero at first.
    ///
    /// # Errors
    /// Returns an error for more than a [`ComplexTransform`] takes.
    pub fn new(len: usize) -> Result<Self, InputError> {
        let transform = ComplexTransform::new(len)?;
        let zeros = vec![Complex64::ZERO; len];
        Ok(Self { transform, coefficients: zeros.clone(), values: zeros })
    }

    /// Returns N, the number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.coefficients.len()
    }

    /// Returns true without samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// Returns the coefficients c (unit of the samples).
    #[must_use]
    pub fn coefficients(&self) -> &[Complex64] {
        &self.coefficients
    }

    /// Takes the series through `samples`.
    ///
    /// # Errors
    /// Returns an error for another number of samples than N; the series is then left as it was.
    pub fn analyse(&mut self, samples: impl ExactSizeIterator<Item = Complex64>) -> Result<(), InputError> {
        same_length("the samples", self.len(), samples.len())?;
        let scale = 1.0 / self.len() as f64;
        for (slot, sample) in self.coefficients.iter_mut().zip(samples) {
            *slot = scale * sample;
        }
        self.transform.forward(&mut self.coefficients)
    }

    /// Takes the series through vectors of the plane.
    ///
    /// # Errors
    /// Returns an error for another number of vectors than N; the series is then left as it was.
    pub fn analyse_vectors<V: Copy + Into<[f64; 2]>>(&mut self, vectors: &[V]) -> Result<(), InputError> {
        self.analyse(vectors.iter().map(|&vector| {
            let [x, y] = vector.into();
            Complex64::new(x, y)
        }))
    }

    /// Takes the wave numbers of `other` that both series have: trigonometric interpolation to more samples, or
    /// truncation to fewer.
    pub fn resample(&mut self, other: &Self) {
        spectrum::copy_band(&other.coefficients, &mut self.coefficients, usize::MAX);
    }

    /// Multiplies each coefficient by `factor(m)`, m its signed wave number, zero for the unpaired one of an even N.
    pub fn multiply(&mut self, factor: impl Fn(f64) -> Complex64) {
        let len = self.len();
        for (index, value) in self.coefficients.iter_mut().enumerate() {
            *value *= factor(spectrum::wave(index, len));
        }
    }

    /// Multiplies each coefficient by a separate factor, in their order, such as [`PeriodicSeries::factors`]; those
    /// beyond the last factor stay.
    pub fn multiply_each(&mut self, factors: &[Complex64]) {
        self.coefficients.iter_mut().zip(factors).for_each(|(value, factor)| *value *= factor);
    }

    /// Returns the factors of [`PeriodicSeries::multiply`] for series of `len` samples, in the order of the
    /// coefficients.
    #[must_use]
    pub fn factors(len: usize, factor: impl Fn(f64) -> Complex64) -> Vec<Complex64> {
        (0..len).map(|index| factor(spectrum::wave(index, len))).collect()
    }

    /// Multiplies each coefficient by `factor(|m|)`: an operator that is the same in both directions of the curve.
    pub fn scale(&mut self, factor: impl Fn(usize) -> f64) {
        let len = self.len();
        for (index, value) in self.coefficients.iter_mut().enumerate() {
            *value *= factor(index.min(len - index));
        }
    }

    /// Goes over to the derivative by alpha.
    pub fn differentiate(&mut self) {
        spectrum::differentiate(&mut self.coefficients);
    }

    /// Goes over to `f(alpha + angle)`.
    pub fn shift(&mut self, angle: f64) {
        self.multiply(|wave| Complex64::cis(wave * angle));
    }

    /// Returns the values at the places of the samples.
    pub fn values(&mut self) -> &[Complex64] {
        self.values.copy_from_slice(&self.coefficients);
        // The lengths are this plan's own, so that the call cannot fail.
        let _ = self.transform.inverse(&mut self.values);
        &self.values
    }

    /// Returns the largest and smallest real part of the series over its period, not only at the places of the samples:
    /// by interpolation to sixteen times as many and parabolas through three of those.
    ///
    /// # Errors
    /// Returns an error for more samples than a [`ComplexTransform`] takes.
    pub fn range(&self) -> Result<[f64; 2], InputError> {
        const FINER: usize = 16;
        let mut fine = Self::new(FINER * self.len())?;
        fine.resample(self);
        let values = fine.values();
        let extreme = |sign: f64| {
            let at = |k: usize| sign * values[k % values.len()].re;
            let most = (0..values.len()).max_by(|&a, &b| at(a).total_cmp(&at(b))).unwrap_or(0);
            let [before, here, after] = [most + values.len() - 1, most, most + 1].map(at);
            let (slope, bend) = (0.5 * (after - before), after - 2.0 * here + before);
            sign * if bend < 0.0 { here - 0.5 * slope * slope / bend } else { here }
        };
        Ok(if self.is_empty() { [f64::NAN; 2] } else { [extreme(1.0), extreme(-1.0)] })
    }

    /// Writes the values at the places of the samples, as vectors of the plane.
    ///
    /// # Errors
    /// Returns an error for another number of vectors than N; they are then left as they were.
    pub fn write_vectors<V: From<[f64; 2]>>(&mut self, vectors: &mut [V]) -> Result<(), InputError> {
        same_length("the vectors", self.len(), vectors.len())?;
        for (vector, value) in vectors.iter_mut().zip(self.values()) {
            *vector = [value.re, value.im].into();
        }
        Ok(())
    }

    /// Truncates `vectors` to the wave numbers |m| <= (modes - 1)/2, in place: all of them stay as they are if there
    /// are no more samples than `modes`, at least the mean is kept.
    ///
    /// If the flow is resolved by fewer modes than a body has markers, the body passes the velocities of its markers
    /// through this, so that nothing moves in a way that the flow does not see.
    ///
    /// # Errors
    /// Returns an error for another number of vectors than N; they are then left as they were.
    pub fn truncate_vectors<V>(&mut self, vectors: &mut [V], modes: usize) -> Result<(), InputError>
    where
        V: Copy + Into<[f64; 2]> + From<[f64; 2]>,
    {
        self.analyse_vectors(vectors)?;
        if modes >= self.len() {
            return Ok(());
        }
        let largest = spectrum::largest_wave(modes);
        self.scale(|m| if m <= largest { 1.0 } else { 0.0 });
        self.write_vectors(vectors)
    }
}

#[cfg(test)]
mod tests;
