//! Integrals of sampled functions.

/// The integral of y from the first time to each of the times, for samples at increasing times: exact for cubics.
///
/// Between two samples it is that of the cubic through them and their neighbours, or, with the derivatives of y, of the
/// cubic with these values and derivatives.
pub(super) fn cumulative_integral(times: &[f64], y: &[f64], derivatives: Option<&[f64]>) -> Vec<f64> {
    let mut integral = vec![0.0; y.len()];
    for i in 1..y.len() {
        let dt = times[i] - times[i - 1];
        integral[i] = integral[i - 1]
            + match derivatives {
                Some(d) => 0.5 * dt * (y[i - 1] + y[i]) + dt * dt / 12.0 * (d[i - 1] - d[i]),
                None => between(times, y, i),
            };
    }
    integral
}

/// The integral over the interval before sample `i` of the polynomial through up to four samples around it.
fn between(times: &[f64], y: &[f64], i: usize) -> f64 {
    let start = (i.max(2) - 2).min(y.len().saturating_sub(4));
    let stencil = start..(start + 4).min(y.len());
    let (middle, half) = (0.5 * (times[i - 1] + times[i]), 0.5 * (times[i] - times[i - 1]));
    // Two Gauss points integrate a cubic exactly.
    let root = half / 3.0_f64.sqrt();
    let value = |t: f64| -> f64 {
        stencil
            .clone()
            .map(|k| {
                let others = stencil.clone().filter(|&m| m != k);
                y[k] * others.map(|m| (t - times[m]) / (times[k] - times[m])).product::<f64>()
            })
            .sum()
    };
    half * (value(middle - root) + value(middle + root))
}

#[cfg(test)]
mod tests;
