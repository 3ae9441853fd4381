//! Linear least squares with standard errors.

/// A fitted number and its standard error, of one dimension.
///
/// The standard error takes the residuals for a first-order autoregressive process, so that the smooth residuals of a
/// model that is only nearly right do not pass for many independent measurements. It is infinite if there are no more
/// data than unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// Best value.
    pub value: f64,
    /// Standard error.
    pub error: f64,
}

impl Estimate {
    /// Returns `true` if the value differs from zero by more than `errors` standard errors.
    #[must_use]
    pub fn differs_from_zero(&self, errors: f64) -> bool {
        self.value.abs() > errors * self.error
    }

    /// Returns the estimate of `factor` times the number.
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { value: factor * self.value, error: factor.abs() * self.error }
    }
}

/// The least squares solution of `columns * coefficients = data`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Solution {
    pub(super) coefficients: Vec<f64>,
    /// (A^T A)^-1.
    pub(super) inverse: Vec<Vec<f64>>,
    pub(super) residuals: Vec<f64>,
}

/// Columns that leave less than this fraction of a column, about 1e5 times round-off, determine it: it counts as
/// dependent.
const RANK: f64 = 1e-11;

impl Solution {
    /// Creates a solution by modified Gram-Schmidt orthogonalisation, with the data as the last column, which is
    /// backward stable (Bjoerck, BIT 7, 1967). `None` for fewer rows than columns, dependent columns, or values that
    /// are not finite.
    pub(super) fn new(mut columns: Vec<Vec<f64>>, data: &[f64]) -> Option<Self> {
        let (rows, count) = (data.len(), columns.len());
        let dot = |a: &[f64], b: &[f64]| a[..rows].iter().zip(&b[..rows]).map(|(a, b)| a * b).sum::<f64>();
        let sizes: Vec<f64> = columns.iter().map(|column| dot(column, column).sqrt()).collect();
        // Below each column stand its coefficients in the original columns.
        for (j, column) in columns.iter_mut().enumerate() {
            column.extend((0..count).map(|i| if i == j { 1.0 } else { 0.0 }));
        }
        let mut rest: Vec<f64> = data.iter().copied().chain(std::iter::repeat_n(0.0, count)).collect();
        for (j, whole) in sizes.into_iter().enumerate() {
            let [column, later @ ..] = &mut columns[j..] else { break };
            let size = dot(column, column).sqrt();
            if rows < count || !size.is_finite() || size <= RANK * whole {
                return None;
            }
            column.iter_mut().for_each(|value| *value /= size);
            for other in later.iter_mut().chain([&mut rest]) {
                let part = dot(column, other);
                other.iter_mut().zip(column.iter()).for_each(|(other, value)| *other -= part * value);
            }
        }
        let coefficients: Vec<f64> = rest.drain(rows..).map(|value| -value).collect();
        let entry = |i: usize, j: usize| columns.iter().map(|column| column[rows + i] * column[rows + j]).sum();
        let inverse: Vec<Vec<f64>> = (0..count).map(|i| (0..count).map(|j| entry(i, j)).collect()).collect();
        let finite = coefficients.iter().chain(inverse.iter().flatten()).all(|value| value.is_finite());
        finite.then_some(Self { coefficients, inverse, residuals: rest })
    }

    /// Returns the sum of the squares of the residuals.
    pub(super) fn power(&self) -> f64 {
        self.residuals.iter().map(|r| r * r).sum()
    }

    /// Returns the variance of the data about the fit, per independent datum.
    pub(super) fn variance(&self) -> f64 {
        let freedom = self.residuals.len() - self.coefficients.len();
        if freedom == 0 {
            return f64::INFINITY;
        }
        self.power() / freedom as f64 * inflation(&self.residuals)
    }

    /// Returns the coefficient `i`.
    pub(super) fn estimate(&self, i: usize) -> Estimate {
        Estimate { value: self.coefficients[i], error: (self.variance() * self.inverse[i][i]).sqrt() }
    }
}

/// Fewest residuals from which a correlation is estimated: its own standard error is 1/sqrt(n), a third for ten.
const CORRELATED: usize = 10;

/// Returns the number of residuals that count as one independent datum: `(1 + r) / (1 - r)` with the correlation r of
/// successive residuals, at least 1.
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

/// Returns the least squares line through the points: value at `x = 0`, slope, and root mean square residual.
pub(super) fn line(x: &[f64], y: &[f64]) -> Option<(Estimate, Estimate, f64)> {
    let solution = Solution::new(vec![vec![1.0; x.len()], x.to_vec()], y)?;
    let rms = (solution.power() / x.len() as f64).sqrt();
    Some((solution.estimate(0), solution.estimate(1), rms))
}

#[cfg(test)]
mod tests;
