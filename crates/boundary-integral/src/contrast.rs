//! Interfaces whose fluid has another viscosity than the surroundings.

use ib_core::FlowError;

use crate::{
    far::Far,
    gmres::{Gmres, Outcome},
    interface::{Interface, Transforms},
    layers::Layers,
    near::Near,
    surroundings::{NodeVelocities, Surroundings},
};

const FOUR_PI: f64 = 4.0 * std::f64::consts::PI;

/// What the double layer needs of an evaluation.
pub(crate) struct Parts<'a> {
    pub(crate) interfaces: &'a [Interface],
    pub(crate) layers: &'a mut Layers,
    pub(crate) far: &'a mut Far,
    pub(crate) near: &'a Near,
    pub(crate) surroundings: &'a mut dyn Surroundings,
    pub(crate) transforms: &'a mut Transforms,
    /// How exactly what walls and images add has to be known, relative to the velocities.
    pub(crate) accuracy: f64,
}

/// Solves for the velocities at the nodes,
/// `(eta_in + eta_out)/2 v + 1/(4 pi) sum over interfaces of (eta_in - eta_out) double layer = s`,
/// with s the single layer divided by 4 pi.
#[derive(Debug, Default)]
pub(crate) struct Contrast {
    gmres: Gmres,
    /// Inside minus outside, interface by interface.
    pub(crate) contrasts: Vec<f64>,
    scales: Vec<f64>,
    right: Vec<f64>,
    normals: Vec<f64>,
    deflation: Vec<f64>,
}

impl Contrast {
    /// Forgets what earlier solutions left, so that the next one does not depend on them.
    pub(crate) fn forget(&mut self) {
        self.gmres.forget();
    }

    /// What earlier solutions left for the next.
    pub(crate) fn save(&self) -> (usize, Vec<f64>) {
        self.gmres.save()
    }

    /// Takes back what [`Contrast::save`] wrote.
    pub(crate) fn restore(&mut self, len: usize, kept: &[f64]) {
        self.gmres.restore(len, kept);
    }

    /// Takes over the viscosities; whether any differs from that of the surroundings.
    pub(crate) fn load(&mut self, interfaces: &[Interface], viscosity: f64) -> bool {
        self.contrasts.clear();
        self.scales.clear();
        for interface in interfaces {
            self.contrasts.push(interface.viscosity - viscosity);
            self.scales.push(2.0 / (interface.viscosity + viscosity));
        }
        self.contrasts.iter().any(|contrast| *contrast != 0.0)
    }

    /// Solves for `velocities`, which hold a guess on entry.
    ///
    /// # Errors
    /// No convergence.
    pub(crate) fn solve(
        &mut self,
        mut parts: Parts<'_>,
        single_layer: &[f64],
        velocities: &mut [f64],
        viscosity: f64,
        tolerance: f64,
        most: usize,
    ) -> Result<Outcome, FlowError> {
        let nodes = parts.interfaces[0].nodes();
        self.right.clear();
        self.right.extend_from_slice(single_layer);
        let mut goal = tolerance;
        self.deflation.clear();
        self.normals.clear();
        for (index, interface) in parts.interfaces.iter().enumerate() {
            let scale = self.scales[index];
            self.right[2 * nodes * index..2 * nodes * (index + 1)].iter_mut().for_each(|value| *value *= scale);
            // A rigid motion is multiplied by eta_out alone, so a residual in it counts that much more.
            goal = goal.min(tolerance * viscosity * scale);
            // A uniform expansion is multiplied by eta_in alone. The velocity has none, so the operator may do with it
            // as it likes: what is added makes the factor that of the rest.
            self.deflation.push((1.0 - interface.viscosity * scale).max(0.0) / interface.perimeter());
            // Not `norm`, whose care for overflow is slow.
            self.normals.extend(interface.tangent.iter().map(|t| t.im / t.norm_sqr().sqrt()));
            self.normals.extend(interface.tangent.iter().map(|t| -t.re / t.norm_sqr().sqrt()));
        }
        parts.layers.prepare_stress();
        let Self { gmres, contrasts, scales, right, normals, deflation } = self;
        let outcome = gmres.solve(
            |v, out, accuracy| {
                parts.accuracy = accuracy.max(tolerance);
                product(&mut parts, contrasts, scales, normals, deflation, v, out);
            },
            right,
            velocities,
            goal.max(1e-15),
            most,
        );
        if outcome.residual <= goal.max(1e-15) {
            Ok(outcome)
        } else {
            let Outcome { iterations, residual } = outcome;
            let what = "the solution for a viscosity contrast";
            Err(FlowError::NoConvergence { what, iterations, residual, tolerance: goal })
        }
    }
}

/// `v + scale/(4 pi) double layer + deflation`.
fn product(
    parts: &mut Parts<'_>,
    contrasts: &[f64],
    scales: &[f64],
    normals: &[f64],
    deflation: &[f64],
    velocities: &[f64],
    out: &mut [f64],
) {
    let Parts { interfaces, layers, far, near, surroundings, transforms, accuracy } = parts;
    let nodes = interfaces[0].nodes();
    let all = NodeVelocities { values: velocities, contrasts };
    for (index, (interface, dipoles)) in interfaces.iter().zip(&mut layers.dipoles).enumerate() {
        let (vx, vy) = all.of(index, nodes);
        dipoles.fill(vx, vy, &interface.tangent, contrasts[index] * interface.weight());
    }
    layers.clear();
    layers.add_dipoles(interfaces);
    let Layers { dipoles, out: sums, .. } = &mut **layers;
    far.add_dipoles(interfaces, dipoles, *accuracy, sums);
    surroundings.add_dipoles(interfaces, dipoles, all, *accuracy, transforms, sums);
    near.add_dipoles(velocities, contrasts, nodes, sums);
    for (index, interface) in interfaces.iter().enumerate() {
        let range = 2 * nodes * index..2 * nodes * (index + 1);
        let (x, y) = out[range.clone()].split_at_mut(nodes);
        let (vx, vy) = all.of(index, nodes);
        let (nx, ny) = normals[range].split_at(nodes);
        let factor = scales[index] / FOUR_PI;
        let growth = if deflation[index] > 0.0 {
            let weight = interface.weight();
            let flux: f64 = (0..nodes).map(|i| (vx[i] * nx[i] + vy[i] * ny[i]) * interface.tangent[i].norm()).sum();
            deflation[index] * flux * weight
        } else {
            0.0
        };
        let sum = &sums[index];
        for i in 0..nodes {
            x[i] = vx[i] + factor * sum.x[i] + growth * nx[i];
            y[i] = vy[i] + factor * sum.y[i] + growth * ny[i];
        }
    }
}

#[cfg(test)]
mod tests;
