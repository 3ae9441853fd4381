//! Sine and cosine transforms of real numbers (DST-I, DST-II, DST-III, DCT-II and DCT-III).

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::{InputError, RealTransform, check_length, same_length};

/// A plan for cosine transforms across N cells, the DCT-II and the DCT-III.
///
/// The values lie at the middles of N cells between two ends, at which the slope is zero:
///
/// `F[n] = sum over j of f[j] cos(pi n (j + 1/2) / N)`, n = 0 to N - 1 (DCT-II, [`CosineTransform::forward`]),
///
/// `f[j] = F[0] / 2 + sum over n > 0 of F[n] cos(pi n (j + 1/2) / N)` (DCT-III, [`CosineTransform::inverse`]).
///
/// Neither is normalised: one after the other multiplies by N/2. Each takes one real transform of N numbers
/// (J. Makhoul, A fast cosine transform in one and two dimensions, IEEE Trans. ASSP 28, 1980).
///
/// ```
/// use motile_base::CosineTransform;
///
/// // Three cells of a constant: only the coefficient n = 0 remains.
/// let mut values = [2.0, 2.0, 2.0];
/// let mut transform = CosineTransform::new(3)?;
/// transform.forward(&mut values)?;
/// assert!((values[0] - 6.0).abs() < 1e-15 && values[1].abs() < 1e-15 && values[2].abs() < 1e-15);
/// # Ok::<(), motile_base::InputError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("DCT"))]
pub struct CosineTransform {
    cells: CellTransform,
}

impl CosineTransform {
    /// Plans transforms of `len` numbers.
    ///
    /// # Errors
    /// Returns [`InputError`] if `len` exceeds 67,108,864.
    pub fn new(len: usize) -> Result<Self, InputError> {
        Ok(Self { cells: CellTransform::new(len)? })
    }

    /// Returns N, how many numbers it transforms.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Returns true for a plan for no numbers, which does nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Replaces values by their coefficients `F[0]` to `F[N - 1]` (DCT-II).
    ///
    /// # Errors
    /// Returns [`InputError`] if the number of values is not N; they are then left as they were.
    pub fn forward(&mut self, values: &mut [f64]) -> Result<(), InputError> {
        self.check(values)?;
        self.cells.load(values, 1.0);
        self.cells.forward();
        self.cells.for_each_coefficient(|n, coefficient| values[n] = coefficient);
        Ok(())
    }

    /// Replaces coefficients `F[0]` to `F[N - 1]` by the values of their sum (DCT-III).
    ///
    /// # Errors
    /// Returns [`InputError`] if the number of coefficients is not N; they are then left as they were.
    pub fn inverse(&mut self, values: &mut [f64]) -> Result<(), InputError> {
        self.check(values)?;
        self.cells.inverse(|n| values[n]);
        self.cells.store(values, 1.0);
        Ok(())
    }

    fn check(&self, values: &[f64]) -> Result<(), InputError> {
        same_length("the numbers of a cosine transform", self.len(), values.len())
    }
}

/// A plan for sine transforms across N cells, the DST-II and the DST-III.
///
/// The values lie at the middles of N cells between two ends, at which they are zero:
///
/// `F[n] = sum over j of f[j] sin(pi n (j + 1/2) / N)`, n = 1 to N (DST-II, [`SineTransform::forward`]),
///
/// `f[j] = (-1)^j F[N] / 2 + sum over n < N of F[n] sin(pi n (j + 1/2) / N)` (DST-III, [`SineTransform::inverse`]).
///
/// Entry n - 1 of a slice holds `F[n]`. Neither is normalised: one after the other multiplies by N/2. Each takes one
/// real transform of N numbers. For values at the nodes between cells, use [`NodeSineTransform`].
#[derive(Debug, Clone)]
#[doc(alias("DST"))]
pub struct SineTransform {
    cells: CellTransform,
}

impl SineTransform {
    /// Plans transforms of `len` numbers.
    ///
    /// # Errors
    /// Returns [`InputError`] if `len` exceeds 67,108,864.
    pub fn new(len: usize) -> Result<Self, InputError> {
        Ok(Self { cells: CellTransform::new(len)? })
    }

    /// Returns N, how many numbers it transforms.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Returns true for a plan for no numbers, which does nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Replaces values by their coefficients `F[1]` to `F[N]` (DST-II).
    ///
    /// # Errors
    /// Returns [`InputError`] if the number of values is not N; they are then left as they were.
    pub fn forward(&mut self, values: &mut [f64]) -> Result<(), InputError> {
        self.check(values)?;
        // sin(pi (N - n) (j + 1/2) / N) = (-1)^j cos(pi n (j + 1/2) / N).
        self.cells.load(values, -1.0);
        self.cells.forward();
        let last = values.len().saturating_sub(1);
        self.cells.for_each_coefficient(|n, coefficient| values[last - n] = coefficient);
        Ok(())
    }

    /// Replaces coefficients `F[1]` to `F[N]` by the values of their sum (DST-III).
    ///
    /// # Errors
    /// Returns [`InputError`] if the number of coefficients is not N; they are then left as they were.
    pub fn inverse(&mut self, values: &mut [f64]) -> Result<(), InputError> {
        self.check(values)?;
        let last = values.len().saturating_sub(1);
        self.cells.inverse(|n| values[last - n]);
        self.cells.store(values, -1.0);
        Ok(())
    }

    fn check(&self, values: &[f64]) -> Result<(), InputError> {
        same_length("the numbers of a sine transform", self.len(), values.len())
    }
}

/// A plan for sine transforms at the inner nodes of an interval, the DST-I.
///
/// The values lie at the nodes j = 1 to M between M + 1 cells, and are zero at the two ends, j = 0 and j = M + 1:
///
/// `F[n] = sum over j of f[j] sin(pi n j / (M + 1))`, n = 1 to M.
///
/// Entry j - 1 of a slice holds `f[j]`, and entry n - 1 holds `F[n]`. The transform is its own inverse up to the
/// factor (M + 1)/2: it is not normalised. It takes one real transform of 2 (M + 1) numbers.
#[derive(Debug, Clone)]
pub struct NodeSineTransform {
    plan: RealTransform,
    /// The odd continuation of the values.
    odd: Vec<f64>,
    spectrum: Vec<Complex64>,
}

impl NodeSineTransform {
    /// Plans transforms of `len` numbers.
    ///
    /// # Errors
    /// Returns [`InputError`] if `len` exceeds 33,554,431.
    pub fn new(len: usize) -> Result<Self, InputError> {
        let continued = 2 * check_length(len)? + 2;
        let plan = RealTransform::new(continued)?;
        let spectrum = vec![Complex64::ZERO; plan.spectrum_len()];
        Ok(Self { plan, odd: vec![0.0; continued], spectrum })
    }

    /// Returns M, how many numbers it transforms.
    #[must_use]
    pub fn len(&self) -> usize {
        self.odd.len() / 2 - 1
    }

    /// Returns true for a plan for no numbers, which does nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Replaces values by their coefficients, or coefficients by the values of their sum (DST-I).
    ///
    /// # Errors
    /// Returns [`InputError`] if the number of values is not M; they are then left as they were.
    pub fn transform(&mut self, values: &mut [f64]) -> Result<(), InputError> {
        same_length("the numbers of a sine transform", self.len(), values.len())?;
        self.continue_oddly(values);
        self.plan.forward(&mut self.odd, &mut self.spectrum)?;
        for (value, coefficient) in values.iter_mut().zip(&self.spectrum[1..]) {
            *value = -0.5 * coefficient.im;
        }
        Ok(())
    }

    fn continue_oddly(&mut self, values: &[f64]) {
        let (low, high) = self.odd.split_at_mut(values.len() + 1);
        low[0] = 0.0;
        high[0] = 0.0;
        for ((low, high), value) in low[1..].iter_mut().zip(high[1..].iter_mut().rev()).zip(values) {
            *low = *value;
            *high = -value;
        }
    }
}

/// Cosine transforms by Makhoul's order: the even cells upwards from the start, the odd ones downwards from the end.
#[derive(Debug, Clone)]
struct CellTransform {
    plan: RealTransform,
    ordered: Vec<f64>,
    spectrum: Vec<Complex64>,
    /// `exp(-pi I n / (2 N))`, n = 0 to N/2.
    turns: Vec<Complex64>,
}

impl CellTransform {
    fn new(len: usize) -> Result<Self, InputError> {
        let plan = RealTransform::new(len)?;
        let turns = (0..=len / 2).map(|n| Complex64::cis(-0.5 * PI * n as f64 / len.max(1) as f64)).collect();
        let spectrum = vec![Complex64::ZERO; plan.spectrum_len()];
        Ok(Self { plan, ordered: vec![0.0; len], spectrum, turns })
    }

    fn len(&self) -> usize {
        self.ordered.len()
    }

    /// Orders the values, the odd cells times `sign`.
    fn load(&mut self, values: &[f64], sign: f64) {
        let (even, odd) = self.ordered.split_at_mut(values.len().div_ceil(2));
        for (ordered, value) in even.iter_mut().zip(values.iter().step_by(2)) {
            *ordered = *value;
        }
        for (ordered, value) in odd.iter_mut().rev().zip(values.iter().skip(1).step_by(2)) {
            *ordered = sign * value;
        }
    }

    /// Undoes [`CellTransform::load`].
    fn store(&self, values: &mut [f64], sign: f64) {
        let (even, odd) = self.ordered.split_at(values.len().div_ceil(2));
        for (value, ordered) in values.iter_mut().step_by(2).zip(even) {
            *value = *ordered;
        }
        for (value, ordered) in values.iter_mut().skip(1).step_by(2).zip(odd.iter().rev()) {
            *value = sign * ordered;
        }
    }

    fn forward(&mut self) {
        // The lengths are those of the plan, so that the call cannot fail.
        let _ = self.plan.forward(&mut self.ordered, &mut self.spectrum);
    }

    /// Hands out the cosine coefficients of what was transformed, two at a time.
    fn for_each_coefficient(&self, mut take: impl FnMut(usize, f64)) {
        let len = self.len();
        for (n, (turn, value)) in self.turns.iter().zip(&self.spectrum).enumerate().take(len) {
            let turned = turn * value;
            if n > 0 {
                take(len - n, -turned.im);
            }
            take(n, turned.re);
        }
    }

    /// Fills the ordered values from cosine coefficients.
    fn inverse(&mut self, coefficient: impl Fn(usize) -> f64) {
        let len = self.len();
        for (n, (turn, value)) in self.turns.iter().zip(&mut self.spectrum).enumerate().take(len) {
            let mirrored = if n == 0 { 0.0 } else { coefficient(len - n) };
            *value = turn.conj() * Complex64::new(0.5 * coefficient(n), -0.5 * mirrored);
        }
        let _ = self.plan.inverse(&mut self.spectrum, &mut self.ordered);
    }
}

#[cfg(test)]
mod tests;
