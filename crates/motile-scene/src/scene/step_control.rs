//! Lengths of steps, and the reasons for them.

use motile_base::{InputError, positive, within};
use serde::{Deserialize, Serialize};

use crate::saved_state::SavedState;

/// Length of the steps of a run.
///
/// Errors are of second order in the step, except for two parts that a swimmer has under the midpoint rule: its
/// stabiliser (orders of 1.5 to 1.9 where steps are longer than the marker spacing squared over its diffusivity, and
/// two below) and, on a grid, its filter of short waves (of first order, `dt gamma (q h/2)^4 / (4 eta h)` of a
/// displacement of wave number q). A swimmer of activity -2 in Cowley's units changes by 4e-7 R0 and 2.6e-6 of its mean
/// number of particles by each between steps of 0.002 and 0.001 at h = R0/5.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[non_exhaustive]
pub enum StepSize {
    /// All steps have this length (time). A run refuses it at the start if it is above the stability limit, and returns
    /// an error if the limit falls below it later.
    Fixed(f64),
    /// All steps have this fraction of the stability limit, from 1e-6 to 1. They are shorter if the integrator bounds
    /// the error of such steps ([`crate::integrator::Integrator::error_bound`]), as the Runge-Kutta-Chebyshev method
    /// does.
    OfLimit(f64),
    /// Steps are as long as accuracy and stability allow. This is the default, at a tolerance of 1e-4. The error of
    /// each step is estimated, and steps whose error is above the tolerance or that fail otherwise are retried with a
    /// shorter one.
    Adaptive {
        /// Largest error of a step: root mean square over the entries of a body's state, in units of their scales
        /// ([`crate::Body::write_scales`]: the radius of a droplet for positions). No dimension; errors of 1e-5 to 1e-4
        /// make for speeds right to about 1e-4, at most 0.5 is taken.
        tolerance: f64,
    },
}

impl StepSize {
    /// Refuses a length that is not positive and finite, a fraction of the limit that is not from 1e-6 to 1, a
    /// tolerance that is not positive and at most 0.5.
    ///
    /// # Errors
    /// Returns an error for the value.
    pub fn check(self) -> Result<(), InputError> {
        match self {
            Self::Fixed(dt) => positive("the time step", dt),
            Self::OfLimit(part) => within("the part of the stable step", part, 1e-6, 1.0),
            Self::Adaptive { tolerance } => within("the tolerance of the steps", tolerance, f64::EPSILON, 0.5),
        }
        .map(drop)
    }
}

impl Default for StepSize {
    fn default() -> Self {
        Self::Adaptive { tolerance: 1e-4 }
    }
}

/// Part of what the error would allow that is taken, so that few steps are rejected.
const SAFETY: f64 = 0.8;
/// Bounds of the change of length from step to step.
const GROWTH: f64 = 3.0;
const DECLINE: f64 = 0.1;
/// Change of length after a step in which something went wrong.
const RETREAT: f64 = 0.25;

/// The length of adaptive steps from the errors of the last two (Watts 1984; Gustafsson 1994: the error of the next
/// step is extrapolated from how it changed).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct StepControl {
    /// Length that accuracy allows for the next step (time); 0 before the first.
    pub(crate) next: f64,
    /// Length and error of the last accepted step; 0 if there is none.
    last: [f64; 2],
    /// True after an attempt that was rejected.
    retreated: bool,
}

impl StepControl {
    /// Returns true if an attempt of length `dt` with the error `error` (in units of the tolerance) is accepted.
    pub(crate) fn judge(&mut self, dt: f64, error: f64) -> bool {
        let error = error.max(1e-10);
        let accepted = error <= 1.0;
        // The error of a step is of third order in its length.
        let mut factor = SAFETY * error.powf(-1.0 / 3.0);
        if accepted {
            let [last_dt, last_error] = self.last;
            if last_dt > 0.0 {
                factor = factor.min(factor * dt / last_dt * (last_error / error).powf(1.0 / 3.0));
            }
            // Straight after a step that was rejected there is no reason to try a longer one.
            factor = factor.min(if self.retreated { 1.0 } else { GROWTH });
            self.last = [dt, error];
        } else {
            factor = factor.min(0.9);
        }
        self.retreated = !accepted;
        self.next = dt * factor.max(DECLINE);
        accepted
    }

    /// Records that something went wrong in an attempt of length `dt`.
    pub(crate) fn retreat(&mut self, dt: f64) {
        self.next = RETREAT * dt;
        self.retreated = true;
    }

    pub(crate) fn save(&self, saved: &mut SavedState) {
        saved.reals.extend([self.next, self.last[0], self.last[1]]);
        saved.counts.push(u64::from(self.retreated));
    }

    pub(crate) fn load(saved: &SavedState) -> Option<Self> {
        match (saved.reals.as_slice(), saved.counts.as_slice()) {
            (&[next, dt, error], &[retreated]) => Some(Self { next, last: [dt, error], retreated: retreated == 1 }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
