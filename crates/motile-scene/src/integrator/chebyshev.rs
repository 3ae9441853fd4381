//! The Runge-Kutta-Chebyshev method.

mod coefficients;

use coefficients::{Coefficients, interval, stages_for};

use super::spectral_radius::PowerMethod;
use super::{Dynamics, Integrator, IntegratorWork};
use crate::{SceneError, saved_state::SavedState};

/// Source of the fastest rate of decay, which says how many stages each step needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SpectralEstimate {
    /// From the bodies' own limits ([`crate::Body::step_limits`]): costs nothing.
    Predicted,
    /// From the bodies' limits, times how much faster the state was found to be by the power method, once every this
    /// many steps. A state that was found to be slower is not trusted: where the method starts from it may not see the
    /// fastest mode.
    Measured(usize),
}

/// Allowance for what the power method has not found yet, and for what changes within a step.
const MARGIN: f64 = 1.05;
/// Range in which a measurement may correct a prediction.
const CORRECTION: [f64; 2] = [1.0, 20.0];
/// That of many stages (Sommeijer, Shampine and Verwer 1998).
const ERROR_CONSTANT: f64 = 1.0 / 15.0;
/// Largest error of a step of a fraction of the stability limit: where decays do not bound the step, the limit says
/// nothing of accuracy.
const ERROR_BOUND: f64 = 3e-4;

/// The second-order method of Runge, Kutta and Chebyshev (Sommeijer, Shampine and Verwer 1998), for stiff bodies. S
/// stages, each an evaluation of forces and flow, are stable up to `dt rate < 0.65 (s^2 - 1)` where the midpoint rule's
/// two reach 2. For a given step, it takes as many stages as the fastest rate of decay requires.
///
/// The bodies' implicit parts (diffusion along an interface) are solved for in each stage, as in Verwer and Sommeijer
/// (2004):
/// ```text
/// Y_1 = Y_0 + m dt (f_0 + g_1)
/// Y_j = (1-mu-nu) Y_0 + mu Y_{j-1} + nu Y_{j-2} + dt (r f_{j-1} + r_0 f_0)
///     + dt ((r_0 - (1-mu-nu) m) g_0 - nu m g_{j-2} + m g_j)
/// ```
/// with f the explicit and g the implicit part of the rate. These are of first order in g; so the last stage is
/// followed by
/// ```text
/// y' = Y_0 + E_s + dt/2 (g(Y_0) + g(y')),   E_j = mu E_{j-1} + nu E_{j-2} + dt (r f_{j-1} + r_0 f_0),
/// ```
/// the explicit part of the step and the trapezoidal rule for the implicit one, which is of second order in both, and
/// stable however stiff the implicit part is. What is not a decay, such as the transport of particles, limits a step as
/// it does for any method.
#[derive(Debug, Clone)]
pub struct RungeKuttaChebyshev {
    most_stages: usize,
    estimate: SpectralEstimate,
    coefficients: Coefficients,
    power: PowerMethod,
    /// Measured over predicted spectral radius; 0 before any measurement.
    measured: f64,
    /// Steps until the next measurement.
    due: usize,
    work: IntegratorWork,
    start: Vec<f64>,
    first_rate: Vec<f64>,
    first_implicit: Vec<f64>,
    states: [Vec<f64>; 2],
    implicits: [Vec<f64>; 2],
    /// Explicit parts of the last two stages.
    increments: [Vec<f64>; 2],
    rate: Vec<f64>,
    next: Vec<f64>,
    right: Vec<f64>,
}

impl Default for RungeKuttaChebyshev {
    fn default() -> Self {
        Self {
            most_stages: 16,
            estimate: SpectralEstimate::Measured(25),
            coefficients: Coefficients::default(),
            power: PowerMethod::default(),
            measured: 0.0,
            due: 0,
            work: IntegratorWork::default(),
            start: Vec::new(),
            first_rate: Vec::new(),
            first_implicit: Vec::new(),
            states: [Vec::new(), Vec::new()],
            implicits: [Vec::new(), Vec::new()],
            increments: [Vec::new(), Vec::new()],
            rate: Vec::new(),
            next: Vec::new(),
            right: Vec::new(),
        }
    }
}

impl RungeKuttaChebyshev {
    /// Creates an at most 16 stages, the spectral radius measured every 25 steps.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the method with at most this many stages per step (2 to 200; others are taken as the nearest of these).
    /// Runs shorten their steps where more would be needed.
    #[must_use]
    pub fn with_most_stages(mut self, stages: usize) -> Self {
        self.most_stages = stages.clamp(2, 200);
        self
    }

    /// Returns the method with another estimate of the spectral radius.
    #[must_use]
    pub fn with_estimate(mut self, estimate: SpectralEstimate) -> Self {
        self.estimate = estimate;
        self
    }

    /// Returns the fastest decay that was found last, in units of what the bodies' limits say; 0 before any
    /// measurement.
    #[must_use]
    pub fn measured(&self) -> f64 {
        self.measured
    }

    /// Returns how much faster than the bodies' limits the fastest decay is taken to be.
    #[must_use]
    pub fn correction(&self) -> f64 {
        (MARGIN * self.measured).clamp(CORRECTION[0], CORRECTION[1])
    }

    /// Returns the fastest rate of decay (1/time), from the bodies' limits and what was measured.
    fn spectral_radius(&mut self, system: &mut dyn Dynamics) -> Result<f64, SceneError> {
        let predicted = system.fastest_decay();
        let SpectralEstimate::Measured(every) = self.estimate else { return Ok(predicted) };
        if self.due == 0 {
            self.due = every.max(1);
            if predicted > 0.0 && predicted.is_finite() {
                let (measured, evaluations) = self.power.estimate(system, &self.start, &self.first_rate)?;
                self.work.estimates += evaluations;
                if measured > 0.0 {
                    self.measured = measured / predicted;
                }
            }
        }
        self.due -= 1;
        Ok(self.correction() * predicted)
    }

    /// Solves for the implicit part: `next` from `right`, its rate to `implicit`.
    fn solve(system: &mut dyn Dynamics, factor: f64, right: &[f64], next: &mut [f64], implicit: &mut [f64]) {
        next.copy_from_slice(right);
        system.solve_implicit(factor, next);
        for ((g, y), r) in implicit.iter_mut().zip(next.iter()).zip(right) {
            *g = (y - r) / factor;
        }
    }
}

impl Integrator for RungeKuttaChebyshev {
    fn name(&self) -> &'static str {
        "the Runge-Kutta-Chebyshev method"
    }

    fn step(&mut self, system: &mut dyn Dynamics, dt: f64) -> Result<(), SceneError> {
        system.write_state(&mut self.start);
        let len = self.start.len();
        let pairs = [&mut self.states, &mut self.implicits, &mut self.increments];
        let single = [&mut self.first_rate, &mut self.first_implicit, &mut self.rate, &mut self.next, &mut self.right];
        pairs.into_iter().flatten().chain(single).for_each(|list| list.resize(len, 0.0));
        system.present_rate(&mut self.first_rate)?;
        let radius = self.spectral_radius(system)?;
        let stages = stages_for(dt * radius).min(self.most_stages);
        self.work.stages += stages;
        self.work.most_stages = self.work.most_stages.max(stages);
        self.coefficients.set(stages);

        let Self { start, first_rate, first_implicit, rate, next, right, coefficients, .. } = self;
        let [before, this] = &mut self.states;
        let [implicit_before, implicit] = &mut self.implicits;
        let [increment_before, increment] = &mut self.increments;
        first_implicit.fill(0.0);
        system.add_implicit(start, 1.0, first_implicit);
        before.copy_from_slice(start);
        implicit_before.copy_from_slice(first_implicit);
        increment_before.fill(0.0);
        let factor = coefficients.first * dt;
        for k in 0..len {
            increment[k] = factor * first_rate[k];
            right[k] = start[k] + increment[k];
        }
        Self::solve(system, factor, right, this, implicit);
        for stage in &coefficients.later {
            system.rate(this, rate)?;
            let free = 1.0 - stage.mu - stage.nu;
            let kept = stage.first_rate * dt - free * factor;
            for k in 0..len {
                let explicit = dt * (stage.rate * rate[k] + stage.first_rate * first_rate[k]);
                right[k] = free * start[k]
                    + stage.mu * this[k]
                    + stage.nu * (before[k] - factor * implicit_before[k])
                    + explicit
                    + kept * first_implicit[k];
                // The new one takes the place of the last but one.
                increment_before[k] = stage.mu * increment[k] + stage.nu * increment_before[k] + explicit;
            }
            std::mem::swap(increment_before, increment);
            Self::solve(system, factor, right, next, implicit_before);
            std::mem::swap(implicit_before, implicit);
            std::mem::swap(before, this);
            std::mem::swap(this, next);
        }
        for k in 0..len {
            next[k] = start[k] + increment[k] + 0.5 * dt * first_implicit[k];
        }
        system.solve_implicit(0.5 * dt, next);
        system.read_state(next)
    }

    fn stability_interval(&self) -> f64 {
        interval(self.most_stages) / self.correction()
    }

    fn stabilised(&self) -> bool {
        false
    }

    fn error_constant(&self) -> Option<f64> {
        Some(ERROR_CONSTANT)
    }

    fn error_bound(&self) -> Option<f64> {
        Some(ERROR_BOUND)
    }

    fn work(&self) -> IntegratorWork {
        self.work
    }

    fn save(&self, saved: &mut SavedState) {
        let IntegratorWork { stages, most_stages, estimates } = self.work;
        saved.counts.extend([self.due, stages, most_stages, estimates].map(|count| count as u64));
        saved.reals.push(self.measured);
        saved.reals.extend_from_slice(&self.power.direction);
    }

    fn load(&mut self, saved: &SavedState) -> Result<(), SceneError> {
        let [due, stages, most_stages, estimates] = saved.counts_of()?;
        let [stages, most_stages, estimates] = [stages, most_stages, estimates].map(|count| count as usize);
        self.due = due as usize;
        self.work = IntegratorWork { stages, most_stages, estimates };
        if let [measured, direction @ ..] = saved.reals.as_slice() {
            self.measured = *measured;
            self.power.direction.clear();
            self.power.direction.extend_from_slice(direction);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
