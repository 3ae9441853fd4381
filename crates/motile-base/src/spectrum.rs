//! Fourier coefficients of periodic samples.
//!
//! Entry m of N coefficients belongs to `exp(I m alpha)` for m < N/2 and to `exp(I (m - N) alpha)` for m > N/2. The one
//! in the middle of an even N stands for both signs: it is left out of every band, and its derivative is zero.

use num_complex::Complex64;

/// Returns the signed wave number of entry `index` of `len` coefficients; zero for the unpaired one of an even length.
#[must_use]
pub fn wave(index: usize, len: usize) -> f64 {
    if 2 * index < len {
        index as f64
    } else if 2 * index == len {
        0.0
    } else {
        index as f64 - len as f64
    }
}

/// Returns the largest wave number of a band of `modes` modes, `(modes - 1) / 2`.
#[must_use]
pub fn largest_wave(modes: usize) -> usize {
    modes.saturating_sub(1) / 2
}

/// Copies the wave numbers up to `largest` into a spectrum of any length, as far as both have them, and clears the
/// rest of that.
pub fn copy_band(from: &[Complex64], to: &mut [Complex64], largest: usize) {
    to.fill(Complex64::ZERO);
    let (n, m) = (from.len(), to.len());
    if n.min(m) == 0 {
        return;
    }
    let largest = largest.min(largest_wave(n.min(m)));
    to[..=largest].copy_from_slice(&from[..=largest]);
    to[m - largest..].copy_from_slice(&from[n - largest..]);
}

/// Clears the wave numbers above `largest`, and the unpaired one.
pub fn truncate(spectrum: &mut [Complex64], largest: usize) {
    let len = spectrum.len();
    if let Some(above) = spectrum.get_mut(largest + 1..len.saturating_sub(largest)) {
        above.fill(Complex64::ZERO);
    }
}

/// Multiplies by I times the wave number: the derivative by the parameter.
pub fn differentiate(spectrum: &mut [Complex64]) {
    let len = spectrum.len();
    for (index, value) in spectrum.iter_mut().enumerate() {
        *value = Complex64::new(-value.im, value.re) * wave(index, len);
    }
}

/// Returns true for a number without other prime factors than `primes`: transforms of lengths with small ones are fast.
#[must_use]
pub fn is_product(mut number: usize, primes: &[usize]) -> bool {
    for &prime in primes {
        while prime > 1 && number > 1 && number.is_multiple_of(prime) {
            number /= prime;
        }
    }
    number == 1
}

#[cfg(test)]
mod tests;
