//! The linear system that a lateral displacement and the heading obey.

use nalgebra::{DMatrix, DVector};

use super::Estimate;
use super::linear_mode::FEWEST_SAMPLES;
use super::quadrature::cumulative_integral;
use super::regression::{Solution, inflation};
use crate::InterfaceError;
use crate::error::{all_finite, enough, increasing, length};

/// A linear system `d/dt (y, q) = M (y, q)` fitted by [`fit_linear_pair`], and its leading eigenvalue s + i w.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearPair {
    /// M, row by row.
    pub matrix: [[f64; 2]; 2],
    /// Growth rate s, negative for a decay (1/time); where there is no oscillation it is the larger of the two real
    /// eigenvalues.
    pub growth_rate: Estimate,
    /// Angular frequency w (radians per time); `None` where the eigenvalues are real.
    pub frequency: Option<Estimate>,
    /// What the fit leaves of the data, the larger of root mean square over root mean square of both quantities (no
    /// dimension).
    pub residual: f64,
}

/// Fits the 2x2 matrix M of `d/dt (y, q) = M (y, q)` to samples of the height y above the centre line and of a second
/// quantity q that the lateral motion depends on, such as the heading (radians) or the lateral velocity, at increasing
/// times.
///
/// By linear least squares from the integrated equation `(y, q) - (y, q)(0) = M INT (y, q) dt`, which needs no
/// differences of samples; the integrals are of fourth order in the intervals, so that 30 samples a period give the
/// eigenvalues to 1e-3. Of the two, [`fit_linear_mode`](crate::trajectory::fit_linear_mode) is the more accurate one; this one
/// shows how the swimmer turns: `M[1][0]` is the turning rate for a displacement of one, `M[1][1]` that for a heading
/// of one.
///
/// # Errors
/// Lists of different length, fewer than eight samples, values that are not finite, times that do not increase,
/// quantities that are zero or proportional to each other.
pub fn fit_linear_pair(times: &[f64], heights: &[f64], others: &[f64]) -> Result<LinearPair, InterfaceError> {
    enough("samples", times.len(), FEWEST_SAMPLES)?;
    length("the heights", times.len(), heights.len())?;
    length("the second quantities", times.len(), others.len())?;
    increasing("the times", times)?;
    all_finite("the heights", heights)?;
    all_finite("the second quantities", others)?;

    let count = times.len();
    let integrals = [heights, others].map(|values| cumulative_integral(times, values, None));
    let mut matrix = [[0.0; 2]; 2];
    let mut covariances = Vec::with_capacity(2);
    let mut residual = 0.0_f64;
    for (row, values) in matrix.iter_mut().zip([heights, others]) {
        let columns = DMatrix::from_fn(count, 3, |i, j| if j == 2 { 1.0 } else { integrals[j][i] });
        let data = DVector::from_column_slice(values);
        let solution = Solution::new(columns, &data)
            .ok_or(InterfaceError::NoFit { what: "a linear system of two quantities", points: count })?;
        *row = [solution.coefficients[0], solution.coefficients[1]];
        residual = residual.max(solution.residuals.norm() / data.norm());
        let freedom = (count - 3) as f64;
        let variance = solution.residuals.norm_squared() / freedom * inflation(solution.residuals.as_slice());
        covariances.push(solution.inverse.view((0, 0), (2, 2)) * variance);
    }
    let [[a, b], [c, d]] = matrix;
    let (half_trace, difference) = (0.5 * (a + d), 0.5 * (a - d));
    let discriminant = difference * difference + b * c;
    // The gradient of half the trace and of the discriminant, by (a, b), (c, d).
    let trace_slopes = [[0.5, 0.0], [0.0, 0.5]];
    let slopes = [[difference, c], [b, -difference]];
    let error = |gradient: [[f64; 2]; 2]| -> f64 {
        let variance = |(row, covariance): (&[f64; 2], &DMatrix<f64>)| -> f64 {
            (0..4).map(|k| row[k / 2] * covariance[(k / 2, k % 2)] * row[k % 2]).sum()
        };
        gradient.iter().zip(&covariances).map(variance).sum::<f64>().max(0.0).sqrt()
    };
    let root = discriminant.abs().sqrt();
    let half = 0.5 / root.max(f64::MIN_POSITIVE);
    let (growth_rate, frequency) = if discriminant < 0.0 {
        let frequency = Estimate { value: root, error: error(slopes.map(|row| row.map(|slope| slope * half))) };
        (Estimate { value: half_trace, error: error(trace_slopes) }, Some(frequency))
    } else {
        let both = [0, 1].map(|i| [0, 1].map(|j: usize| trace_slopes[i][j] + half * slopes[i][j]));
        (Estimate { value: half_trace + root, error: error(both) }, None)
    };
    Ok(LinearPair { matrix, growth_rate, frequency, residual })
}

#[cfg(test)]
mod tests;
