//! Corrections of the sums over nodes for nodes close to another curve or to an image of their own.
//!
//! The sums over nodes are exact where curves are some spacings apart. A node that is closer gets the difference
//! between the accurate quadrature of [`CloseWeights`] and the plain sum, both in free space: images farther away and
//! walls do not notice.

use fourier::spectrum::{copy_band, largest_wave};
use num_complex::Complex64;

use crate::{
    curve::{Curve, REFINEMENT},
    geometry::Images,
    greens::{Flow, Vectors},
    layer::{Density, Kept, Plan},
};

/// A node close to a curve.
#[derive(Debug, Clone, Copy)]
struct CloseNode {
    target: usize,
    node: usize,
    source: usize,
    /// Position of the node relative to the centre of the source or its image (length).
    point: Complex64,
    /// Where its rows start, if they are kept.
    force_row: Option<usize>,
    stress_row: Option<usize>,
}

/// A node on the wrong side of a curve whose forces come later.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    pub(crate) curve: usize,
    pub(crate) wall: usize,
    /// Where (length).
    pub(crate) place: Complex64,
}

/// The corrections for the present positions.
#[derive(Debug, Clone)]
pub(crate) struct CloseCorrection {
    /// Distance in spacings below which a node is close.
    reach: f64,
    /// Whether corrections between two curves are found on one of them only.
    symmetric: bool,
    close: Vec<CloseNode>,
    /// Factors of v and conj v, v a force or a velocity, at the nodes of the source, for each close node.
    rows: Vec<(f64, Complex64)>,
    fine: [Vec<Complex64>; 2],
    coarse: [Vec<Complex64>; 2],
    crossing: Option<Crossing>,
}

impl CloseCorrection {
    pub(crate) fn new(tolerance: f64, symmetric: bool) -> Self {
        let (fine, coarse) = Default::default();
        Self { reach: reach(tolerance), symmetric, close: Vec::new(), rows: Vec::new(), fine, coarse, crossing: None }
    }

    /// Looks for close nodes and prepares the fine nodes of the curves that have some.
    pub(crate) fn find(&mut self, curves: &mut [Curve], plans: &mut [Plan], images: &Images, kept: Kept) {
        self.close.clear();
        for source in 0..curves.len() {
            let curve = &curves[source];
            let reach = self.reach * curve.spacing();
            let first = self.close.len();
            for (target, other) in curves.iter().enumerate() {
                if !kept.pair(target, source) || self.symmetric && !finer(curves, target, source) {
                    continue;
                }
                let apart = images.wrap(other.centre - curve.centre);
                // An open curve goes on in x by itself.
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

    /// Adds the corrections of the single layer, or keeps them for [`CloseCorrection::add_kept`], and keeps those of
    /// the double layer if `stress` is asked for.
    pub(crate) fn add_forces(
        &mut self,
        curves: &[Curve],
        plans: &mut [Plan],
        kept: Kept,
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
            if kept.is_kept(target) != kept.is_kept(source)
                && left.is_some_and(|left| left != (kept.is_kept(source) && curve.is_open()))
            {
                let (curve, wall) = if kept.is_kept(source) { (target, source) } else { (source, target) };
                self.crossing = Some(Crossing { curve, wall, place: curves[source].centre + point });
            }
            if kept.is_kept(source) {
                self.close[index].force_row = Some(self.push_force_row(curve, plan, point));
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
                self.close[index].stress_row = Some(self.push_stress_row(curve, plan, point));
            }
        }
    }

    /// A node that the last look has found on the wrong side.
    pub(crate) fn crossing(&self) -> Option<Crossing> {
        self.crossing
    }

    /// The single layer at the point of the present weights as factors of the forces at the nodes.
    fn push_force_row(&mut self, curve: &Curve, plan: &mut Plan, point: Complex64) -> usize {
        let factors = |log: f64, e: Complex64| (-log, 0.5 * e.conj());
        let greens = curve.greens();
        let fine = |plan: &Plan, j: usize| {
            let kernels = plan.weights.kernels(j);
            factors(kernels.log, kernels.e[0])
        };
        let node = |j: usize| {
            let kernels = greens.at(curve.nodes.position[j] - point);
            factors(kernels.log, kernels.e[0])
        };
        // Forces at the nodes are shared among the fine nodes.
        self.push_row(curve, plan, 1.0 / REFINEMENT as f64, fine, node)
    }

    /// The double layer at the point of the present weights as factors of the velocities at the nodes.
    fn push_stress_row(&mut self, curve: &Curve, plan: &mut Plan, point: Complex64) -> usize {
        let weight = curve.weight();
        let greens = curve.greens();
        let fine = |plan: &Plan, j: usize| {
            let kernels = plan.weights.kernels(j);
            factors(kernels.c[0], kernels.e[1], curve.fine.tangent[j] * (weight / REFINEMENT as f64))
        };
        let node = |j: usize| {
            let kernels = greens.at(curve.nodes.position[j] - point);
            factors(kernels.c[0], kernels.e[1], curve.nodes.tangent[j] * weight)
        };
        self.push_row(curve, plan, 1.0, fine, node)
    }

    /// Keeps the factors at the fine nodes, which go through the transpose of the interpolation times `share`, less
    /// those at the nodes.
    fn push_row(
        &mut self,
        curve: &Curve,
        plan: &mut Plan,
        share: f64,
        fine_factors: impl Fn(&Plan, usize) -> (f64, Complex64),
        node_factors: impl Fn(usize) -> (f64, Complex64),
    ) -> usize {
        let nodes = curve.len();
        for (array, len) in self.fine.iter_mut().map(|array| (array, REFINEMENT * nodes)) {
            array.resize(len, Complex64::default());
        }
        self.coarse.iter_mut().for_each(|array| array.resize(nodes, Complex64::default()));
        let [own, conjugate] = &mut self.fine;
        for j in 0..own.len() {
            let (c, d) = fine_factors(plan, j);
            own[j] = Complex64::new(c, 0.0);
            conjugate[j] = d;
        }
        for (fine, coarse) in self.fine.iter_mut().zip(&mut self.coarse) {
            plan.transforms.fine.inverse(fine);
            copy_band(fine, coarse, largest_wave(nodes));
            plan.transforms.nodes.forward(coarse);
        }
        let first = self.rows.len();
        for j in 0..nodes {
            let (c, d) = node_factors(j);
            self.rows.push((share * self.coarse[0][j].re - c, share * self.coarse[1][j] - d));
        }
        first
    }

    /// Adds the corrections of the double layer.
    pub(crate) fn add_dipoles(&self, density: Density<'_>, out: &mut [Vectors]) {
        for close in &self.close {
            let Some(row) = close.stress_row else { continue };
            let (vx, vy) = density.of(close.source);
            let sum = act(&self.rows[row..row + vx.len()], vx, vy) * density.contrasts[close.source];
            out[close.target].x[close.node] += sum.re;
            out[close.target].y[close.node] += sum.im;
        }
    }

    /// Adds the corrections of the single layer that were kept, for forces at the nodes. Where they are symmetric the
    /// curve that they were not found on gets their transpose.
    pub(crate) fn add_kept(&self, curves: &[Curve], out: &mut [Vectors]) {
        for close in &self.close {
            let Some(row) = close.force_row else { continue };
            let (target, source) = (&curves[close.target], &curves[close.source]);
            let row = &self.rows[row..row + source.len()];
            // Each of two images of the same curve gives half.
            let share = if self.symmetric && close.target == close.source { 0.5 } else { 1.0 };
            let mut sum = Complex64::default();
            for ((c, d), force) in row.iter().zip(&source.nodes.force) {
                sum += force * *c + force.conj() * d;
            }
            out[close.target].x[close.node] += share * sum.re;
            out[close.target].y[close.node] += share * sum.im;
            if self.symmetric {
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

/// Whether the nodes of a curve are closer together than those of another one, of two with the same spacing whether it
/// is the first one: they resolve best what is between the two.
fn finer(curves: &[Curve], one: usize, other: usize) -> bool {
    curves[one].spacing().total_cmp(&curves[other].spacing()).then(one.cmp(&other)).is_le()
}

/// The product of a row with vectors at the nodes.
fn act(row: &[(f64, Complex64)], vx: &[f64], vy: &[f64]) -> Complex64 {
    let mut sum = Complex64::default();
    for (j, (c, d)) in row.iter().enumerate() {
        let v = Complex64::new(vx[j], vy[j]);
        sum += v * *c + v.conj() * d;
    }
    sum
}

/// Distance in spacings beyond which the trapezoidal rule is exact to a tolerance: its error falls like
/// exp(-2 pi distance/spacing).
pub(crate) fn reach(tolerance: f64) -> f64 {
    1.0 - tolerance.ln() / std::f64::consts::TAU
}

/// Factors of v and conj v in the double layer of an element, from the kernels c_1 and e_2.
fn factors(c: Complex64, e: Complex64, tangent: Complex64) -> (f64, Complex64) {
    let i = Complex64::new(0.0, 1.0);
    (-2.0 * (tangent * c).im, i * (tangent * c.conj() - (tangent * e).conj()))
}
