//! Stokeslets and stresses between all nodes of two curves, stored for repeated products.

use crate::greens::{Nodes, PairKernel, Stokeslet, Vectors, Window, ln};

use super::{
    arrays::Dipoles,
    sums::{Shift, add_dipoles, add_forces, shifts},
};

/// N components of all pairs of nodes, shift after shift.
#[derive(Debug, Clone)]
struct Components<const N: usize> {
    nodes: usize,
    arrays: [Vec<f64>; N],
}

impl<const N: usize> Default for Components<N> {
    fn default() -> Self {
        Self { nodes: 0, arrays: std::array::from_fn(|_| Vec::new()) }
    }
}

impl<const N: usize> Components<N> {
    /// Calls `write` for each shift with the nodes of target and source and the components to be written.
    #[inline(always)]
    fn fill(
        &mut self,
        [target, source]: [&Nodes; 2],
        same: bool,
        write: impl Fn(Shift, [Window<'_>; 2], [&mut [f64]; N]),
    ) {
        let both = [target.len(), source.len()];
        self.nodes = target.len();
        let len = self.nodes * shifts(both, same).count();
        self.arrays.iter_mut().for_each(|array| array.resize(len, 0.0));
        for shift in shifts(both, same) {
            let Shift { index, d, count } = shift;
            let range = index * self.nodes..index * self.nodes + count;
            let windows = [target.window(0, count), source.window(d, count)];
            write(shift, windows, self.arrays.each_mut().map(|array| &mut array[range.clone()]));
        }
    }

    /// Returns the components of the pairs of one shift.
    #[inline(always)]
    fn of(&self, Shift { index, count, .. }: Shift) -> [&[f64]; N] {
        let range = index * self.nodes..index * self.nodes + count;
        self.arrays.each_ref().map(|array| &array[range.clone()])
    }
}

/// Components xx, xy, yy of the Stokeslets, with the weights of Kress between nodes of the same curve.
#[derive(Debug, Clone, Default)]
pub(crate) struct StoredStokeslets(Components<3>);

impl StoredStokeslets {
    /// Computes the Stokeslets of all pairs; `kress` are the weights by shift for a curve with itself.
    #[inline(always)]
    pub(crate) fn fill<K: PairKernel>(&mut self, kernel: &K, kress: Option<&[f64]>, both: [&Nodes; 2]) {
        self.0.fill(
            both,
            kress.is_some(),
            #[inline(always)]
            |Shift { d, count, .. }, [t, s], [a, b, c]| {
                let weight = kress.map_or(0.0, |kress| kress[d]);
                for i in 0..count {
                    let Stokeslet { q, xx, xy, yy } = kernel.stokeslet(&t, &s, i);
                    let log = weight - 0.5 * ln(q);
                    (a[i], b[i], c[i]) = (xx + log, xy, yy + log);
                }
            },
        );
    }

    /// Calls `take` with the nodes of target and source of each pair and the components between them.
    pub(crate) fn each(&self, both: [usize; 2], same: bool, mut take: impl FnMut([usize; 2], [f64; 3])) {
        for shift in shifts(both, same) {
            let [a, b, c] = self.0.of(shift);
            for (i, ((a, b), c)) in a.iter().zip(b).zip(c).enumerate() {
                take([i, (i + shift.d) % both[1]], [*a, *b, *c]);
            }
        }
    }

    /// Adds the flow of the forces of one shift.
    #[inline(always)]
    pub(crate) fn apply(&self, shift: Shift, forces: [&Vectors; 2], near: &mut Vectors, far: &mut Vectors) {
        let [a, b, c] = self.0.of(shift);
        add_forces(
            shift,
            forces,
            near,
            far,
            #[inline(always)]
            |i| [a[i], b[i], c[i]],
        );
    }
}

/// Components xxx, xxy, xyy, yyy of the stresses.
#[derive(Debug, Clone, Default)]
pub(crate) struct StoredStress(Components<4>);

impl StoredStress {
    /// Computes the stresses of all pairs.
    #[inline(always)]
    pub(crate) fn fill<K: PairKernel>(&mut self, kernel: &K, both: [&Nodes; 2], same: bool) {
        self.0.fill(
            both,
            same,
            #[inline(always)]
            |shift, [t, s], [a, b, c, e]| {
                for i in 0..shift.count {
                    [a[i], b[i], c[i], e[i]] = kernel.stress(&t, &s, i);
                }
            },
        );
    }

    /// Adds the flow of the dipoles of one shift.
    #[inline(always)]
    pub(crate) fn apply(&self, shift: Shift, dipoles: [&Dipoles; 2], near: &mut Vectors, far: &mut Vectors) {
        let [a, b, c, e] = self.0.of(shift);
        add_dipoles(
            shift,
            dipoles,
            near,
            far,
            #[inline(always)]
            |i, source, target| {
                let act = |[xx, s, yy]: [f64; 3]| [a[i] * xx + b[i] * s + c[i] * yy, b[i] * xx + c[i] * s + e[i] * yy];
                // The stress is odd in the distance.
                [act(source), act(target).map(|u| -u)]
            },
        );
    }
}

#[cfg(test)]
mod tests;
