//! The flow at points anywhere: velocity, pressure and velocity gradient.

use std::f64::consts::{PI, TAU};

use motile_base::{
    FlowSample, InputError, Vec2,
    boxes::{BoxTree, Frame},
};
use num_complex::Complex64;

use crate::{
    close_weights::{CloseWeights, reach},
    curve::Curve,
    density::Density,
    ewald::{Ewald, spread},
    greens::{Flow, GreensFunction, Kernels, walls::Uncorrected},
    layer::{Layers, bounding_box},
    plan::Plan,
    rigid_motion::RigidMotion,
    transforms::REFINEMENT,
};

/// Fraction of a radius by which two positions of the same node may differ by round-off.
const SAME_NODE: f64 = 1e-10;

/// Pairs of nodes and points from which on fast sums cost less than sums over pairs (measured).
const MANY_PAIRS: f64 = 2.5e5;
/// Nodes from which on they do so in the plane, and distance of points from the middle of nodes over the distance of
/// nodes up to which they do (measured).
const MANY_NODES: usize = 300;
const FARTHEST: f64 = 3.0;
/// Tolerance of fast sums over the tolerance of velocities: gradients are less accurate, and lose more accuracy if the
/// cut-off is smaller.
const SHARPER: f64 = 0.1;
/// Fraction of the minimum distance at which points are close below which nodes are left out of fast sums.
const LEFT_OUT: f64 = 0.5;

/// Evaluation of layers at points, with its working memory.
#[derive(Debug, Clone)]
pub(crate) struct Sampler {
    /// Distance in spacings below which a point is close to a curve.
    reach: f64,
    /// The point relative to the images of a curve that it is close to.
    close: Vec<Complex64>,
    /// Mean of the double layer in a box.
    mean: Complex64,
    /// The image of the last point in a curve itself, not in an image of the curve (length).
    home: Vec2,
    /// Fast sums over the nodes at many points, once there have been some.
    sums: Option<Box<Ewald>>,
    /// The flow of the nodes at all points by fast sums; empty without them.
    fast: Vec<Flow>,
    /// Boxes around the curves, and the numbers of those that may be close to the last point.
    tree: BoxTree,
    near: Vec<usize>,
    /// Distance at which points are close to the curve with the largest spacing (length).
    farthest: f64,
}

/// Place of a point among curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Place {
    /// Outside of all curves.
    Exterior,
    /// Inside a closed curve, the innermost.
    Inside(usize),
    /// On one of the sides of an open curve, the nearest.
    Beside {
        /// Number of the curve.
        curve: usize,
        /// True on the left, the inside.
        left: bool,
    },
}

impl Sampler {
    pub(crate) fn new(tolerance: f64) -> Self {
        let (close, mean, sums, fast, tree, near) = Default::default();
        Self { reach: reach(tolerance), close, mean, home: Vec2::ZERO, sums, fast, tree, near, farthest: 0.0 }
    }

    /// Writes the flow at points, the single layer less the double layer and the forced flow. Fluid inside a closed
    /// curve, next to an open one, or outside of all, has the viscosity `viscosity(place)`; the curves that have a
    /// motion are rigid bodies.
    ///
    /// # Errors
    /// Returns an error for a grid of fast sums too large for a transform.
    pub(crate) fn sample(
        &mut self,
        layers: &mut Layers,
        density: Density<'_>,
        points: &[Vec2],
        out: &mut [FlowSample],
        viscosity: impl Fn(Place) -> f64,
        motion: impl Fn(usize) -> Option<RigidMotion>,
    ) -> Result<(), InputError> {
        layers.curves.iter_mut().for_each(|curve| curve.refine(&mut layers.plans[curve.plan].transforms));
        if let Some(walls) = layers.walls.as_mut().filter(|walls| walls.uses_images()) {
            // The flow at points is summed by modes.
            walls.use_modes(&mut layers.curves, &mut layers.plans)?;
        }
        layers.refine(density, |_| true);
        let (uncorrected, sharper) = self.sum_nodes(layers, density, points)?;
        let points = points.iter().map(|point| Complex64::new(point.x, point.y));
        self.mean = layers.mean_flow(density).unwrap_or_default();
        if let Some(walls) = &mut layers.walls {
            walls.prepare_points(&layers.curves, density, &layers.fine, (uncorrected, sharper), points.clone());
        }
        let exterior = viscosity(Place::Exterior);
        let forced = layers.forced_flow(exterior);
        // The mean pressure gradient of a channel is no part of a sample.
        let pressure_slope = exterior * layers.imposed.bend;
        for (index, (point, out)) in points.zip(out).enumerate() {
            let (flow, inside) = self.flow_at(layers, index, point, density);
            let place = Vec2::new(point.re, point.im);
            // In a sheared box an image moves along with the imposed flow there: the velocity is that at home, in the
            // curve itself, and the difference of the imposed flow.
            let home = if let Place::Exterior = inside { place } else { self.home };
            let beyond = forced.velocity_at(place) - forced.velocity_at(home);
            if let Place::Inside(curve) = inside
                && let Some(motion) = motion(curve)
            {
                let velocity = motion.at(home) + beyond;
                *out = FlowSample { velocity, pressure: 0.0, gradient: [[0.0, -motion.spin], [motion.spin, 0.0]] };
                continue;
            }
            let viscosity = viscosity(inside);
            let scale = 1.0 / (4.0 * PI * viscosity);
            let share = exterior / viscosity;
            *out = FlowSample {
                velocity: Vec2::new(flow.velocity.re * scale, flow.velocity.im * scale)
                    + forced.velocity_at(home) * share
                    + beyond,
                pressure: flow.pressure / (4.0 * PI) + pressure_slope * place.x,
                gradient: flow.gradient().map(|row| row.map(|slope| slope * scale)),
            };
            let forced = forced.gradient_at(place);
            for (row, forced) in out.gradient.iter_mut().zip(forced) {
                row.iter_mut().zip(forced).for_each(|(slope, forced)| *slope += forced * share);
            }
        }
        Ok(())
    }

    /// Returns the sums over the nodes at all points at once where nodes times points are many; the part of the sums
    /// that walls are to correct, and their tolerance over the tolerance of velocities.
    fn sum_nodes(
        &mut self,
        layers: &mut Layers,
        density: Density<'_>,
        points: &[Vec2],
    ) -> Result<(Uncorrected, f64), InputError> {
        self.fast.clear();
        self.near.clear();
        if !pays(layers, points) {
            self.near.extend(0..layers.curves.len());
            return Ok((Uncorrected::Row, 1.0));
        }
        let sharper = SHARPER * layers.sharpness;
        let tolerance = SHARPER * layers.sharp_tolerance();
        let Layers { region, images, curves, .. } = layers;
        match &mut self.sums {
            Some(sums) if sums.tolerance() == tolerance => sums.set(images, curves, points)?,
            sums => *sums = Ewald::new(region, images, tolerance, curves, points)?.map(Box::new),
        }
        let Some(sums) = &mut self.sums else { return Ok((Uncorrected::Row, 1.0)) };
        let spacings = curves.iter().map(Curve::spacing);
        let nearest = LEFT_OUT * self.reach * spacings.clone().fold(f64::INFINITY, f64::min);
        self.farthest = self.reach * spacings.fold(0.0, f64::max);
        sums.sample(curves, density, points, nearest, &mut self.fast);
        let boxes: Vec<Frame> = curves.iter().map(bounding_box).collect();
        self.tree.build_by_place(&boxes);
        Ok((sums.uncorrected(), sharper))
    }

    /// Returns the flow at the point of that number, and its place among the curves with a density.
    fn flow_at(&mut self, layers: &mut Layers, index: usize, point: Complex64, density: Density<'_>) -> (Flow, Place) {
        let mut flow = Flow::default();
        let mut inside = Place::Exterior;
        let mut nearest = f64::INFINITY;
        let images = layers.images;
        if let Some(summed) = self.fast.get(index) {
            flow = *summed;
            self.near.clear();
            let place = Frame::around([Vec2::new(point.re, point.im)]);
            self.tree.each_near(&place, images.periods, self.farthest, &mut |number| self.near.push(number));
            self.near.sort_unstable();
        }
        for near in 0..self.near.len() {
            let number = self.near[near];
            let curve = &layers.curves[number];
            let (apart, distance) = (images.wrap(point - curve.centre), self.reach * curve.spacing());
            let open = curve.is_open();
            self.close.clear();
            // An open curve has its own images along x.
            for shift in images.shifts(open) {
                let point = apart + shift;
                let curve = &layers.curves[number];
                if !open && point.norm() > curve.radius + distance {
                    continue;
                }
                let squares = curve.nodes.position.iter().map(|z| curve.wrap(z - point).norm_sqr());
                let (close, away) = if open {
                    let away = squares.fold(f64::INFINITY, f64::min);
                    (away < distance * distance, away)
                } else {
                    let mut squares = squares;
                    (squares.any(|square| square < distance * distance), f64::INFINITY)
                };
                let side = if close {
                    self.close.push(point);
                    self.add_close(layers, number, point, density, &mut flow)
                } else {
                    None
                };
                let curve = &layers.curves[number];
                if number >= density.contrasts.len() {
                    continue;
                }
                let left = || side.unwrap_or_else(|| curve.winds_around(point));
                let before = inside;
                // Of open curves the nearest tells, of closed ones, which lie between them, the innermost.
                inside = match inside {
                    Place::Exterior | Place::Beside { .. } if open && away < nearest => {
                        nearest = away;
                        Place::Beside { curve: number, left: left() }
                    }
                    Place::Inside(other) if !open && curve.radius < layers.curves[other].radius && left() => {
                        Place::Inside(number)
                    }
                    Place::Exterior | Place::Beside { .. } if !open && left() => Place::Inside(number),
                    place => place,
                };
                if inside != before {
                    let home = curve.centre + point;
                    self.home = Vec2::new(home.re, home.im);
                }
            }
            self.add_nodes(layers, number, apart, density, &mut flow);
        }
        match &layers.walls {
            Some(walls) => walls.add_flow(index, &mut flow),
            None => flow.velocity += self.mean,
        }
        (flow, inside)
    }

    /// Adds the flow of one image of a curve by the quadrature for close points; true for a point on the left of the
    /// curve, if it is close to the fine nodes as well.
    fn add_close(
        &self,
        layers: &mut Layers,
        number: usize,
        point: Complex64,
        density: Density<'_>,
        flow: &mut Flow,
    ) -> Option<bool> {
        let Layers { curves, plans, fine, .. } = layers;
        let curve = &curves[number];
        let Plan { weights, .. } = &mut plans[curve.plan];
        let place = weights.place(curve, point, self.reach);
        let (inside, contrast) = (place.is_left(), density.contrast(number));
        if contrast == 0.0 {
            weights.fill::<2>(curve, &place);
        } else {
            weights.fill::<3>(curve, &place);
        }
        for (j, force) in curve.fine.force.iter().enumerate() {
            flow.add_force(&weights.fine.at(j), *force, 1.0);
        }
        flow.velocity += CloseWeights::modal(weights.polar, &curve.force);
        if contrast == 0.0 {
            return inside;
        }
        let len = REFINEMENT * curve.len();
        let velocities = &fine[number * len..(number + 1) * len];
        // The double layer of a constant is known: with the velocity of the nearest node subtracted, nothing is divided
        // by a small distance.
        let constant = if inside.is_some() { velocities[place.nearest] } else { Complex64::default() };
        let turns = match (inside, curve.is_open()) {
            (None, _) | (Some(false), false) => 0.0,
            (Some(true), false) => 2.0,
            (Some(true), true) => 1.0,
            (Some(false), true) => -1.0,
        };
        flow.velocity += constant * (turns * TAU * contrast);
        let weight = contrast * curve.weight() / REFINEMENT as f64;
        for (j, velocity) in velocities.iter().enumerate() {
            flow.add_dipole(&weights.fine.at(j), velocity - constant, curve.fine.tangent[j] * weight, 1.0);
        }
        inside
    }

    /// Adds the flow of the nodes of a curve and of all its images but the close ones, which have been added.
    fn add_nodes(&self, layers: &Layers, number: usize, apart: Complex64, density: Density<'_>, flow: &mut Flow) {
        let curve = &layers.curves[number];
        let contrast = density.contrast(number);
        let weight = curve.weight() * contrast;
        let velocities = (contrast != 0.0).then(|| density.of(number));
        let greens = curve.greens();
        if let (Some(sums), false) = (&self.sums, self.fast.is_empty()) {
            // The nodes are in the sums over all, and in the quadrature for close points.
            for (point, (i, z)) in self
                .close
                .iter()
                .flat_map(|point| curve.nodes.position.iter().enumerate().map(move |node| (point, node)))
            {
                let d = curve.wrap(z - point);
                let kernels = match sums.leaves_out(d) {
                    false => greens.at(d),
                    true if curve.is_open() => greens.without_nearest(d),
                    true => continue,
                };
                flow.add_force(&kernels, curve.nodes.force[i], -1.0);
                if let Some((vx, vy)) = velocities {
                    flow.add_dipole(&kernels, Complex64::new(vx[i], vy[i]), curve.nodes.tangent[i] * weight, -1.0);
                }
            }
            return;
        }
        // The quadrature for close points has all images of an open curve in a channel.
        if curve.is_open() && !self.close.is_empty() && matches!(layers.greens, GreensFunction::Row { .. }) {
            return;
        }
        let images = layers.images;
        for (i, z) in curve.nodes.position.iter().enumerate() {
            let nearest = images.wrap(z - apart);
            let mut add = |k: &Kernels, sign: f64| {
                flow.add_force(k, curve.nodes.force[i], sign);
                if let Some((vx, vy)) = velocities {
                    flow.add_dipole(k, Complex64::new(vx[i], vy[i]), curve.nodes.tangent[i] * weight, sign);
                }
            };
            let mut own = false;
            for point in &self.close {
                let d = curve.wrap(z - point);
                if (d - nearest).norm_sqr() < (SAME_NODE * curve.radius).powi(2) {
                    own = true;
                    if curve.is_open() {
                        add(&greens.without_nearest(d), -1.0);
                    }
                } else {
                    add(&greens.at(d), -1.0);
                }
            }
            add(&if own { layers.greens.without_nearest(nearest) } else { layers.greens.at(nearest) }, 1.0);
        }
    }
}

/// Returns true if fast sums at points cost less than sums over pairs. The curves that have a density are closed then.
pub(crate) fn pays(layers: &Layers, points: &[Vec2]) -> bool {
    let Layers { greens, curves, stored, .. } = layers;
    let given = if stored.mutual { curves.len() } else { stored.first };
    let nodes = layers.starts[curves.len()];
    let near = || *greens != GreensFunction::Free || nodes >= MANY_NODES && spread(curves, points) <= FARTHEST;
    nodes as f64 * points.len() as f64 >= MANY_PAIRS && !curves[..given].iter().any(Curve::is_open) && near()
}
