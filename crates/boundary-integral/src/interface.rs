//! One closed interface on its shape nodes.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::transform::{Transform, copy_band, differentiate, largest_wave};

/// Fine nodes per node, where a flow is needed close to an interface.
pub(crate) const REFINEMENT: usize = 4;

/// Transforms shared by all interfaces of a solver.
#[derive(Debug)]
pub(crate) struct Transforms {
    pub(crate) nodes: Transform,
    pub(crate) fine: Transform,
    markers: Vec<Transform>,
    marker_values: Vec<Complex64>,
}

impl Transforms {
    pub(crate) fn new(nodes: usize) -> Self {
        Self {
            nodes: Transform::new(nodes),
            fine: Transform::new(REFINEMENT * nodes),
            markers: Vec::new(),
            marker_values: Vec::new(),
        }
    }

    /// The transform of `len` marker values with a buffer of that length; made at the first use of a length.
    pub(crate) fn markers(&mut self, len: usize) -> (&mut Transform, &mut [Complex64]) {
        let index = self.markers.iter().position(|plan| plan.len() == len).unwrap_or_else(|| {
            self.markers.push(Transform::new(len));
            self.markers.len() - 1
        });
        if self.marker_values.len() < len {
            self.marker_values.resize(len, Complex64::default());
        }
        (&mut self.markers[index], &mut self.marker_values[..len])
    }
}

/// Values at the fine nodes: positions relative to the centre, derivative by the parameter, force times weight.
#[derive(Debug, Default)]
pub(crate) struct FineNodes {
    pub(crate) position: Vec<Complex64>,
    pub(crate) tangent: Vec<Complex64>,
    pub(crate) force: Vec<Complex64>,
    ready: bool,
}

/// A closed interface: shape and force on the shape nodes, as complex numbers x + i y.
#[derive(Debug)]
pub(crate) struct Interface {
    /// Mean of the nodes (length), as given, not wrapped.
    pub(crate) centre: Complex64,
    /// Largest distance of a node from the centre (length).
    pub(crate) radius: f64,
    /// Positions relative to the centre (length).
    pub(crate) position: Vec<Complex64>,
    /// Derivative of the position by the parameter (length).
    pub(crate) tangent: Vec<Complex64>,
    /// Curvature (1/length), positive for a circle.
    pub(crate) curvature: Vec<f64>,
    /// Force per parameter times the weight 2 pi / nodes (force).
    pub(crate) force: Vec<Complex64>,
    /// Fourier coefficients of the position relative to the centre.
    pub(crate) shape: Vec<Complex64>,
    /// Fourier coefficients of the force per parameter.
    pub(crate) force_spectrum: Vec<Complex64>,
    /// Viscosity inside (stress times time).
    pub(crate) viscosity: f64,
    pub(crate) fine: FineNodes,
}

impl Interface {
    pub(crate) fn new(nodes: usize) -> Self {
        let zeros = vec![Complex64::default(); nodes];
        Self {
            centre: Complex64::default(),
            radius: 0.0,
            position: zeros.clone(),
            tangent: zeros.clone(),
            curvature: vec![0.0; nodes],
            force: zeros.clone(),
            shape: zeros.clone(),
            force_spectrum: zeros,
            viscosity: 1.0,
            fine: FineNodes::default(),
        }
    }

    pub(crate) fn nodes(&self) -> usize {
        self.position.len()
    }

    /// Weight of a node in an integral over the parameter.
    pub(crate) fn weight(&self) -> f64 {
        TAU / self.nodes() as f64
    }

    /// Takes over marker positions and forces, truncated to the modes that the nodes carry.
    pub(crate) fn load(
        &mut self,
        transforms: &mut Transforms,
        viscosity: f64,
        positions: impl Iterator<Item = Complex64>,
        forces: impl Iterator<Item = Complex64>,
        markers: usize,
    ) {
        self.viscosity = viscosity;
        let nodes = self.nodes();
        let largest = largest_wave(nodes);
        let (plan, buffer) = transforms.markers(markers);
        fill(buffer, positions);
        plan.forward(buffer);
        self.centre = buffer[0];
        copy_band(buffer, &mut self.shape, largest);
        self.shape[0] = Complex64::default();
        let per_parameter = markers as f64 / TAU;
        fill(buffer, forces.map(|force| force * per_parameter));
        plan.forward(buffer);
        copy_band(buffer, &mut self.force_spectrum, largest);

        self.position.copy_from_slice(&self.shape);
        transforms.nodes.inverse(&mut self.position);
        self.force.copy_from_slice(&self.force_spectrum);
        transforms.nodes.inverse(&mut self.force);
        let weight = self.weight();
        self.force.iter_mut().for_each(|force| *force *= weight);
        self.tangent.copy_from_slice(&self.shape);
        differentiate(&mut self.tangent);
        // The fine buffer is free here: it lends its head to the second derivative.
        self.fine.ready = false;
        self.fine.position.resize(REFINEMENT * nodes, Complex64::default());
        let second = &mut self.fine.position[..nodes];
        second.copy_from_slice(&self.tangent);
        differentiate(second);
        transforms.nodes.inverse(second);
        transforms.nodes.inverse(&mut self.tangent);
        for ((curvature, first), second) in self.curvature.iter_mut().zip(&self.tangent).zip(second) {
            let square = first.norm_sqr();
            *curvature = (first.conj() * *second).im / (square * square.sqrt());
        }
        self.radius = self.position.iter().map(Complex64::norm_sqr).fold(0.0, f64::max).sqrt();
    }

    /// Fills the fine nodes, once for each shape.
    pub(crate) fn refine(&mut self, transforms: &mut Transforms) {
        if self.fine.ready {
            return;
        }
        let len = REFINEMENT * self.nodes();
        let largest = largest_wave(self.nodes());
        let fine = &mut self.fine;
        for values in [&mut fine.position, &mut fine.tangent, &mut fine.force] {
            values.resize(len, Complex64::default());
        }
        copy_band(&self.shape, &mut fine.position, largest);
        fine.tangent.copy_from_slice(&fine.position);
        differentiate(&mut fine.tangent);
        copy_band(&self.force_spectrum, &mut fine.force, largest);
        for values in [&mut fine.position, &mut fine.tangent, &mut fine.force] {
            transforms.fine.inverse(values);
        }
        let weight = TAU / len as f64;
        fine.force.iter_mut().for_each(|force| *force *= weight);
        fine.ready = true;
    }

    /// Signed area (length squared), positive for a counter-clockwise curve.
    pub(crate) fn signed_area(&self) -> f64 {
        let sum: f64 = self.position.iter().zip(&self.tangent).map(|(z, t)| (z.conj() * t).im).sum();
        0.5 * self.weight() * sum
    }

    /// Length of the curve (length).
    pub(crate) fn perimeter(&self) -> f64 {
        self.weight() * self.tangent.iter().map(|t| t.norm_sqr().sqrt()).sum::<f64>()
    }

    /// Largest distance between neighbouring nodes along the curve (length).
    pub(crate) fn spacing(&self) -> f64 {
        self.weight() * self.tangent.iter().map(Complex64::norm_sqr).fold(0.0, f64::max).sqrt()
    }
}

fn fill(buffer: &mut [Complex64], values: impl Iterator<Item = Complex64>) {
    for (slot, value) in buffer.iter_mut().zip(values) {
        *slot = value;
    }
}
