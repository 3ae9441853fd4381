//! Normal equations of small nonlinear least squares.

/// Normal equations `M s = g` of a Gauss-Newton step for N unknowns, with `M = sum of w r r^T` and `g = sum of w d r`
/// over measurements of the deviation d with derivatives r and weight w.
#[derive(Debug)]
pub(super) struct NormalEquations<const N: usize> {
    matrix: [[f64; N]; N],
    gradient: [f64; N],
}

impl<const N: usize> NormalEquations<N> {
    pub(super) fn new() -> Self {
        Self { matrix: [[0.0; N]; N], gradient: [0.0; N] }
    }

    /// Adds a measurement: the derivatives `row` of its deviation by the unknowns, its weight, and the deviation.
    pub(super) fn add(&mut self, row: [f64; N], weight: f64, deviation: f64) {
        for i in 0..N {
            let weighted = weight * row[i];
            self.gradient[i] += weighted * deviation;
            self.matrix[i][i..].iter_mut().zip(&row[i..]).for_each(|(entry, other)| *entry += weighted * other);
        }
    }

    /// Returns the step s with the diagonal of M raised by the part `damping`, by elimination with partial pivoting;
    /// `None` for a singular matrix or a step that is not finite.
    pub(super) fn step(&self, damping: f64) -> Option<[f64; N]> {
        // Only the upper half has been summed.
        let entry = |i: usize, j: usize| self.matrix[i.min(j)][i.max(j)] * if i == j { 1.0 + damping } else { 1.0 };
        let mut a: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        let mut x = self.gradient;
        for i in 0..N {
            let pivot = (i..N).max_by(|&k, &l| a[k][i].abs().total_cmp(&a[l][i].abs()))?;
            a.swap(i, pivot);
            x.swap(i, pivot);
            if a[i][i] == 0.0 {
                return None;
            }
            let (above, below) = a.split_at_mut(i + 1);
            for (row, k) in below.iter_mut().zip(i + 1..) {
                let factor = row[i] / above[i][i];
                row.iter_mut().zip(above[i]).for_each(|(entry, pivot)| *entry -= factor * pivot);
                x[k] -= factor * x[i];
            }
        }
        for i in (0..N).rev() {
            let known: f64 = (i + 1..N).map(|j| a[i][j] * x[j]).sum();
            x[i] = (x[i] - known) / a[i][i];
        }
        x.iter().all(|value| value.is_finite()).then_some(x)
    }
}

#[cfg(test)]
mod tests;
