//! Cyclic tridiagonal systems, which implicit diffusion and smoothing along a closed curve lead to.

use std::ops::{Add, Mul};

/// Solves `lower[k] x[k-1] + diagonal[k] x[k] + upper[k] x[k+1] = rhs[k]`, indices modulo n, for coefficients that
/// vary along the curve.
///
/// A Thomas sweep with a rank-one correction for the two corners (Sherman and Morrison): about 14 n operations, no
/// pivoting. It is accurate to round-off where the diagonal dominates its row or its column, as it does for implicit
/// diffusion. The plan owns its scratch and allocates nothing per call.
#[derive(Debug, Clone, Default)]
pub(crate) struct CyclicTridiagonal {
    ratios: Vec<f64>,
    correction: Vec<f64>,
}

impl CyclicTridiagonal {
    /// Creates a plan for `n` unknowns, n >= 3.
    pub(crate) fn new(n: usize) -> Self {
        Self { ratios: vec![0.0; n], correction: vec![0.0; n] }
    }

    /// Replaces `x`, which holds the right-hand side, by the solution. `lower[0]` multiplies `x[n-1]`, `upper[n-1]`
    /// multiplies `x[0]`. Not finite for a singular system.
    pub(crate) fn solve(&mut self, lower: &[f64], diagonal: &[f64], upper: &[f64], x: &mut [f64]) {
        let n = self.ratios.len();
        // A = T + u v^T with u = (gamma, 0, ..., upper[n-1]) and v = (1, 0, ..., lower[0]/gamma).
        let gamma = -diagonal[0];
        let (first, last) = (diagonal[0] - gamma, diagonal[n - 1] - upper[n - 1] * lower[0] / gamma);
        let z = &mut self.correction;
        z.fill(0.0);
        z[0] = gamma;
        z[n - 1] = upper[n - 1];

        let mut pivot = first;
        for k in 0..n {
            if k > 0 {
                self.ratios[k] = upper[k - 1] / pivot;
                let centre = if k == n - 1 { last } else { diagonal[k] };
                let next = centre - lower[k] * self.ratios[k];
                x[k] -= lower[k] * x[k - 1];
                z[k] -= lower[k] * z[k - 1];
                pivot = next;
            }
            x[k] /= pivot;
            z[k] /= pivot;
        }
        for k in (0..n - 1).rev() {
            x[k] -= self.ratios[k + 1] * x[k + 1];
            z[k] -= self.ratios[k + 1] * z[k + 1];
        }
        let corner = lower[0] / gamma;
        let denominator = 1.0 + z[0] + corner * z[n - 1];
        let factor = (x[0] + corner * x[n - 1]) / denominator;
        for (x, z) in x.iter_mut().zip(z.iter()) {
            *x -= factor * z;
        }
    }
}

/// Solves `off x[k-1] + diagonal x[k] + off x[k+1] = rhs[k]`, indices modulo n, for coefficients that are the same
/// everywhere and a diagonal that dominates, `|diagonal| > 2 |off|`.
///
/// The operator is the product of a forward and a backward recursion, each closed periodically: four multiplications
/// an unknown, no division, no scratch, any number of unknowns. Works on numbers and on vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CirculantTridiagonal {
    root: f64,
    scale: f64,
}

impl CirculantTridiagonal {
    /// Creates the operator with these coefficients, factorised.
    fn new(diagonal: f64, off: f64) -> Self {
        // off (E + 1/E) + diagonal = (1 - root E)(1 - root / E) / scale, |root| < 1
        let root = -2.0 * off / (diagonal + diagonal.signum() * (diagonal * diagonal - 4.0 * off * off).sqrt());
        Self { root, scale: (1.0 + root * root) / diagonal }
    }

    /// Creates the smoothing operator S^-1 = 1 - width^2 d^2/ds^2 by second differences on points `spacing` apart, so
    /// that [`CirculantTridiagonal::solve`] applies S.
    pub(crate) fn smoothing(width: f64, spacing: f64) -> Self {
        let ratio = width / spacing;
        Self::new(1.0 + 2.0 * ratio * ratio, -ratio * ratio)
    }

    /// Replaces the right-hand side by the solution.
    pub(crate) fn solve<T>(&self, x: &mut [T])
    where
        T: Copy + Add<Output = T> + Mul<f64, Output = T>,
    {
        let n = x.len();
        if n == 0 {
            return;
        }
        let z = self.root;
        // y[k] = x[k] + z y[k-1], closed by y[n-1] = (sum over j of z^j x[n-1-j]) / (1 - z^n).
        let mut tail = x[0];
        let mut power = z;
        for &value in &x[1..] {
            tail = value + tail * z;
            power *= z;
        }
        let mut previous = tail * (1.0 / (1.0 - power));
        for value in x.iter_mut() {
            previous = *value + previous * z;
            *value = previous;
        }
        let mut tail = x[n - 1];
        for &value in x[..n - 1].iter().rev() {
            tail = value + tail * z;
        }
        let mut next = tail * (1.0 / (1.0 - power));
        for value in x.iter_mut().rev() {
            next = *value + next * z;
            *value = next * self.scale;
        }
    }
}

#[cfg(test)]
mod tests;
