//! Critical points, at which a disturbance starts to grow, along one parameter and in two.

use num_complex::Complex64;

use crate::iteration::MOST_ITERATIONS;
use crate::spectrum::{NO_GROWTH, eigenvector};
use crate::system::System;
use crate::{Eigenmode, Parameter, SteadyError, SteadyState};

/// First step of a parameter over its value, and the largest one: growth rates are smooth over a few parts in a
/// hundred.
const FIRST_STEP: f64 = 5e-3;
const LARGEST_STEP: f64 = 0.1;

/// Critical point: a steady state with a disturbance that neither grows nor decays. At zero frequency it is a branch
/// point or a fold, else a Hopf point.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Critical {
    /// State at the critical value of the parameter, which its description holds.
    pub state: SteadyState,
    /// Critical mode; its growth rate is below 1e-8 D/R^2.
    pub mode: Eigenmode,
}

impl SteadyState {
    /// Returns the mode of this state whose eigenvalue is nearest to the eigenvalue of a neighbouring state's mode.
    pub(crate) fn track(&self, mode: &Eigenmode) -> Result<Eigenmode, SteadyError> {
        let reduced = System::new(self.setup())?.reduced(self.point(), mode.symmetry.part())?;
        let (value, _) = eigenvector(&reduced.matrix, mode.value)?;
        Ok(Eigenmode { value: Complex64::new(value.re, value.im.abs()), ..mode.clone() })
    }

    /// Finds the steady state at a nearby value of a parameter, using Newton's method from this one.
    ///
    /// # Errors
    /// Returns an error for a description without this parameter; no convergence; a state that the nodes do not
    /// resolve.
    pub fn at(&self, parameter: Parameter, value: f64) -> Result<Self, SteadyError> {
        self.moved_to(&parameter.with(self.setup(), value)?)
    }

    /// Returns the critical point of a mode along a parameter, where the mode neither grows nor decays: by secants on
    /// its growth rate.
    ///
    /// # Errors
    /// Returns an error for a description without this parameter; no critical point nearby; no convergence on the way.
    pub fn critical(&self, mode: &Eigenmode, parameter: Parameter) -> Result<Critical, SteadyError> {
        let start = parameter.get(self.setup()).unwrap_or(f64::NAN);
        let unit = parameter.scale(self.setup());
        let rate = self.diffusion_rate();
        let (mut before, mut rate_before) = (start, mode.value.re);
        let mut now = start + FIRST_STEP * unit;
        let (mut state, mut mode) = (self.clone(), mode.clone());
        for _ in 0..MOST_ITERATIONS {
            if mode.value.re.abs() < NO_GROWTH * rate {
                return Ok(Critical { state, mode });
            }
            state = state.at(parameter, now)?;
            mode = state.track(&mode)?;
            let slope = (mode.value.re - rate_before) / (now - before);
            (before, rate_before) = (now, mode.value.re);
            let step = -mode.value.re / slope;
            if !step.is_finite() {
                break;
            }
            now += step.clamp(-LARGEST_STEP * unit, LARGEST_STEP * unit);
        }
        Err(SteadyError::not_found(
            "a critical point",
            [start, now],
            "Start closer to it, from a point of a branch on either side",
        ))
    }
}

impl Critical {
    /// Returns the stability boundary in two parameters: for each of the `values` of `second`, in small steps from the
    /// value here, the critical point along `first`; `found` is called with each. Ends before the first value without a
    /// point.
    ///
    /// # Errors
    /// Returns an error for a description without one of the parameters.
    pub fn curve(
        &self,
        [first, second]: [Parameter; 2],
        values: impl IntoIterator<Item = f64>,
        mut found: impl FnMut(&Self),
    ) -> Result<Vec<Self>, SteadyError> {
        let mut curve: Vec<Self> = Vec::new();
        let value = |critical: &Self, parameter: Parameter| parameter.get(critical.state.setup()).unwrap_or(f64::NAN);
        for goal in values {
            let last = curve.last().unwrap_or(self);
            // A straight line through the last two points.
            let guess = match curve.as_slice() {
                [.., a, b] => {
                    let slope = (value(b, first) - value(a, first)) / (value(b, second) - value(a, second));
                    value(b, first) + slope * (goal - value(b, second))
                }
                _ => value(last, first),
            };
            let setup = first.with(&second.with(last.state.setup(), goal)?, guess)?;
            let next = last.state.moved_to(&setup).and_then(|state| {
                let mode = state.track(&last.mode)?;
                state.critical(&mode, first)
            });
            let Ok(next) = next else { break };
            found(&next);
            curve.push(next);
        }
        Ok(curve)
    }
}
