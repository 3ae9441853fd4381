//! Corrections of the sums over nodes at nodes close to another curve or to an image of their own.
//!
//! The sums over nodes are exact where curves are some spacings apart. A node that is closer gets the difference
//! between the quadrature of [`CloseWeights`](crate::close_weights::CloseWeights) and the plain sum, both in free
//! space: images farther away and walls are resolved by the plain sum.

use motile_base::{
    Vec2,
    boxes::{BoxTree, Frame},
    spectrum::{copy_band, largest_wave},
};
use num_complex::Complex64;

use crate::{
    Symmetry,
    close_weights::reach,
    curve::Curve,
    density::{Density, StoredLayers},
    greens::{Flow, Kernels, Vectors},
    images::Images,
    plan::Plan,
    transforms::REFINEMENT,
};

/// Part of the force or the weight of a node that each of its fine nodes has.
const FINE_SHARE: f64 = 1.0 / REFINEMENT as f64;

/// A node close to a curve.
#[derive(Debug, Clone, Copy)]
struct CloseNode {
    target: usize,
    node: usize,
    source: usize,
    /// Position of the node relative to the centre of the source or its image (length).
    point: Complex64,
    /// First entries of the rows of the single and of the double layer, if they are stored.
    force_row: Option<usize>,
    stress_row: Option<usize>,
}

/// A node on the wrong side of a stored curve, a rigid wall.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    pub(crate) curve: usize,
    pub(crate) wall: usize,
    /// Position of the node (length).
    pub(crate) place: Complex64,
}

/// The corrections for the present positions.
#[derive(Debug, Clone)]
pub(crate) struct CloseCorrection {
    /// Distance in spacings below which a node is close.
    reach: f64,
    symmetry: Symmetry,
    /// Boxes around the curves, and the numbers of the curves near the present one.
    boxes: Vec<Frame>,
    tree: BoxTree,
    near: Vec<usize>,
    close: Vec<CloseNode>,
    /// Factors of v and conj v, v a force or a velocity, at the nodes of the source, row after row.
    rows: Vec<(f64, Complex64)>,
    fine: [Vec<Complex64>; 2],
    coarse: [Vec<Complex64>; 2],
    crossing: Option<Crossing>,
}

impl CloseCorrection {
    pub(crate) fn new(tolerance: f64, symmetry: Symmetry) -> Self {
        let (boxes, tree, near, close, rows, fine, coarse) = Default::default();
        let reach = reach(tolerance);
        Self { reach, symmetry, boxes, tree, near, close, rows, fine, coarse, crossing: None }
    }

    /// Finds the nodes that are close to a curve and prepares the fine nodes of the curves that have some.
    pub(crate) fn find(&mut self, curves: &mut [Curve], plans: &mut [Plan], images: &Images, stored: StoredLayers) {
        let one_sided = self.symmetry == Symmetry::ToRoundOff;
        self.close.clear();
        self.boxes.clear();
        self.boxes.extend(curves.iter().map(bounding_box));
        self.tree.build_by_place(&self.boxes);
        for source in 0..curves.len() {
            let curve = &curves[source];
            let reach = self.reach * curve.spacing();
            let first = self.close.len();
            self.near.clear();
            self.tree.each_near(&self.boxes[source], images.periods, reach, &mut |target| self.near.push(target));
            self.near.sort_unstable();
            for &target in &self.near {
                let other = &curves[target];
                if !stored.couples(target, source) || one_sided && !finer(curves, target, source) {
                    continue;
                }
                let apart = images.wrap(other.centre - curve.centre);
                // An open curve has its own images along x.
                for shift in images.shifts().filter(|shift| !curve.is_open() || shift.re == 0.0) {
                    let own = target == source && shift == Complex64::default();
                    let offset = apart + shift;
                    let far = |distance: f64, radii: f64| !curve.is_open() && distance >= radii + reach;
                    if own || far(offset.norm(), curve.radius + other.radius) {
                        continue;
                    }
                    for (node, z) in other.nodes.position.iter().enumerate() {
                        let point = z + offset;
                        if !far(point.norm(), curve.radius)
                            && curve.nodes.position.iter().any(|z| curve.wrap(z - point).norm_sqr() < reach * reach)
                        {
                            let (force_row, stress_row) = (None, None);
                            self.close.push(CloseNode { target, node, source, point, force_row, stress_row });
                        }
                    }
                }
            }
            if self.close.len() > first {
                let plan = &mut plans[curves[source].plan];
                curves[source].refine(&mut plan.transforms);
            }
        }
    }

    /// Adds the corrections of the single layer, or stores them for [`CloseCorrection::add_stored`] on stored curves.
    /// With `stress`, stores those of the double layer.
    pub(crate) fn add_forces(
        &mut self,
        curves: &[Curve],
        plans: &mut [Plan],
        stored: StoredLayers,
        stress: bool,
        out: &mut [Vectors],
    ) {
        self.rows.clear();
        self.crossing = None;
        for index in 0..self.close.len() {
            let CloseNode { target, node, source, point, .. } = self.close[index];
            let curve = &curves[source];
            let plan = &mut plans[curve.plan];
            let left = plan.weights.find(curve, &mut plan.transforms, point, self.reach);
            // Fluid is to the left of open walls and outside of closed ones; walls are outside of interfaces.
            if stored.has(target) != stored.has(source)
                && left.is_some_and(|left| left != (stored.has(source) && curve.is_open()))
            {
                let (curve, wall) = if stored.has(source) { (target, source) } else { (source, target) };
                self.crossing = Some(Crossing { curve, wall, place: curves[source].centre + point });
            }
            if stored.has(source) {
                self.close[index].force_row = Some(self.push_row(curve, plan, point, FINE_SHARE, force_factors));
                continue;
            }
            let mut flow = Flow::default();
            for (j, force) in curve.fine.force.iter().enumerate() {
                flow.add_force(&plan.weights.kernels(j), *force, 1.0);
            }
            let greens = curve.greens();
            for (z, force) in curve.nodes.position.iter().zip(&curve.nodes.force) {
                flow.add_force(&greens.at(z - point), *force, -1.0);
            }
            out[target].x[node] += flow.velocity.re;
            out[target].y[node] += flow.velocity.im;
            if stress {
                self.close[index].stress_row = Some(self.push_row(curve, plan, point, 1.0, stress_factors));
            }
        }
    }

    /// A node on the wrong side, if the last single layer has come across one.
    pub(crate) fn crossing(&self) -> Option<Crossing> {
        self.crossing
    }

    /// Stores a row of factors of the values at the nodes for the point of the present weights: `share` times the
    /// transpose of the interpolation to fine nodes applied to the factors there, less the factors of the plain sum.
    /// `factors` takes the kernels and the element (tangent times weight) of a node. Returns the first entry.
    fn push_row(
        &mut self,
        curve: &Curve,
        plan: &mut Plan,
        point: Complex64,
        share: f64,
        factors: impl Fn(&Kernels, Complex64) -> (f64, Complex64),
    ) -> usize {
        let nodes = curve.len();
        for (array, len) in self.fine.iter_mut().map(|array| (array, REFINEMENT * nodes)) {
            array.resize(len, Complex64::default());
        }
        self.coarse.iter_mut().for_each(|array| array.resize(nodes, Complex64::default()));
        let [own, conjugate] = &mut self.fine;
        for (j, tangent) in curve.fine.tangent.iter().enumerate() {
            let (c, d) = factors(&plan.weights.kernels(j), tangent * (FINE_SHARE * curve.weight()));
            (own[j], conjugate[j]) = (Complex64::new(c, 0.0), d);
        }
        for (fine, coarse) in self.fine.iter_mut().zip(&mut self.coarse) {
            plan.transforms.fine.inverse(fine);
            copy_band(fine, coarse, largest_wave(nodes));
            plan.transforms.nodes.forward(coarse);
        }
        let first = self.rows.len();
        let greens = curve.greens();
        for (j, (z, tangent)) in curve.nodes.position.iter().zip(&curve.nodes.tangent).enumerate() {
            let (c, d) = factors(&greens.at(z - point), tangent * curve.weight());
            self.rows.push((share * self.coarse[0][j].re - c, share * self.coarse[1][j] - d));
        }
        first
    }

    /// Adds the corrections of the double layer.
    pub(crate) fn add_dipoles(&self, density: Density<'_>, out: &mut [Vectors]) {
        for close in &self.close {
            let Some(row) = close.stress_row else { continue };
            let (vx, vy) = density.of(close.source);
            let velocities = vx.iter().zip(vy).map(|(x, y)| Complex64::new(*x, *y));
            let sum = act(&self.rows[row..row + vx.len()], velocities) * density.contrasts[close.source];
            out[close.target].x[close.node] += sum.re;
            out[close.target].y[close.node] += sum.im;
        }
    }

    /// Adds the stored corrections of the single layer for the forces at the nodes. Where the operator is symmetric to
    /// round-off the source gets the transpose.
    pub(crate) fn add_stored(&self, curves: &[Curve], out: &mut [Vectors]) {
        let symmetric = self.symmetry == Symmetry::ToRoundOff;
        for close in &self.close {
            let Some(row) = close.force_row else { continue };
            let (target, source) = (&curves[close.target], &curves[close.source]);
            let row = &self.rows[row..row + source.len()];
            // A pair of images of the same curve is found from both ends.
            let share = if symmetric && close.target == close.source { 0.5 } else { 1.0 };
            let sum = act(row, source.nodes.force.iter().copied());
            out[close.target].x[close.node] += share * sum.re;
            out[close.target].y[close.node] += share * sum.im;
            if symmetric {
                let force = share * target.nodes.force[close.node];
                for (j, (c, d)) in row.iter().enumerate() {
                    // The factors act on the components of a force by a symmetric matrix.
                    let flow = force * *c + force.conj() * d;
                    out[close.source].x[j] += flow.re;
                    out[close.source].y[j] += flow.im;
                }
            }
        }
    }
}

/// A box around a curve; an open one runs across the period.
fn bounding_box(curve: &Curve) -> Frame {
    let centre = Vec2::new(curve.centre.re, curve.centre.im);
    let half = Vec2::splat(curve.radius);
    Frame::around([centre - half, centre + half])
}

/// True for the curve of a pair whose nodes are closer together and resolve best the film between the two; of curves
/// with the same spacing for the first one.
fn finer(curves: &[Curve], one: usize, other: usize) -> bool {
    curves[one].spacing().total_cmp(&curves[other].spacing()).then(one.cmp(&other)).is_le()
}

/// Product of a row with vectors at the nodes.
fn act(row: &[(f64, Complex64)], vectors: impl Iterator<Item = Complex64>) -> Complex64 {
    row.iter().zip(vectors).fold(Complex64::default(), |sum, ((c, d), v)| sum + (v * *c + v.conj() * d))
}

/// Factors of a force and its conjugate in the single layer.
fn force_factors(kernels: &Kernels, _: Complex64) -> (f64, Complex64) {
    (-kernels.log, 0.5 * kernels.e[0].conj())
}

/// Factors of a velocity and its conjugate in the double layer of an element.
fn stress_factors(kernels: &Kernels, element: Complex64) -> (f64, Complex64) {
    let i = Complex64::new(0.0, 1.0);
    (-2.0 * (element * kernels.c[0]).im, i * (element * kernels.c[0].conj() - (element * kernels.e[1]).conj()))
}
