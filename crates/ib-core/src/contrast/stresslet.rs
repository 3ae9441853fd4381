//! The stresslet of droplets of another viscosity, from the flow outside of them.

use stokes_layers::gmres::{Gmres, dot};

use super::{Contrast, MOST_ITERATIONS, TOLERANCE, check};
use crate::{FlowError, Vec2};

impl Contrast {
    /// The stresslet (force times length) of the flow outside of a droplet under these forces, velocities of all other
    /// forces and velocities at the nodes of all droplets, as of the last solution.
    ///
    /// The first moment of the forces and `(eta - eta_in) sum (v n + n v) ds`, whose sum it is (Cowley (2.49)), are
    /// larger than it by the ratio of viscosities, and so are their errors. But outside the flow is also that of a
    /// double layer in a fluid of one viscosity,
    ///
    /// `eta (v - v_other) = K q` on the interfaces, K that of [`stokes_layers::dense::DoubleLayerMatrix`],
    ///
    /// which is the flow of no forces inside as well, so that `S = sum (q n + n q) ds` without its trace. A rigid
    /// motion of a droplet, which K takes to zero, has no part in it; where a droplet is pulled the flow is that of the
    /// forces which carry its net force and torque besides, R F, whose moment is added.
    pub(crate) fn stresslet(
        &self,
        droplet: usize,
        forces: &[Vec2],
        other: &[Vec2],
        velocities: &[Vec2],
    ) -> Result<[[f64; 2]; 2], FlowError> {
        let (nodes, viscosity) = (self.nodes, self.viscosity);
        let (mut matrix, mut curves) = (self.matrix.clone(), self.curves.clone());
        // A of these viscosities is K.
        curves.iter_mut().for_each(|curve| (curve.outside, curve.contrast) = (0.0, 1.0));
        let mut right = vec![0.0; 2 * nodes];
        for (i, (velocity, other)) in velocities.iter().zip(other).enumerate() {
            let own = viscosity * (velocity - other);
            [right[i], right[nodes + i]] = [own.x, own.y];
        }
        for (motion, left) in self.rigid.motions(nodes).zip(self.left.chunks_exact(2 * nodes)) {
            let amount = dot(left, &right);
            right.iter_mut().zip(motion).for_each(|(value, motion)| *value -= amount * motion);
        }
        // The other eigenvalues of K are about one half.
        let product = |q: &[f64], out: &mut [f64], _: f64| {
            matrix.product(&curves, q, out);
            out.iter_mut().for_each(|out| *out *= 2.0);
            for (motion, weighted) in self.rigid.motions(nodes).zip(self.rigid.weighted(nodes)) {
                let amount = dot(weighted, q);
                out.iter_mut().zip(motion).for_each(|(out, motion)| *out += amount * motion);
            }
        };
        let mut density = right.clone();
        let outcome = Gmres::default().solve(product, &right, &mut density, TOLERANCE, MOST_ITERATIONS);
        check("the stresslet of droplets of another viscosity", outcome)?;

        let mut pulled = vec![Vec2::ZERO; nodes];
        self.rigid_part(forces, &mut pulled);
        let curve = &self.curves[droplet];
        let [mut along, mut across] = [0.0; 2];
        for (k, (normal, place)) in curve.normals.iter().zip(&curve.positions).enumerate() {
            let i = curve.first + k;
            // K was taken twice.
            let (q, force) = (2.0 * Vec2::new(density[i], density[nodes + i]), pulled[i]);
            along += q.x * normal.x - q.y * normal.y + 0.5 * (force.x * place.x - force.y * place.y);
            across += q.x * normal.y + q.y * normal.x + 0.5 * (force.x * place.y + force.y * place.x);
        }
        Ok([[along, across], [across, -along]])
    }
}
