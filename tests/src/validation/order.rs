//! Orders of convergence.

/// The order p of errors `e ~ h^p`, from the least-squares slope of log |e| over log h. NaN for fewer than two points.
#[must_use]
pub fn order(spacings: &[f64], errors: &[f64]) -> f64 {
    let n = spacings.len().min(errors.len()) as f64;
    let (mut sx, mut sy, mut sxx, mut sxy) = (0.0, 0.0, 0.0, 0.0);
    for (h, e) in spacings.iter().zip(errors) {
        let (x, y) = (h.ln(), e.abs().ln());
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    (n * sxy - sx * sy) / (n * sxx - sx * sx)
}

#[cfg(test)]
mod tests;
