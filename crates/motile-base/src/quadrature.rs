//! Quadrature on an interval.

use std::f64::consts::PI;

/// Returns the points and weights of the Gauss-Legendre rule on (-1, 1), from 1 down to -1, by Newton's method: exact
/// for polynomials of degree `2 count - 1`.
///
/// ```
/// let rule = motile_base::internal::gauss_legendre(3);
/// let integral: f64 = rule.iter().map(|(x, weight)| weight * x.powi(4)).sum();
/// assert!((integral - 0.4).abs() < 1e-15);
/// ```
#[must_use]
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    let node = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut before, mut value) = (1.0, x);
            for k in 2..=count {
                let k = k as f64;
                (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

#[cfg(test)]
mod tests;
