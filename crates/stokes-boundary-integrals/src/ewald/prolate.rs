//! Prolate spheroidal function of order 0: of all functions with a bounded spectrum the one that is most concentrated.

use nalgebra::DMatrix;

/// Legendre coefficients beyond twice the parameter: they fall faster than exponentially from the parameter on.
const MORE_TERMS: usize = 30;

/// The even eigenfunction psi of `-d/dx (1 - x^2) d/dx + c^2 x^2` on |x| <= 1 with the minimum eigenvalue, over its
/// value at 0.
#[derive(Debug, Clone)]
pub struct Prolate {
    /// Coefficients of the Legendre polynomials of even degree.
    coefficients: Vec<f64>,
    /// Minus the second derivative at 0, which is the eigenvalue.
    pub bend: f64,
}

impl Prolate {
    /// Creates the function with the parameter c.
    #[must_use]
    pub fn new(c: f64) -> Self {
        let count = c as usize + MORE_TERMS;
        let square = c * c;
        let mut matrix = DMatrix::<f64>::zeros(count, count);
        // Recurrence of x^2 times normalised Legendre polynomials of even degree.
        for i in 0..count {
            let k = 2.0 * i as f64;
            let both = (2.0 * k + 3.0) * (2.0 * k - 1.0);
            matrix[(i, i)] = k * (k + 1.0) + (2.0 * k * (k + 1.0) - 1.0) / both * square;
            if i + 1 < count {
                let root = ((2.0 * k + 1.0) * (2.0 * k + 5.0)).sqrt();
                let beside = (k + 2.0) * (k + 1.0) / ((2.0 * k + 3.0) * root) * square;
                (matrix[(i, i + 1)], matrix[(i + 1, i)]) = (beside, beside);
            }
        }
        let eigen = matrix.symmetric_eigen();
        let least = eigen.eigenvalues.imin();
        let vector = eigen.eigenvectors.column(least);
        let coefficients = vector.iter().enumerate().map(|(i, value)| value * (2.0 * i as f64 + 0.5).sqrt()).collect();
        let mut prolate = Self { coefficients, bend: eigen.eigenvalues[least] };
        let scale = 1.0 / prolate.at(0.0);
        prolate.coefficients.iter_mut().for_each(|value| *value *= scale);
        prolate
    }

    /// Returns the value at x, |x| <= 1.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        let (mut before, mut now, mut sum) = (1.0, x, 0.0);
        for (i, coefficient) in self.coefficients.iter().enumerate() {
            sum += coefficient * before;
            for k in [2 * i + 2, 2 * i + 3] {
                let k = k as f64;
                (before, now) = (now, ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k);
            }
        }
        sum
    }
}
