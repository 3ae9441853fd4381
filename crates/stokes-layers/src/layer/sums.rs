//! Sums over all pairs of nodes of one or two curves.
//!
//! Pairs are visited by cyclic shift: node i of one curve with node i + d of the other, for all i, then the next d.
//! Both directions of a pair share one evaluation of the kernel, and the loop over i has no sums across i, so it runs
//! in vector registers.

use std::f64::consts::{PI, TAU};

use crate::greens::{PairKernel, Stokeslet, Vectors, ln};

use super::direct::NodeArrays;

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

/// The shifts that visit every pair of nodes of a target and a source once; the target has no more nodes.
pub(crate) fn shifts([target, source]: [usize; 2], same: bool) -> impl Iterator<Item = Shift> {
    let first = usize::from(same);
    let last = if same { source / 2 + 1 } else { source };
    (first..last).map(move |d| Shift { index: d - first, d, count: if same && 2 * d == source { d } else { target } })
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

/// Sums over all pairs, with room to work in.
#[derive(Debug, Clone, Default)]
pub(crate) struct PairSums {
    sources: Vectors,
}

impl PairSums {
    /// Visits all pairs of nodes of a target and a source curve, which has no fewer nodes, the `same` one or not:
    /// `apply` adds the flow of a shift at the targets and at the sources, the latter in an array twice as long.
    pub(crate) fn visit(
        &mut self,
        same: bool,
        [target, source]: [usize; 2],
        out: &mut [Vectors],
        mut apply: impl FnMut(Shift, &mut Vectors, &mut Vectors),
    ) {
        let n = out[source].x.len();
        self.sources.clear(2 * n);
        for shift in shifts([out[target].x.len(), n], same) {
            apply(shift, &mut out[target], &mut self.sources);
        }
        // The doubled array is folded into the cyclic one.
        let out = &mut out[source];
        for (out, sources) in [(&mut out.x, &self.sources.x), (&mut out.y, &self.sources.y)] {
            for i in 0..n {
                out[i] += sources[i] + sources[i + n];
            }
        }
    }
}

/// Adds the flow of the forces of one shift, `weight` being added to the logarithm.
#[inline(always)]
pub(crate) fn single_layer<K: PairKernel>(
    kernel: &K,
    weight: f64,
    Shift { d, count, .. }: Shift,
    [target, source]: [&NodeArrays; 2],
    near: &mut Vectors,
    far: &mut Vectors,
) {
    let (t, s) = (target.nodes.window(0, count), source.nodes.window(d, count));
    let (tx, ty) = (&target.force.x[..count], &target.force.y[..count]);
    let (sx, sy) = (&source.force.x[d..d + count], &source.force.y[d..d + count]);
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
