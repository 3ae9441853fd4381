//! Values at the nodes of a curve as arrays of components, for loops in vector registers.

use num_complex::Complex64;

use crate::{
    curve::Curve,
    greens::{Nodes, Vectors},
};

/// Positions, tangents, forces and dipoles at the nodes of a curve.
#[derive(Debug, Clone, Default)]
pub(crate) struct NodeArrays {
    pub(crate) nodes: Nodes,
    /// Derivative of the position by the parameter (length).
    pub(crate) tangent: Vectors,
    /// Force per parameter times the weight of the node (force).
    pub(crate) force: Vectors,
    pub(crate) dipoles: Dipoles,
    /// Number of the curve's plan.
    pub(crate) plan: usize,
}

impl NodeArrays {
    /// Takes over the shape of a curve and its forces, or zero forces and dipoles if they are given later; `wave` as in
    /// [`Nodes::fill`].
    pub(crate) fn load(&mut self, curve: &Curve, given_later: bool, wave: Option<f64>) {
        self.nodes.fill(&curve.nodes.position, wave);
        self.tangent.fill(&curve.nodes.tangent);
        self.plan = curve.plan;
        if given_later {
            self.force.clear(2 * curve.len());
            self.dipoles.clear(curve.len());
        } else {
            self.force.fill(&curve.nodes.force);
        }
    }
}

/// Dipoles that the stress acts on in a double layer: the symmetric products of velocity and normal
/// `v_x n_x`, `v_x n_y + v_y n_x`, `v_y n_y` times the weight of the node (length squared per time times the contrast
/// of viscosities). Every array is stored twice in a row, so that a cyclic shift is a slice.
#[derive(Debug, Default, Clone)]
pub(crate) struct Dipoles {
    pub(crate) xx: Vec<f64>,
    pub(crate) s: Vec<f64>,
    pub(crate) yy: Vec<f64>,
}

impl Dipoles {
    fn arrays(&mut self) -> [&mut Vec<f64>; 3] {
        [&mut self.xx, &mut self.s, &mut self.yy]
    }

    /// Sets the dipoles at so many nodes to zero.
    pub(crate) fn clear(&mut self, nodes: usize) {
        for array in self.arrays() {
            array.clear();
            array.resize(2 * nodes, 0.0);
        }
    }

    /// Fills the arrays from velocities and derivatives of the position by the parameter, of which the normal is
    /// `n ds = -i (dX/dalpha) dalpha`.
    pub(crate) fn fill(&mut self, (vx, vy): (&[f64], &[f64]), tangents: &[Complex64], weight: f64) {
        let n = tangents.len();
        self.arrays().into_iter().for_each(|array| array.resize(2 * n, 0.0));
        for (i, t) in tangents.iter().enumerate() {
            [self.xx[i], self.s[i], self.yy[i]] = dipole([vx[i], vy[i]], t * weight);
        }
        self.arrays().into_iter().for_each(|array| array.copy_within(..n, n));
    }
}

/// Returns the products of velocity and normal that the stress acts on, for the derivative of the position by the
/// parameter times the weight of the node.
#[inline(always)]
pub(crate) fn dipole([vx, vy]: [f64; 2], tangent: Complex64) -> [f64; 3] {
    let (nx, ny) = (tangent.im, -tangent.re);
    [vx * nx, vx * ny + vy * nx, vy * ny]
}
