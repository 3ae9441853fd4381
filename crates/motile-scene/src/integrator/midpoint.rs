//! The midpoint rule.

use super::{Dynamics, Integrator, IntegratorWork};
use crate::{SceneError, saved_state::SavedState};

/// Between the 1/24 of a rate that depends on time alone and the 1/6 of a decay. The estimate has the error of the step
/// in it too, so it is 2.4 and 1.2 times the true error of these two (docs/explanation/time-stepping.md).
const ERROR_CONSTANT: f64 = 1.0 / 15.0;

/// The midpoint rule (Cowley (2.37)), second order, two evaluations per step, with the bodies' implicit parts by
/// backward Euler in the first half step and by the trapezoidal rule over the whole step:
///
/// `y_m = y + dt/2 (f(y) + L y_m)`, `y' = y + dt f(y_m) + dt/2 (L(y) y + L(y') y')`.
#[derive(Debug, Clone, Default)]
pub struct Midpoint {
    start: Vec<f64>,
    stage: Vec<f64>,
    rate: Vec<f64>,
    steps: usize,
}

impl Integrator for Midpoint {
    fn name(&self) -> &'static str {
        "the midpoint rule"
    }

    fn step(&mut self, system: &mut dyn Dynamics, dt: f64) -> Result<(), SceneError> {
        system.write_state(&mut self.start);
        self.rate.resize(self.start.len(), 0.0);
        self.stage.resize(self.start.len(), 0.0);
        self.steps += 1;

        system.present_rate(&mut self.rate)?;
        for ((y, y0), f) in self.stage.iter_mut().zip(&self.start).zip(&self.rate) {
            *y = y0 + 0.5 * dt * f;
        }
        system.solve_implicit(0.5 * dt, &mut self.stage);

        system.rate(&self.stage, &mut self.rate)?;
        for ((y, y0), f) in self.stage.iter_mut().zip(&self.start).zip(&self.rate) {
            *y = y0 + dt * f;
        }
        system.add_implicit(&self.start, 0.5 * dt, &mut self.stage);
        system.solve_implicit(0.5 * dt, &mut self.stage);
        system.read_state(&self.stage)
    }

    fn stability_interval(&self) -> f64 {
        2.0
    }

    fn error_constant(&self) -> Option<f64> {
        Some(ERROR_CONSTANT)
    }

    fn work(&self) -> IntegratorWork {
        IntegratorWork { stages: 2 * self.steps, most_stages: 2 * self.steps.min(1), estimates: 0 }
    }

    fn save(&self, saved: &mut SavedState) {
        saved.counts.push(self.steps as u64);
    }

    fn load(&mut self, saved: &SavedState) -> Result<(), SceneError> {
        let [steps] = saved.counts_of()?;
        self.steps = steps as usize;
        Ok(())
    }
}
