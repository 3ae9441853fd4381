//! Growth and frequency of a small lateral motion.

use std::f64::consts::TAU;

use motile_base::{
    internal::{all_finite, at_least},
    same_length,
};

use super::Estimate;
use super::regression::Solution;
use super::separable::{Data, Model, SeparableFit};
use crate::AnalysisError;
use crate::error::increasing;

/// The leading mode of a small lateral motion, `y(t) = Re(a e^((s + i w) t))`, fitted by [`fit_linear_mode`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LinearMode {
    /// Growth rate s, negative for a decay (1/time); the larger of two real rates where the motion does not oscillate.
    pub growth_rate: Estimate,
    /// Angular frequency w (radians per time); `None` if the motion does not oscillate.
    pub frequency: Option<Estimate>,
    /// Smaller one of two real rates (1/time); `None` for an oscillation, and where the data show one rate only.
    pub second_rate: Option<f64>,
    /// Root mean square of the residuals over the root mean square of the data (no dimension).
    pub residual: f64,
    /// Length of the record (time).
    pub duration: f64,
}

impl LinearMode {
    /// Returns the period 2 pi/w (time); `None` if the motion does not oscillate.
    #[must_use]
    pub fn period(&self) -> Option<Estimate> {
        self.frequency.map(|w| Estimate { value: TAU / w.value, error: TAU / (w.value * w.value) * w.error })
    }

    /// Returns the number of periods in the record, 0 if the motion does not oscillate.
    #[must_use]
    pub fn periods(&self) -> f64 {
        self.frequency.map_or(0.0, |w| w.value * self.duration / TAU)
    }
}

/// Fewest samples of a fit: twice the four unknowns of an oscillation.
pub(super) const FEWEST_SAMPLES: usize = 8;

/// Ratio of the residuals of the fits with two rates and with one below which the second rate is believed.
const BETTER: f64 = 0.95;

/// Returns the least squares fit of `y(t) = Re(a e^((s + i w) t))`, or, where the motion is overdamped, of the sum of
/// two real exponentials, to the height y above the centre line (length) at increasing times; both solve `y'' = 2 s
/// y' - (s^2 + w^2) y`. A small lateral displacement of a steady swimmer is of this form once everything faster has
/// decayed: leave the beginning of a run out.
///
/// If you add the lateral velocities y' of the centroid (length per time) to the heights, both are fitted at once, each
/// with its root mean square as unit. A fraction of a period then suffices; without them it takes about half a period.
/// Samples need not be evenly spaced, nor be many in a period, as long as they show the oscillation. Noise does not
/// bias the result, as it does where slopes are taken from differences.
///
/// ```
/// use motile_analysis::trajectory::fit_linear_mode;
/// let times: Vec<f64> = (0..200).map(f64::from).collect();
/// let y: Vec<f64> = times.iter().map(|t| 1e-3 * (0.002 * t).exp() * (0.05 * t).cos()).collect();
/// let mode = fit_linear_mode(&times, &y, None)?;
/// println!("growth {:.5}, period {:.2}", mode.growth_rate.value, mode.period().map_or(f64::NAN, |p| p.value));
/// assert!((mode.growth_rate.value - 0.002).abs() < 1e-9);
/// # Ok::<(), motile_analysis::AnalysisError>(())
/// ```
///
/// # Errors
/// Returns an error for lists of different length, fewer than eight samples, values that are not finite, times that do
/// not increase, data that determine no rate (such as zeros).
pub fn fit_linear_mode(
    times: &[f64],
    heights: &[f64],
    velocities: Option<&[f64]>,
) -> Result<LinearMode, AnalysisError> {
    at_least("samples", times.len(), FEWEST_SAMPLES)?;
    same_length("the heights", times.len(), heights.len())?;
    increasing("the times", times)?;
    all_finite("the heights", heights)?;
    if let Some(velocities) = velocities {
        same_length("the lateral velocities", times.len(), velocities.len())?;
        all_finite("the lateral velocities", velocities)?;
    }
    let no_fit = || AnalysisError::no_fit("a linear mode", times.len());

    // In units of the record's length and the largest height.
    let duration = times[times.len() - 1] - times[0];
    let size = heights.iter().fold(0.0_f64, |a, y| a.max(y.abs()));
    if size == 0.0 {
        return Err(no_fit());
    }
    let times: Vec<f64> = times.iter().map(|t| (t - times[0]) / duration).collect();
    let heights: Vec<f64> = heights.iter().map(|y| y / size).collect();
    let velocities: Option<Vec<f64>> =
        velocities.map(|velocities| velocities.iter().map(|v| v * duration / size).collect());
    let velocities = velocities.as_deref();

    let data = Data::new(times.clone(), &heights, velocities).ok_or_else(no_fit)?;
    let fit = |model: Model| data.fit(model, weak_form(model, &times, &heights, velocities)?);
    let (one, two) = (fit(Model::Exponential), fit(Model::Oscillator));
    let fit = match (one, two) {
        (Some(one), Some(two)) if two.residual < BETTER * one.residual && one.residual > f64::EPSILON => two,
        (Some(one), _) => one,
        (None, Some(two)) => two,
        (None, None) => return Err(no_fit()),
    };
    Ok(mode(&fit, duration))
}

/// Returns the mode of a fit whose unit of time is the length `duration` of the record.
fn mode(fit: &SeparableFit, duration: f64) -> LinearMode {
    let estimate =
        |value: f64, variance: f64| Estimate { value, error: variance.max(0.0).sqrt() }.scaled(1.0 / duration);
    let cov = &fit.covariance;
    let (growth_rate, frequency, second_rate) = match fit.rates[..] {
        [s, d] if d < 0.0 => {
            let w = (-d).sqrt();
            (estimate(s, cov[0][0]), Some(estimate(w, cov[1][1] / (4.0 * w * w))), None)
        }
        [s, d] => {
            let q = d.sqrt();
            // Where both rates coincide, their errors are those of the square root.
            let slope = 0.5 / q.max(cov[1][1].powf(0.25)).max(f64::MIN_POSITIVE);
            let variance = cov[0][0] + 2.0 * slope * cov[0][1] + slope * slope * cov[1][1];
            (estimate(s + q, variance), None, Some((s - q) / duration))
        }
        _ => (estimate(fit.rates[0], cov[0][0]), None, None),
    };
    LinearMode { growth_rate, frequency, second_rate, residual: fit.residual, duration }
}

/// Returns the initial guess of the rates of a model, by linear least squares from its integrated equation, `y' -
/// y'(0) = a (y - y(0)) + b INT y`, once more integrated where the velocities are not known.
fn weak_form(model: Model, times: &[f64], heights: &[f64], velocities: Option<&[f64]>) -> Option<Vec<f64>> {
    let once = cumulative_integral(times, heights, velocities);
    let solve = |columns: &[&[f64]], data: &[f64]| {
        let columns = columns.iter().map(|column| column.to_vec()).collect();
        Solution::new(columns, data).map(|solution| solution.coefficients)
    };
    let constant = vec![1.0; times.len()];
    if model == Model::Exponential {
        return Some(vec![solve(&[&constant, &once], heights)?[1]]);
    }
    let [a, b] = match velocities {
        Some(velocities) => {
            let c = solve(&[&constant, heights, &once], velocities)?;
            [c[1], c[2]]
        }
        None => {
            let twice = cumulative_integral(times, &once, Some(heights));
            let c = solve(&[&constant, times, &once, &twice], heights)?;
            [c[2], c[3]]
        }
    };
    Some(vec![0.5 * a, 0.25 * a * a + b])
}

/// Returns the integral of y from the first time to each of the times, for samples at increasing times: exact for
/// cubics.
///
/// Between two samples y is taken for the cubic through them and their neighbours, or, with the derivatives of y, for
/// the cubic with these values and derivatives.
fn cumulative_integral(times: &[f64], y: &[f64], derivatives: Option<&[f64]>) -> Vec<f64> {
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

/// Returns the integral over the interval before sample `i` of the polynomial through up to four samples around it.
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
