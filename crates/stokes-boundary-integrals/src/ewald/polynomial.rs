//! Polynomials through values of a smooth function, as short as an accuracy allows.

use std::f64::consts::PI;

/// Values from which a polynomial is found.
const NODES: usize = 48;

/// Coefficients that smooth functions do not need, which are round-off, and its least multiple to leave out: powers of
/// round-off would be larger by the largest coefficients of Chebyshev polynomials.
const NOISE: usize = 12;
const LEAST: f64 = 4.0;

/// Powers of t, |t| <= 1, that approximate `function` to `accuracy`, or to round-off.
#[must_use]
pub fn powers(accuracy: f64, function: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut terms = chebyshev(function);
    let noise = &terms[NODES - NOISE..];
    let accuracy = noise.iter().map(|term| LEAST * term.abs()).fold(accuracy, f64::max);
    while terms.len() > 1 && terms[terms.len() - 1].abs() < accuracy {
        terms.pop();
    }
    // By the recurrence of Chebyshev polynomials.
    let len = terms.len();
    let mut out = vec![0.0; len];
    let (mut before, mut now) = (vec![0.0; len], vec![0.0; len]);
    before[0] = 1.0;
    if len > 1 {
        now[1] = 1.0;
    }
    for term in terms {
        for k in 0..len {
            out[k] += term * before[k];
        }
        let next = (0..len).map(|k| if k == 0 { -before[0] } else { 2.0 * now[k - 1] - before[k] }).collect();
        before = std::mem::replace(&mut now, next);
    }
    out
}

/// Returns the coefficients of Chebyshev polynomials in the interpolant through [`NODES`] values.
fn chebyshev(function: impl Fn(f64) -> f64) -> Vec<f64> {
    let angle = |i: usize| PI * (i as f64 + 0.5) / NODES as f64;
    let values: Vec<f64> = (0..NODES).map(|i| function(angle(i).cos())).collect();
    let coefficient = |k: usize| {
        let sum: f64 = values.iter().enumerate().map(|(i, value)| value * (k as f64 * angle(i)).cos()).sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / NODES as f64
    };
    (0..NODES).map(coefficient).collect()
}

/// Returns the value at t of a polynomial by its powers.
pub(super) fn value(powers: &[f64], t: f64) -> f64 {
    powers.iter().rev().fold(0.0, |sum, power| sum * t + power)
}
