//! Truncation of the forces on a surface of revolution to the waves that its nodes carry.

use motile_base::{PeriodicSeries, Vec2};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use num_complex::Complex64;

use super::waves::Pair;
use crate::refusal::singular_surfaces;
use stokes_boundary_integrals::LayerError;

/// Truncation of forces per parameter and azimuth, given at more points than there are nodes.
///
/// With N nodes, velocities along and across the axis are series of cosines and of sines below the wave N. The
/// truncated force is sin(t) times such series, so that it vanishes at the poles as rings do, and has the power of the
/// given one in each of these velocities. In the uniform one, that is the net force. A series that is cut at a wave has
/// neither: what it leaves of the pull across at a pole gives the velocity a jump there, which grows into a needle.
#[derive(Debug, Clone)]
pub(super) struct Truncation {
    /// Series through the force on the closed curve: cosines of the part across, sines of the part along.
    series: PeriodicSeries,
    /// Powers of sin(t) times the series in each other, factorised.
    powers: [Cholesky<f64, Dyn>; 2],
    values: [DVector<f64>; 2],
}

/// Returns the integral of sin(t) cos(n t) from 0 to pi.
fn weighted(n: usize) -> f64 {
    if n.is_multiple_of(2) { 2.0 / (1.0 - (n * n) as f64) } else { 0.0 }
}

impl Truncation {
    /// Creates a plan for forces at the ends of so many intervals from 0 to pi, more than the nodes.
    ///
    /// # Errors
    /// Returns an error for more points than a Fourier transform takes.
    pub(super) fn new(nodes: usize, intervals: usize) -> Result<Self, LayerError> {
        let along = DMatrix::from_fn(nodes, nodes, |k, l| 0.5 * (weighted(k.abs_diff(l)) + weighted(k + l)));
        let across =
            DMatrix::from_fn(nodes - 1, nodes - 1, |k, l| 0.5 * (weighted(k.abs_diff(l)) - weighted(k + l + 2)));
        // Powers of functions that are independent are positive definite.
        let factors = |matrix: DMatrix<f64>| matrix.cholesky().ok_or(singular_surfaces());
        Ok(Self {
            series: PeriodicSeries::new(2 * intervals)?,
            powers: [factors(along)?, factors(across)?],
            values: [DVector::zeros(nodes), DVector::zeros(nodes - 1)],
        })
    }

    /// Truncates the force at point j (force per parameter and azimuth).
    ///
    /// # Errors
    /// Returns no error: the series has as many points as it was made for.
    pub(super) fn apply(&mut self, force: impl Fn(usize) -> Vec2, out: &mut Pair) -> Result<(), LayerError> {
        let Self { series, powers, values: [along, across] } = self;
        let count = series.len();
        let half = count / 2;
        series.analyse((0..count).map(|k| {
            let Vec2 { x, y } = force(k.min(count - k));
            Complex64::from(if k > half { y - x } else { y + x })
        }))?;
        // Integrals of sin(j t) cos(k t) and of cos(j t) sin(k t) over half a turn.
        let coefficient = |j: usize| if j == 0 || j == half { 1.0 } else { 2.0 } * series.coefficients()[j];
        along.fill(0.0);
        across.fill(0.0);
        for j in 0..=half {
            let Complex64 { re: cosine, im } = coefficient(j);
            for k in ((j + 1) % 2..along.len()).step_by(2) {
                let (a, b) = (j as f64, k as f64);
                let factor = 2.0 / ((a - b) * (a + b));
                along[k] -= factor * a * im;
                if k > 0 {
                    across[k - 1] -= factor * b * cosine;
                }
            }
        }
        for (factors, values) in powers.iter().zip([&mut *along, across]) {
            factors.solve_mut(values);
        }
        let Pair { cos, sin } = out;
        cos.fill(0.0);
        sin.fill(0.0);
        for (k, value) in along.iter().enumerate() {
            sin[k + 1] += 0.5 * value;
            if k > 0 {
                sin[k - 1] -= 0.5 * value;
            } else {
                sin[1] += 0.5 * value;
            }
        }
        sin[0] = 0.0;
        for (k, value) in across.iter().enumerate() {
            cos[k] += 0.5 * value;
            cos[k + 2] -= 0.5 * value;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
