//! Sums over all pairs of nodes of one or two interfaces.
//!
//! Pairs are visited by cyclic shift: node i of one curve with node i + d of the other, for all i, then the next d.
//! Both directions of a pair share one evaluation of the kernel, and the loop over i has no sums across i, so it runs
//! in vector registers.

use std::f64::consts::{PI, TAU};

use crate::{
    logarithm::ln,
    pair_kernel::{PairKernel, Stokeslet},
    planes::{Planes, Vectors},
    stress::{Dipoles, StressSource},
};

/// The pairs (i, i + d) of one cyclic shift d.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shift {
    /// Position in the list of shifts.
    pub(crate) index: usize,
    /// The shift.
    pub(crate) d: usize,
    /// Number of pairs.
    pub(crate) count: usize,
}

/// The shifts that visit every pair once.
pub(crate) fn shifts(nodes: usize, same: bool) -> impl Iterator<Item = Shift> {
    let first = usize::from(same);
    let last = if same { nodes / 2 + 1 } else { nodes };
    (first..last).map(move |d| Shift { index: d - first, d, count: if same && 2 * d == nodes { d } else { nodes } })
}

/// The weights of the Kress quadrature by shift: `1/2 ln(4 sin^2(pi d/n)) + K_d n/(2 pi)` with
/// `K_d = (1/n) sum over m != 0 of (pi/|m|) exp(2 pi i m d/n)`; at d = 0 the second term alone.
pub(crate) fn kress_weights(nodes: usize) -> Vec<f64> {
    let n = nodes as f64;
    let weight = |d: usize| {
        let angle = TAU * d as f64 / n;
        // One entry for each sign of m, and one for the unpaired wave of an even number of nodes.
        let mut sum: f64 = (1..nodes.div_ceil(2)).map(|m| 2.0 * (angle * m as f64).cos() / m as f64).sum();
        if nodes.is_multiple_of(2) {
            sum += 2.0 * if d.is_multiple_of(2) { 1.0 } else { -1.0 } / n;
        }
        let smooth = 0.5 * sum;
        if d == 0 { smooth } else { (2.0 * (PI * d as f64 / n).sin()).ln() + smooth }
    };
    (0..nodes).map(weight).collect()
}

/// Sums over the pairs of one interface with itself or with another, with room to work in.
#[derive(Debug, Default)]
pub(crate) struct PairSums {
    kress: Vec<f64>,
    far: Vectors,
}

/// Values at the nodes of a target and a source interface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Both<'a, T> {
    pub(crate) target: &'a T,
    pub(crate) source: &'a T,
}

impl PairSums {
    pub(crate) fn new(nodes: usize) -> Self {
        Self { kress: kress_weights(nodes), far: Vectors::default() }
    }

    /// `out_i += sum over j != i of (G_ij + Kress weight) f_j` on one curve, with the diagonal.
    pub(crate) fn single_layer_own<K: PairKernel>(
        &mut self,
        kernel: &K,
        planes: &Planes,
        tangents: &Vectors,
        forces: &Vectors,
        out: &mut Vectors,
    ) {
        let n = self.kress.len();
        for i in 0..n {
            let [xx, xy, yy] = kernel.diagonal(tangents.x[i], tangents.y[i]);
            let log = self.kress[0];
            out.x[i] += (xx + log) * forces.x[i] + xy * forces.y[i];
            out.y[i] += xy * forces.x[i] + (yy + log) * forces.y[i];
        }
        self.far.clear(2 * n);
        for shift in shifts(n, true) {
            let both = Both { target: planes, source: planes };
            let forces = Both { target: forces, source: forces };
            single_layer_shift(kernel, self.kress[shift.d], shift, &both, &forces, out, &mut self.far);
        }
        self.fold(out);
    }

    /// `target_i += sum over j of G_ij f_j` and the reverse for two curves.
    pub(crate) fn single_layer<K: PairKernel>(
        &mut self,
        kernel: &K,
        planes: &Both<'_, Planes>,
        forces: &Both<'_, Vectors>,
        target: &mut Vectors,
        source: &mut Vectors,
    ) {
        let n = self.kress.len();
        self.far.clear(2 * n);
        for shift in shifts(n, false) {
            single_layer_shift(kernel, 0.0, shift, planes, forces, target, &mut self.far);
        }
        self.fold(source);
    }

    /// `out_i += sum over j != i of T_ij P_j` on one curve, without the diagonal.
    pub(crate) fn double_layer_own(&mut self, stress: &dyn StressSource, dipoles: &Dipoles, out: &mut Vectors) {
        let n = self.kress.len();
        self.far.clear(2 * n);
        for shift in shifts(n, true) {
            let both = Both { target: dipoles, source: dipoles };
            stress.apply(shift, &both, out, &mut self.far);
        }
        self.fold(out);
    }

    /// `target_i += sum over j of T_ij P_j` and the reverse for two curves.
    pub(crate) fn double_layer(
        &mut self,
        stress: &dyn StressSource,
        dipoles: &Both<'_, Dipoles>,
        target: &mut Vectors,
        source: &mut Vectors,
    ) {
        let n = self.kress.len();
        self.far.clear(2 * n);
        for shift in shifts(n, false) {
            stress.apply(shift, dipoles, target, &mut self.far);
        }
        self.fold(source);
    }

    /// Adds the doubled array to the cyclic one.
    fn fold(&self, out: &mut Vectors) {
        let n = self.kress.len();
        for (out, far) in [(&mut out.x, &self.far.x), (&mut out.y, &self.far.y)] {
            for i in 0..n {
                out[i] += far[i] + far[i + n];
            }
        }
    }
}

#[inline(always)]
fn single_layer_shift<K: PairKernel>(
    kernel: &K,
    weight: f64,
    Shift { d, count, .. }: Shift,
    planes: &Both<'_, Planes>,
    forces: &Both<'_, Vectors>,
    near: &mut Vectors,
    far: &mut Vectors,
) {
    let (t, s) = (planes.target.window(0, count), planes.source.window(d, count));
    let (tx, ty) = (&forces.target.x[..count], &forces.target.y[..count]);
    let (sx, sy) = (&forces.source.x[d..d + count], &forces.source.y[d..d + count]);
    let (ux, uy) = (&mut near.x[..count], &mut near.y[..count]);
    let (vx, vy) = (&mut far.x[d..d + count], &mut far.y[d..d + count]);
    for i in 0..count {
        let Stokeslet { q, xx, xy, yy } = kernel.stokeslet(&t, &s, i);
        let log = weight - 0.5 * ln(q);
        let (xx, yy) = (xx + log, yy + log);
        ux[i] += xx * sx[i] + xy * sy[i];
        uy[i] += xy * sx[i] + yy * sy[i];
        vx[i] += xx * tx[i] + xy * ty[i];
        vy[i] += xy * tx[i] + yy * ty[i];
    }
}
