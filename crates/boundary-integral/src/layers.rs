//! Arrays of all interfaces that pair sums work on.

use crate::{
    interface::Interface,
    pair_kernel::{FreePair, RowPair},
    pair_sums::{Both, PairSums},
    planes::{Planes, Vectors},
    stress::{Dipoles, DirectStress, StoredStress, StressSource},
};

/// Up to so many pairs of interfaces, the stress between their nodes is stored instead of computed for each product.
const MOST_STORED_PAIRS: usize = 200;

/// A Green's function that goes by sums over nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pair {
    Free(FreePair),
    Row(RowPair),
}

/// Two interfaces and a Green's function between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Direct {
    pub(crate) target: usize,
    pub(crate) source: usize,
    /// An interface with itself, not with an image of its own.
    pub(crate) own: bool,
    pub(crate) pair: Pair,
}

/// Evaluates an expression with the kernel of a [`Pair`].
macro_rules! with_kernel {
    ($pair:expr, $kernel:ident => $body:expr) => {
        match $pair {
            Pair::Free($kernel) => $body,
            Pair::Row($kernel) => $body,
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
    pub(crate) directs: Vec<Direct>,
    /// For an interface with its own image.
    image: Vectors,
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
            directs: Vec::new(),
            image: Vectors::default(),
            stresses: Vec::new(),
            stored: false,
        }
    }

    /// Takes over the present shapes and forces; `wave` as in [`Planes::fill`].
    pub(crate) fn load(&mut self, interfaces: &[Interface], wave: Option<(f64, bool)>) {
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
        self.clear();
    }

    pub(crate) fn clear(&mut self) {
        let nodes = self.nodes;
        self.out.iter_mut().for_each(|out| out.clear(nodes));
    }

    /// Adds the single layers of all pairs.
    pub(crate) fn add_forces(&mut self) {
        let Self { directs, sums, planes, tangents, forces, out, image, nodes, .. } = self;
        for &Direct { target, source, own, pair } in &*directs {
            if own {
                let (planes, tangents, forces) = (&planes[target], &tangents[target], &forces[target]);
                let out = &mut out[target];
                with_kernel!(&pair, kernel => sums.single_layer_own(kernel, planes, tangents, forces, out));
                continue;
            }
            let planes = Both { target: &planes[target], source: &planes[source] };
            let forces = Both { target: &forces[target], source: &forces[source] };
            image.clear(*nodes);
            with_two(out, image, target, source, |near, far| {
                with_kernel!(&pair, kernel => sums.single_layer(kernel, &planes, &forces, near, far));
            });
        }
    }

    /// Stores the stress between all pairs, unless there are too many.
    pub(crate) fn prepare_stress(&mut self) {
        let Self { directs, planes, nodes, stresses, .. } = self;
        self.stored = directs.len() <= MOST_STORED_PAIRS;
        if !self.stored {
            return;
        }
        stresses.resize_with(directs.len().max(stresses.len()), StoredStress::default);
        for (&Direct { target, source, own, pair }, stress) in directs.iter().zip(stresses) {
            let planes = Both { target: &planes[target], source: &planes[source] };
            with_kernel!(&pair, kernel => stress.fill(kernel, &planes, *nodes, own));
        }
    }

    /// Adds the double layers of all pairs for the present dipoles, with the diagonal.
    pub(crate) fn add_dipoles(&mut self, interfaces: &[Interface]) {
        let Self { directs, sums, planes, dipoles, out, image, nodes, stresses, stored, .. } = self;
        for (index, &Direct { target, source, own, pair }) in directs.iter().enumerate() {
            let both = Both { target: &dipoles[target], source: &dipoles[source] };
            image.clear(*nodes);
            let mut run = |stress: &dyn StressSource| {
                if own {
                    sums.double_layer_own(stress, both.target, &mut out[target]);
                } else {
                    with_two(out, image, target, source, |near, far| sums.double_layer(stress, &both, near, far));
                }
            };
            if *stored {
                run(&stresses[index]);
            } else {
                let planes = Both { target: &planes[target], source: &planes[source] };
                with_kernel!(pair, kernel => run(&DirectStress { kernel, planes }));
            }
            if own {
                add_diagonal(&interfaces[target], both.target, &mut out[target]);
            }
        }
    }
}

/// Calls a function with the arrays of two interfaces, which may be the same one.
fn with_two(
    out: &mut [Vectors],
    image: &mut Vectors,
    target: usize,
    source: usize,
    run: impl FnOnce(&mut Vectors, &mut Vectors),
) {
    if target == source {
        run(&mut out[target], image);
        for (out, image) in [(&mut out[target].x, &image.x), (&mut out[target].y, &image.y)] {
            out.iter_mut().zip(image).for_each(|(out, image)| *out += image);
        }
    } else {
        let (head, tail) = out.split_at_mut(target.max(source));
        let (low, high) = (&mut head[target.min(source)], &mut tail[0]);
        if target < source { run(low, high) } else { run(high, low) }
    }
}

/// The limit of the double layer at the node itself: `-2 kappa tau (tau.v)` times the weight, from the dipoles
/// `xx = v_x n_x` and so on through `kappa tau (tau.v) |n ds|`.
fn add_diagonal(interface: &Interface, dipoles: &Dipoles, out: &mut Vectors) {
    for (i, (tangent, curvature)) in interface.tangent.iter().zip(&interface.curvature).enumerate() {
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
