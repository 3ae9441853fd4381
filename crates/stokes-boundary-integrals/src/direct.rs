//! Layers between curves that are close to each other, summed node by node.

mod arrays;
mod stored;
mod sums;

use motile_base::internal::widely;

use crate::{
    curve::Curve,
    density::StoredLayers,
    greens::{AnyPair, PairKernel, Vectors},
    plan::Plan,
};
use arrays::NodeArrays;
pub(crate) use arrays::{Dipoles, dipole};
use stored::{StoredStokeslets, StoredStress};
use sums::{PairSums, double_layer, single_layer};

/// Largest number of pairs of curves, and of pairs of nodes, for which the stress between nodes is stored instead of
/// computed in each product. As many stresses take 256 MB, and 200 pairs of curves of 64 nodes 25 MB. Beyond, memory is
/// read no faster than the stress is computed.
const MOST_STORED_PAIRS: usize = 200;
const MOST_STORED_STRESSES: usize = 1 << 23;

/// Evaluates an expression with the kernel of an [`AnyPair`].
macro_rules! with_kernel {
    ($pair:expr, $kernel:ident => $body:expr) => {
        match $pair {
            AnyPair::Free($kernel) => $body,
            AnyPair::Row($kernel) => $body,
            AnyPair::Lattice($kernel) => $body,
            AnyPair::Sheared($kernel) => $body,
        }
    };
}

/// Two curves and the Green's function, or the part of it, that is summed over their nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CurvePair {
    /// The curve with fewer nodes.
    pub(crate) target: usize,
    pub(crate) source: usize,
    /// True for a curve with itself, false for a curve with one of its images.
    pub(crate) own: bool,
    pub(crate) kernel: AnyPair,
}

/// Sums over the nodes of pairs of curves.
#[derive(Debug, Clone, Default)]
pub(crate) struct DirectSums {
    sums: PairSums,
    pub(crate) curves: Vec<NodeArrays>,
    pub(crate) pairs: Vec<CurvePair>,
    /// Stokeslets of the pairs that have a stored curve.
    stokeslets: Vec<StoredStokeslets>,
    /// Stresses of all pairs, if they are stored.
    stresses: Vec<StoredStress>,
    stresses_stored: bool,
}

impl DirectSums {
    /// Takes over the present shapes, and the forces that are given already; `wave` is 2 pi/period of a row of images
    /// along x.
    pub(crate) fn load(&mut self, curves: &[Curve], stored: StoredLayers, wave: Option<f64>) {
        self.curves.resize_with(curves.len(), NodeArrays::default);
        for (index, (arrays, curve)) in self.curves.iter_mut().zip(curves).enumerate() {
            arrays.load(curve, stored.has(index), wave);
        }
        self.pairs.clear();
        self.stresses_stored = false;
    }

    /// Adds the single layers of all pairs, of a curve on itself by the rule of Kress; stores the Stokeslets of pairs
    /// with a stored curve.
    pub(crate) fn add_forces(&mut self, plans: &[Plan], stored: StoredLayers, out: &mut [Vectors]) {
        let Self { sums, curves, pairs, stokeslets, .. } = self;
        stokeslets.resize_with(pairs.len().max(stokeslets.len()), StoredStokeslets::default);
        for (&CurvePair { target, source, own, kernel }, stokeslets) in pairs.iter().zip(stokeslets) {
            let both = [&curves[target], &curves[source]];
            let kress = &plans[both[0].plan].kress;
            with_kernel!(&kernel, kernel => {
                if stored.has(target) || stored.has(source) {
                    let (kress, nodes) = (if own { Some(&kress[..]) } else { None }, both.map(|arrays| &arrays.nodes));
                    widely(#[inline(always)] || stokeslets.fill(kernel, kress, nodes));
                    if !(stored.has(target) && stored.has(source)) {
                        let forces = both.map(|arrays| &arrays.force);
                        sums.visit(false, [target, source], out, #[inline(always)] |shift, near, far| {
                            stokeslets.apply(shift, forces, near, far);
                        });
                    }
                    continue;
                }
                if own {
                    add_force_at_node(kernel, kress[0], both[0], &mut out[target]);
                }
                sums.visit(own, [target, source], out, #[inline(always)] |shift, near, far| {
                    let weight = if own { kress[shift.d] } else { 0.0 };
                    single_layer(kernel, weight, shift, both, near, far);
                });
            });
        }
    }

    /// Adds the single layers of the stored curves for the forces that are now on them.
    pub(crate) fn add_stored(&mut self, on: &[Curve], plans: &[Plan], stored: StoredLayers, out: &mut [Vectors]) {
        let Self { sums, curves, pairs, stokeslets, .. } = self;
        for (index, (arrays, curve)) in curves.iter_mut().zip(on).enumerate() {
            if stored.has(index) {
                arrays.force.fill(&curve.nodes.force);
            } else {
                arrays.force.clear(2 * curve.len());
            }
        }
        for (&CurvePair { target, source, own, kernel }, stokeslets) in pairs.iter().zip(stokeslets) {
            if !(stored.has(target) || stored.has(source)) {
                continue;
            }
            let both = [&curves[target], &curves[source]];
            if own {
                let kress = &plans[both[0].plan].kress;
                with_kernel!(&kernel, kernel => add_force_at_node(kernel, kress[0], both[0], &mut out[target]));
            }
            let forces = both.map(|arrays| &arrays.force);
            sums.visit(
                own,
                [target, source],
                out,
                #[inline(always)]
                |shift, near, far| stokeslets.apply(shift, forces, near, far),
            );
        }
    }

    /// Calls `take` with the curves and nodes of target and source of each pair of nodes of stored curves and the
    /// components of the single layer between them; each pair serves both directions.
    pub(crate) fn each_stored(&self, plans: &[Plan], mut take: impl FnMut([[usize; 2]; 2], [f64; 3])) {
        for (&CurvePair { target, source, own, kernel }, stokeslets) in self.pairs.iter().zip(&self.stokeslets) {
            let both = [&self.curves[target], &self.curves[source]];
            stokeslets.each(both.map(|arrays| arrays.nodes.len()), own, |[i, j], g| {
                take([[target, i], [source, j]], g);
            });
            if own {
                let weight = plans[both[0].plan].kress[0];
                let Vectors { x, y } = &both[0].tangent;
                for (i, (x, y)) in x.iter().zip(y).enumerate().take(both[0].nodes.len()) {
                    let [xx, xy, yy] = with_kernel!(&kernel, kernel => kernel.diagonal(*x, *y));
                    take([[target, i]; 2], [xx + weight, xy, yy + weight]);
                }
            }
        }
    }

    /// Stores the stress between all pairs of nodes, unless there are too many.
    pub(crate) fn prepare_stress(&mut self) {
        let Self { curves, pairs, stresses, stresses_stored, .. } = self;
        let size = |pair: &CurvePair| curves[pair.target].nodes.len() * curves[pair.source].nodes.len();
        *stresses_stored =
            pairs.len() <= MOST_STORED_PAIRS && pairs.iter().map(size).sum::<usize>() <= MOST_STORED_STRESSES;
        if !*stresses_stored {
            return;
        }
        stresses.resize_with(pairs.len().max(stresses.len()), StoredStress::default);
        for (&CurvePair { target, source, own, kernel }, stress) in pairs.iter().zip(stresses) {
            let both = [&curves[target].nodes, &curves[source].nodes];
            with_kernel!(&kernel, kernel => widely(#[inline(always)] || stress.fill(kernel, both, own)));
        }
    }

    /// Adds the double layers of all pairs for the present dipoles.
    pub(crate) fn add_dipoles(&mut self, on: &[Curve], out: &mut [Vectors]) {
        let Self { sums, curves, pairs, stresses, stresses_stored, .. } = self;
        for (index, &CurvePair { target, source, own, kernel }) in pairs.iter().enumerate() {
            let both = [&curves[target], &curves[source]];
            if *stresses_stored {
                let (stress, dipoles) = (&stresses[index], both.map(|arrays| &arrays.dipoles));
                sums.visit(
                    own,
                    [target, source],
                    out,
                    #[inline(always)]
                    |shift, near, far| stress.apply(shift, dipoles, near, far),
                );
            } else {
                let pair = [target, source];
                with_kernel!(&kernel, kernel => sums.visit(own, pair, out, #[inline(always)] |shift, near, far| {
                    double_layer(kernel, shift, both, near, far);
                }));
            }
            if own {
                let Dipoles { xx, s, yy } = &both[0].dipoles;
                for i in 0..on[target].len() {
                    add_dipole_at_node(&on[target], i, [xx[i], s[i], yy[i]], &mut out[target]);
                }
            }
        }
    }
}

/// Adds the flow of the force of each node at the node itself, where the rule of Kress has the limit of
/// `G + ln|alpha difference|` and the weight of the logarithm.
fn add_force_at_node<K: PairKernel>(kernel: &K, weight: f64, arrays: &NodeArrays, out: &mut Vectors) {
    let NodeArrays { tangent, force, .. } = arrays;
    for i in 0..out.x.len() {
        let [xx, xy, yy] = kernel.diagonal(tangent.x[i], tangent.y[i]);
        out.x[i] += (xx + weight) * force.x[i] + xy * force.y[i];
        out.y[i] += xy * force.x[i] + (yy + weight) * force.y[i];
    }
}

/// Adds the limit of the double layer at node i itself, `-2 kappa tau (tau.v) |n ds|` with the unit tangent tau and the
/// curvature kappa, from the dipole there.
pub(crate) fn add_dipole_at_node(curve: &Curve, i: usize, [xx, s, yy]: [f64; 3], out: &mut Vectors) {
    let (tangent, curvature) = (curve.nodes.tangent[i], curve.curvature[i]);
    let speed = tangent.norm_sqr().sqrt();
    let (tx, ty) = (tangent.re / speed, tangent.im / speed);
    let (nx, ny) = (ty, -tx);
    // tau.v |n ds| = tau.(P n) with the symmetric P, less the normal part that P holds twice.
    let (px, py) = (xx * nx + 0.5 * s * ny, 0.5 * s * nx + yy * ny);
    let along = 2.0 * (tx * px + ty * py);
    out.x[i] -= 2.0 * curvature * along * tx;
    out.y[i] -= 2.0 * curvature * along * ty;
}
