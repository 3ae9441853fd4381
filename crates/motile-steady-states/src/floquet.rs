//! Stability of limit cycles: Floquet multipliers.

use std::f64::consts::PI;

use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::cycle::weights;
use crate::elimination::Elimination;
use crate::modes::Part;
use crate::spectrum::{complement, eigenvalues};
use crate::{LimitCycle, Stability, SteadyError};

/// Steps of the time integration, of third order, over half a period.
const STEPS: usize = 80;

/// Floquet multipliers of a limit cycle: factors by which disturbances grow over a period.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Multipliers {
    /// Multipliers, largest modulus first, of disturbances that conserve area and particles; without the two of shifts
    /// in time and along the channel, which are 1.
    pub values: Vec<Complex64>,
    /// Error estimate: the distance from 1 of the computed multipliers of these two shifts, over half a period.
    pub neutral: f64,
}

impl Multipliers {
    /// Returns the stability of the cycle, undecided if the largest multiplier has the modulus 1 within its error.
    #[must_use]
    pub fn stability(&self) -> Stability {
        // The error is that of half a period, of whose multiplier the square is listed.
        let largest = self.values.first().map_or(0.0, |value| value.norm());
        Stability::of_rate(largest - 1.0, 2.0 * largest.sqrt() * self.neutral)
    }

    /// Returns true if all disturbances decay by more than the error of their multipliers.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.stability() == Stability::Stable
    }
}

impl LimitCycle {
    /// Returns the Floquet multipliers: squares of the eigenvalues of the map that takes a disturbance to its mirror
    /// image half a period later. The linearised equations are integrated in time by the third-order method Radau IIA,
    /// which damps fast modes, with trigonometric interpolation of their matrix between the instants.
    ///
    /// # Errors
    /// Returns an error for a flow that cannot be solved for; singular equations; eigenvalues that do not converge.
    pub fn multipliers(&self) -> Result<Multipliers, SteadyError> {
        let mut own = self.copy(&self.system.model.setup)?;
        let (count, n) = (own.states.len(), own.system.modes.len());
        let odd = own.system.modes.part(Part::Odd);
        let mut jacobians = Vec::new();
        let mut conserved = None;
        for point in own.points()? {
            jacobians.push(own.tau * own.system.jacobian(&point, Part::Full)?);
            if conserved.is_none() {
                own.system.load(&point)?;
                conserved = Some(own.system.conserved_gradients(&point.base, Part::Full)?);
            }
        }
        let basis = complement(&conserved.unwrap_or_default(), n);
        let matrix = |phase: f64| {
            let weights: Vec<[f64; 2]> = (0..count).map(|k| weights(phase, k, count)).collect();
            DMatrix::from_fn(n, n, |i, j| {
                // Entries between the symmetries change their sign after half a period.
                let which = usize::from(odd.contains(&i) != odd.contains(&j));
                jacobians.iter().zip(&weights).map(|(jacobian, w)| w[which] * jacobian[(i, j)]).sum()
            })
        };
        let singular = || SteadyError::singular("the growth on a cycle", "Use another number of nodes");
        let mut flow = propagated(matrix, basis.clone(), STEPS).ok_or_else(singular)?;
        for row in odd {
            flow.row_mut(row).neg_mut();
        }
        let mut half = eigenvalues(&(basis.transpose() * flow))?;
        let distance = |value: &Complex64| (value - 1.0).norm();
        half.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let shifts: Vec<Complex64> = half.drain(..2.min(half.len())).collect();
        let mut values: Vec<Complex64> = half.into_iter().map(|value| value * value).collect();
        values.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        Ok(Multipliers { values, neutral: shifts.iter().map(distance).fold(0.0, f64::max) })
    }
}

/// Returns the solutions of `dy/dt = A(t) y` at t = pi from those at 0, the columns of `flow`, in so many steps of the
/// method Radau IIA of third order; `None` for a singular step.
fn propagated(matrix: impl Fn(f64) -> DMatrix<f64>, mut flow: DMatrix<f64>, steps: usize) -> Option<DMatrix<f64>> {
    let (n, step) = (flow.nrows(), PI / steps as f64);
    for k in 0..steps {
        let start = step * k as f64;
        let (first, second) = (step * matrix(start + step / 3.0), step * matrix(start + step));
        let mut stages = DMatrix::identity(2 * n, 2 * n);
        for (row, weights) in [[5.0 / 12.0, -1.0 / 12.0], [0.75, 0.25]].into_iter().enumerate() {
            for (column, (weight, matrix)) in weights.into_iter().zip([&first, &second]).enumerate() {
                let mut block = stages.view_mut((row * n, column * n), (n, n));
                block -= weight * matrix;
            }
        }
        let mut right = DMatrix::zeros(2 * n, flow.ncols());
        right.rows_mut(0, n).copy_from(&flow);
        right.rows_mut(n, n).copy_from(&flow);
        flow = Elimination::new(stages).solve(right)?.rows(n, n).into_owned();
    }
    Some(flow)
}

#[cfg(test)]
mod tests;
