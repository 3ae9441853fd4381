//! Where a disturbance starts to grow, in one parameter and in two.

use num_complex::Complex64;

use crate::spectrum::{NO_GROWTH, eigenvector};
use crate::system::System;
use crate::{Eigenmode, Parameter, SteadyError, SteadyState};

/// Iterations before giving up.
const MOST_ITERATIONS: usize = 30;
/// Relative step of a parameter to start with.
const FIRST_STEP: f64 = 5e-3;
/// Largest relative change of a parameter at once.
const LARGEST_STEP: f64 = 0.1;

/// A state with a disturbance that neither grows nor decays: a branch point or a fold where the frequency is zero, a
/// Hopf point where it is not.
#[derive(Debug, Clone)]
pub struct Critical {
    /// The state, its description having the critical value of the parameter.
    pub state: SteadyState,
    /// The disturbance; its growth rate is zero up to what was solved for.
    pub mode: Eigenmode,
}

impl SteadyState {
    /// The eigenvalue near that of a mode of a neighbouring state.
    pub(crate) fn track(&self, mode: &Eigenmode) -> Result<Eigenmode, SteadyError> {
        let reduced = System::new(self.setup())?.reduced(self.point(), mode.symmetry.part())?;
        let (value, _) = eigenvector(&reduced.matrix, mode.value)?;
        Ok(Eigenmode { value: Complex64::new(value.re, value.im.abs()), ..mode.clone() })
    }

    /// This state at another value of a parameter, nearby.
    ///
    /// # Errors
    /// No convergence.
    pub fn at(&self, parameter: Parameter, value: f64) -> Result<Self, SteadyError> {
        self.moved_to(&parameter.with(self.setup(), value)?)
    }

    /// Goes along a parameter to where a mode neither grows nor decays, by secants on its growth rate.
    ///
    /// # Errors
    /// A description without this parameter, no such point nearby.
    pub fn critical(&self, mode: &Eigenmode, parameter: Parameter) -> Result<Critical, SteadyError> {
        let start = parameter.get(self.setup()).unwrap_or(f64::NAN);
        let unit = start.abs().max(1e-2);
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
        Err(SteadyError::NotFound {
            what: "a critical point",
            from: start,
            to: now,
            remedy: "start closer to it, from a point of a branch on either side",
        })
    }
}

impl Critical {
    /// The curve of such points in two parameters: at each value of `second`, nearby values following each other, the
    /// point in `first`. Ends before the first value at which it is not found.
    ///
    /// # Errors
    /// A description without one of the parameters.
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
