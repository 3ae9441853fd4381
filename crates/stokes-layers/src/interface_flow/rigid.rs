//! Rigid walls and obstacles at rest between interfaces.

use std::f64::consts::TAU;

use input_checks::within;
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::{
    FlowSample, Forcing, LayerCurve, LayerError, Vec2,
    curve::{Curve, GivenCurve},
    layer::{Density, Layers},
};

use super::flow_samples;

/// Most nodes of all walls: their matrix then takes 288 MB.
const MOST_NODES: f64 = 3000.0;
/// Walls closer to each other than this part of their spacing touch.
const TOUCHING: f64 = 0.02;
/// Intervals of the quadrature behind a wall, with [`GAUSS`] points each.
const INTERVALS: usize = 24;
/// Points and weights of Gauss and Legendre on (-1, 1).
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Walls by a single layer whose forces cancel the velocity there, factorised once.
///
/// The layer's matrix takes the force of a uniform pressure behind a wall to nothing; the forces found have none.
#[derive(Debug, Clone)]
pub(crate) struct RigidWalls {
    forcing: Forcing,
    half: f64,
    /// Twice the period times the viscosity.
    scale: f64,
    factors: LU<f64, Dyn, Dyn>,
    /// Forces on the fluid at the nodes (force), and the mean pressure gradient, of the last response.
    pub(crate) forces: DVector<f64>,
    pub(crate) gradient: f64,
    /// Those of the last response with the forcing.
    driven: (DVector<f64>, f64),
    /// The forces for a unit pressure gradient.
    unit: DVector<f64>,
    /// The flux for a unit pressure gradient, without what passes behind walls (area per time over force per volume).
    conductance: f64,
    /// half^2 - y^2 at the x components, 0 at the others.
    parabola: DVector<f64>,
}

impl RigidWalls {
    /// Takes over walls into layers that have nothing else.
    pub(crate) fn new<'a>(
        layers: &mut Layers,
        [length, width]: [f64; 2],
        forcing: Forcing,
        viscosity: f64,
        walls: impl Iterator<Item = LayerCurve<'a>> + Clone,
    ) -> Result<Self, LayerError> {
        let mut total = 0.0;
        for LayerCurve { nodes, .. } in walls.clone() {
            within("the number of nodes of a wall", nodes as f64, 16.0, 4096.0)?;
            total += nodes as f64;
        }
        within("the number of nodes of all walls", total, 0.0, MOST_NODES)?;
        let given = |LayerCurve { positions, period, nodes }| GivenCurve { positions, forces: None, period, nodes };
        layers.load(walls.map(given), true)?;
        layers.single_layer(false);
        layers.refine_kept();
        check_apart(&layers.curves, length)?;

        let half = 0.5 * width;
        let count = 2 * layers.starts[layers.curves.len()];
        let mut matrix = DMatrix::zeros(count, count);
        let mut forces = DVector::zeros(count);
        for column in 0..count {
            forces[column] = 1.0;
            layers.kept_layer(forces.as_slice());
            write_walls(layers, matrix.column_mut(column).as_mut_slice(), 1.0);
            forces[column] = 0.0;
        }
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
        let factors = LU::new(matrix);
        // 4 pi eta times the velocity of a unit gradient is -2 pi (half^2 - y^2).
        let mut unit = &parabola * TAU;
        if !factors.solve_mut(&mut unit) || !unit.iter().all(|f| f.is_finite()) {
            return Err(LayerError::SingularWalls);
        }
        let scale = 2.0 * length * viscosity;
        let behind = flux_behind(layers, viscosity, half, &unit);
        let conductance = parabola.dot(&unit) / scale - 2.0 / 3.0 * half.powi(3) / viscosity - behind;
        layers.fix();
        let driven = (forces.clone(), 0.0);
        Ok(Self { forcing, half, scale, factors, forces, gradient: 0.0, driven, unit, conductance, parabola })
    }

    /// Replaces the flow of the last layer by that of the walls' response to it; `moment` is 2 l eta times the flux of
    /// the layer. With `driven` the forcing of the channel is part of the response.
    pub(crate) fn respond(&mut self, layers: &mut Layers, moment: f64, driven: bool) {
        write_walls(layers, self.forces.as_mut_slice(), -1.0);
        self.factors.solve_mut(&mut self.forces);
        self.gradient = match self.forcing {
            Forcing::Gradient(gradient) => {
                if driven {
                    gradient
                } else {
                    0.0
                }
            }
            Forcing::Flux(flux) => {
                let found = (moment + self.parabola.dot(&self.forces)) / self.scale;
                (if driven { flux - found } else { -found }) / self.conductance
            }
        };
        self.forces.axpy(self.gradient, &self.unit, 1.0);
        if driven {
            self.driven.0.copy_from(&self.forces);
            self.driven.1 = self.gradient;
        }
        layers.kept_layer(self.forces.as_slice());
        let factor = -TAU * self.gradient;
        let interfaces = layers.kept.first;
        for (curve, out) in layers.curves[..interfaces].iter().zip(&mut layers.out) {
            for (u, z) in out.x.iter_mut().zip(&curve.nodes.position) {
                let y = z.im + curve.centre.im;
                *u += factor * (self.half * self.half - y * y);
            }
        }
    }
}

impl RigidWalls {
    /// Takes the last response, to a double layer, from that with the forcing.
    pub(crate) fn combine(&mut self) {
        self.forces.axpy(1.0, &self.driven.0, -1.0);
        self.gradient = self.driven.1 - self.gradient;
    }
}

/// Writes the flow at the nodes of walls, times a sign.
fn write_walls(layers: &Layers, out: &mut [f64], sign: f64) {
    let mut first = 0;
    for flow in &layers.out[layers.kept.first..] {
        for values in [&flow.x, &flow.y] {
            for (out, value) in out[first..].iter_mut().zip(values) {
                *out = sign * value;
            }
            first += values.len();
        }
    }
}

/// The flux between open walls and those of the channel behind them, for a unit pressure gradient.
fn flux_behind(layers: &mut Layers, viscosity: f64, half: f64, unit: &DVector<f64>) -> f64 {
    let mut ends = Vec::new();
    for curve in layers.curves.iter().filter(|curve| curve.is_open()) {
        // From the wall of the channel to the place that comes closest to it nothing is in between.
        let side = -curve.period.re.signum();
        let nearest = curve.fine.position.iter().max_by(|a, b| (side * a.im).total_cmp(&(side * b.im)));
        ends.extend(nearest.map(|z| (z + curve.centre, side * half)));
    }
    layers.set_kept(unit.as_slice(), true);
    layers.set_gradient(1.0);
    let mut flux = 0.0;
    for (place, wall) in ends {
        let step = (wall - place.im) / INTERVALS as f64;
        let at = |k: usize, s: f64| Vec2::new(place.re, place.im + step * (k as f64 + 0.5 + 0.5 * s));
        let points: Vec<Vec2> = (0..INTERVALS).flat_map(|k| GAUSS.map(|(s, _)| at(k, s))).collect();
        let mut samples = vec![FlowSample::default(); points.len()];
        flow_samples(layers, Density { values: &[], contrasts: &[] }, &points, &mut samples, |_| viscosity, &[]);
        let weights = GAUSS.iter().map(|(_, weight)| 0.5 * step.abs() * weight).cycle();
        flux += samples.iter().zip(weights).map(|(sample, weight)| sample.velocity.x * weight).sum::<f64>();
    }
    layers.set_gradient(0.0);
    flux
}

/// Refuses walls that cross or touch, themselves or one another.
fn check_apart(curves: &[Curve], length: f64) -> Result<(), LayerError> {
    for (first, one) in curves.iter().enumerate() {
        let count = one.fine.position.len();
        // Ends of the piece of the curve from a fine node on.
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
                    let side = |p: num_complex::Complex64, q: num_complex::Complex64, r: num_complex::Complex64| {
                        ((q - p).conj() * (r - p)).im
                    };
                    let crosses = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
                    if crosses || (first != second && (c - a).norm() < touching) {
                        return Err(LayerError::WallsCross { first, second, x: c.re, y: c.im });
                    }
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
