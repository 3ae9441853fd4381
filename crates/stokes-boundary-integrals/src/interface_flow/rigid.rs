//! Rigid walls and obstacles at rest next to interfaces.

use std::f64::consts::TAU;

use motile_base::{Vec2, internal::gauss_legendre, within};
use nalgebra::{DMatrix, DVector};

use num_complex::Complex64;

use super::factors::DenseFactors;
use crate::{
    LayerError,
    curve::{Curve, LayerCurve},
    density::Density,
    layer::Layers,
    sample::Sampler,
};
use motile_base::{Drive, FlowSample};

/// Largest number of nodes of all walls: their matrix then takes 288 MB.
const MOST_NODES: f64 = 3000.0;
/// Distance over the spacing below which walls touch: a twelfth of the distance of fine nodes, far below the films that
/// these resolve.
const TOUCHING: f64 = 0.02;
/// Gauss-Legendre points of the quadrature behind a wall: a flow that varies over a tenth of the way is integrated to
/// round-off.
const BEHIND: usize = 48;

/// Rigid walls as a single layer whose forces cancel the velocity on them, with the matrix factorised once.
///
/// The matrix takes the forces of a uniform pressure behind a wall to zero, so that it is singular. With the projection
/// onto these forces added it is regular, and the forces found have no such part.
#[derive(Debug, Clone)]
pub(crate) struct RigidWalls {
    drive: Drive,
    /// Half the width of the channel around the walls (length).
    half: f64,
    /// Twice the period times the viscosity (length times stress times time).
    scale: f64,
    factors: DenseFactors,
    /// Forces on the fluid at the nodes (force) in the last response.
    pub(crate) forces: DVector<f64>,
    /// Mean pressure gradient (stress per length) in the last response.
    pub(crate) gradient: f64,
    /// Forces and mean pressure gradient in the last response with the forcing.
    driven: (DVector<f64>, f64),
    /// Forces for a unit pressure gradient (area).
    unit: DVector<f64>,
    /// Flux between the walls for a unit pressure gradient (area per time over force per volume).
    conductance: f64,
    /// half^2 - y^2 at the x components (area), 0 at the others.
    parabola: DVector<f64>,
    /// True once the present interfaces are known to lie between the walls.
    pub(crate) checked: bool,
}

impl RigidWalls {
    /// Takes over walls into layers without curves, and factorises their matrix.
    ///
    /// # Errors
    /// Returns the errors of [`super::InterfaceFlow::with_walls`].
    pub(crate) fn new<'a>(
        layers: &mut Layers,
        sampler: &mut Sampler,
        [length, width]: [f64; 2],
        drive: Drive,
        viscosity: f64,
        walls: impl Iterator<Item = LayerCurve<'a>> + Clone + Send,
    ) -> Result<Self, LayerError> {
        let mut total = 0.0;
        for (number, wall) in walls.clone().enumerate() {
            wall.check_nodes("wall", number)?;
            total += wall.nodes as f64;
        }
        within("the number of nodes of all walls", total, 0.0, MOST_NODES)?;
        layers.load(&walls.map(|wall| (wall, [].as_slice())), true)?;
        layers.single_layer(false);
        layers.refine_stored();
        check_apart(&layers.curves, length)?;

        let half = 0.5 * width;
        let count = 2 * layers.starts[layers.curves.len()];
        let mut matrix = DMatrix::zeros(count, count);
        layers.write_stored(&mut matrix);
        let mean = matrix.trace() / count.max(1) as f64;
        let mut parabola = DVector::zeros(count);
        for (index, curve) in layers.curves.iter().enumerate() {
            let range = layers.entries(index);
            let mut normal = DVector::zeros(range.len());
            let nodes = curve.nodes.tangent.iter().zip(&curve.nodes.position).enumerate();
            for (i, (tangent, position)) in nodes {
                (normal[i], normal[curve.len() + i]) = (tangent.im, -tangent.re);
                let y = position.im + curve.centre.im;
                parabola[range.start + i] = half * half - y * y;
            }
            let factor = mean / normal.norm_squared();
            let mut block = matrix.view_mut((range.start, range.start), (range.len(), range.len()));
            block.ger(factor, &normal, &normal, 1.0);
        }
        let factors = DenseFactors::new(matrix);
        // 4 pi eta times the velocity that a unit gradient drives is -2 pi (half^2 - y^2).
        let mut unit = &parabola * TAU;
        factors.solve(&mut unit);
        if !unit.iter().all(|f| f.is_finite()) {
            return Err(LayerError::singular_walls());
        }
        let scale = 2.0 * length * viscosity;
        let behind = flux_behind(layers, sampler, viscosity, half, &unit)?;
        let conductance = parabola.dot(&unit) / scale - 2.0 / 3.0 * half.powi(3) / viscosity - behind;
        layers.fix();
        let forces = DVector::zeros(count);
        let driven = (forces.clone(), 0.0);
        let (gradient, checked) = (0.0, false);
        Ok(Self { drive, half, scale, factors, forces, gradient, driven, unit, conductance, parabola, checked })
    }

    /// Replaces the flow of the last layer by the flow of the walls' response to it; `moment` (force times area) is 2 l
    /// eta times the flux of the layer. With `driven`, the drive of the channel is part of the response.
    pub(crate) fn respond(&mut self, layers: &mut Layers, moment: f64, driven: bool) {
        self.forces.fill(0.0);
        add_walls(layers, -1.0, self.forces.as_mut_slice());
        self.factors.solve(&mut self.forces);
        let part = if driven { 1.0 } else { 0.0 };
        self.gradient = match self.drive.flux() {
            None => part * self.drive.gradient(),
            Some(flux) => {
                let found = (moment + self.parabola.dot(&self.forces)) / self.scale;
                (part * flux - found) / self.conductance
            }
        };
        self.forces.axpy(self.gradient, &self.unit, 1.0);
        if driven {
            self.driven.0.copy_from(&self.forces);
            self.driven.1 = self.gradient;
        }
        layers.stored_layer(self.forces.as_slice());
        let factor = -TAU * self.gradient;
        let interfaces = layers.stored.first;
        for (curve, out) in layers.curves[..interfaces].iter().zip(&mut layers.flow) {
            for (u, z) in out.x.iter_mut().zip(&curve.nodes.position) {
                let y = z.im + curve.centre.im;
                *u += factor * (self.half * self.half - y * y);
            }
        }
    }

    /// Subtracts the last response, to a double layer, from that with the forcing.
    pub(crate) fn combine(&mut self) {
        self.forces.axpy(1.0, &self.driven.0, -1.0);
        self.gradient = self.driven.1 - self.gradient;
    }
}

/// Adds a multiple of the flow at the nodes of all walls to values there.
fn add_walls(layers: &Layers, factor: f64, values: &mut [f64]) {
    let first = layers.stored.first;
    let start = layers.entries(first).start;
    for wall in first..layers.curves.len() {
        let entries = layers.entries(wall);
        layers.add_flow(wall, factor, &mut values[entries.start - start..entries.end - start]);
    }
}

/// Returns the flux between open walls and the walls of the channel behind them, for a unit pressure gradient.
fn flux_behind(
    layers: &mut Layers,
    sampler: &mut Sampler,
    viscosity: f64,
    half: f64,
    unit: &DVector<f64>,
) -> Result<f64, LayerError> {
    let mut ends = Vec::new();
    for curve in layers.curves.iter().filter(|curve| curve.is_open()) {
        // Between the wall of the channel and the place that comes closest to it there is no other wall.
        let side = -curve.period.re.signum();
        let nearest = curve.fine.position.iter().max_by(|a, b| (side * a.im).total_cmp(&(side * b.im)));
        ends.extend(nearest.map(|z| (z + curve.centre, side * half)));
    }
    layers.set_stored(unit.as_slice(), true);
    layers.set_gradient(1.0);
    let (rule, mut flux) = (gauss_legendre(BEHIND), 0.0);
    for (place, wall) in ends {
        let half_way = 0.5 * (wall - place.im);
        let points: Vec<Vec2> =
            rule.iter().map(|(s, _)| Vec2::new(place.re, place.im + half_way * (1.0 + s))).collect();
        let mut samples = vec![FlowSample::default(); points.len()];
        sampler.sample(layers, Density::NONE, &points, &mut samples, |_| viscosity, |_| None)?;
        let values = samples.iter().zip(&rule).map(|(sample, (_, weight))| sample.velocity.x * weight);
        flux += half_way.abs() * values.sum::<f64>();
    }
    layers.set_gradient(0.0);
    Ok(flux)
}

/// Refuses walls that cross or touch, themselves or one another.
fn check_apart(curves: &[Curve], length: f64) -> Result<(), LayerError> {
    for (first, one) in curves.iter().enumerate() {
        let count = one.fine.position.len();
        // Ends of the piece of the curve behind a fine node.
        let piece = |curve: &Curve, k: usize| {
            let len = curve.fine.position.len();
            let next = curve.fine.position[(k + 1) % len];
            [curve.fine.position[k], if k + 1 == len { next + curve.period } else { next }].map(|z| z + curve.centre)
        };
        for (second, other) in curves.iter().enumerate().skip(first) {
            let touching = TOUCHING * one.spacing().max(other.spacing());
            for i in 0..count {
                let [a, b] = piece(one, i);
                for j in if first == second { i + 2 } else { 0 }..other.fine.position.len() {
                    if first == second && i == 0 && j + 1 == count {
                        continue;
                    }
                    let apart = other.fine.position[j] + other.centre - a;
                    let shift = length * (apart.re / length).round();
                    let [c, d] = piece(other, j).map(|z| z - shift);
                    if (c - a).norm_sqr() > (b - a).norm_sqr() + (d - c).norm_sqr() + touching * touching {
                        continue;
                    }
                    let side = |p: Complex64, q: Complex64, r: Complex64| ((q - p).conj() * (r - p)).im;
                    let crosses = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
                    if crosses || (first != second && (c - a).norm() < touching) {
                        return Err(LayerError::walls_cross(first, second, Vec2::new(c.re, c.im)));
                    }
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
