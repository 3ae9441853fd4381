//! Sums over all pairs of nodes of one or two curves, the kernel evaluated for each pair.
//!
//! Pairs are visited by cyclic shift: node i of one curve with node i + d of the other, for all i, then the next d.
//! Both directions of a pair share one evaluation of the kernel, and the loop over i has no sums across i, so it runs
//! in vector registers.

use motile_base::internal::widely;

use crate::greens::{PairKernel, Stokeslet, Vectors, ln};

use super::arrays::{Dipoles, NodeArrays};

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

/// Shifts that visit every pair of nodes of a target and a source once; the target has no more nodes than the source.
pub(crate) fn shifts([target, source]: [usize; 2], same: bool) -> impl Iterator<Item = Shift> {
    let first = usize::from(same);
    let last = if same { source / 2 + 1 } else { source };
    (first..last).map(move |d| Shift { index: d - first, d, count: if same && 2 * d == source { d } else { target } })
}

/// Sums over all pairs, with their working memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct PairSums {
    sources: Vectors,
}

impl PairSums {
    /// Visits all pairs of nodes of a target and a source curve, which has no fewer nodes and may be the `same` one.
    /// There, `apply` adds the flow of a shift at the targets and at the sources, the latter in an array twice as long.
    pub(crate) fn visit(
        &mut self,
        same: bool,
        [target, source]: [usize; 2],
        out: &mut [Vectors],
        mut apply: impl FnMut(Shift, &mut Vectors, &mut Vectors),
    ) {
        let n = out[source].x.len();
        self.sources.clear(2 * n);
        widely(
            #[inline(always)]
            || {
                for shift in shifts([out[target].x.len(), n], same) {
                    apply(shift, &mut out[target], &mut self.sources);
                }
            },
        );
        // The doubled array is folded into the cyclic one.
        let out = &mut out[source];
        for (out, sources) in [(&mut out.x, &self.sources.x), (&mut out.y, &self.sources.y)] {
            for i in 0..n {
                out[i] += sources[i] + sources[i + n];
            }
        }
    }
}

/// Adds the flow of the forces of one shift; `weight` is added to the logarithm.
#[inline(always)]
pub(crate) fn single_layer<K: PairKernel>(
    kernel: &K,
    weight: f64,
    shift: Shift,
    [target, source]: [&NodeArrays; 2],
    near: &mut Vectors,
    far: &mut Vectors,
) {
    let (t, s) = (target.nodes.window(0, shift.count), source.nodes.window(shift.d, shift.count));
    add_forces(
        shift,
        [&target.force, &source.force],
        near,
        far,
        #[inline(always)]
        |i| {
            let Stokeslet { q, xx, xy, yy } = kernel.stokeslet(&t, &s, i);
            let log = weight - 0.5 * ln(q);
            [xx + log, xy, yy + log]
        },
    );
}

/// Adds the flow of the dipoles of one shift, the stress of every pair recomputed: for systems whose stored components
/// would not fit into the cache.
#[inline(always)]
pub(crate) fn double_layer<K: PairKernel>(
    kernel: &K,
    shift: Shift,
    [target, source]: [&NodeArrays; 2],
    near: &mut Vectors,
    far: &mut Vectors,
) {
    let (t, s) = (target.nodes.window(0, shift.count), source.nodes.window(shift.d, shift.count));
    let dipoles = [&target.dipoles, &source.dipoles];
    add_dipoles(
        shift,
        dipoles,
        near,
        far,
        #[inline(always)]
        |i, source, target| kernel.act(&t, &s, i, source, target),
    );
}

/// Adds `near += G F` of the sources and `far += G F` of the targets, G = (xx, xy, yy) of pair i by `stokeslet(i)`.
#[inline(always)]
pub(crate) fn add_forces(
    Shift { d, count, .. }: Shift,
    [t, s]: [&Vectors; 2],
    near: &mut Vectors,
    far: &mut Vectors,
    stokeslet: impl Fn(usize) -> [f64; 3],
) {
    let (tx, ty) = (&t.x[..count], &t.y[..count]);
    let (sx, sy) = (&s.x[d..d + count], &s.y[d..d + count]);
    let (ux, uy) = (&mut near.x[..count], &mut near.y[..count]);
    let (vx, vy) = (&mut far.x[d..d + count], &mut far.y[d..d + count]);
    for i in 0..count {
        let [xx, xy, yy] = stokeslet(i);
        ux[i] += xx * sx[i] + xy * sy[i];
        uy[i] += xy * sx[i] + yy * sy[i];
        vx[i] += xx * tx[i] + xy * ty[i];
        vy[i] += xy * tx[i] + yy * ty[i];
    }
}

/// Adds the flow of dipoles, `act(i, source, target)` being the velocities at the target and at the source of pair i.
#[inline(always)]
pub(crate) fn add_dipoles(
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
