//! The stress between all nodes of two curves, stored or recomputed for each product.

use num_complex::Complex64;

use crate::greens::{Nodes, PairKernel, Vectors};

use super::{
    direct::NodeArrays,
    sums::{Shift, shifts},
};

/// The symmetric products of velocity and normal that the stress acts on, at the nodes of a curve and stored twice
/// in a row: `v_x n_x`, `v_x n_y + v_y n_x`, `v_y n_y`, times a weight.
#[derive(Debug, Default, Clone)]
pub(crate) struct Dipoles {
    pub(crate) xx: Vec<f64>,
    pub(crate) s: Vec<f64>,
    pub(crate) yy: Vec<f64>,
}

impl Dipoles {
    /// None at any of so many nodes.
    pub(crate) fn clear(&mut self, nodes: usize) {
        for array in [&mut self.xx, &mut self.s, &mut self.yy] {
            array.clear();
            array.resize(2 * nodes, 0.0);
        }
    }

    /// From velocities and derivatives of the position by the parameter; `n ds = -i (dX/dalpha) dalpha`.
    pub(crate) fn fill(&mut self, (vx, vy): (&[f64], &[f64]), tangents: &[Complex64], weight: f64) {
        let n = tangents.len();
        for array in [&mut self.xx, &mut self.s, &mut self.yy] {
            array.resize(2 * n, 0.0);
        }
        for (i, t) in tangents.iter().enumerate() {
            let (nx, ny) = (t.im * weight, -t.re * weight);
            self.xx[i] = vx[i] * nx;
            self.s[i] = vx[i] * ny + vy[i] * nx;
            self.yy[i] = vy[i] * ny;
        }
        for array in [&mut self.xx, &mut self.s, &mut self.yy] {
            array.copy_within(..n, n);
        }
    }
}

/// Components xxx, xxy, xyy, yyy of all pairs, shift after shift.
#[derive(Debug, Clone, Default)]
pub(crate) struct StoredStress {
    nodes: usize,
    components: [Vec<f64>; 4],
}

impl StoredStress {
    pub(crate) fn fill<K: PairKernel>(&mut self, kernel: &K, [target, source]: [&Nodes; 2], same: bool) {
        let nodes = target.len();
        self.nodes = nodes;
        let both = [nodes, source.len()];
        let len = nodes * shifts(both, same).count();
        for component in &mut self.components {
            component.resize(len, 0.0);
        }
        for Shift { index, d, count } in shifts(both, same) {
            let (t, s) = (target.window(0, count), source.window(d, count));
            let range = index * nodes..index * nodes + count;
            let [a, b, c, e] = &mut self.components;
            let (a, b) = (&mut a[range.clone()], &mut b[range.clone()]);
            let (c, e) = (&mut c[range.clone()], &mut e[range]);
            for i in 0..count {
                [a[i], b[i], c[i], e[i]] = kernel.stress(&t, &s, i);
            }
        }
    }

    /// Adds the flow of the dipoles of one shift, near += T P of the sources and far += T P of the targets.
    pub(crate) fn apply(&self, shift: Shift, dipoles: [&Dipoles; 2], near: &mut Vectors, far: &mut Vectors) {
        let Shift { index, count, .. } = shift;
        let range = index * self.nodes..index * self.nodes + count;
        let [a, b, c, e] = &self.components;
        let (a, b) = (&a[range.clone()], &b[range.clone()]);
        let (c, e) = (&c[range.clone()], &e[range]);
        accumulate(shift, dipoles, near, far, |i, source, target| {
            let act = |[xx, s, yy]: [f64; 3]| [a[i] * xx + b[i] * s + c[i] * yy, b[i] * xx + c[i] * s + e[i] * yy];
            // The stress is odd in the distance.
            [act(source), act(target).map(|u| -u)]
        });
    }
}

/// Adds the flow of the dipoles of one shift, the stress of every pair recomputed: for systems whose stored
/// components would not fit into the cache.
#[inline(always)]
pub(crate) fn double_layer<K: PairKernel>(
    kernel: &K,
    shift: Shift,
    [target, source]: [&NodeArrays; 2],
    near: &mut Vectors,
    far: &mut Vectors,
) {
    let Shift { d, count, .. } = shift;
    let (t, s) = (target.nodes.window(0, count), source.nodes.window(d, count));
    let dipoles = [&target.dipoles, &source.dipoles];
    accumulate(shift, dipoles, near, far, |i, source, target| kernel.act(&t, &s, i, source, target));
}

#[inline(always)]
fn accumulate(
    Shift { d, count, .. }: Shift,
    [t, s]: [&Dipoles; 2],
    near: &mut Vectors,
    far: &mut Vectors,
    act: impl Fn(usize, [f64; 3], [f64; 3]) -> [[f64; 2]; 2],
) {
    let (txx, ts, tyy) = (&t.xx[..count], &t.s[..count], &t.yy[..count]);
    let (sxx, ss, syy) = (&s.xx[d..d + count], &s.s[d..d + count], &s.yy[d..d + count]);
    let (ux, uy) = (&mut near.x[..count], &mut near.y[..count]);
    let (vx, vy) = (&mut far.x[d..d + count], &mut far.y[d..d + count]);
    for i in 0..count {
        let [at_target, at_source] = act(i, [sxx[i], ss[i], syy[i]], [txx[i], ts[i], tyy[i]]);
        ux[i] += at_target[0];
        uy[i] += at_target[1];
        vx[i] += at_source[0];
        vy[i] += at_source[1];
    }
}

#[cfg(test)]
mod tests;
