//! The Stokeslets between all nodes of two curves, stored.

use crate::greens::{Nodes, PairKernel, Stokeslet, Vectors, ln};

use super::sums::{Shift, shifts};

/// Components xx, xy, yy of all pairs, shift after shift, the weights of Kress included on the same curve.
#[derive(Debug, Clone, Default)]
pub(crate) struct StoredStokeslets {
    nodes: usize,
    components: [Vec<f64>; 3],
}

impl StoredStokeslets {
    /// With the weights of Kress for the pairs of a curve with itself.
    pub(crate) fn fill<K: PairKernel>(&mut self, kernel: &K, kress: Option<&[f64]>, [target, source]: [&Nodes; 2]) {
        let nodes = target.len();
        self.nodes = nodes;
        let both = [nodes, source.len()];
        let len = nodes * shifts(both, kress.is_some()).count();
        for component in &mut self.components {
            component.resize(len, 0.0);
        }
        for Shift { index, d, count } in shifts(both, kress.is_some()) {
            let (t, s) = (target.window(0, count), source.window(d, count));
            let weight = kress.map_or(0.0, |kress| kress[d]);
            let range = index * nodes..index * nodes + count;
            let [a, b, c] = &mut self.components;
            let (a, b, c) = (&mut a[range.clone()], &mut b[range.clone()], &mut c[range]);
            for i in 0..count {
                let Stokeslet { q, xx, xy, yy } = kernel.stokeslet(&t, &s, i);
                let log = weight - 0.5 * ln(q);
                (a[i], b[i], c[i]) = (xx + log, xy, yy + log);
            }
        }
    }

    /// Adds the flow of the forces of one shift, near += G F of the sources and far += G F of the targets.
    pub(crate) fn apply(
        &self,
        Shift { index, d, count }: Shift,
        [t, s]: [&Vectors; 2],
        near: &mut Vectors,
        far: &mut Vectors,
    ) {
        let range = index * self.nodes..index * self.nodes + count;
        let [a, b, c] = &self.components;
        let (a, b, c) = (&a[range.clone()], &b[range.clone()], &c[range]);
        let (tx, ty) = (&t.x[..count], &t.y[..count]);
        let (sx, sy) = (&s.x[d..d + count], &s.y[d..d + count]);
        let (ux, uy) = (&mut near.x[..count], &mut near.y[..count]);
        let (vx, vy) = (&mut far.x[d..d + count], &mut far.y[d..d + count]);
        for i in 0..count {
            ux[i] += a[i] * sx[i] + b[i] * sy[i];
            uy[i] += b[i] * sx[i] + c[i] * sy[i];
            vx[i] += a[i] * tx[i] + b[i] * ty[i];
            vy[i] += b[i] * tx[i] + c[i] * ty[i];
        }
    }
}
