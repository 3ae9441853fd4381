//! The error of a step.

use super::Dynamics;
use crate::{Hydrodynamics, SceneError, System};

/// Estimates the error of a step from the defect that the trapezoidal rule has in it: states y and rates f at its start
/// (0) and end (1) give the third derivative of the solution,
///
/// `dt^3 y''' = 12 (y_0 - y_1) + 6 dt (f_0 + f_1)`,
///
/// and the error is an integrator's own constant ([`crate::integrator::Integrator::error_constant`]) times that.
#[derive(Debug, Default)]
pub(crate) struct ErrorEstimate {
    rate_before: Vec<f64>,
    /// The state before anything is done at the end of the step, and the rate after.
    after: Vec<f64>,
    rate_after: Vec<f64>,
    lengths_after: Vec<usize>,
    scales: Vec<f64>,
}

impl ErrorEstimate {
    /// Looks at `start`, the state that the step begins with.
    pub(crate) fn begin<H: Hydrodynamics>(&mut self, system: &mut System<H>, start: &[f64]) -> Result<(), SceneError> {
        self.rate_before.resize(start.len(), 0.0);
        system.whole_rate(start, &mut self.rate_before)?;
        self.scales.resize(start.len(), 1.0);
        system.write_scales(&mut self.scales);
        Ok(())
    }

    /// Looks at the state that the integrator has left, before bodies do anything about it at the end of the step.
    pub(crate) fn advanced<H: Hydrodynamics>(&mut self, system: &System<H>) {
        system.write_state(&mut self.after);
    }

    /// Returns the error of a step of `dt` (time) from `start`, whose parts had the lengths `lengths`. It is the root
    /// mean square over a body, in units of its scales, of the worst body (no dimension). `None` if markers have been
    /// inserted or removed, so that states cannot be compared.
    pub(crate) fn end<H: Hydrodynamics>(
        &mut self,
        system: &mut System<H>,
        (start, lengths): (&[f64], &[usize]),
        dt: f64,
        constant: f64,
    ) -> Result<Option<f64>, SceneError> {
        system.write_lengths(&mut self.lengths_after);
        self.rate_after.resize(system.state_len(), 0.0);
        if self.lengths_after != *lengths {
            system.present_rate(&mut self.rate_after)?;
            return Ok(None);
        }
        system.whole_rate(&self.after, &mut self.rate_after)?;
        let Self { rate_before, after, rate_after, scales, .. } = self;
        for (((rate, before), y0), y1) in rate_after.iter_mut().zip(&*rate_before).zip(start).zip(&*after) {
            *rate = constant * (12.0 * (y0 - y1) + 6.0 * dt * (before + *rate));
        }
        Ok(Some(system.error_norm(rate_after, scales)))
    }

    /// After a step that does not stay: what the bodies keep of the flow belongs to the present state again.
    pub(crate) fn return_to<H: Hydrodynamics>(
        &mut self,
        system: &mut System<H>,
        state: &[f64],
    ) -> Result<(), SceneError> {
        self.rate_before.resize(state.len(), 0.0);
        system.present_rate(&mut self.rate_before)
    }
}
