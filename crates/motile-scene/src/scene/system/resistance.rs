//! Velocities of bodies whose forces depend on them.

use super::bodies::Bodies;
use crate::{FlowError, Hydrodynamics};
use motile_base::{SolveReport, Vec2};

/// Fraction of the velocities, in the norm of what is dissipated, by which forces may miss them.
const TOLERANCE: f64 = 1e-8;
/// Part at which a solution is taken that comes no nearer, for flows that are iterated themselves.
const ACCEPTED: f64 = 1e-5;
/// Most iterations.
const MOST: usize = 200;

/// Solves `v = V(F - D v)` for the velocities v of the markers, V being the velocities of the flow for given forces and
/// -D v the forces of [`crate::Viscous`] bodies, by conjugate gradients. V is affine in the forces, `V(F - g) = V(F) -
/// M g` with a symmetric M, so that `1 + M D` is symmetric and positive in the product `u D v`.
#[derive(Debug, Default)]
pub(super) struct Resistance {
    /// Forces that do not depend on velocities (force).
    forces: Vec<Vec2>,
    /// Velocities that forces are computed from (length per time).
    guess: Vec<Vec2>,
    /// Those of the flow under these forces.
    found: Vec<Vec2>,
    residual: Vec<Vec2>,
    direction: Vec<Vec2>,
    trial: Vec<Vec2>,
    resisting: Vec<Vec2>,
}

/// Writes -D v of all bodies (force).
fn resist(bodies: &mut Bodies, velocities: &[Vec2], out: &mut [Vec2]) {
    out.fill(Vec2::ZERO);
    let Bodies { list, markers, .. } = bodies;
    for (body, group) in list.iter_mut().zip(markers.groups()) {
        if let Some(viscous) = body.as_viscous() {
            viscous.add_viscous_forces(&velocities[group.range.clone()], &mut out[group.range.clone()]);
        }
    }
}

fn dot(a: &[Vec2], b: &[Vec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

impl Resistance {
    /// Makes the markers' forces and velocities those of each other.
    pub(super) fn solve<H: Hydrodynamics>(
        &mut self,
        flow: &mut H,
        bodies: &mut Bodies,
    ) -> Result<SolveReport, FlowError> {
        if !bodies.list.iter_mut().any(|body| body.as_viscous().is_some()) {
            return flow.velocities(&mut bodies.markers);
        }
        self.forces.clone_from(&bodies.markers.forces);
        // The latest velocities are near to the next ones.
        self.guess.clone_from(&bodies.markers.velocities);
        let count = self.forces.len();
        for list in [&mut self.residual, &mut self.direction, &mut self.trial, &mut self.resisting] {
            list.resize(count, Vec2::ZERO);
        }
        self.trial.copy_from_slice(&self.guess);
        let mut report = self.evaluate(flow, bodies)?;
        self.found.clone_from(&bodies.markers.velocities);
        for ((r, v), w) in self.residual.iter_mut().zip(&self.found).zip(&self.guess) {
            *r = *v - *w;
        }
        self.direction.copy_from_slice(&self.residual);
        let mut left = self.dissipated(bodies, |all| &all.residual);
        let mut iterations = 0;
        loop {
            let scale = self.dissipated(bodies, |all| &all.found);
            let reached = (left / scale.max(f64::MIN_POSITIVE)).sqrt();
            if reached <= TOLERANCE || (iterations >= MOST && reached <= ACCEPTED) {
                report.residual = report.residual.max(reached);
                break;
            }
            if iterations >= MOST || reached.is_nan() {
                let what = "the velocities of bodies that resist them";
                return Err(FlowError::NoConvergence { what, iterations, residual: reached, tolerance: TOLERANCE });
            }
            iterations += 1;
            let length = self.dissipated(bodies, |all| &all.direction);
            // As large as the velocities, so that the difference is not lost among them.
            let stretch = (scale.max(left) / length).sqrt();
            for ((t, w), p) in self.trial.iter_mut().zip(&self.guess).zip(&self.direction) {
                *t = *w + *p * stretch;
            }
            report = self.evaluate(flow, bodies)?;
            // M D p, in place of the trial.
            for ((t, v), now) in self.trial.iter_mut().zip(&self.found).zip(&bodies.markers.velocities) {
                *t = (*v - *now) / stretch;
            }
            resist(bodies, &self.direction, &mut self.resisting);
            let step = left / (length - dot(&self.resisting, &self.trial));
            for (k, taken) in self.trial.iter().enumerate() {
                self.guess[k] += self.direction[k] * step;
                self.found[k] -= *taken * step;
                self.residual[k] -= (self.direction[k] + *taken) * step;
            }
            let before = std::mem::replace(&mut left, self.dissipated(bodies, |all| &all.residual));
            for (p, r) in self.direction.iter_mut().zip(&self.residual) {
                *p = *r + *p * (left / before);
            }
        }
        if iterations > 0 {
            self.trial.copy_from_slice(&self.guess);
            let residual = report.residual;
            report = self.evaluate(flow, bodies)?;
            report.residual = report.residual.max(residual);
        }
        Ok(report)
    }

    /// Returns the flow with the forces at the trial velocities.
    fn evaluate<H: Hydrodynamics>(&mut self, flow: &mut H, bodies: &mut Bodies) -> Result<SolveReport, FlowError> {
        resist(bodies, &self.trial, &mut self.resisting);
        let forces = bodies.markers.forces.iter_mut().zip(&self.forces).zip(&self.resisting);
        forces.for_each(|((force, own), resisting)| *force = *own + *resisting);
        flow.velocities(&mut bodies.markers)
    }

    /// Returns `u D u` (energy per time).
    fn dissipated(&mut self, bodies: &mut Bodies, of: impl Fn(&Self) -> &[Vec2]) -> f64 {
        let mut resisting = std::mem::take(&mut self.resisting);
        resist(bodies, of(self), &mut resisting);
        let sum = -dot(of(self), &resisting);
        self.resisting = resisting;
        sum
    }
}
