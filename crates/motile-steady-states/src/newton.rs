//! Newton's method for steady states.

use crate::SteadyError;
use crate::iteration::{CONTRACTION, MOST_ITERATIONS, Outcome, REUSABLE, damped};
use crate::model::TOLERANCE;
use crate::modes::Part;
use crate::system::{Along, Equations, Point, System};

/// Convergence: rates have an error of TOLERANCE, and corrections are off by TOLERANCE times a condition number of
/// about 1e3, so smaller ones are round-off.
const SMALLEST_CORRECTION: f64 = 3e3 * TOLERANCE;
/// Largest rate of change (in units of D/R^2) of a state: solutions among mirror-symmetric droplets that are not
/// steady against the other symmetry have rates of order one, the errors of nodes lie far below.
const LARGEST_RATE: f64 = 0.1;

impl System {
    /// Runs Newton's method from a point, for some coefficients of the state. With an equation for a parameter
    /// also for that, and the system is then the one at the value found. On failure, the point is as far as it came.
    pub(crate) fn newton(
        &mut self,
        point: &mut Point,
        part: Part,
        along: Option<&Along>,
    ) -> Result<Outcome, SteadyError> {
        let mut outcome = Outcome::default();
        let (mut kept, mut before) = (None::<Equations>, f64::INFINITY);
        for iteration in 1..=MOST_ITERATIONS {
            let rates = self.residual(point)?;
            outcome.residual = rates.amax();
            if !outcome.residual.is_finite() {
                break;
            }
            // At a branch point the equations are singular, and a state that is there already needs none. With a
            // parameter the first correction is always solved for: the predictor lies beside the branch.
            if (iteration > 1 || along.is_none()) && self.is_steady(outcome.residual) {
                return Ok(outcome);
            }
            outcome.iterations = iteration;
            let reused = kept.is_some();
            let equations = match kept.take() {
                Some(equations) => equations,
                None => {
                    let jacobian = self.rough_jacobian(point, part, &rates)?;
                    let equations = self.border(point, part, &jacobian, along)?;
                    outcome.condition = equations.condition();
                    equations
                }
            };
            let correction = self.correction(&equations, &rates)?;
            let parameter = along.map_or(0.0, |along| correction.parameter / along.parameter.scale(&self.model.setup));
            let size = correction.state.amax().max(parameter.abs());
            if reused && size > CONTRACTION * before {
                // The matrix is too old: the same iteration with a new one.
                before = f64::INFINITY;
                continue;
            }
            damped(size, |part| {
                let next = point.corrected(&correction, part);
                match along {
                    Some(along) => {
                        let mut system = self.moved(along.parameter, part * correction.parameter)?;
                        system.load(&next)?;
                        *self = system;
                    }
                    None => self.load(&next)?,
                }
                *point = next;
                Ok(())
            })?;
            if size < SMALLEST_CORRECTION {
                outcome.residual = self.residual(point)?.amax();
                let steady = outcome.residual < LARGEST_RATE * self.model.rate_unit();
                return if steady { Ok(outcome) } else { Err(outcome.failure()) };
            }
            kept = (size < REUSABLE).then_some(equations);
            before = size;
        }
        Err(outcome.failure())
    }

    /// Steady to round-off: the rates (1/time) hold second derivatives of concentrations, whose error is TOLERANCE
    /// times the square of the largest wave number, half the number of nodes. Area and particles are the same as for
    /// the droplet.
    fn is_steady(&self, residual: f64) -> bool {
        let floor = TOLERANCE * (0.5 * self.model.nodes() as f64).powi(2) * self.model.rate_unit();
        residual < floor && self.model.lacks().iter().all(|lack| lack.abs() < SMALLEST_CORRECTION)
    }
}

#[cfg(test)]
mod tests;
