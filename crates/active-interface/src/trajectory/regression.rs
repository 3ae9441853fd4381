//! Linear least squares with standard errors.

use nalgebra::{DMatrix, DVector};

/// A fitted number and its standard error, both of the same dimension.
///
/// The standard error takes the residuals for a first-order autoregressive process, so that the smooth residuals of a
/// model that is only nearly right do not pass for many independent measurements. It is infinite where there are no
/// more data than unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

impl Estimate {
    /// Whether the value differs from zero by more than `errors` standard errors.
    #[must_use]
    pub fn differs_from_zero(&self, errors: f64) -> bool {
        self.value.abs() > errors * self.error
    }

    /// The estimate of `factor` times the number.
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { value: factor * self.value, error: factor.abs() * self.error }
    }
}

/// The least squares solution of `columns * coefficients = data`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Solution {
    pub(super) coefficients: DVector<f64>,
    /// (A^T A)^-1.
    pub(super) inverse: DMatrix<f64>,
    pub(super) residuals: DVector<f64>,
}

/// Columns whose directions span less than this part of the largest one are taken for dependent.
const RANK: f64 = 1e-11;

impl Solution {
    /// `None` for fewer rows than columns, columns that depend on each other, or values that are not finite.
    pub(super) fn new(mut columns: DMatrix<f64>, data: &DVector<f64>) -> Option<Self> {
        let scales: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
        if columns.nrows() < columns.ncols() || scales.iter().any(|&scale| !(scale.is_finite() && scale > 0.0)) {
            return None;
        }
        for (mut column, scale) in columns.column_iter_mut().zip(&scales) {
            column /= *scale;
        }
        let decomposition = columns.clone().svd(true, true);
        let singular = &decomposition.singular_values;
        if singular.min() <= RANK * singular.max() {
            return None;
        }
        let scaled = decomposition.solve(data, 0.0).ok()?;
        let residuals = data - &columns * &scaled;
        let turned = decomposition.v_t?;
        let weights = DMatrix::from_diagonal(&singular.map(|value| 1.0 / (value * value)));
        let inverse = turned.transpose() * weights * &turned;
        let count = scales.len();
        let coefficients = DVector::from_fn(count, |i, _| scaled[i] / scales[i]);
        let inverse = DMatrix::from_fn(count, count, |i, j| inverse[(i, j)] / (scales[i] * scales[j]));
        let finite = coefficients.iter().chain(inverse.iter()).all(|value| value.is_finite());
        finite.then_some(Self { coefficients, inverse, residuals })
    }

    /// Variance of the data about the fit, per independent datum.
    pub(super) fn variance(&self) -> f64 {
        let freedom = self.residuals.len() - self.coefficients.len();
        if freedom == 0 {
            return f64::INFINITY;
        }
        self.residuals.norm_squared() / freedom as f64 * inflation(self.residuals.as_slice())
    }

    /// The coefficient `i`.
    pub(super) fn estimate(&self, i: usize) -> Estimate {
        Estimate { value: self.coefficients[i], error: (self.variance() * self.inverse[(i, i)]).sqrt() }
    }
}

/// Fewer residuals than this do not tell whether they are correlated.
const CORRELATED: usize = 10;

/// How many residuals count for one: `(1 + r) / (1 - r)` with their correlation r to the next one, at least 1.
pub(super) fn inflation(residuals: &[f64]) -> f64 {
    let power: f64 = residuals.iter().map(|r| r * r).sum();
    if residuals.len() < CORRELATED || power == 0.0 {
        return 1.0;
    }
    let shifted: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let most = 1.0 - 2.0 / residuals.len() as f64;
    let correlation = (shifted / power).clamp(0.0, most);
    (1.0 + correlation) / (1.0 - correlation)
}

/// Value at `x = 0` and slope of the straight line through the points.
pub(super) fn line(x: &[f64], y: &[f64]) -> Option<(Estimate, Estimate, f64)> {
    let columns = DMatrix::from_fn(x.len(), 2, |i, j| if j == 0 { 1.0 } else { x[i] });
    let solution = Solution::new(columns, &DVector::from_column_slice(y))?;
    let rms = (solution.residuals.norm_squared() / x.len() as f64).sqrt();
    Some((solution.estimate(0), solution.estimate(1), rms))
}

#[cfg(test)]
mod tests;
