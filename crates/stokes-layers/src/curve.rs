//! Curves on their nodes: closed ones, and open ones that go on periodically.

mod calculus;
mod transform;

use std::f64::consts::TAU;

use fourier::spectrum::{copy_band, differentiate, largest_wave};
use input_checks::{InputError, same_length, within};
use num_complex::Complex64;

use crate::{
    Geometry, LayerError, Vec2,
    greens::{GreensFunction, half_turns},
};
pub use calculus::{PeriodicCalculus, TensionPlacement};
pub(crate) use transform::Transform;

/// Fine nodes per node, where a flow is needed close to a curve.
pub(crate) const REFINEMENT: usize = 4;

/// Largest number of points that a curve is given by.
const MOST_POINTS: f64 = 1_048_576.0;

/// Transforms between points, nodes and fine nodes, shared by all curves of that many nodes.
#[derive(Debug, Clone)]
pub(crate) struct Transforms {
    pub(crate) nodes: Transform,
    pub(crate) fine: Transform,
    points: Vec<Transform>,
    buffer: Vec<Complex64>,
    spectrum: Vec<Complex64>,
}

impl Transforms {
    pub(crate) fn new(nodes: usize) -> Result<Self, InputError> {
        Ok(Self {
            nodes: Transform::new(nodes)?,
            fine: Transform::new(REFINEMENT.saturating_mul(nodes))?,
            points: Vec::new(),
            buffer: Vec::new(),
            spectrum: vec![Complex64::default(); nodes],
        })
    }

    /// The transform of `len` values at points with a buffer of that length; made at the first use of a length.
    fn points(&mut self, len: usize) -> Result<(&mut Transform, &mut [Complex64]), InputError> {
        let known = self.points.iter().position(|plan| plan.len() == len);
        if known.is_none() {
            self.points.push(Transform::new(len)?);
        }
        let index = known.unwrap_or(self.points.len() - 1);
        self.buffer.resize(self.buffer.len().max(len), Complex64::default());
        Ok((&mut self.points[index], &mut self.buffer[..len]))
    }

    /// Fourier coefficients of values at points less what they gain in a turn, as many as there are nodes, the modes
    /// that nodes do not carry left out.
    fn analyse(&mut self, values: &[Vec2], gain: Complex64, out: &mut [Complex64]) -> Result<(), InputError> {
        let (plan, buffer) = self.points(values.len())?;
        let step = gain / values.len() as f64;
        for (k, (slot, value)) in buffer.iter_mut().zip(values).enumerate() {
            *slot = Complex64::new(value.x, value.y) - step * k as f64;
        }
        plan.forward(buffer);
        copy_band(buffer, out, largest_wave(out.len()));
        Ok(())
    }

    /// Values at nodes, x then y, from values at points.
    pub(crate) fn at_nodes(&mut self, values: &[Vec2], out: &mut [f64]) -> Result<(), InputError> {
        let mut spectrum = std::mem::take(&mut self.spectrum);
        self.analyse(values, Complex64::default(), &mut spectrum)?;
        self.nodes.inverse(&mut spectrum);
        let (x, y) = out.split_at_mut(spectrum.len());
        for ((x, y), value) in x.iter_mut().zip(y).zip(&spectrum) {
            (*x, *y) = (value.re, value.im);
        }
        self.spectrum = spectrum;
        Ok(())
    }

    /// Fourier coefficients of values at nodes, x then y.
    fn coefficients(&mut self, values: &[f64]) -> &[Complex64] {
        let (x, y) = values.split_at(self.spectrum.len());
        for ((value, x), y) in self.spectrum.iter_mut().zip(x).zip(y) {
            *value = Complex64::new(*x, *y);
        }
        self.nodes.forward(&mut self.spectrum);
        &self.spectrum
    }

    /// Values at points from values at nodes, x then y.
    pub(crate) fn at_points(&mut self, values: &[f64], out: &mut [Vec2]) -> Result<(), InputError> {
        self.coefficients(values);
        let spectrum = std::mem::take(&mut self.spectrum);
        let (plan, buffer) = self.points(out.len())?;
        copy_band(&spectrum, buffer, largest_wave(spectrum.len()));
        plan.inverse(buffer);
        for (out, value) in out.iter_mut().zip(buffer) {
            *out = Vec2::new(value.re, value.im);
        }
        self.spectrum = spectrum;
        Ok(())
    }

    /// Values at fine nodes from values at nodes, x then y.
    pub(crate) fn at_fine(&mut self, values: &[f64], out: &mut [Complex64]) {
        copy_band(self.coefficients(values), out, largest_wave(values.len() / 2));
        self.fine.inverse(out);
    }
}

/// A curve at equally spaced parameters, as complex numbers x + i y.
#[derive(Debug, Clone, Default)]
pub(crate) struct Samples {
    /// Positions relative to the curve's centre (length).
    pub(crate) position: Vec<Complex64>,
    /// Derivative of the position by the parameter (length).
    pub(crate) tangent: Vec<Complex64>,
    /// Force per parameter times the weight 2 pi/number (force).
    pub(crate) force: Vec<Complex64>,
    /// exp(i k z/2) and its inverse at the fine nodes of an open curve with the wave number k.
    pub(crate) half_turns: Vec<[Complex64; 2]>,
}

impl Samples {
    /// From Fourier coefficients of a shape that advances by `period` in a turn; `second` is filled with the second
    /// derivative where it is given.
    fn fill(
        &mut self,
        transform: &mut Transform,
        [shape, force]: [&[Complex64]; 2],
        period: Complex64,
        second: Option<&mut Vec<Complex64>>,
    ) {
        let len = transform.len();
        for values in [&mut self.position, &mut self.tangent] {
            values.resize(len, Complex64::default());
        }
        copy_band(shape, &mut self.position, largest_wave(shape.len()));
        self.tangent.copy_from_slice(&self.position);
        differentiate(&mut self.tangent);
        if let Some(second) = second {
            second.clone_from(&self.tangent);
            differentiate(second);
            transform.inverse(second);
        }
        transform.inverse(&mut self.position);
        transform.inverse(&mut self.tangent);
        for (j, (position, tangent)) in self.position.iter_mut().zip(&mut self.tangent).enumerate() {
            *position += period * (j as f64 / len as f64 - 0.5);
            *tangent += period / TAU;
        }
        self.fill_force(transform, force);
    }

    /// Forces from the Fourier coefficients of the force per parameter.
    fn fill_force(&mut self, transform: &mut Transform, force: &[Complex64]) {
        let len = transform.len();
        self.force.resize(len, Complex64::default());
        copy_band(force, &mut self.force, largest_wave(force.len()));
        transform.inverse(&mut self.force);
        let weight = TAU / len as f64;
        self.force.iter_mut().for_each(|force| *force *= weight);
    }
}

/// A curve by points of equally spaced parameters, with forces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GivenCurve<'a> {
    pub(crate) positions: &'a [Vec2],
    /// Force at each point, unless forces come later.
    pub(crate) forces: Option<&'a [Vec2]>,
    pub(crate) period: Vec2,
    pub(crate) nodes: usize,
}

/// A curve that advances by its period in each turn of the parameter, by nothing if it is closed: shape and force on
/// its nodes and, where they are needed, on fine nodes.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    /// Mean of the nodes (length), as given, not wrapped.
    pub(crate) centre: Complex64,
    /// What it advances by in a turn (length), zero for a closed one.
    pub(crate) period: Complex64,
    /// Largest distance of a node from the centre (length).
    pub(crate) radius: f64,
    pub(crate) nodes: Samples,
    /// Curvature at the nodes (1/length), positive for a circle.
    pub(crate) curvature: Vec<f64>,
    /// Fourier coefficients of the position relative to the centre, less what it advances.
    pub(crate) shape: Vec<Complex64>,
    /// Fourier coefficients of the force per parameter.
    force: Vec<Complex64>,
    pub(crate) fine: Samples,
    refined: bool,
    second: Vec<Complex64>,
    /// Number of points that it is given by.
    pub(crate) points: usize,
    /// Number of the plan for its nodes.
    pub(crate) plan: usize,
}

impl Curve {
    pub(crate) fn new(nodes: usize) -> Self {
        let zeros = vec![Complex64::default(); nodes];
        Self {
            centre: Complex64::default(),
            period: Complex64::default(),
            radius: 0.0,
            nodes: Samples::default(),
            curvature: vec![0.0; nodes],
            shape: zeros.clone(),
            force: zeros,
            fine: Samples::default(),
            refined: false,
            second: Vec::new(),
            points: 0,
            plan: 0,
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.shape.len()
    }

    /// Weight of a node in an integral over the parameter.
    pub(crate) fn weight(&self) -> f64 {
        TAU / self.len() as f64
    }

    /// The nodes or the fine nodes.
    pub(crate) fn samples(&self, fine: bool) -> &Samples {
        if fine { &self.fine } else { &self.nodes }
    }

    /// Whether it is open, so that it goes on periodically.
    pub(crate) fn is_open(&self) -> bool {
        self.period.re != 0.0
    }

    /// The Green's function of the curve with all that goes on of it: of a row of images for an open one.
    pub(crate) fn greens(&self) -> GreensFunction {
        if self.is_open() { GreensFunction::Row { k: TAU / self.period.re.abs() } } else { GreensFunction::Free }
    }

    /// The shortest vector that differs from d by periods of an open curve.
    pub(crate) fn wrap(&self, d: Complex64) -> Complex64 {
        if self.is_open() { d - self.period * (d.re / self.period.re).round() } else { d }
    }

    /// Takes over positions and forces, truncated to the modes that the nodes carry; `curve` is its number.
    pub(crate) fn load(
        &mut self,
        transforms: &mut Transforms,
        GivenCurve { positions, forces, period, .. }: GivenCurve<'_>,
        geometry: &Geometry,
        curve: usize,
    ) -> Result<(), LayerError> {
        let forces = forces.unwrap_or(&[]);
        if !forces.is_empty() {
            same_length("the forces on a curve", positions.len(), forces.len())?;
        }
        within("the number of points of a curve", positions.len() as f64, self.len() as f64, MOST_POINTS)?;
        let expected = geometry.images().periods[0].unwrap_or(0.0);
        if period != Vec2::ZERO && (period.y != 0.0 || expected == 0.0 || period.x.abs() != expected) {
            return Err(LayerError::Period { curve, x: period.x, y: period.y, expected });
        }
        for (what, values) in [("the position", positions), ("the force", forces)] {
            if let Some(point) = values.iter().position(|value| !(value.x.is_finite() && value.y.is_finite())) {
                let (x, y) = (values[point].x, values[point].y);
                return Err(LayerError::NonFinite { what, curve, point, x, y });
            }
        }
        self.points = positions.len();
        self.period = Complex64::new(period.x, period.y);
        transforms.analyse(positions, self.period, &mut self.shape)?;
        self.centre = std::mem::take(&mut self.shape[0]) + 0.5 * self.period;
        if forces.is_empty() {
            self.force.fill(Complex64::default());
        } else {
            transforms.analyse(forces, Complex64::default(), &mut self.force)?;
        }
        let per_parameter = positions.len() as f64 / TAU;
        self.force.iter_mut().for_each(|force| *force *= per_parameter);
        let Self { nodes, shape, force, second, .. } = self;
        nodes.fill(&mut transforms.nodes, [shape, force], self.period, Some(second));
        for ((curvature, first), second) in self.curvature.iter_mut().zip(&nodes.tangent).zip(second) {
            let square = first.norm_sqr();
            *curvature = (first.conj() * *second).im / (square * square.sqrt());
        }
        self.radius = self.nodes.position.iter().map(Complex64::norm_sqr).fold(0.0, f64::max).sqrt();
        self.refined = false;
        if self.is_open() || self.signed_area() > 0.0 { Ok(()) } else { Err(LayerError::Clockwise { curve }) }
    }

    /// Fills the fine nodes, once for each shape.
    pub(crate) fn refine(&mut self, transforms: &mut Transforms) {
        if !self.refined {
            self.fine.fill(&mut transforms.fine, [&self.shape, &self.force], self.period, None);
            if let GreensFunction::Row { k } = self.greens() {
                self.fine.half_turns.clear();
                self.fine.half_turns.extend(self.fine.position.iter().map(|z| half_turns(*z, k)));
            }
            self.refined = true;
        }
    }

    /// Takes over forces at the nodes, x then y.
    pub(crate) fn set_forces(&mut self, transforms: &mut Transforms, values: &[f64], fine: bool) {
        let (x, y) = values.split_at(self.len());
        for ((force, x), y) in self.nodes.force.iter_mut().zip(x).zip(y) {
            *force = Complex64::new(*x, *y);
        }
        self.force.copy_from_slice(transforms.coefficients(values));
        let per_node = 1.0 / self.weight();
        self.force.iter_mut().for_each(|force| *force *= per_node);
        if fine {
            self.refine_forces(transforms);
        }
    }

    /// Fills the fine nodes, their forces in any case.
    pub(crate) fn refine_forces(&mut self, transforms: &mut Transforms) {
        if self.refined {
            self.fine.fill_force(&mut transforms.fine, &self.force);
        }
        self.refine(transforms);
    }

    /// Signed area (length squared), positive for a counter-clockwise curve.
    fn signed_area(&self) -> f64 {
        let terms = self.nodes.position.iter().zip(&self.nodes.tangent);
        0.5 * self.weight() * terms.map(|(z, t)| (z.conj() * t).im).sum::<f64>()
    }

    /// Length of the curve (length).
    pub(crate) fn perimeter(&self) -> f64 {
        self.weight() * self.nodes.tangent.iter().map(|t| t.norm_sqr().sqrt()).sum::<f64>()
    }

    /// Largest distance between neighbouring nodes along the curve (length).
    pub(crate) fn spacing(&self) -> f64 {
        self.weight() * self.nodes.tangent.iter().map(Complex64::norm_sqr).fold(0.0, f64::max).sqrt()
    }

    /// Whether a point, relative to its centre, is inside the polygon through the fine nodes of a closed curve.
    pub(crate) fn polygon_contains(&self, point: Complex64) -> bool {
        let corners = &self.fine.position;
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        let right = |(a, b): &(&Complex64, &Complex64)| {
            (a.im > point.im) != (b.im > point.im)
                && point.re < a.re + (b.re - a.re) * (point.im - a.im) / (b.im - a.im)
        };
        sides.filter(right).count() % 2 == 1
    }

    /// Whether a point, relative to its centre, that is some spacings away from it lies on its left, by Cauchy's
    /// formula.
    pub(crate) fn winds_around(&self, point: Complex64) -> bool {
        let greens = self.greens();
        let terms = self.nodes.position.iter().zip(&self.nodes.tangent);
        let sum: f64 = terms.map(|(z, tangent)| (tangent * greens.at(z - point).c[0]).im).sum();
        // An open curve turns half way around what is on its left, and half way the other way around the rest.
        sum * self.weight() > if self.is_open() { 0.0 } else { 0.5 * TAU }
    }
}
