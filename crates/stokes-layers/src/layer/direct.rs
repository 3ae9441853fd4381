//! Sums over the nodes of curves that are close to each other.

use crate::{
    curve::Curve,
    greens::{FreePair, LatticePair, Nodes, PairKernel, RowPair, Vectors},
};

use super::{
    Kept, Plan,
    dipoles::{Dipoles, StoredStress, double_layer},
    stokeslets::StoredStokeslets,
    sums::{PairSums, single_layer},
};

/// Up to so many pairs of curves, the stress between their nodes is stored instead of computed for each product.
const MOST_STORED_PAIRS: usize = 200;
/// The same for pairs of nodes.
const MOST_STORED_STRESSES: usize = 1 << 23;

/// A Green's function that is summed node by node.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pair {
    Free(FreePair),
    Row(RowPair),
    Lattice(LatticePair),
}

/// Evaluates an expression with the kernel of a [`Pair`].
macro_rules! with_kernel {
    ($pair:expr, $kernel:ident => $body:expr) => {
        match $pair {
            Pair::Free($kernel) => $body,
            Pair::Row($kernel) => $body,
            Pair::Lattice($kernel) => $body,
        }
    };
}

/// Two curves and a Green's function between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DirectPair {
    /// The one with fewer nodes.
    pub(crate) target: usize,
    pub(crate) source: usize,
    /// A curve with itself, not with an image of its own.
    pub(crate) own: bool,
    pub(crate) kernel: Pair,
}

/// Values at the nodes of a curve as arrays.
#[derive(Debug, Clone, Default)]
pub(crate) struct NodeArrays {
    pub(crate) nodes: Nodes,
    tangent: Vectors,
    pub(crate) force: Vectors,
    pub(crate) dipoles: Dipoles,
    plan: usize,
}

/// Sums over pairs of curves.
#[derive(Debug, Clone, Default)]
pub(crate) struct DirectSums {
    sums: PairSums,
    pub(crate) curves: Vec<NodeArrays>,
    pub(crate) pairs: Vec<DirectPair>,
    /// Stokeslets of the pairs with a curve whose forces come later.
    stokeslets: Vec<StoredStokeslets>,
    stresses: Vec<StoredStress>,
    stored: bool,
}

impl DirectSums {
    /// Takes over the present shapes and forces, none on the curves whose forces come later; `wave` as in
    /// [`Nodes::fill`].
    pub(crate) fn load(&mut self, curves: &[Curve], kept: Kept, wave: Option<f64>) {
        self.curves.resize_with(curves.len(), NodeArrays::default);
        for (index, (arrays, curve)) in self.curves.iter_mut().zip(curves).enumerate() {
            arrays.nodes.fill(&curve.nodes.position, wave);
            arrays.tangent.fill(&curve.nodes.tangent);
            arrays.plan = curve.plan;
            if kept.is_kept(index) {
                arrays.force.clear(2 * curve.len());
                arrays.dipoles.clear(curve.len());
            } else {
                arrays.force.fill(&curve.nodes.force);
            }
        }
        self.pairs.clear();
        self.stored = false;
    }

    /// Adds the single layers of all pairs, that of a curve on itself by the rule of Kress.
    pub(crate) fn add_forces(&mut self, plans: &[Plan], kept: Kept, out: &mut [Vectors]) {
        let Self { sums, curves, pairs, stokeslets, .. } = self;
        stokeslets.resize_with(pairs.len().max(stokeslets.len()), StoredStokeslets::default);
        for (&DirectPair { target, source, own, kernel }, stored) in pairs.iter().zip(stokeslets) {
            let both = [&curves[target], &curves[source]];
            let kress = &plans[both[0].plan].kress;
            with_kernel!(&kernel, kernel => {
                if kept.is_kept(target) || kept.is_kept(source) {
                    stored.fill(kernel, if own { Some(kress) } else { None }, both.map(|arrays| &arrays.nodes));
                    if !(kept.is_kept(target) && kept.is_kept(source)) {
                        let forces = both.map(|arrays| &arrays.force);
                        sums.visit(false, [target, source], out, |shift, near, far| {
                            stored.apply(shift, forces, near, far);
                        });
                    }
                    continue;
                }
                if own {
                    add_force_at_node(kernel, kress[0], both[0], &mut out[target]);
                }
                sums.visit(own, [target, source], out, |shift, near, far| {
                    let weight = if own { kress[shift.d] } else { 0.0 };
                    single_layer(kernel, weight, shift, both, near, far);
                });
            });
        }
    }

    /// Adds the single layers of the forces that came later, those of all other curves being left out.
    pub(crate) fn add_kept(&mut self, on: &[Curve], plans: &[Plan], kept: Kept, out: &mut [Vectors]) {
        let Self { sums, curves, pairs, stokeslets, .. } = self;
        for (index, (arrays, curve)) in curves.iter_mut().zip(on).enumerate() {
            if kept.is_kept(index) {
                arrays.force.fill(&curve.nodes.force);
            } else {
                arrays.force.clear(2 * curve.len());
            }
        }
        for (&DirectPair { target, source, own, kernel }, stored) in pairs.iter().zip(stokeslets) {
            if !(kept.is_kept(target) || kept.is_kept(source)) {
                continue;
            }
            let both = [&curves[target], &curves[source]];
            if own {
                let kress = &plans[both[0].plan].kress;
                with_kernel!(&kernel, kernel => add_force_at_node(kernel, kress[0], both[0], &mut out[target]));
            }
            let forces = both.map(|arrays| &arrays.force);
            sums.visit(own, [target, source], out, |shift, near, far| stored.apply(shift, forces, near, far));
        }
    }

    /// Stores the stress between all pairs, unless there are too many.
    pub(crate) fn prepare_stress(&mut self) {
        let Self { curves, pairs, stresses, stored, .. } = self;
        let size = |pair: &DirectPair| curves[pair.target].nodes.len() * curves[pair.source].nodes.len();
        *stored = pairs.len() <= MOST_STORED_PAIRS && pairs.iter().map(size).sum::<usize>() <= MOST_STORED_STRESSES;
        if !*stored {
            return;
        }
        stresses.resize_with(pairs.len().max(stresses.len()), StoredStress::default);
        for (&DirectPair { target, source, own, kernel }, stress) in pairs.iter().zip(stresses) {
            let both = [&curves[target].nodes, &curves[source].nodes];
            with_kernel!(&kernel, kernel => stress.fill(kernel, both, own));
        }
    }

    /// Adds the double layers of all pairs for the present dipoles.
    pub(crate) fn add_dipoles(&mut self, on: &[Curve], out: &mut [Vectors]) {
        let Self { sums, curves, pairs, stresses, stored, .. } = self;
        for (index, &DirectPair { target, source, own, kernel }) in pairs.iter().enumerate() {
            let both = [&curves[target], &curves[source]];
            if *stored {
                let (stress, dipoles) = (&stresses[index], both.map(|arrays| &arrays.dipoles));
                sums.visit(own, [target, source], out, |shift, near, far| stress.apply(shift, dipoles, near, far));
            } else {
                with_kernel!(&kernel, kernel => sums.visit(own, [target, source], out, |shift, near, far| {
                    double_layer(kernel, shift, both, near, far);
                }));
            }
            if own {
                add_dipole_at_node(&on[target], &both[0].dipoles, &mut out[target]);
            }
        }
    }
}

/// Adds the flow of the force of each node at the node itself.
fn add_force_at_node<K: PairKernel>(kernel: &K, weight: f64, arrays: &NodeArrays, out: &mut Vectors) {
    let NodeArrays { tangent, force, .. } = arrays;
    for i in 0..out.x.len() {
        let [xx, xy, yy] = kernel.diagonal(tangent.x[i], tangent.y[i]);
        out.x[i] += (xx + weight) * force.x[i] + xy * force.y[i];
        out.y[i] += xy * force.x[i] + (yy + weight) * force.y[i];
    }
}

/// Adds the limit of the double layer at the node itself: `-2 kappa tau (tau.v)` times the weight, from the dipoles
/// `xx = v_x n_x` and so on through `kappa tau (tau.v) |n ds|`.
fn add_dipole_at_node(curve: &Curve, dipoles: &Dipoles, out: &mut Vectors) {
    for (i, (tangent, curvature)) in curve.nodes.tangent.iter().zip(&curve.curvature).enumerate() {
        let speed = tangent.norm_sqr().sqrt();
        let (tx, ty) = (tangent.re / speed, tangent.im / speed);
        let (nx, ny) = (ty, -tx);
        // tau.v |n ds| = tau.(P n) with the symmetric P, less the normal part that P holds twice.
        let (px, py) = (dipoles.xx[i] * nx + 0.5 * dipoles.s[i] * ny, 0.5 * dipoles.s[i] * nx + dipoles.yy[i] * ny);
        let along = 2.0 * (tx * px + ty * py);
        out.x[i] -= 2.0 * curvature * along * tx;
        out.y[i] -= 2.0 * curvature * along * ty;
    }
}
