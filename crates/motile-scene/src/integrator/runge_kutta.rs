//! The classical Runge-Kutta method.

use super::{Dynamics, Integrator, IntegratorWork};
use crate::{SceneError, saved_state::SavedState};

/// That of the midpoint rule: adaptive steps are as long as its steps would be, and their errors far smaller.
const ERROR_CONSTANT: f64 = 1.0 / 15.0;

/// The classical Runge-Kutta method, fourth order, four evaluations per step, for smooth motions without particles,
/// whose implicit parts it refuses: drops, shells and rigid bodies in flows.
///
/// Adaptive steps take its errors for errors of a method of second order.
#[derive(Debug, Clone, Default)]
pub struct RungeKutta {
    start: Vec<f64>,
    stage: Vec<f64>,
    rate: Vec<f64>,
    sum: Vec<f64>,
    steps: usize,
}

impl Integrator for RungeKutta {
    fn name(&self) -> &'static str {
        "the Runge-Kutta method"
    }

    fn step(&mut self, system: &mut dyn Dynamics, dt: f64) -> Result<(), SceneError> {
        system.write_state(&mut self.start);
        let count = self.start.len();
        for list in [&mut self.rate, &mut self.stage, &mut self.sum] {
            list.resize(count, 0.0);
        }
        self.steps += 1;

        self.sum.fill(0.0);
        system.add_implicit(&self.start, 1.0, &mut self.sum);
        if self.sum.iter().any(|&part| part != 0.0) {
            return Err(SceneError::implicit_parts(self.name()));
        }
        system.present_rate(&mut self.rate)?;
        self.sum.copy_from_slice(&self.rate);
        for (part, weight) in [(0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            for ((y, y0), f) in self.stage.iter_mut().zip(&self.start).zip(&self.rate) {
                *y = y0 + part * dt * f;
            }
            system.rate(&self.stage, &mut self.rate)?;
            self.sum.iter_mut().zip(&self.rate).for_each(|(sum, rate)| *sum += weight * rate);
        }
        self.start.iter_mut().zip(&self.sum).for_each(|(y, sum)| *y += dt / 6.0 * sum);
        system.read_state(&self.start)
    }

    /// Returns the root of `1 - x + x^2/2 - x^3/6 + x^4/24 = 1`.
    fn stability_interval(&self) -> f64 {
        2.785_293_563_405_282
    }

    fn stabilised(&self) -> bool {
        false
    }

    fn error_constant(&self) -> Option<f64> {
        Some(ERROR_CONSTANT)
    }

    fn work(&self) -> IntegratorWork {
        IntegratorWork { stages: 4 * self.steps, most_stages: 4 * self.steps.min(1), estimates: 0 }
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
