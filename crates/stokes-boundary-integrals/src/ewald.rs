//! Fast sums of layers over many nodes in the plane, a periodic box or a channel, linear in their number.
//!
//! The Green's function is split into a part that ends at a cut-off, summed over the nodes within it ([`near`]), and a
//! smooth part with a bounded spectrum. Its sources are spread to a grid, transformed, multiplied by the spectrum,
//! transformed back and interpolated (Ewald, Ann. Phys. 369, 253, 1921; Lindbo and Tornberg, J. Comput. Phys. 230,
//! 8744, 2011). The [`split`] is by a prolate function (Jiang and Greengard, Commun. Pure Appl. Math. 78, 2025), which
//! needs the fewest waves. Sums over nodes equal the sums of [`crate::direct`] to the tolerance: the quadrature is the
//! same, the weights of Kress one cyclic product per curve.

mod cells;
mod cluster;
mod columns;
mod lattice;
mod near;
pub(crate) mod polynomial;
pub(crate) mod prolate;
mod rows;
mod sampled;
mod split;
mod window;

use std::{f64::consts::PI, ops::Range};

use motile_base::{InputError, Region, Vec2, internal::spectrum::is_product};

use crate::{
    curve::Curve,
    density::Density,
    direct::{add_dipole_at_node, dipole},
    greens::{Vectors, walls::Uncorrected},
    images::Images,
    plan::Plans,
    shares,
};
use cells::{Cells, FEWEST};
use cluster::Cluster;
pub(crate) use cluster::{filling, spread};
use columns::{Columns, Part, write_rows};
use lattice::Lattice;
use near::{Carried, Near};
use rows::Rows;
use sampled::Smooth;
use split::Split;
use window::{OVERSAMPLING, Window};

/// Cut-off over the mean distance of nodes, the root of area over number, at which near part and grid cost alike
/// (measured).
const CUTOFF: f64 = 3.0;
/// Classes of the number of nodes in a factor of 2: all numbers of a class have the same cut-off, so that a few more
/// nodes change neither grid nor memory.
const CLASSES: f64 = 2.0;

/// Cut-off in the plane, whose nodes fill only a fraction of the box, over that in a box of as many nodes (measured).
const IN_PLANE: f64 = 0.6;

/// Fast sums over the nodes of curves in the plane, a box or a channel, with plans and working memory.
#[derive(Debug, Clone)]
pub(crate) struct Ewald {
    split: Split,
    /// Grids that samples of the flow need besides, once there have been some.
    smooth: Option<Smooth>,
    tolerance: f64,
    window: Window,
    lattice: Lattice,
    /// Width of a channel (length), whose box is higher by the cut-off: then no image beyond its upper and lower side
    /// is within the cut-off of the channel.
    width: Option<f64>,
    /// Maker of the box of nodes in the plane.
    cluster: Option<Box<Cluster>>,
    /// Distance beyond which the smooth part is all there is (length).
    cutoff: f64,
    size: [usize; 2],
    rows: Vec<Rows>,
    columns: Vec<Columns>,
    cells: Cells,
    near: Vec<Near>,
    /// Points at which the flow is sampled.
    targets: Cells,
    /// Distance from them below which nodes are left out (length).
    left_out: f64,
    /// Sources of the entries of the cells.
    carried: [Vec<f64>; 3],
    /// Sources at the nodes, curve after curve, then the flow there.
    nodes: [Vec<f64>; 3],
}

impl Ewald {
    /// Returns the sums to a relative tolerance over the nodes of curves, at `points` (length), or at the nodes if
    /// there are no points; none in regions of revolution.
    ///
    /// # Errors
    /// Returns an error for a grid too large for a transform.
    pub(crate) fn new(
        region: &Region,
        images: &Images,
        tolerance: f64,
        curves: &[Curve],
        points: &[Vec2],
    ) -> Result<Option<Self>, InputError> {
        let width = if let Region::Channel { width, .. } = region { Some(*width) } else { None };
        let mut cluster = (*region == Region::Plane).then(|| Box::new(Cluster::new(tolerance)));
        let around = cluster.as_mut().map(|cluster| cluster.set(curves, points)).transpose()?;
        let Some(lattice) = Lattice::of(around.as_ref().unwrap_or(images), width.unwrap_or(0.0)) else {
            return Ok(None);
        };
        let (split, window) = (Split::new(tolerance), Window::new(tolerance));
        let (rows, columns, cells, near, targets, carried, nodes) = Default::default();
        let mut ewald = Self {
            split,
            smooth: None,
            tolerance,
            window,
            lattice,
            width,
            cluster,
            cutoff: 0.0,
            size: [0; 2],
            rows,
            columns,
            cells,
            near,
            targets,
            left_out: 0.0,
            carried,
            nodes,
        };
        ewald.plan(count(curves, points))?;
        Ok(Some(ewald))
    }

    /// Returns the relative tolerance.
    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Takes over the images of a box, the curves, and `points` as in [`Ewald::new`]; grid and transforms are kept
    /// where they fit.
    ///
    /// # Errors
    /// Returns an error for a grid too large for a transform.
    pub(crate) fn set(&mut self, images: &Images, curves: &[Curve], points: &[Vec2]) -> Result<(), InputError> {
        let nodes = count(curves, points);
        let around = self.cluster.as_mut().map(|cluster| cluster.set(curves, points)).transpose()?;
        let before = self.lattice;
        self.lattice = Lattice::of(around.as_ref().unwrap_or(images), before.lengths[1]).unwrap_or(before);
        if before.steepest != self.lattice.steepest
            || self.cutoff != self.cutoff_for(nodes)
            || self.cluster.is_some() && before != self.lattice
        {
            return self.plan(nodes);
        }
        if before != self.lattice {
            self.set_symbol();
        }
        Ok(())
    }

    /// Returns the cut-off for so many nodes (length), at most what keeps each node to one image within it.
    fn cutoff_for(&self, nodes: usize) -> f64 {
        let class = 2f64.powf((CLASSES * (nodes.max(1) as f64).log2()).ceil() / CLASSES);
        let [lx, ly] = self.lattice.lengths;
        // The box of a channel is twice as high as its width at most.
        let height = self.width.unwrap_or(ly);
        let most = [lx / self.lattice.stretch(), self.width.map_or(ly, |width| 2.0 * width)];
        let most = most.map(|length| 2.0 / FEWEST as f64 * length);
        let part = if self.cluster.is_some() { IN_PLANE } else { 1.0 };
        (part * CUTOFF * (lx * height / class).sqrt()).min(most[0]).min(most[1])
    }

    fn plan(&mut self, nodes: usize) -> Result<(), InputError> {
        self.cutoff = self.cutoff_for(nodes);
        if let Some(width) = self.width {
            self.lattice.lengths[1] = width + self.cutoff;
        }
        let largest = self.split.c / self.cutoff;
        let stretch = [1.0, self.lattice.stretch()];
        let waves = [0, 1].map(|axis| largest * stretch[axis] * self.lattice.lengths[axis] / (2.0 * PI));
        let points = self.window.points;
        self.size = waves.map(|waves| smooth((2.0 * OVERSAMPLING * waves).ceil().max(2.0 * points as f64) as usize));
        self.cells.sort(&self.lattice, self.cutoff, true, std::iter::empty());
        self.rows = Rows::divide(self.cells.counts()[1], self.size, points)?;
        self.columns = Columns::divide(waves[0] as usize, self.size)?;
        self.set_symbol();
        Ok(())
    }

    fn set_symbol(&mut self) {
        let Self { columns, lattice, cutoff, split, window, .. } = self;
        shares::each(columns, |share| share.set_symbol(lattice, *cutoff, split, window));
    }

    /// Returns the part of the sums that walls are to correct.
    pub(crate) fn uncorrected(&self) -> Uncorrected {
        if self.width.is_some() { Uncorrected::Box { reach: self.cutoff } } else { Uncorrected::Row }
    }

    /// Takes over the nodes of curves.
    pub(crate) fn place(&mut self, curves: &[Curve]) {
        if let Some(cluster) = &mut self.cluster {
            cluster.place(curves);
        }
        let points = curves
            .iter()
            .flat_map(|curve| curve.nodes.position.iter().map(|z| [z.re + curve.centre.re, z.im + curve.centre.im]));
        self.cells.sort(&self.lattice, self.cutoff, true, points);
    }

    /// Adds the single layers of some curves at the nodes of all, of a curve on itself by the rule of Kress.
    pub(crate) fn add_forces(&mut self, curves: &[Curve], from: Range<usize>, plans: &mut Plans, out: &mut [Vectors]) {
        self.load_forces(curves, from.clone());
        self.carry(2);
        self.sum(false);
        if let Some(cluster) = &mut self.cluster {
            cluster.remove_forces([&self.nodes[0], &self.nodes[1]], out);
        }
        // The smooth part of a node at itself; without the logarithm of the cut-off, which is in that of each pair.
        let own = self.split.own - self.cutoff.ln();
        self.scatter(out);
        let nodes = self.nodes[0].len();
        let len = shares::curves(curves.len(), nodes);
        let (curves, out) = (&curves[from.clone()], &mut out[from]);
        let pieces = curves.chunks(len).zip(out.chunks_mut(len)).zip(plans.pieces());
        shares::each_of(nodes, pieces, |((curves, out), plans)| {
            for (curve, out) in curves.iter().zip(&mut **out) {
                let kress = plans[curve.plan].kress_flow(curve);
                let nodes = kress.iter().zip(&curve.nodes.force).zip(&curve.nodes.tangent);
                for (i, ((kress, force), tangent)) in nodes.enumerate() {
                    let square = tangent.norm_sqr();
                    let even = -0.5 * square.ln() - own;
                    let along = tangent * ((tangent.conj() * force).re / square);
                    let flow = kress + force * even + along;
                    out.x[i] += flow.re;
                    out.y[i] += flow.im;
                }
            }
        });
    }

    /// Adds the double layers of all curves at their nodes, of zero mean over the box.
    pub(crate) fn add_dipoles(&mut self, curves: &[Curve], density: Density<'_>, out: &mut [Vectors]) {
        self.load_dipoles(curves, density);
        self.carry(3);
        self.sum(true);
        if let Some(cluster) = &mut self.cluster {
            cluster.remove_dipoles(self.nodes.each_ref().map(Vec::as_slice), out);
        }
        self.scatter(out);
        for (index, (curve, contrast)) in curves.iter().zip(density.contrasts).enumerate() {
            let (x, y) = density.of(index);
            let weight = contrast * curve.weight();
            for i in 0..curve.len() {
                add_dipole_at_node(curve, i, dipole([x[i], y[i]], curve.nodes.tangent[i] * weight), &mut out[index]);
            }
        }
    }

    /// Takes over the forces at the nodes of some curves, none at others.
    fn load_forces(&mut self, curves: &[Curve], from: Range<usize>) {
        self.nodes.iter_mut().for_each(Vec::clear);
        for (index, curve) in curves.iter().enumerate() {
            let part = if from.contains(&index) { 1.0 } else { 0.0 };
            for force in &curve.nodes.force {
                self.nodes[0].push(part * force.re);
                self.nodes[1].push(part * force.im);
            }
        }
    }

    /// Takes over the dipoles at the nodes of the curves that have a density, none at others.
    fn load_dipoles(&mut self, curves: &[Curve], density: Density<'_>) {
        self.nodes.iter_mut().for_each(Vec::clear);
        for (index, (curve, contrast)) in curves.iter().zip(density.contrasts).enumerate() {
            let (x, y) = density.of(index);
            let weight = contrast * curve.weight();
            for ((x, y), tangent) in x.iter().zip(y).zip(&curve.nodes.tangent) {
                let dipole = dipole([*x, *y], tangent * weight);
                self.nodes.iter_mut().zip(dipole).for_each(|(array, value)| array.push(value));
            }
        }
        let all = curves.iter().map(Curve::len).sum();
        self.nodes.iter_mut().for_each(|array| array.resize(all, 0.0));
    }

    /// Distributes what the nodes carry, in the first arrays, to the entries of the cells.
    fn carry(&mut self, parts: usize) {
        let Self { cells, carried, nodes, .. } = self;
        for (carried, nodes) in carried.iter_mut().zip(nodes).take(parts) {
            carried.resize(cells.points.len(), 0.0);
            let len = shares::length(carried.len());
            let pieces = carried.chunks_mut(len).zip(cells.points.chunks(len));
            shares::each_of(cells.points.len(), pieces, |(carried, points)| {
                carried.iter_mut().zip(*points).for_each(|(carried, &point)| *carried = nodes[point as usize]);
            });
        }
    }

    /// Computes near part and smooth part at the entries.
    fn sum(&mut self, double: bool) {
        self.spread(double, Part::Velocity);
        let Self { split, window, cutoff, rows, cells, near, carried: [a, b, c], .. } = self;
        let (split, window, cells) = (&*split, &*window, &*cells);
        let (a, b, c) = (a.as_slice(), b.as_slice(), c.as_slice());
        let (carried, factor) =
            if double { (Carried::Dipoles([a, b, c]), 1.0 / *cutoff) } else { (Carried::Forces([a, b]), 1.0) };
        Near::divide(near, cells);
        shares::each(near, |share| share.sum(split, cells, carried, factor));
        shares::each(rows, |share| {
            share.begin(cells);
            share.interpolate(cells, window);
        });
    }

    /// Computes one quantity of the smooth flow of what the entries carry on the grid.
    fn spread(&mut self, double: bool, part: Part) {
        let Self { window, lattice, rows, columns, cells, carried: [a, b, c], .. } = self;
        let (window, lattice, cells) = (&*window, &*lattice, &*cells);
        let (a, b, c) = (a.as_slice(), b.as_slice(), c.as_slice());
        if double {
            shares::each(rows, |share| share.spread(cells, window, |i| [a[i] + c[i], 0.0]));
            transform(rows, columns, true);
            shares::each(rows, |share| share.spread(cells, window, |i| [0.5 * (a[i] - c[i]), 0.5 * b[i]]));
            transform(rows, columns, false);
            shares::each(columns, |share| share.apply_stress(lattice, part));
        } else {
            shares::each(rows, |share| share.spread(cells, window, |i| [a[i], b[i]]));
            transform(rows, columns, false);
            shares::each(columns, |share| share.apply_stokeslet(lattice, part));
        }
        {
            let columns = columns.as_slice();
            shares::each(rows, |share| {
                share.transform_back(|first, stride, rows| write_rows(columns, first, stride, rows));
            });
        }
        rows::unfold(rows);
    }

    /// Adds the flow at the entries to that at the nodes.
    fn scatter(&mut self, out: &mut [Vectors]) {
        let Self { rows, cells, near, nodes: [u, v, _], .. } = self;
        for Near { rows, flow, .. } in near {
            let first = rows.clone().next().map_or(0, |row| cells.row(row).start);
            for entry in rows.clone().flat_map(|row| cells.row(row)) {
                let node = cells.points[entry] as usize;
                (u[node], v[node]) = (flow[0][entry - first], flow[1][entry - first]);
            }
        }
        for share in rows {
            let first = share.entries(cells).start;
            for entry in share.cells.clone().flat_map(|row| cells.row(row)) {
                let node = cells.points[entry] as usize;
                u[node] += share.flow[0][entry - first];
                v[node] += share.flow[1][entry - first];
            }
        }
        let mut first = 0;
        for Vectors { x, y } in out {
            let all = first..first + x.len();
            x.iter_mut().zip(&u[all.clone()]).for_each(|(x, u)| *x += u);
            y.iter_mut().zip(&v[all.clone()]).for_each(|(y, v)| *y += v);
            first = all.end;
        }
    }
}

/// Returns the number of nodes, or the geometric mean of their number and the number of points: near part and grid cost
/// alike for one product of both numbers.
fn count(curves: &[Curve], points: &[Vec2]) -> usize {
    let nodes = curves.iter().map(Curve::len).sum::<usize>();
    if points.is_empty() { nodes } else { (nodes as f64 * points.len() as f64).sqrt().ceil() as usize }
}

/// Transforms what has been spread to the columns of the spectrum.
fn transform(rows: &mut [Rows], columns: &mut [Columns], traces: bool) {
    rows::fold(rows);
    shares::each(rows, Rows::transform);
    let rows = &*rows;
    shares::each(columns, |share| share.gather(rows, traces));
}

/// Returns the least even number from a given one on without prime factors above 5, which is fast to transform.
fn smooth(least: usize) -> usize {
    let mut number = least.next_multiple_of(2);
    while !is_product(number, &[2, 3, 5]) {
        number += 2;
    }
    number
}
