//! Arrays of all interfaces that pair sums work on.

use crate::{
    interface::Interface,
    lattice_kernel::LatticePair,
    pair_kernel::{FreePair, RowPair},
    pair_sums::{Both, PairSums},
    planes::{Planes, Vectors},
    stress::{Dipoles, DirectStress, StoredStress},
};

/// Up to so many nodes in all, the stress between pairs is stored instead of computed for each product.
const MOST_STORED_NODES: usize = 1280;

/// The Green's function between two interfaces, without the parts that go by moments or modes.
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

/// Node values of all interfaces as arrays, and sums over pairs of them.
#[derive(Debug)]
pub(crate) struct Layers {
    nodes: usize,
    sums: PairSums,
    planes: Vec<Planes>,
    tangents: Vec<Vectors>,
    forces: Vec<Vectors>,
    pub(crate) dipoles: Vec<Dipoles>,
    /// 4 pi times velocity times viscosity at the nodes.
    pub(crate) out: Vec<Vectors>,
    pairs: Vec<Pair>,
    stresses: Vec<StoredStress>,
    stored: bool,
}

impl Layers {
    pub(crate) fn new(nodes: usize) -> Self {
        Self {
            nodes,
            sums: PairSums::new(nodes),
            planes: Vec::new(),
            tangents: Vec::new(),
            forces: Vec::new(),
            dipoles: Vec::new(),
            out: Vec::new(),
            pairs: Vec::new(),
            stresses: Vec::new(),
            stored: false,
        }
    }

    /// Takes over the present shapes and forces; `wave` as in [`Planes::fill`].
    pub(crate) fn load(
        &mut self,
        interfaces: &[Interface],
        wave: Option<(f64, bool)>,
        pair: impl Fn(&Interface, &Interface) -> Pair,
    ) {
        let count = interfaces.len();
        self.planes.resize_with(count, Planes::default);
        self.dipoles.resize_with(count, Dipoles::default);
        for arrays in [&mut self.tangents, &mut self.forces, &mut self.out] {
            arrays.resize_with(count, Vectors::default);
        }
        let (k, transposed) = wave.map_or((None, false), |(k, transposed)| (Some(k), transposed));
        for (index, interface) in interfaces.iter().enumerate() {
            self.planes[index].fill(&interface.position, k, transposed);
            self.tangents[index].fill(&interface.tangent);
            self.forces[index].fill(&interface.force);
        }
        self.pairs.clear();
        for (index, target) in interfaces.iter().enumerate() {
            for source in &interfaces[index..] {
                self.pairs.push(pair(target, source));
            }
        }
        self.clear();
    }

    pub(crate) fn clear(&mut self) {
        let nodes = self.nodes;
        self.out.iter_mut().for_each(|out| out.clear(nodes));
    }

    /// Adds the single layers of all pairs.
    pub(crate) fn add_forces(&mut self) {
        let mut pairs = self.pairs.iter();
        for target in 0..self.out.len() {
            for source in target..self.out.len() {
                let Some(pair) = pairs.next() else { return };
                if source == target {
                    let (planes, tangents) = (&self.planes[target], &self.tangents[target]);
                    let (forces, out) = (&self.forces[target], &mut self.out[target]);
                    with_kernel!(pair, kernel => self.sums.single_layer_own(kernel, planes, tangents, forces, out));
                } else {
                    let (head, tail) = self.out.split_at_mut(source);
                    let planes = Both { target: &self.planes[target], source: &self.planes[source] };
                    let forces = Both { target: &self.forces[target], source: &self.forces[source] };
                    let (near, far) = (&mut head[target], &mut tail[0]);
                    with_kernel!(pair, kernel => self.sums.single_layer(kernel, &planes, &forces, near, far));
                }
            }
        }
    }

    /// Stores the stress between all pairs, unless there are too many.
    pub(crate) fn prepare_stress(&mut self) {
        let count = self.planes.len();
        self.stored = count * self.nodes <= MOST_STORED_NODES;
        if !self.stored {
            return;
        }
        self.stresses.resize_with(self.pairs.len().max(self.stresses.len()), StoredStress::default);
        let mut index = 0;
        for target in 0..count {
            for source in target..count {
                let planes = Both { target: &self.planes[target], source: &self.planes[source] };
                let stress = &mut self.stresses[index];
                with_kernel!(&self.pairs[index], kernel => stress.fill(kernel, &planes, self.nodes, source == target));
                index += 1;
            }
        }
    }

    /// Adds the double layers of all pairs for the present dipoles, with the diagonal.
    pub(crate) fn add_dipoles(&mut self, interfaces: &[Interface]) {
        let mut index = 0;
        for target in 0..self.out.len() {
            for source in target..self.out.len() {
                let (head, tail) = self.out.split_at_mut(source);
                let both = Both { target: &self.dipoles[target], source: &self.dipoles[source] };
                if source == target {
                    add_diagonal(&interfaces[target], both.target, &mut tail[0]);
                }
                let mut run = |stress: &dyn crate::stress::StressSource| {
                    if source == target {
                        self.sums.double_layer_own(stress, both.target, &mut tail[0]);
                    } else {
                        self.sums.double_layer(stress, &both, &mut head[target], &mut tail[0]);
                    }
                };
                if self.stored {
                    run(&self.stresses[index]);
                } else {
                    let planes = Both { target: &self.planes[target], source: &self.planes[source] };
                    with_kernel!(self.pairs[index], kernel => run(&DirectStress { kernel, planes }));
                }
                index += 1;
            }
        }
    }
}

/// The limit of the double layer at the node itself: `-2 kappa tau (tau.v)` times the weight, from the dipoles
/// `xx = v_x n_x` and so on through `kappa tau (tau.v) |n ds|`.
fn add_diagonal(interface: &Interface, dipoles: &Dipoles, out: &mut Vectors) {
    for (i, (tangent, curvature)) in interface.tangent.iter().zip(&interface.curvature).enumerate() {
        let speed = tangent.norm();
        let (tx, ty) = (tangent.re / speed, tangent.im / speed);
        let (nx, ny) = (ty, -tx);
        // tau.v |n ds| = tau.(P n) with the symmetric P, less the normal part that P holds twice.
        let (px, py) = (dipoles.xx[i] * nx + 0.5 * dipoles.s[i] * ny, 0.5 * dipoles.s[i] * nx + dipoles.yy[i] * ny);
        let along = 2.0 * (tx * px + ty * py);
        out.x[i] -= 2.0 * curvature * along * tx;
        out.y[i] -= 2.0 * curvature * along * ty;
    }
}
