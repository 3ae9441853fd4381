//! Velocity, gradient and pressure at any point.

use std::f64::consts::TAU;

use ib_core::{FlowError, FlowSample, Markers, Vec2};
use num_complex::Complex64;

use crate::{
    calculus::load,
    close::CloseWeights,
    field::{Flow, Kernels, free, weighted},
    interface::{Interface, REFINEMENT, Transforms},
    near::reach,
    surroundings::{NodeVelocities, Surroundings},
    transform::{copy_band, largest_wave},
};

/// What a flow is sampled from.
pub(crate) struct Scene<'a> {
    pub(crate) interfaces: &'a mut [Interface],
    pub(crate) contrasts: &'a [f64],
    pub(crate) surroundings: &'a mut dyn Surroundings,
    pub(crate) transforms: &'a mut Transforms,
    pub(crate) viscosity: f64,
}

/// Room for sampling.
#[derive(Debug)]
pub(crate) struct Sampler {
    reach: f64,
    weights: CloseWeights,
    /// Velocities at the nodes, x then y, interface after interface.
    velocities: Vec<f64>,
    /// Velocities at the nodes and at the fine nodes as complex numbers, interface after interface.
    coarse: Vec<Complex64>,
    fine: Vec<Complex64>,
    points: Vec<Complex64>,
    /// The point relative to the images that it is close to.
    close: Vec<Complex64>,
}

impl Sampler {
    pub(crate) fn new(nodes: usize, tolerance: f64) -> Self {
        Self {
            reach: reach(tolerance),
            weights: CloseWeights::new(nodes),
            velocities: Vec::new(),
            coarse: Vec::new(),
            fine: Vec::new(),
            points: Vec::new(),
            close: Vec::new(),
        }
    }

    pub(crate) fn sample(
        &mut self,
        scene: Scene<'_>,
        markers: &Markers,
        points: &[Vec2],
        out: &mut [FlowSample],
    ) -> Result<(), FlowError> {
        let Scene { interfaces, contrasts, surroundings, transforms, viscosity } = scene;
        for (marker, point) in points.iter().enumerate() {
            if !(point.x.is_finite() && point.y.is_finite()) {
                let what = "the position of a sample";
                return Err(FlowError::NonFinite { what, body: 0, marker, x: point.x, y: point.y });
            }
        }
        self.load(interfaces, transforms, markers);
        self.points.clear();
        self.points.extend(points.iter().map(|p| Complex64::new(p.x, p.y)));
        let velocities = NodeVelocities { values: &self.velocities, contrasts };
        surroundings.begin_field(interfaces, velocities, transforms, &self.points);
        let (kernel, images) = (surroundings.field(), surroundings.images());
        for (index, out) in out.iter_mut().enumerate() {
            let point = self.points[index];
            let mut flow = Flow::default();
            let mut local = viscosity;
            for (body, interface) in interfaces.iter().enumerate() {
                let nodes = interface.nodes();
                let apart = images.wrap(point - interface.centre);
                let weight = interface.weight() * contrasts[body];
                let distance = self.reach * interface.spacing();
                self.close.clear();
                for shift in images.shifts() {
                    let point = apart + shift;
                    if point.norm() > interface.radius + distance {
                        continue;
                    }
                    let close = interface.position.iter().any(|z| (z - point).norm_sqr() < distance * distance);
                    let inside = if close {
                        self.close.push(point);
                        self.add_close(interface, body, point, weight, transforms, &mut flow)
                    } else {
                        None
                    };
                    if inside.unwrap_or_else(|| winds_around(interface, point)) {
                        local = interface.viscosity;
                    }
                }
                let coarse = &self.coarse[body * nodes..(body + 1) * nodes];
                for (i, z) in interface.position.iter().enumerate() {
                    // Close images have been taken from the fine nodes and are left out here.
                    let nearest = images.wrap(z - apart);
                    let mut add = |k: &Kernels, sign: f64| {
                        flow.add_force(k, interface.force[i], sign);
                        if weight != 0.0 {
                            flow.add_dipole(k, coarse[i], interface.tangent[i] * weight, sign);
                        }
                    };
                    let mut own = false;
                    for point in &self.close {
                        let d = z - point;
                        if (d - nearest).norm_sqr() < 1e-20 * interface.radius * interface.radius {
                            own = true;
                        } else {
                            add(&free(d), -1.0);
                        }
                    }
                    add(&if own { kernel.images(nearest) } else { kernel.at(nearest) }, 1.0);
                }
            }
            surroundings.add_field(index, &mut flow);
            *out = flow_sample(&flow, local);
            // The imposed flow is a parabola, so this difference is its slope.
            let imposed = |y: f64| surroundings.imposed(y, viscosity) * viscosity / local;
            out.velocity.x += imposed(point.im);
            out.gradient[0][1] += 0.5 * (imposed(point.im + 1.0) - imposed(point.im - 1.0));
        }
        Ok(())
    }

    /// Takes the velocities at the nodes and fine nodes from the markers.
    fn load(&mut self, interfaces: &mut [Interface], transforms: &mut Transforms, markers: &Markers) {
        self.velocities.clear();
        let Some(nodes) = interfaces.first().map(Interface::nodes) else { return };
        self.coarse.resize(nodes * interfaces.len(), Complex64::default());
        self.fine.resize(REFINEMENT * nodes * interfaces.len(), Complex64::default());
        for (index, interface) in interfaces.iter_mut().enumerate() {
            interface.refine(transforms);
            let range = markers.groups()[index].range.clone();
            let (plan, values) = transforms.markers(range.len());
            load(&markers.velocities[range], values);
            plan.forward(values);
            let coarse = &mut self.coarse[index * nodes..(index + 1) * nodes];
            let fine = &mut self.fine[index * REFINEMENT * nodes..(index + 1) * REFINEMENT * nodes];
            copy_band(values, coarse, largest_wave(nodes));
            copy_band(values, fine, largest_wave(nodes));
            transforms.nodes.inverse(coarse);
            transforms.fine.inverse(fine);
            self.velocities.extend(coarse.iter().map(|v| v.re));
            self.velocities.extend(coarse.iter().map(|v| v.im));
        }
    }

    /// Adds the flow of one image of an interface by the quadrature for close points, and tells the side if the point
    /// is close to the fine nodes as well.
    fn add_close(
        &mut self,
        interface: &Interface,
        body: usize,
        point: Complex64,
        weight: f64,
        transforms: &mut Transforms,
        flow: &mut Flow,
    ) -> Option<bool> {
        let len = REFINEMENT * interface.nodes();
        let inside = self.weights.find(interface, transforms, point, self.reach);
        let velocities = &self.fine[body * len..(body + 1) * len];
        let [first, second, third] = &self.weights.powers;
        // The double layer of a constant is known: with the velocity of the nearest node taken off, nothing is divided
        // by a small distance.
        let distances = self.weights.distance.iter().map(Complex64::norm_sqr).enumerate();
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(j, _)| j);
        let constant = if inside.is_some() { velocities[nearest] } else { Complex64::default() };
        if inside == Some(true) {
            flow.velocity += constant * (4.0 * std::f64::consts::PI * weight / interface.weight());
        }
        let weight = weight / REFINEMENT as f64;
        for (j, velocity) in velocities.iter().enumerate() {
            let c = [first[j], second[j], third[j]];
            let k = weighted(self.weights.log[j] - 0.5, c, self.weights.distance[j].conj());
            flow.add_force(&k, interface.fine.force[j], 1.0);
            flow.add_dipole(&k, velocity - constant, interface.fine.tangent[j] * weight, 1.0);
        }
        inside
    }
}

/// Whether a curve goes around a point that is some spacings away from it, by Cauchy's formula.
fn winds_around(interface: &Interface, point: Complex64) -> bool {
    let terms = interface.position.iter().zip(&interface.tangent);
    let sum: f64 = terms.map(|(z, tangent)| (tangent / (z - point)).im).sum();
    sum * interface.weight() > 0.5 * TAU
}

fn flow_sample(flow: &Flow, viscosity: f64) -> FlowSample {
    let factor = 1.0 / (4.0 * std::f64::consts::PI);
    let scale = factor / viscosity;
    let along = (flow.spin + flow.strain) * scale;
    let across = Complex64::new(0.0, scale) * (flow.spin - flow.strain);
    FlowSample {
        velocity: Vec2::new(flow.velocity.re * scale, flow.velocity.im * scale),
        pressure: flow.pressure * factor,
        gradient: [[along.re, across.re], [along.im, across.im]],
    }
}
