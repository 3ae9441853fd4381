//! Time steps with the integrators of `motile-scene`.

use motile_base::{internal::Refuse, positive};
use motile_scene::{
    SceneError, StepSize,
    integrator::{Dynamics, Integrator},
};
use sphere_harmonics::count;

use crate::{SpaceDroplet, SpaceError};

/// Part of the step that the tolerance allows which is taken.
const SAFETY: f64 = 0.8;
/// Shortest step, in units of the first stable one.
const SHORTEST: f64 = 1e-6;
/// Most steps of a run.
const MOST_STEPS: f64 = 1e8;

/// Work and conservation of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RunReport {
    /// Steps that were taken.
    pub steps: usize,
    /// Steps that were rejected and repeated.
    pub rejected: usize,
    /// Length of the last full step (time).
    pub last_step: f64,
    /// Largest change of the volume in a step that was undone, over the volume.
    pub volume_error: f64,
}

impl SpaceDroplet {
    /// Advances the droplet to the time `until`, and calls `observe` after each step.
    ///
    /// Use [`crate::RungeKuttaChebyshev`] for swimmers, because they are stiff at a high degree, and
    /// [`crate::Midpoint`] otherwise. Diffusion along the surface is implicit in both. After each
    /// step, the frame moves to the centroid, and the volume returns to its value; what is undone is the truncation of
    /// the motion to the degree.
    ///
    /// ```
    /// use space_droplets::{ConstantTension, RungeKuttaChebyshev, SpaceDroplet, StepSize};
    ///
    /// // A stretched drop relaxes at the rate 0.457 of the second harmonic.
    /// let stretched = |s: [f64; 3]| s.map(|x| x * (1.0 + 0.01 * (3.0 * s[2] * s[2] - 1.0)));
    /// let mut drop = SpaceDroplet::shaped(6, stretched, [1.0, 1.0], ConstantTension::new(1.0)?)?;
    /// let aspect = |drop: &SpaceDroplet| drop.semi_axes()[0] / drop.semi_axes()[2] - 1.0;
    /// let start = aspect(&drop);
    /// let steps = StepSize::Adaptive { tolerance: 1e-6 };
    /// drop.advance(2.0, steps, &mut RungeKuttaChebyshev::new(), |_| {})?;
    /// let rate = (aspect(&drop) / start).ln() / 2.0;
    /// println!("rate {rate:.3}, linear theory {:.3}", -16.0 / 35.0);
    /// assert!((rate + 16.0 / 35.0).abs() < 3e-3);
    /// # Ok::<(), space_droplets::SpaceError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error for a step size or a time that cannot be used, [`SpaceError::Stagnation`], or the errors of
    /// [`SpaceDroplet::evaluate`] unless shorter steps avoid them. The droplet is then in the state of the last
    /// complete step.
    pub fn advance(
        &mut self,
        until: f64,
        step_size: StepSize,
        integrator: &mut dyn Integrator,
        observe: impl FnMut(&Self),
    ) -> Result<RunReport, SpaceError> {
        advance(self, until, step_size, integrator, observe)
    }
}

/// State that a run advances: one droplet or several.
pub(crate) trait Runs: Dynamics {
    /// The time.
    fn time_mut(&mut self) -> &mut f64;
    /// Computes the flow, unless it is known.
    fn update(&mut self) -> Result<(), SpaceError>;
    /// Returns the error of the last evaluation for an integrator, if there was one.
    fn failure(&mut self) -> &mut Option<SpaceError>;
    /// Writes all rates of the present state, whose flow is known.
    fn write_rates(&self, rates: &mut Vec<f64>);
    /// Returns an estimate of the fastest rate of the explicit part (1/time).
    fn fastest(&self) -> f64;
    /// Centres frames, restores volumes, computes the flow, and returns the largest relative change of a volume.
    fn finish_step(&mut self) -> Result<f64, SpaceError>;
    /// Returns the defect of the trapezoidal rule in a step from the state `start` with the rates `before`.
    fn defect(&self, start: &[f64], before: &[f64], dt: f64) -> f64;
}

/// Advances to the time `until`; see [`SpaceDroplet::advance`].
pub(crate) fn advance<R: Runs>(
    run: &mut R,
    until: f64,
    step_size: StepSize,
    integrator: &mut dyn Integrator,
    mut observe: impl FnMut(&R),
) -> Result<RunReport, SpaceError> {
    step_size.check()?;
    let begin = *run.time_mut();
    positive("the length of the run", until - begin)?;
    run.update()?;
    let shortest = SHORTEST / run.fastest().max(1.0 / (until - begin));
    if shortest * MOST_STEPS < SHORTEST * (until - begin) {
        let what = "the run would take more than 1e8 steps";
        return Err(SpaceError::refused(what, "", "Use a smaller tension, a weaker activity or a shorter run"));
    }
    let bound = integrator.error_bound();
    let (constant, tolerance) = match step_size {
        StepSize::Adaptive { tolerance } => (integrator.error_constant(), tolerance),
        StepSize::OfLimit(_) => (bound.and(integrator.error_constant()), bound.unwrap_or(1.0)),
        _ => (None, 1.0),
    };
    if constant.is_none() && matches!(step_size, StepSize::Adaptive { .. }) {
        let what = format!("the error of a step of {} cannot be estimated", integrator.name());
        return Err(SpaceError::refused(what, "", "Use another step size than `StepSize::Adaptive`"));
    }
    let (mut start, mut before) = (Vec::new(), Vec::new());
    let mut allowed = f64::INFINITY;
    let mut report = RunReport::default();
    while *run.time_mut() < until {
        run.update()?;
        let now = *run.time_mut();
        let stable = integrator.stability_interval() / run.fastest();
        let full = match step_size {
            StepSize::Fixed(dt) => dt,
            StepSize::OfLimit(part) => (part * stable).min(allowed),
            _ => (0.8 * stable).min(allowed),
        };
        // Without a limit, the first step is a hundredth of the run.
        let full = if full.is_finite() { full } else { 0.01 * (until - now) };
        if full < shortest {
            return Err(SpaceError::Stagnation { time: now, step: full });
        }
        let left = until - now;
        let last = full >= left * (1.0 - 1e-9);
        // The last two steps are of one length.
        let dt = if last { left } else { full.min(0.5 * left) };
        run.write_state(&mut start);
        run.write_rates(&mut before);
        *run.failure() = None;
        let outcome = match integrator.step(run, dt) {
            Ok(()) => run.finish_step(),
            // The integrator knows the error of a stage in words only.
            Err(error) => Err(run.failure().take().unwrap_or_else(|| error.into())),
        };
        let (error, drift) = match outcome {
            Ok(drift) => (constant.map_or(0.0, |c| c * run.defect(&start, &before, dt) / tolerance), drift),
            Err(error) if constant.is_none() => {
                run.read_state(&start)?;
                return Err(error);
            }
            Err(error) if dt * 0.25 < shortest => {
                run.read_state(&start)?;
                return Err(error);
            }
            Err(_) => (64.0, 0.0),
        };
        if error > 1.0 {
            run.read_state(&start)?;
            allowed = dt * (SAFETY / error.cbrt()).clamp(0.1, 0.9);
            report.rejected += 1;
            continue;
        }
        if constant.is_some() {
            allowed = dt * (SAFETY / error.cbrt().max(1e-3)).clamp(0.2, 3.0);
        }
        *run.time_mut() = if last { until } else { now + dt };
        report.steps += 1;
        report.last_step = full;
        report.volume_error = report.volume_error.max(drift);
        observe(run);
    }
    Ok(report)
}

impl SpaceDroplet {
    /// Centres the frame, restores the volume, and returns the change of the volume over itself.
    pub(crate) fn restore(&mut self) -> Result<f64, SpaceError> {
        self.update_surface()?;
        let drift = (self.surface.volume() / self.volume - 1.0).abs();
        self.centre();
        Ok(drift)
    }

    /// Returns the defect of the trapezoidal rule in a step, `12 (y_0 - y_1) + 6 dt (f_0 + f_1)`: the mean over the
    /// sphere, positions in units of the radius, particles in units of their mean.
    pub(crate) fn defect_of(&self, start: &[f64], before: &[f64], dt: f64) -> f64 {
        let n = count(self.degree);
        let entry = |k: usize| 12.0 * (start[k] - self.state[k]) + 6.0 * dt * (before[k] + self.flow.rates[k]);
        let norm = |range: std::ops::Range<usize>| range.map(|k| entry(k).powi(2)).sum::<f64>();
        let area = 4.0 * std::f64::consts::PI;
        // The motion of the frame is no deformation.
        let shape = (0..3).map(|i| norm(i * n + 1..(i + 1) * n)).sum::<f64>() / area;
        let particles = norm(3 * n..4 * n) / self.state[3 * n].powi(2).max(f64::MIN_POSITIVE);
        (shape / self.radius.powi(2) + particles).sqrt()
    }

    /// Returns an estimate of the fastest rate of the explicit part (1/time): tension, gathering of particles, what is
    /// not implicit of the diffusion, and the motion of the parameters.
    pub(crate) fn rate_bound(&self) -> f64 {
        let p = self.degree as f64;
        let smallest = self.surface.area.iter().fold(f64::INFINITY, |least, area| least.min(*area));
        let wave = p / (2.0 * (self.viscosities[0] + self.viscosities[1]) * smallest.sqrt());
        let (concentrations, tensions) = (&self.flow.concentrations, &self.flow.tensions);
        let tension = tensions.iter().fold(0.0_f64, |most, tension| most.max(tension.abs()));
        let gathering = concentrations.iter().map(|&c| (c * self.tension.slope(c)).abs()).fold(0.0, f64::max);
        let excess = (1.0 / smallest - 1.0 / self.radius.powi(2)).max(0.0);
        let spreading = self.diffusivity * p * (p + 1.0) * excess;
        let strain = self.gradient.iter().flatten().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        wave * (tension + gathering) + spreading + strain + self.edge.map_or(0.0, |edge| 1.0 / edge.time)
    }

    /// Returns the state without dimension: lengths over the radius, particles over their mean.
    pub(crate) fn scaled_state(&self) -> impl Iterator<Item = f64> {
        let particles = 3 * count(self.degree)..4 * count(self.degree);
        let mean = self.state[particles.start].abs();
        let scales = [1.0 / self.radius, if mean > 0.0 { 1.0 / mean } else { 1.0 }];
        self.state.iter().enumerate().map(move |(k, value)| value * scales[usize::from(particles.contains(&k))])
    }

    /// Writes the rates without the implicit diffusion.
    pub(crate) fn write_explicit(&self, rate: &mut [f64]) {
        rate.copy_from_slice(&self.flow.rates);
        self.each_particle(|decay, k| rate[k] += decay * self.state[k]);
    }

    /// Adds `factor` times the rates of implicit diffusion.
    pub(crate) fn add_diffusion(&self, state: &[f64], factor: f64, out: &mut [f64]) {
        self.each_particle(|decay, k| out[k] -= factor * decay * state[k]);
    }

    /// Solves a step of implicit diffusion.
    pub(crate) fn solve_diffusion(&self, factor: f64, state: &mut [f64]) {
        self.each_particle(|decay, k| state[k] /= 1.0 + factor * decay);
    }

    /// Calls `change` with the rate of implicit diffusion (1/time) and the number of each particle coefficient.
    fn each_particle(&self, mut change: impl FnMut(f64, usize)) {
        let n = count(self.degree);
        let rate = self.diffusivity / self.radius.powi(2);
        for place in 0..n {
            let l = place.isqrt() as f64;
            change(rate * l * (l + 1.0), 3 * n + place);
        }
    }
}

impl Runs for SpaceDroplet {
    fn time_mut(&mut self) -> &mut f64 {
        &mut self.time
    }

    fn update(&mut self) -> Result<(), SpaceError> {
        self.evaluate()
    }

    fn failure(&mut self) -> &mut Option<SpaceError> {
        &mut self.failure
    }

    fn write_rates(&self, rates: &mut Vec<f64>) {
        rates.clone_from(&self.flow.rates);
    }

    fn fastest(&self) -> f64 {
        self.rate_bound()
    }

    fn finish_step(&mut self) -> Result<f64, SpaceError> {
        let drift = self.restore()?;
        self.evaluate()?;
        Ok(drift)
    }

    fn defect(&self, start: &[f64], before: &[f64], dt: f64) -> f64 {
        self.defect_of(start, before, dt)
    }
}

impl Dynamics for SpaceDroplet {
    fn state_len(&self) -> usize {
        self.state.len()
    }

    fn write_state(&self, state: &mut Vec<f64>) {
        state.clone_from(&self.state);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), SceneError> {
        self.state.copy_from_slice(state);
        self.flow.known = false;
        self.flow.solved = false;
        Ok(())
    }

    fn rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        self.read_state(state)?;
        self.present_rate(rate)
    }

    fn present_rate(&mut self, rate: &mut [f64]) -> Result<(), SceneError> {
        if let Err(error) = self.evaluate() {
            self.failure = Some(error.clone());
            return Err(error.into());
        }
        self.write_explicit(rate);
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        self.add_diffusion(state, factor, out);
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        self.solve_diffusion(factor, state);
    }

    fn write_scales(&self, scales: &mut [f64]) {
        let n = count(self.degree);
        scales.fill(self.radius);
        let mean = self.state[3 * n].abs();
        scales[3 * n..4 * n].fill(if mean > 0.0 { mean } else { 1.0 });
    }

    fn fastest_decay(&self) -> f64 {
        self.rate_bound()
    }
}

#[cfg(test)]
mod tests;
