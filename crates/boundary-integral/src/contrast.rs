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
mod tests {
    use num_complex::Complex64;
    use stokes_grid::Drive;

    use super::*;
    use crate::{
        Channel, FreeSpace, PeriodicBox, domain::sealed::Region, far::Division, solver::divide,
        surroundings::surroundings,
    };

    const NODES: usize = 96;

    /// Largest error of `A E = eta_out E` at the first of two interfaces and of `A E = 0` at the second, for the rigid
    /// motions E of the first, relative to the mean viscosity; and whether a uniform expansion keeps its flux.
    fn errors(domain: &impl Region, second: Complex64, viscosities: [f64; 2]) -> [f64; 2] {
        let tolerance = 1e-15;
        let mut surroundings = surroundings(domain.kind(), tolerance);
        let mut transforms = Transforms::new(NODES);
        let mut interfaces = vec![Interface::new(NODES), Interface::new(NODES)];
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / NODES as f64;
        let outline = |k: usize| Complex64::new(1.2 * angle(k).cos(), 0.9 * angle(k).sin()) * Complex64::cis(0.3);
        for (interface, (centre, viscosity)) in
            interfaces.iter_mut().zip([Complex64::new(0.2, 0.1), second].into_iter().zip(viscosities))
        {
            let forces = (0..NODES).map(|_| Complex64::default());
            interface.load(&mut transforms, viscosity, (0..NODES).map(|k| centre + outline(k)), forces, NODES);
        }
        surroundings.prepare(&mut interfaces, &mut transforms).unwrap();
        let (mut layers, mut near) = (Layers::new(NODES), Near::new(NODES, tolerance));
        layers.load(&interfaces, surroundings.wave());
        let mut far = surroundings.far(tolerance);
        divide(surroundings.as_ref(), &interfaces, &mut layers, &mut far, &mut Division::new());
        near.find(&mut interfaces, &mut transforms, &surroundings.images());
        near.add_forces(&interfaces, &mut transforms, true, &mut layers.out);
        layers.prepare_stress();
        let mut contrast = Contrast::default();
        contrast.load(&interfaces, 1.0);
        let normals = vec![0.0; 4 * NODES];
        let mut parts = Parts {
            interfaces: &interfaces,
            layers: &mut layers,
            far: &mut far,
            near: &near,
            surroundings: surroundings.as_mut(),
            transforms: &mut transforms,
            accuracy: tolerance,
        };
        let mut apply = |v: &[f64]| {
            let mut out = vec![0.0; 4 * NODES];
            product(&mut parts, &contrast.contrasts, &contrast.scales, &normals, &[0.0; 2], v, &mut out);
            out
        };
        let motions: [fn(Complex64) -> Complex64; 3] =
            [|_| Complex64::new(1.0, 0.0), |_| Complex64::new(0.0, 1.0), |z| Complex64::new(0.0, 1.0) * z];
        let mut rigid = 0.0f64;
        for motion in motions {
            let mut v = vec![0.0; 4 * NODES];
            for (i, z) in interfaces[0].position.iter().enumerate() {
                (v[i], v[NODES + i]) = (motion(*z).re, motion(*z).im);
            }
            let out = apply(&v);
            for (i, out) in out.iter().enumerate() {
                let expected = contrast.scales[0] * if i < 2 * NODES { v[i] } else { 0.0 };
                rigid = rigid.max((out - expected).abs());
            }
        }
        // The flux through the first curve is multiplied by its inner viscosity.
        let flux = |v: &[f64]| -> f64 {
            (0..NODES).map(|i| v[i] * interfaces[0].tangent[i].im - v[NODES + i] * interfaces[0].tangent[i].re).sum()
        };
        let smooth: Vec<f64> = (0..4 * NODES).map(|i| (3.0 * angle(i % NODES)).sin() + 0.4).collect();
        let expanded: Vec<f64> = (0..4 * NODES)
            .map(|i| {
                let t = interfaces[0].tangent[i % NODES];
                smooth[i]
                    + if i < NODES {
                        t.im
                    } else if i < 2 * NODES {
                        -t.re
                    } else {
                        0.0
                    }
            })
            .collect();
        let kept = flux(&apply(&expanded)) - viscosities[0] * contrast.scales[0] * flux(&expanded);
        [rigid, kept.abs() / flux(&expanded)]
    }

    #[test]
    fn rigid_motions_and_flux() {
        for viscosities in [[10.0, 3.0], [1000.0, 0.001], [0.001, 50.0]] {
            let free = errors(&FreeSpace, Complex64::new(3.1, 0.4), viscosities);
            assert!(free[0] < 1e-12 && free[1] < 1e-12, "{free:?}");
            let close = errors(&FreeSpace, Complex64::new(2.65, 0.4), viscosities);
            assert!(close[0] < 1e-11, "{close:?}");
            let square = errors(&PeriodicBox::new(6.0, 7.0).unwrap(), Complex64::new(3.2, 3.6), viscosities);
            assert!(square[0] < 1e-12, "{square:?}");
            let large = errors(&PeriodicBox::new(14.0, 15.0).unwrap(), Complex64::new(2.9, 0.6), viscosities);
            assert!(large[0] < 1e-12, "{large:?}");
            for drive in [Drive::ZeroGradient, Drive::ZeroFlux] {
                let channel = Channel::new(7.0, 4.0).unwrap().with_drive(drive).unwrap();
                let channel = errors(&channel, Complex64::new(3.5, -0.4), viscosities);
                assert!(channel[0] < 1e-11, "{channel:?}");
            }
        }
    }
}
