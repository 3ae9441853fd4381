//! Corrections of the sums over nodes for nodes close to another curve or to an image of their own.
//!
//! The sums over nodes are exact where curves are some spacings apart. A node that is closer gets the difference
//! between the accurate quadrature of [`CloseWeights`] and the plain sum, both in free space: images farther away and
//! walls do not notice.

use fourier::spectrum::{copy_band, largest_wave};
use num_complex::Complex64;

use crate::{
    curve::{Curve, REFINEMENT, Transforms},
    geometry::Images,
    greens::{Flow, Vectors, free},
    layer::Density,
};

use super::CloseWeights;

/// A node close to a curve.
#[derive(Debug, Clone, Copy)]
struct CloseNode {
    target: usize,
    node: usize,
    source: usize,
    /// Position of the node relative to the centre of the source or its image (length).
    point: Complex64,
}

/// The corrections for the present positions.
#[derive(Debug, Clone)]
pub(crate) struct CloseCorrection {
    /// Distance in spacings below which a node is close.
    reach: f64,
    close: Vec<CloseNode>,
    /// Factors of v and conj v at the nodes of the source, for each close node.
    rows: Vec<(f64, Complex64)>,
    weights: CloseWeights,
    fine: [Vec<Complex64>; 2],
    coarse: [Vec<Complex64>; 2],
}

impl CloseCorrection {
    pub(crate) fn new(nodes: usize, tolerance: f64) -> Self {
        let fine = vec![Complex64::default(); REFINEMENT * nodes];
        let coarse = vec![Complex64::default(); nodes];
        Self {
            reach: reach(tolerance),
            close: Vec::new(),
            rows: Vec::new(),
            weights: CloseWeights::new(nodes),
            fine: [fine.clone(), fine],
            coarse: [coarse.clone(), coarse],
        }
    }

    /// Looks for close nodes and prepares the fine nodes of the curves that have some.
    pub(crate) fn find(&mut self, curves: &mut [Curve], transforms: &mut Transforms, images: &Images) {
        self.close.clear();
        for source in 0..curves.len() {
            let curve = &curves[source];
            let reach = self.reach * curve.spacing();
            let first = self.close.len();
            for (target, other) in curves.iter().enumerate() {
                let apart = images.wrap(other.centre - curve.centre);
                for shift in images.shifts() {
                    let own = target == source && shift == Complex64::default();
                    let offset = apart + shift;
                    if own || offset.norm() >= curve.radius + other.radius + reach {
                        continue;
                    }
                    for (node, z) in other.nodes.position.iter().enumerate() {
                        let point = z + offset;
                        if point.norm() < curve.radius + reach
                            && curve.nodes.position.iter().any(|z| (z - point).norm_sqr() < reach * reach)
                        {
                            self.close.push(CloseNode { target, node, source, point });
                        }
                    }
                }
            }
            if self.close.len() > first {
                curves[source].refine(transforms);
            }
        }
    }

    /// Adds the corrections of the single layer and, where `rows` is asked for, keeps those of the double layer.
    pub(crate) fn add_forces(
        &mut self,
        curves: &[Curve],
        transforms: &mut Transforms,
        rows: bool,
        out: &mut [Vectors],
    ) {
        self.rows.clear();
        for index in 0..self.close.len() {
            let CloseNode { target, node, source, point } = self.close[index];
            let curve = &curves[source];
            self.weights.find(curve, transforms, point, self.reach);
            let mut flow = Flow::default();
            for (j, force) in curve.fine.force.iter().enumerate() {
                flow.add_force(&self.weights.kernels(j), *force, 1.0);
            }
            for (z, force) in curve.nodes.position.iter().zip(&curve.nodes.force) {
                flow.add_force(&free(z - point), *force, -1.0);
            }
            out[target].x[node] += flow.velocity.re;
            out[target].y[node] += flow.velocity.im;
            if rows {
                self.push_row(curve, transforms, point);
            }
        }
    }

    /// The double layer at the point of the present weights as factors of the velocities at the nodes: the factors at
    /// the fine nodes go through the transpose of the interpolation.
    fn push_row(&mut self, curve: &Curve, transforms: &mut Transforms, point: Complex64) {
        let nodes = curve.len();
        let fine_weight = curve.weight() / REFINEMENT as f64;
        let [own, conjugate] = &mut self.fine;
        let [first, second, _] = &self.weights.powers;
        for (j, tangent) in curve.fine.tangent.iter().enumerate() {
            let (c, d) = factors(first[j], second[j], self.weights.distance[j], tangent * fine_weight);
            own[j] = Complex64::new(c, 0.0);
            conjugate[j] = d;
        }
        for (fine, coarse) in self.fine.iter_mut().zip(&mut self.coarse) {
            transforms.fine.inverse(fine);
            copy_band(fine, coarse, largest_wave(nodes));
            transforms.nodes.forward(coarse);
        }
        let weight = curve.weight();
        for (j, (z, tangent)) in curve.nodes.position.iter().zip(&curve.nodes.tangent).enumerate() {
            let d = z - point;
            let inverse = d.inv();
            let (c, e) = factors(inverse, inverse * inverse, d, tangent * weight);
            self.rows.push((self.coarse[0][j].re - c, self.coarse[1][j] - e));
        }
    }

    /// Adds the corrections of the double layer.
    pub(crate) fn add_dipoles(&self, density: Density<'_>, out: &mut [Vectors]) {
        let nodes = density.nodes();
        for (close, row) in self.close.iter().zip(self.rows.chunks_exact(nodes)) {
            let (vx, vy) = density.of(close.source);
            let mut sum = Complex64::default();
            for (j, (c, d)) in row.iter().enumerate() {
                let v = Complex64::new(vx[j], vy[j]);
                sum += v * *c + v.conj() * d;
            }
            out[close.target].x[close.node] += density.contrasts[close.source] * sum.re;
            out[close.target].y[close.node] += density.contrasts[close.source] * sum.im;
        }
    }
}

/// Distance in spacings beyond which the trapezoidal rule is exact to a tolerance: its error falls like
/// exp(-2 pi distance/spacing).
pub(crate) fn reach(tolerance: f64) -> f64 {
    1.0 - tolerance.ln() / std::f64::consts::TAU
}

/// Factors of v and conj v in the double layer of an element.
fn factors(first: Complex64, second: Complex64, d: Complex64, tangent: Complex64) -> (f64, Complex64) {
    let i = Complex64::new(0.0, 1.0);
    let c = -2.0 * (tangent * first).im;
    (c, i * (tangent * first.conj() - d * (tangent * second).conj()))
}
