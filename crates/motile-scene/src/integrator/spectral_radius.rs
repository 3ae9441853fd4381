//! The largest rate at which perturbations of a state decay.

use super::Dynamics;
use crate::SceneError;

/// Most evaluations of an estimate from nothing, and of one from the direction found last.
const MOST: [usize; 2] = [30, 5];
/// Size of the perturbation, in units of the scales of the state.
const PERTURBATION: f64 = 1e-6;
/// Fraction of the estimate that may be missing when it is taken.
const TOLERANCE: f64 = 0.1;

/// The nonlinear power method (Sommeijer, Shampine and Verwer 1998): differences of rates between a state and a
/// perturbed one, the perturbation being turned towards the fastest mode. Starts from the direction found last.
///
/// The rates of elastic walls and of interfaces lie densely up to the fastest, so that the estimate approaches it only
/// as `1 - c/k` after k evaluations. What is missing is k times the last change, however small that is.
#[derive(Debug, Clone, Default)]
pub(super) struct PowerMethod {
    pub(super) direction: Vec<f64>,
    scales: Vec<f64>,
    perturbed: Vec<f64>,
    rate: Vec<f64>,
}

/// Returns the root mean square of `values` in units of `scales`.
fn norm(values: &[f64], scales: &[f64]) -> f64 {
    let sum: f64 = values.iter().zip(scales).map(|(value, scale)| (value / scale).powi(2)).sum();
    (sum / values.len().max(1) as f64).sqrt()
}

impl PowerMethod {
    /// Returns the spectral radius (1/time) of the derivative of the explicit rate at `state`, whose rate is `rate`,
    /// and the evaluations that it took. The bodies are left in another state.
    ///
    /// # Errors
    /// Returns the errors of the bodies and of the flow.
    pub(super) fn estimate(
        &mut self,
        system: &mut dyn Dynamics,
        state: &[f64],
        rate: &[f64],
    ) -> Result<(f64, usize), SceneError> {
        let len = state.len();
        self.scales.resize(len, 1.0);
        system.write_scales(&mut self.scales);
        self.rate.resize(len, 0.0);
        self.perturbed.resize(len, 0.0);
        let known = self.direction.len() == len && norm(&self.direction, &self.scales) > 0.0;
        if !known {
            // Neighbours move against each other, each body's entries in their own units; the weights keep it from
            // being orthogonal to a mode by symmetry.
            self.direction.clear();
            let weight = |k: usize| 1.0 + 0.5 * ((k * 7919) % 101) as f64 / 101.0;
            let sign = |k: usize| if (k / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
            self.direction.extend(self.scales.iter().enumerate().map(|(k, scale)| scale * sign(k) * weight(k)));
        }
        let most = MOST[usize::from(known)];
        let (mut radius, mut missing) = (0.0, 0.0);
        for evaluations in 1..=most {
            let factor = PERTURBATION / norm(&self.direction, &self.scales);
            for ((z, y), d) in self.perturbed.iter_mut().zip(state).zip(&self.direction) {
                *z = y + factor * d;
            }
            system.rate(&self.perturbed, &mut self.rate)?;
            for ((d, after), before) in self.direction.iter_mut().zip(&self.rate).zip(rate) {
                *d = after - before;
            }
            let grown = norm(&self.direction, &self.scales);
            let before = std::mem::replace(&mut radius, grown / PERTURBATION);
            if grown == 0.0 || !grown.is_finite() {
                self.direction.clear();
                return Ok((0.0, evaluations));
            }
            missing = (evaluations as f64 * (radius - before).abs()).min(TOLERANCE * radius);
            if evaluations > 1 && missing < TOLERANCE * radius {
                return Ok((radius + missing, evaluations));
            }
        }
        Ok((radius + missing, most))
    }
}
