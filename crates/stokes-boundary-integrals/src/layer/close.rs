//! Corrections of the sums over nodes at nodes close to another curve or to one of their images.
//!
//! The sums over nodes are exact where curves are some spacings apart. A node that is closer gets the difference
//! between the quadrature of [`CloseWeights`](crate::close_weights::CloseWeights) on the fine nodes and the plain sum,
//! both in free space: images farther away and walls are resolved by the plain sum.

use std::f64::consts::PI;

use motile_base::{
    Vec2,
    boxes::{BoxTree, Frame},
    internal::spectrum::{copy_band, largest_wave},
};
use num_complex::Complex64;

use crate::{
    Symmetry,
    close_weights::{CloseWeights, reach},
    curve::Curve,
    density::{Density, StoredLayers},
    greens::Vectors,
    images::Images,
    plan::{Plan, Plans},
    shares,
    transforms::REFINEMENT,
};

use super::rows::Row;

/// Fraction of the force or the weight of a node that each of its fine nodes has.
const FINE_SHARE: f64 = 1.0 / REFINEMENT as f64;

/// Fraction of the velocities that waves shorter than the waves of the shapes have if viscosities differ and films are
/// thinner than the nodes resolve (measured: 4e-4 to 6e-4 at a fifth of the distance of nodes).
const SHORT: f64 = 1e-3;

/// A node close to a curve.
#[derive(Debug, Clone, Copy)]
struct CloseNode {
    target: usize,
    node: usize,
    source: usize,
    /// Position of the node relative to the centre of the source or its image (length).
    point: Complex64,
    /// Flow of the last correction there, except a stored one.
    flow: Complex64,
    /// The rows of the single and of the double layer, if they are stored.
    force_row: Option<Row>,
    stress_row: Option<Row>,
    /// The pole that the logarithm's series is about ([`CloseWeights::modal`]).
    polar: Complex64,
}

/// Values at the fine nodes and at the nodes of a curve that has close nodes, as arrays of components.
#[derive(Debug, Clone, Default)]
struct Source {
    /// Derivatives of the position by the parameter times the weight of the node (length).
    tangents: [Vectors; 2],
    /// Forces, or velocities.
    values: [Vectors; 2],
    /// Flow, by the transposes of rows.
    flow: [Vectors; 2],
    modes: Vec<Complex64>,
    /// True for a source of the present corrections.
    used: bool,
}

impl Source {
    fn load(&mut self, curve: &Curve) {
        for ((fine, tangents), share) in [true, false].into_iter().zip(&mut self.tangents).zip([FINE_SHARE, 1.0]) {
            tangents.fill(&curve.samples(fine).tangent);
            let weight = share * curve.weight();
            tangents.x.iter_mut().chain(&mut tangents.y).for_each(|value| *value *= weight);
        }
        self.load_forces(curve);
        self.used = true;
    }

    fn load_forces(&mut self, curve: &Curve) {
        for (fine, values) in [true, false].into_iter().zip(&mut self.values) {
            values.fill(&curve.samples(fine).force);
        }
    }
}

/// A node on the wrong side of a stored curve, a rigid wall.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    pub(crate) curve: usize,
    pub(crate) wall: usize,
    /// Position of the node (length).
    pub(crate) place: Complex64,
}

/// The corrections of some of the curves, for the present positions.
#[derive(Debug, Clone, Default)]
struct Share {
    /// Numbers of the curves near the present one.
    near: Vec<usize>,
    close: Vec<CloseNode>,
    /// Entries of the rows.
    rows: Vec<f64>,
    squares: Vec<f64>,
    fine: Vec<Complex64>,
    crossing: Option<Crossing>,
}

impl Share {
    /// Finds the nodes that are close to a curve.
    fn find(&mut self, curves: &[Curve], source: usize, search: &Search<'_>) {
        let Self { near, close, squares, .. } = self;
        let curve = &curves[source];
        let reach = search.reach * curve.spacing();
        squares.resize(curve.len(), 0.0);
        near.clear();
        search.tree.each_near(&search.boxes[source], search.images.periods, reach, &mut |target| near.push(target));
        near.sort_unstable();
        for &target in &*near {
            let other = &curves[target];
            if !search.stored.couples(target, source) || search.one_sided && part(curves, target, source) == 0.0 {
                continue;
            }
            let apart = search.images.wrap(other.centre - curve.centre);
            // An open curve has its own images along x.
            for shift in search.images.shifts(curve.is_open()) {
                let own = target == source && shift == Complex64::default();
                let offset = apart + shift;
                let far = |d: Complex64, radii: f64| !curve.is_open() && d.norm_sqr() >= (radii + reach).powi(2);
                if own || far(offset, curve.radius + other.radius) {
                    continue;
                }
                for (node, z) in other.nodes.position.iter().enumerate() {
                    let point = z + offset;
                    if !far(point, curve.radius) && curve.squares_from(point, squares) < reach * reach {
                        let (flow, force_row, stress_row, polar) = Default::default();
                        close.push(CloseNode { target, node, source, point, flow, force_row, stress_row, polar });
                    }
                }
            }
        }
    }

    /// Computes the flow of the corrections of the single layer, or stores them on stored curves; with `stress`, stores
    /// the corrections of the double layer.
    fn find_flow(
        &mut self,
        curves: &[Curve],
        plans: &mut [Plan],
        sources: &[Source],
        (stored, reach, stress): (StoredLayers, f64, bool),
    ) {
        let Self { close, rows, crossing, .. } = self;
        rows.clear();
        *crossing = None;
        for close in close {
            let CloseNode { target, source: number, point, .. } = *close;
            let curve = &curves[number];
            let (weights, source) = (&mut plans[curve.plan].weights, &sources[number]);
            let place = weights.place(curve, point, reach);
            // Fluid is to the left of open walls and outside of closed ones; walls are outside of interfaces.
            if stored.has(target) != stored.has(number)
                && place.is_left().is_some_and(|left| left != (stored.has(number) && curve.is_open()))
            {
                let (curve, wall) = if stored.has(number) { (target, number) } else { (number, target) };
                *crossing = Some(Crossing { curve, wall, place: curves[number].centre + point });
            }
            let stress = stress && !stored.has(number);
            if stress {
                weights.fill::<2>(curve, &place);
            } else {
                weights.fill::<1>(curve, &place);
            }
            close.polar = weights.polar;
            let row = Row::forces(weights.arrays(), rows);
            if stored.has(number) {
                close.force_row = Some(row);
                continue;
            }
            close.flow = row.product(rows, &source.values) + CloseWeights::modal(close.polar, &curve.force);
            rows.truncate(row.start);
            if stress {
                close.stress_row = Some(Row::stresses(weights.arrays(), &source.tangents, rows));
            }
        }
    }

    /// Computes the flow of the corrections of the double layer, `sources` being the sources of the share's curves, of
    /// which the first one has the number `first`.
    fn find_stress_flow(
        &mut self,
        plans: &mut [Plan],
        (curves, sources): (&[Curve], &mut [Source]),
        first: usize,
        density: Density<'_>,
    ) {
        let Self { close, rows, fine, .. } = self;
        for (index, (source, curve)) in sources.iter_mut().zip(curves).enumerate() {
            if source.used && density.contrast(first + index) != 0.0 {
                let (x, y) = density.of(first + index);
                fine.resize(REFINEMENT * x.len(), Complex64::default());
                plans[curve.plan].transforms.at_fine(density.values_of(first + index), fine);
                let [on_fine, nodes] = &mut source.values;
                on_fine.fill(fine);
                nodes.copy([x, y]);
            }
        }
        for close in close {
            let contrast = density.contrast(close.source);
            close.flow = match close.stress_row {
                Some(row) if contrast != 0.0 => row.product(rows, &sources[close.source - first].values) * contrast,
                _ => Complex64::default(),
            };
        }
    }
}

/// Knowledge of all curves that the search for close nodes needs.
struct Search<'a> {
    /// Distance in spacings below which a node is close.
    reach: f64,
    one_sided: bool,
    images: &'a Images,
    stored: StoredLayers,
    boxes: &'a [Frame],
    tree: &'a BoxTree,
}

/// The corrections for the present positions.
#[derive(Debug, Clone)]
pub(crate) struct CloseCorrection {
    tolerance: f64,
    /// Distance in spacings below which a node is close.
    reach: f64,
    symmetry: Symmetry,
    /// Boxes around the curves.
    boxes: Vec<Frame>,
    tree: BoxTree,
    /// Shares of so many curves with so many nodes in all.
    shares: Vec<Share>,
    curves: usize,
    nodes: usize,
    sources: Vec<Source>,
    fine: Vec<Complex64>,
    coarse: Vec<Complex64>,
}

impl CloseCorrection {
    pub(crate) fn new(tolerance: f64, symmetry: Symmetry) -> Self {
        let (boxes, tree, all, sources) = Default::default();
        let [fine, coarse] = Default::default();
        let reach = reach(tolerance);
        Self { tolerance, reach, symmetry, boxes, tree, shares: all, curves: 1, nodes: 0, sources, fine, coarse }
    }

    /// Looks for close nodes as far as the plain sum is not exact to the tolerance: for densities of long waves, or
    /// with short ones besides. Its error is exp(-(n - m) distance) for the wave m on n nodes of a distance of 2 pi/n,
    /// and they carry waves up to n/2.
    pub(crate) fn resolve(&mut self, short: bool) {
        let long = reach(self.tolerance);
        self.reach = if short { long.max(1.0 + (SHORT / self.tolerance).ln() / PI) } else { long };
    }

    /// Finds the nodes that are close to a curve and prepares the fine nodes of the curves that have some.
    pub(crate) fn find(&mut self, curves: &mut [Curve], plans: &mut Plans, images: &Images, stored: StoredLayers) {
        self.nodes = curves.iter().map(Curve::len).sum();
        self.curves = shares::curves(curves.len(), self.nodes);
        let Self { reach, symmetry, boxes, tree, shares: all, curves: len, nodes, sources, .. } = self;
        let (reach, len, nodes) = (*reach, *len, *nodes);
        sources.resize_with(curves.len().max(sources.len()), Source::default);
        all.resize_with(curves.len().div_ceil(len), Share::default);
        boxes.clear();
        boxes.extend(curves.iter().map(bounding_box));
        tree.build_by_place(boxes);
        let one_sided = *symmetry == Symmetry::ToRoundOff;
        let search = Search { reach, one_sided, images, stored, boxes, tree };
        let (search, given) = (&search, &*curves);
        shares::each_of(nodes, all.iter_mut().enumerate(), |(index, share)| {
            share.close.clear();
            for source in *index * len..given.len().min((*index + 1) * len) {
                share.find(given, source, search);
            }
        });
        let pieces = all.iter().zip(curves.chunks_mut(len)).zip(sources.chunks_mut(len)).zip(plans.pieces());
        shares::each_of(nodes, pieces.enumerate(), |(index, (((share, curves), sources), plans))| {
            sources.iter_mut().for_each(|source| source.used = false);
            for close in &share.close {
                let source = close.source - *index * len;
                if !sources[source].used {
                    let curve = &mut curves[source];
                    curve.refine(&mut plans[curve.plan].transforms);
                    sources[source].load(curve);
                }
            }
        });
    }

    /// Adds the corrections of the single layer, or stores them for [`CloseCorrection::add_stored`] on stored curves.
    /// With `stress`, stores the corrections of the double layer.
    pub(crate) fn add_forces(
        &mut self,
        curves: &[Curve],
        plans: &mut Plans,
        stored: StoredLayers,
        stress: bool,
        out: &mut [Vectors],
    ) {
        let Self { reach, shares: all, nodes, sources, .. } = self;
        let given = (stored, *reach, stress);
        shares::each_of(*nodes, all.iter_mut().zip(plans.pieces()), |(share, plans)| {
            share.find_flow(curves, plans, sources, given);
        });
        self.add_flow(out, |close| close.force_row.is_none());
    }

    /// Adds the flow of some of the close nodes.
    fn add_flow(&self, out: &mut [Vectors], which: impl Fn(&CloseNode) -> bool) {
        for close in self.shares.iter().flat_map(|share| &share.close).filter(|close| which(close)) {
            out[close.target].x[close.node] += close.flow.re;
            out[close.target].y[close.node] += close.flow.im;
        }
    }

    /// Returns a node on the wrong side, if the last single layer has come across one.
    pub(crate) fn crossing(&self) -> Option<Crossing> {
        self.shares.iter().rev().find_map(|share| share.crossing)
    }

    /// Returns true for a curve whose forces at the fine nodes the corrections read.
    pub(crate) fn reads(&self, curve: usize) -> bool {
        self.sources.get(curve).is_some_and(|source| source.used)
    }

    /// Adds the corrections of the double layer.
    pub(crate) fn add_dipoles(
        &mut self,
        curves: &[Curve],
        plans: &mut Plans,
        density: Density<'_>,
        out: &mut [Vectors],
    ) {
        let Self { shares: all, curves: len, nodes, sources, .. } = self;
        if all.iter().flat_map(|share| &share.close).all(|close| close.stress_row.is_none()) {
            return;
        }
        let len = *len;
        let pieces = all.iter_mut().zip(curves.chunks(len).zip(sources.chunks_mut(len))).zip(plans.pieces());
        shares::each_of(*nodes, pieces.enumerate(), |(index, ((share, (curves, sources)), plans))| {
            share.find_stress_flow(plans, (curves, sources), *index * len, density);
        });
        self.add_flow(out, |close| close.stress_row.is_some());
    }

    /// Adds the stored corrections of the single layer for the forces at the nodes. If the operator is symmetric to
    /// round-off, the source gets the transpose.
    pub(crate) fn add_stored(&mut self, curves: &[Curve], plans: &mut [Plan], out: &mut [Vectors]) {
        let symmetric = self.symmetry == Symmetry::ToRoundOff;
        let Self { shares: all, sources, .. } = self;
        for (source, curve) in sources.iter_mut().zip(curves).filter(|(source, _)| source.used) {
            source.load_forces(curve);
            if symmetric {
                let nodes = curve.len();
                source.flow.iter_mut().zip([REFINEMENT * nodes, nodes]).for_each(|(flow, len)| flow.clear(len));
                source.modes.clear();
                source.modes.resize(curve.len(), Complex64::default());
            }
        }
        for (close, rows) in all.iter().flat_map(|share| share.close.iter().map(|close| (close, &share.rows))) {
            let Some(row) = close.force_row else { continue };
            let (target, source) = (&curves[close.target], &mut sources[close.source]);
            let share = if symmetric { part(curves, close.target, close.source) } else { 1.0 };
            let modal = CloseWeights::modal(close.polar, &curves[close.source].force);
            let sum = row.product(rows, &source.values) + modal;
            out[close.target].x[close.node] += share * sum.re;
            out[close.target].y[close.node] += share * sum.im;
            if symmetric {
                // The factors act on the components of a force by a symmetric matrix.
                let force = share * target.nodes.force[close.node];
                row.add_transpose(rows, force, &mut source.flow);
                CloseWeights::add_modal_transpose(close.polar, force, &mut source.modes);
            }
        }
        if symmetric {
            self.add_transposes(curves, plans, out);
        }
    }

    /// Adds the flow that the transposes of rows have added up.
    fn add_transposes(&mut self, curves: &[Curve], plans: &mut [Plan], out: &mut [Vectors]) {
        let Self { sources, fine, coarse, .. } = self;
        for ((source, curve), out) in sources.iter().zip(curves).zip(out).filter(|((source, _), _)| source.used) {
            let (transforms, nodes) = (&mut plans[curve.plan].transforms, curve.len());
            let [on_fine, on_nodes] = &source.flow;
            fine.clear();
            fine.extend(on_fine.x.iter().zip(&on_fine.y).map(|(x, y)| Complex64::new(*x, *y) * FINE_SHARE));
            transforms.fine.inverse(fine);
            coarse.resize(nodes, Complex64::default());
            copy_band(fine, coarse, largest_wave(nodes));
            coarse.iter_mut().zip(&source.modes).for_each(|(flow, mode)| *flow += mode);
            transforms.nodes.forward(coarse);
            for (j, flow) in coarse.iter().enumerate() {
                out.x[j] += flow.re + on_nodes.x[j];
                out.y[j] += flow.im + on_nodes.y[j];
            }
        }
    }
}

/// Returns a box around a curve; an open one runs across the period.
pub(crate) fn bounding_box(curve: &Curve) -> Frame {
    let centre = Vec2::new(curve.centre.re, curve.centre.im);
    let half = Vec2::splat(curve.radius);
    Frame::around([centre - half, centre + half])
}

/// Relative difference of spacings up to which they are the same, as for a curve and its mirror image.
const SAME_SPACING: f64 = 1e-9;

/// Returns the part of the corrections between two curves that is computed at the nodes of `target` where the operator
/// is symmetric to round-off: all of it if its nodes are closer together, as they resolve best the film between the
/// two; half of it if both have the same spacing, so that neither is the first and mirror images stay such.
fn part(curves: &[Curve], target: usize, source: usize) -> f64 {
    let [here, there] = [target, source].map(|curve| curves[curve].spacing());
    if (here - there).abs() <= SAME_SPACING * here { 0.5 } else { f64::from(u8::from(here < there)) }
}
