//! The equation for the velocities of droplets of other viscosities in surroundings.
//!
//! A product with the double layers of droplets in unbounded fluid takes far less time than the double layers that the
//! surroundings reflect. So with the matrix K of the former and W of the latter, the equation `(K + W) u = b` is solved
//! for `K u`, with an iteration for K within each product. W reflects smooth fields, so the outer iteration converges
//! fast. Its first residual comes with the flow of the forces, for a guess from earlier states. Later products are
//! rougher as the residual falls.

use motile_base::internal::dot;
use stokes_boundary_integrals::internal::gmres::{Gmres, Outcome};

use crate::SpaceError;
use crate::flow::MOST_ITERATIONS;
use crate::guess::Guess;

/// Residual over the right-hand side.
const TOLERANCE: f64 = 1e-11;
/// Part of the error that a product may have which goes to the surroundings, and to the iteration within it.
const PART: f64 = 0.2;
/// Least accurate products.
const ROUGHEST: f64 = 0.05;
/// Residual of a guess, over the right-hand side, above which the residual is computed once more with all digits.
///
/// The points of droplets alias the waves of a near wall. Rough products may leave out more of these than they promise.
const FAR: f64 = 1e-4;

/// An equation with two matrices.
pub(crate) trait Reflecting {
    /// Writes the product with the matrix in unbounded fluid.
    fn free(&mut self, x: &[f64], out: &mut [f64]);

    /// Writes the product with the matrix of the surroundings, with an error of about `accuracy` times its size.
    fn reflected(&mut self, x: &[f64], out: &mut [f64], accuracy: f64) -> Result<(), SpaceError>;
}

/// Memory for the iterations, and earlier states for guesses.
#[derive(Debug, Clone)]
pub(crate) struct Reflections {
    pub(crate) guess: Guess,
    inner: Gmres,
    outer: Gmres,
    residual: Vec<f64>,
    /// What solves the equation for K u, and u.
    change: Vec<f64>,
    moved: Vec<f64>,
}

impl Default for Reflections {
    fn default() -> Self {
        let (residual, change, moved) = (Vec::new(), Vec::new(), Vec::new());
        let (inner, outer) = (Gmres::default(), Gmres::recycling());
        Self { guess: Guess::default(), inner, outer, residual, change, moved }
    }
}

impl Reflections {
    /// Forgets earlier states.
    pub(crate) fn forget(&mut self) {
        self.guess.forget();
        self.outer.forget();
    }

    /// Returns how many earlier states there are, and all numbers that a checkpoint keeps of them and of the directions
    /// of earlier iterations, for so many velocities.
    pub(crate) fn save(&self, velocities: usize) -> (u64, Vec<f64>) {
        let mut saved: Vec<f64> = self.guess.save().collect();
        saved.extend(self.outer.save(velocities));
        (self.guess.len() as u64, saved)
    }

    /// Takes over what [`Reflections::save`] returned, for states and velocities of these lengths. Returns false if it
    /// does not fit.
    pub(crate) fn load(&mut self, [state, velocities]: [usize; 2], count: u64, saved: &[f64]) -> bool {
        self.forget();
        let end = (count as usize).saturating_mul(state + velocities);
        let Some((states, directions)) = saved.split_at_checked(end) else { return false };
        self.guess.load([state, velocities], states);
        self.outer.restore(velocities, directions);
        self.guess.len() as u64 == count && self.outer.save(velocities).len() == directions.len()
    }

    /// Solves `(K + W) u = b` for u, which holds a guess on entry. Takes `b - W u` for this guess.
    pub(crate) fn solve(
        &mut self,
        equation: &mut impl Reflecting,
        right: &[f64],
        u: &mut [f64],
    ) -> Result<Outcome, SpaceError> {
        let Self { residual, change, moved, .. } = self;
        for list in [&mut *residual, &mut *change, &mut *moved] {
            list.clear();
            list.resize(right.len(), 0.0);
        }
        equation.free(u, residual);
        residual.iter_mut().zip(right).for_each(|(residual, right)| *residual = right - *residual);
        let (scale, left) = (dot(right, right).sqrt(), dot(residual, residual).sqrt());
        if scale == 0.0 {
            u.fill(0.0);
            return Ok(Outcome::default());
        }
        if left.is_nan() || left <= TOLERANCE * scale {
            return Ok(Outcome { iterations: 0, residual: left / scale });
        }
        let first = self.improve(equation, u, TOLERANCE * scale / left)?;
        if left <= FAR * scale {
            return Ok(Outcome { residual: first.residual * left / scale, ..first });
        }
        let Self { residual, change, moved, .. } = self;
        equation.free(moved, change);
        residual.iter_mut().zip(&*change).for_each(|(residual, change)| *residual -= change);
        equation.reflected(moved, change, 0.0)?;
        residual.iter_mut().zip(&*change).for_each(|(residual, change)| *residual -= change);
        let left = dot(residual, residual).sqrt();
        if left.is_nan() || left <= TOLERANCE * scale {
            return Ok(Outcome { residual: left / scale, ..first });
        }
        let second = self.improve(equation, u, TOLERANCE * scale / left)?;
        let iterations = first.iterations + second.iterations;
        Ok(Outcome { iterations, residual: second.residual * left / scale })
    }

    /// Adds the solution for the residual to u, until what is left is this part of it.
    fn improve(&mut self, equation: &mut impl Reflecting, u: &mut [f64], goal: f64) -> Result<Outcome, SpaceError> {
        let Self { inner, outer, residual, change, moved, .. } = self;
        change.fill(0.0);
        let mut failed = Ok(());
        let product = |v: &[f64], out: &mut [f64], accuracy: f64| {
            if v.iter().all(|value| *value == 0.0) {
                out.fill(0.0);
                return;
            }
            let accuracy = (PART * accuracy).clamp(PART * TOLERANCE, ROUGHEST);
            moved.fill(0.0);
            inner.solve(|x, out, _| equation.free(x, out), v, moved, accuracy, MOST_ITERATIONS);
            if failed.is_ok() {
                failed = equation.reflected(moved, out, accuracy);
            }
            if failed.is_err() {
                // This ends the iteration.
                out.fill(f64::NAN);
            }
            out.iter_mut().zip(v).for_each(|(out, v)| *out += v);
        };
        let outcome = outer.solve(product, residual, change, goal, MOST_ITERATIONS);
        failed?;
        moved.fill(0.0);
        let last = inner.solve(|x, out, _| equation.free(x, out), change, moved, PART * goal, MOST_ITERATIONS);
        u.iter_mut().zip(&*moved).for_each(|(u, moved)| *u += moved);
        Ok(Outcome { residual: outcome.residual.max(last.residual), ..outcome })
    }
}

#[cfg(test)]
mod tests;
