//! Time steps.

use crate::{Hydrodynamics, SceneError, System};

/// Advances the state of all bodies by one step.
pub trait Integrator: std::fmt::Debug + Send {
    /// Advances the states of `system` by `dt` (time): reads them with [`System::write_state`], computes rates with
    /// [`System::present_rate`] and [`System::rate`], and leaves the new ones with [`System::read_state`]. The clock, the calls before and after a step and the return to the last good
    /// state after an error are the scene's.
    ///
    /// # Errors
    /// Those of the bodies and of the flow.
    fn step<H: Hydrodynamics>(&mut self, system: &mut System<H>, dt: f64) -> Result<(), SceneError>;

    /// Length of the interval of stability on the negative real axis: a mode that decays at the rate r is stable for
    /// `dt < interval / r`. No dimension; 2 for the midpoint rule, for which bodies estimate their limits.
    fn stability_interval(&self) -> f64;
}

/// The midpoint rule (thesis (2.37)), second order, two evaluations a step, with the bodies' implicit parts by backward
/// Euler in the first half step and by the trapezoidal rule over the whole step:
///
/// `y_m = y + dt/2 (f(y) + L y_m)`, `y' = y + dt f(y_m) + dt/2 (L(y) y + L(y') y')`.
#[derive(Debug, Clone, Default)]
pub struct Midpoint {
    start: Vec<f64>,
    stage: Vec<f64>,
    rate: Vec<f64>,
}

impl Integrator for Midpoint {
    fn step<H: Hydrodynamics>(&mut self, system: &mut System<H>, dt: f64) -> Result<(), SceneError> {
        system.write_state(&mut self.start);
        self.rate.resize(self.start.len(), 0.0);
        self.stage.resize(self.start.len(), 0.0);

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
}
