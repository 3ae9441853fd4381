//! Layers at points anywhere.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::{
    close::reach,
    curve::REFINEMENT,
    greens::{Flow, GreensFunction, Kernels},
};

use super::{Density, Layers, Plan};

/// Room for the flow at points.
#[derive(Debug, Clone)]
pub(crate) struct PointSums {
    /// Distance in spacings below which a point is close to a curve.
    reach: f64,
    /// The point relative to the images of a curve that it is close to.
    close: Vec<Complex64>,
    /// The mean flow of a box.
    mean: Complex64,
}

impl PointSums {
    pub(crate) fn new(tolerance: f64) -> Self {
        Self { reach: reach(tolerance), close: Vec::new(), mean: Complex64::default() }
    }
}

impl Layers {
    /// Prepares for [`Layers::flow_at`] at these points.
    pub(crate) fn prepare_points(&mut self, density: Density<'_>, points: impl Iterator<Item = Complex64>) {
        self.curves.iter_mut().for_each(|curve| curve.refine(&mut self.plans[curve.plan].transforms));
        self.refine(density);
        self.points.mean = self.mean_flow(density).unwrap_or_default();
        if let Some(walls) = &mut self.walls {
            walls.prepare_points(&self.curves, density, &self.fine, points);
        }
    }

    /// The flow at the point of that number, and the innermost curve that it lies inside of: the single layer less
    /// the double layer.
    pub(crate) fn flow_at(&mut self, index: usize, point: Complex64, density: Density<'_>) -> (Flow, Option<usize>) {
        let mut flow = Flow::default();
        let mut inside = None;
        let images = self.geometry.images();
        for body in 0..self.curves.len() {
            let apart = images.wrap(point - self.curves[body].centre);
            let distance = self.points.reach * self.curves[body].spacing();
            self.points.close.clear();
            let open = self.curves[body].is_open();
            // An open curve goes on in x by itself.
            for shift in images.shifts().filter(|shift| !open || shift.re == 0.0) {
                let point = apart + shift;
                let curve = &self.curves[body];
                if !open && point.norm() > curve.radius + distance {
                    continue;
                }
                let is_close = |z: &Complex64| curve.wrap(z - point).norm_sqr() < distance * distance;
                let side = if curve.nodes.position.iter().any(is_close) {
                    self.points.close.push(point);
                    self.add_close(body, point, density, &mut flow)
                } else {
                    None
                };
                let fluid = body < density.contrasts.len();
                let smaller = |other: usize| self.curves[body].radius < self.curves[other].radius;
                if fluid && inside.is_none_or(smaller) && side.unwrap_or_else(|| self.curves[body].winds_around(point))
                {
                    inside = Some(body);
                }
            }
            self.add_nodes(body, apart, density, &mut flow);
        }
        match &self.walls {
            Some(walls) => walls.add_flow(index, &mut flow),
            None => flow.velocity += self.points.mean,
        }
        (flow, inside)
    }

    /// Adds the flow of one image of a curve by the quadrature for close points, and tells the side if the point is
    /// close to the fine nodes as well.
    fn add_close(&mut self, body: usize, point: Complex64, density: Density<'_>, flow: &mut Flow) -> Option<bool> {
        let Self { curves, plans, points: PointSums { reach, .. }, .. } = self;
        let curve = &curves[body];
        let Plan { transforms, weights, .. } = &mut plans[curve.plan];
        let inside = weights.find(curve, transforms, point, *reach);
        for (j, force) in curve.fine.force.iter().enumerate() {
            flow.add_force(&weights.kernels(j), *force, 1.0);
        }
        let contrast = density.contrast(body);
        if contrast == 0.0 {
            return inside;
        }
        let len = REFINEMENT * curve.len();
        let velocities = &self.fine[body * len..(body + 1) * len];
        // The double layer of a constant is known: with the velocity of the nearest node subtracted, nothing is divided
        // by a small distance.
        let constant = if inside.is_some() { velocities[weights.nearest()] } else { Complex64::default() };
        let turns = match (inside, curve.is_open()) {
            (None, _) | (Some(false), false) => 0.0,
            (Some(true), false) => 2.0,
            (Some(inside), true) => {
                if inside {
                    1.0
                } else {
                    -1.0
                }
            }
        };
        flow.velocity += constant * (turns * TAU * contrast);
        let weight = contrast * curve.weight() / REFINEMENT as f64;
        for (j, velocity) in velocities.iter().enumerate() {
            flow.add_dipole(&weights.kernels(j), velocity - constant, curve.fine.tangent[j] * weight, 1.0);
        }
        inside
    }

    /// Adds the flow of the nodes of a curve and of all its images but the close ones, which have been added.
    fn add_nodes(&self, body: usize, apart: Complex64, density: Density<'_>, flow: &mut Flow) {
        let curve = &self.curves[body];
        let contrast = density.contrast(body);
        let weight = curve.weight() * contrast;
        let velocities = (contrast != 0.0).then(|| density.of(body));
        let greens = curve.greens();
        // Nothing is left of an open curve in a channel.
        if curve.is_open() && !self.points.close.is_empty() && matches!(self.greens, GreensFunction::Row { .. }) {
            return;
        }
        let images = self.geometry.images();
        for (i, z) in curve.nodes.position.iter().enumerate() {
            let nearest = images.wrap(z - apart);
            let mut add = |k: &Kernels, sign: f64| {
                flow.add_force(k, curve.nodes.force[i], sign);
                if let Some((vx, vy)) = velocities {
                    flow.add_dipole(k, Complex64::new(vx[i], vy[i]), curve.nodes.tangent[i] * weight, sign);
                }
            };
            let mut own = false;
            for point in &self.points.close {
                let d = curve.wrap(z - point);
                if (d - nearest).norm_sqr() < 1e-20 * curve.radius * curve.radius {
                    own = true;
                    if curve.is_open() {
                        add(&greens.images(d), -1.0);
                    }
                } else {
                    add(&greens.at(d), -1.0);
                }
            }
            add(&if own { self.greens.images(nearest) } else { self.greens.at(nearest) }, 1.0);
        }
    }
}
