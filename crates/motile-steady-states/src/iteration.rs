//! Iterations: their limits, results and failures, damping, continuation in steps.

use crate::SteadyError;

/// Iterations before giving up: Newton's method that converges at all needs about six, secants about ten.
pub(crate) const MOST_ITERATIONS: usize = 30;
/// Largest change of a coefficient at once, in units of the radius and the mean density: beyond a third the linearised
/// equations do not describe a droplet. A change of a sixth they describe well.
pub(crate) const LARGEST_CHANGE: f64 = 0.35;
pub(crate) const USUAL_CHANGE: f64 = 0.15;
/// Factor of a step in time or along a branch after one that has failed.
pub(crate) const SHORTER: f64 = 0.4;
/// Corrections and steps of which less than this part can be taken are given up.
pub(crate) const LEAST_PART: f64 = 0.01;
/// Corrections below this change the matrix by a hundredth: the next iteration reuses it, for as long as corrections
/// shrink tenfold.
pub(crate) const REUSABLE: f64 = 1e-2;
pub(crate) const CONTRACTION: f64 = 0.1;
/// Remedy where no state is found.
const REMEDY: &str = "Start from a run or from a neighbouring state, or use more nodes";

/// Result of an iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Outcome {
    pub(crate) iterations: usize,
    /// Largest rate of change of a coefficient (1/time).
    pub(crate) residual: f64,
    /// Condition number of the linear equations; not a number if none were solved.
    pub(crate) condition: f64,
}

impl Default for Outcome {
    fn default() -> Self {
        Self { iterations: 0, residual: f64::INFINITY, condition: f64::NAN }
    }
}

impl Outcome {
    /// Returns the error of an iteration that ended here.
    pub(crate) fn failure(&self) -> SteadyError {
        let Self { residual, iterations, .. } = *self;
        SteadyError::NoConvergence { residual, iterations, remedy: REMEDY }
    }
}

/// Returns the damped step: takes a correction whose largest coefficient is `size` whole if that is small enough, else
/// in part, and half as much each time that `take` fails, as it does for a droplet that reaches into a wall.
pub(crate) fn damped<T>(size: f64, mut take: impl FnMut(f64) -> Result<T, SteadyError>) -> Result<T, SteadyError> {
    let mut part = (LARGEST_CHANGE / size).min(1.0);
    loop {
        match take(part) {
            Err(_) if part > LEAST_PART => part *= 0.5,
            outcome => return outcome,
        }
    }
}

/// Returns the continuation from a `start` to 1 in steps that are halved where `next` fails: it is given the last
/// result and how far to go.
pub(crate) fn in_steps<T>(
    (mut last, mut reached): (T, f64),
    mut step: f64,
    mut next: impl FnMut(&T, f64) -> Result<T, SteadyError>,
) -> Result<T, SteadyError> {
    while reached < 1.0 {
        let ahead = (reached + step).min(1.0);
        match next(&last, ahead) {
            Ok(found) => (last, reached) = (found, ahead),
            Err(_) if step > LEAST_PART => step *= 0.5,
            Err(error) => return Err(error),
        }
    }
    Ok(last)
}

#[cfg(test)]
mod tests;
