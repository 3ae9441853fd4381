//! Growth and frequency of a small lateral motion.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::Estimate;
use super::quadrature::cumulative_integral;
use super::regression::Solution;
use super::separable::{Data, Model, SeparableFit};
use crate::InterfaceError;
use crate::error::{all_finite, enough, increasing, length};

/// The leading mode of a small lateral motion, `y(t) = Re(a e^((s + i w) t))`, fitted by [`fit_linear_mode`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearMode {
    /// Growth rate s, negative for a decay (1/time). Where the motion does not oscillate it is the larger of two real rates.
    pub growth_rate: Estimate,
    /// Angular frequency w (radians per time); `None` where the motion does not oscillate.
    pub frequency: Option<Estimate>,
    /// The smaller one of two real rates (1/time); `None` for an oscillation, and where the data show one rate only.
    pub second_rate: Option<f64>,
    /// What the fit leaves of the data, root mean square over root mean square (no dimension).
    pub residual: f64,
    /// Length of the record (time).
    pub duration: f64,
}

impl LinearMode {
    /// The period 2 pi/w (time); `None` where the motion does not oscillate.
    #[must_use]
    pub fn period(&self) -> Option<Estimate> {
        self.frequency.map(|w| Estimate { value: TAU / w.value, error: TAU / (w.value * w.value) * w.error })
    }

    /// How many periods the record contains, 0 where the motion does not oscillate.
    #[must_use]
    pub fn periods(&self) -> f64 {
        self.frequency.map_or(0.0, |w| w.value * self.duration / TAU)
    }
}

/// Fewest samples of a fit.
pub(super) const FEWEST_SAMPLES: usize = 8;

/// One rate is enough if two leave no less than this part of its residual.
const BETTER: f64 = 0.95;

/// Fits `y'' = 2 s y' - (s^2 + w^2) y`, that is `y(t) = Re(a e^((s + i w) t))` or, where the motion is overdamped, the sum of two
/// real exponentials, to the height y above the centre line (length) at increasing times, in the least squares sense. What a
/// small lateral displacement of a steady swimmer follows once everything faster has decayed: leave the beginning of a run out.
///
/// With the lateral velocities y' (length per time; the centroid's) beside the heights, both are fitted at once, each with its root mean square as unit. A fraction of
/// a period then suffices; without them it takes about half a period. Samples need not be evenly spaced, nor be many in a period, as
/// long as they show the oscillation. Noise does not bias the result, as it does where slopes are taken from differences.
///
/// ```
/// use active_interface::fit_linear_mode;
/// let times: Vec<f64> = (0..200).map(f64::from).collect();
/// let y: Vec<f64> = times.iter().map(|t| 1e-3 * (0.002 * t).exp() * (0.05 * t).cos()).collect();
/// let mode = fit_linear_mode(&times, &y, None)?;
/// println!("growth {:.5}, period {:.2}", mode.growth_rate.value, mode.period().map_or(f64::NAN, |p| p.value));
/// assert!((mode.growth_rate.value - 0.002).abs() < 1e-9);
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
///
/// # Errors
/// Lists of different length, fewer than eight samples, values that are not finite, times that do not increase, data that
/// determine no rate (such as zeros).
pub fn fit_linear_mode(
    times: &[f64],
    heights: &[f64],
    velocities: Option<&[f64]>,
) -> Result<LinearMode, InterfaceError> {
    enough("samples", times.len(), FEWEST_SAMPLES)?;
    length("the heights", times.len(), heights.len())?;
    increasing("the times", times)?;
    all_finite("the heights", heights)?;
    if let Some(velocities) = velocities {
        length("the lateral velocities", times.len(), velocities.len())?;
        all_finite("the lateral velocities", velocities)?;
    }
    let no_fit = InterfaceError::NoFit { what: "a linear mode", points: times.len() };

    // In units of the record's length and the largest height.
    let duration = times[times.len() - 1] - times[0];
    let size = heights.iter().fold(0.0_f64, |a, y| a.max(y.abs()));
    if size == 0.0 {
        return Err(no_fit);
    }
    let times: Vec<f64> = times.iter().map(|t| (t - times[0]) / duration).collect();
    let heights: Vec<f64> = heights.iter().map(|y| y / size).collect();
    let velocities: Option<Vec<f64>> =
        velocities.map(|velocities| velocities.iter().map(|v| v * duration / size).collect());
    let velocities = velocities.as_deref();

    let data = Data::new(times.clone(), &heights, velocities).ok_or(no_fit.clone())?;
    let fit = |model: Model| data.fit(model, weak_form(model, &times, &heights, velocities)?);
    let (one, two) = (fit(Model::Exponential), fit(Model::Oscillator));
    let fit = match (one, two) {
        (Some(one), Some(two)) if two.residual < BETTER * one.residual && one.residual > f64::EPSILON => two,
        (Some(one), _) => one,
        (None, Some(two)) => two,
        (None, None) => return Err(no_fit),
    };
    Ok(mode(&fit, duration))
}

/// The mode of a fit in the times of a record of length `duration`.
fn mode(fit: &SeparableFit, duration: f64) -> LinearMode {
    let estimate =
        |value: f64, variance: f64| Estimate { value, error: variance.max(0.0).sqrt() }.scaled(1.0 / duration);
    let cov = &fit.covariance;
    let (growth_rate, frequency, second_rate) = match fit.rates[..] {
        [s, d] if d < 0.0 => {
            let w = (-d).sqrt();
            (estimate(s, cov[(0, 0)]), Some(estimate(w, cov[(1, 1)] / (4.0 * w * w))), None)
        }
        [s, d] => {
            let q = d.sqrt();
            // Where both rates coincide, their errors are those of the square root.
            let slope = 0.5 / q.max(cov[(1, 1)].powf(0.25)).max(f64::MIN_POSITIVE);
            let variance = cov[(0, 0)] + 2.0 * slope * cov[(0, 1)] + slope * slope * cov[(1, 1)];
            (estimate(s + q, variance), None, Some((s - q) / duration))
        }
        _ => (estimate(fit.rates[0], cov[(0, 0)]), None, None),
    };
    LinearMode { growth_rate, frequency, second_rate, residual: fit.residual, duration }
}

/// The rates of a model by linear least squares from its integrated equation,
/// `y' - y'(0) = a (y - y(0)) + b INT y`, once more integrated where the velocities are not known.
fn weak_form(model: Model, times: &[f64], heights: &[f64], velocities: Option<&[f64]>) -> Option<Vec<f64>> {
    let once = cumulative_integral(times, heights, velocities);
    let solve = |columns: &[&[f64]], data: &[f64]| {
        let matrix = DMatrix::from_fn(times.len(), columns.len(), |i, j| columns[j][i]);
        Solution::new(matrix, &DVector::from_column_slice(data)).map(|solution| solution.coefficients)
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

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    /// Heights and velocities of `Re(a e^((s + i w) t))`.
    fn signal(times: &[f64], s: f64, w: f64, phase: f64) -> (Vec<f64>, Vec<f64>) {
        times
            .iter()
            .map(|t| {
                let (sin, cos) = (w * t + phase).sin_cos();
                let size = 0.01 * (s * t).exp();
                (size * cos, size * (s * cos - w * sin))
            })
            .unzip()
    }

    fn even(end: f64, count: usize) -> Vec<f64> {
        (0..count).map(|i| end * i as f64 / (count - 1) as f64).collect()
    }

    /// The three modes of `channel_lateral_stability.csv`: w = 5, l = 12.
    const REFERENCE: [(f64, f64); 3] =
        [(-0.000_942_6, 0.033_642_4), (0.006_669_6, 0.057_778_5), (0.001_177_4, 0.045_963_5)];

    #[test]
    fn modes_of_the_reference_from_one_period() {
        for (s, w) in REFERENCE {
            let times = even(TAU / w, 60);
            let (y, v) = signal(&times, s, w, 0.3);
            for velocities in [None, Some(&v[..])] {
                let mode = fit_linear_mode(&times, &y, velocities).unwrap();
                assert_relative_eq!(mode.growth_rate.value, s, max_relative = 1e-6);
                assert_relative_eq!(mode.frequency.unwrap().value, w, max_relative = 1e-8);
                assert!(mode.residual < 1e-9 && (mode.periods() - 1.0).abs() < 1e-6, "{mode:?}");
            }
        }
    }

    #[test]
    fn a_quarter_of_a_period_with_velocities() {
        for (s, w) in REFERENCE {
            let times = even(0.25 * TAU / w, 40);
            let (y, v) = signal(&times, s, w, 1.0);
            let mode = fit_linear_mode(&times, &y, Some(&v)).unwrap();
            assert_relative_eq!(mode.growth_rate.value, s, max_relative = 1e-3);
            assert_relative_eq!(mode.frequency.unwrap().value, w, max_relative = 1e-4);
        }
    }

    #[test]
    fn noise_does_not_bias_and_its_errors_are_honest() {
        let (s, w) = REFERENCE[1];
        let times = even(2.0 * TAU / w, 400);
        let (clean, _) = signal(&times, s, w, 0.0);
        // A fixed sequence of pseudo-random numbers in (-1, 1), five per cent of the amplitude.
        let mut seed = 1_u64;
        let mut noise = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let trials = 40;
        let scores: Vec<f64> = (0..trials)
            .map(|_| {
                let y: Vec<f64> = clean.iter().map(|y| y + 5e-4 * noise()).collect();
                let mode = fit_linear_mode(&times, &y, None).unwrap();
                assert_relative_eq!(mode.growth_rate.value, s, max_relative = 0.03);
                (mode.growth_rate.value - s) / mode.growth_rate.error
            })
            .collect();
        let mean = scores.iter().sum::<f64>() / f64::from(trials);
        let spread = (scores.iter().map(|score| score * score).sum::<f64>() / f64::from(trials)).sqrt();
        assert!(mean.abs() < 0.5 && (0.6..1.4).contains(&spread), "{mean} {spread}");
    }

    #[test]
    fn motion_without_oscillation() {
        let times = even(30.0, 100);
        let one: Vec<f64> = times.iter().map(|t| 0.2 * (-0.1 * t).exp()).collect();
        let mode = fit_linear_mode(&times, &one, None).unwrap();
        assert_relative_eq!(mode.growth_rate.value, -0.1, max_relative = 1e-8);
        assert!(mode.frequency.is_none() && mode.period().is_none() && mode.periods() == 0.0);
        let two: Vec<f64> = times.iter().map(|t| 0.2 * (-0.1 * t).exp() - 0.1 * (-0.4 * t).exp()).collect();
        let mode = fit_linear_mode(&times, &two, None).unwrap();
        assert_relative_eq!(mode.growth_rate.value, -0.1, max_relative = 1e-6);
        assert_relative_eq!(mode.second_rate.unwrap(), -0.4, max_relative = 1e-6);
        // A straight line has the rate zero twice.
        let line: Vec<f64> = times.iter().map(|t| 0.1 + 0.02 * t).collect();
        let mode = fit_linear_mode(&times, &line, None).unwrap();
        assert!(mode.growth_rate.value.abs() < 1e-3 && mode.periods() < 1e-2, "{mode:?}");
        let rest = fit_linear_mode(&times, &[0.3; 100], Some(&[0.0; 100]));
        assert!(rest.is_err() || rest.unwrap().growth_rate.value.abs() < 1e-12);
    }

    #[test]
    fn bad_input_is_refused() {
        let (times, y) = (even(1.0, 10), [1.0; 10]);
        assert!(fit_linear_mode(&times, &[0.0; 10], None).is_err());
        assert!(fit_linear_mode(&times[..7], &y[..7], None).is_err());
        assert!(fit_linear_mode(&times, &y[..9], None).is_err());
        assert!(fit_linear_mode(&[0.0; 10], &y, None).is_err());
        assert!(fit_linear_mode(&times, &[f64::NAN; 10], None).is_err());
        assert!(fit_linear_mode(&times, &y, Some(&y[..9])).is_err());
        assert!(fit_linear_mode(&times, &y, Some(&[f64::INFINITY; 10])).is_err());
    }

    proptest! {
        #[test]
        fn uneven_samples(s in -0.02..0.02f64, w in 0.02..0.2f64, phase in 0.0..6.3f64, periods in 0.6..5.0f64,
                          jitter in prop::collection::vec(-0.4..0.4f64, 120), known: bool) {
            let end = periods * TAU / w;
            let times: Vec<f64> = jitter.iter().enumerate().map(|(i, j)| end * (i as f64 + j) / 119.0).collect();
            let (y, v) = signal(&times, s, w, phase);
            let mode = fit_linear_mode(&times, &y, known.then_some(&v[..])).unwrap();
            prop_assert!((mode.growth_rate.value - s).abs() < 1e-5 * w, "{:?}", mode);
            prop_assert!((mode.frequency.unwrap().value - w).abs() < 1e-5 * w, "{:?}", mode);
        }
    }
}
