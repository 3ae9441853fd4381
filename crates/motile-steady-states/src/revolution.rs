//! Bodies of revolution: integrals over rings, divergence along the meridian, moments of the volume.

use std::f64::consts::PI;

use motile_base::{PeriodicSeries, Vec2};
use num_complex::Complex64;

use crate::{Profile, SteadyError};

/// Quadrature over the meridian of a body of revolution, on the nodes of the closed curve of it and its mirror image.
///
/// Integrands over t from 0 to pi have the distance y from the axis as a factor, and are odd in t: series of sines,
/// which the weights integrate exactly. Half of a node's weight is its mirror image's.
#[derive(Debug)]
pub(crate) struct Rings {
    pub(crate) weights: Vec<f64>,
}

impl Rings {
    /// Rings of an even number of nodes, the first one on the axis.
    pub(crate) fn new(nodes: usize) -> Self {
        let half = nodes / 2;
        let weight = |j: usize| -> f64 {
            let t = PI * j.min(nodes - j) as f64 / half as f64;
            (1..half).step_by(2).map(|k| 2.0 / (half * k) as f64 * (k as f64 * t).sin()).sum()
        };
        Self { weights: (0..nodes).map(weight).collect() }
    }

    /// Returns the factor of a sum over forces at nodes that makes it an integral over the surface.
    pub(crate) fn of_forces(&self, node: usize) -> f64 {
        self.weights[node] * self.weights.len() as f64 / PI
    }

    /// dm/dt of the density m = c |x_a| with the flux f along the meridian, where rings widen at the rates dy/dt:
    /// `-df/da - (y_a f + m dy/dt)/y`, at the poles its limit.
    pub(crate) fn divergence<'a>(
        &self,
        series: &mut PeriodicSeries,
        nodes: impl Iterator<Item = (&'a Vec2, &'a Vec2)> + Clone,
        states: impl ExactSizeIterator<Item = (f64, f64)> + Clone,
        flux: &[f64],
        rates: &mut [f64],
    ) -> Result<(), SteadyError> {
        let half = flux.len() / 2;
        // Both in one transform, whose round-off is that of the larger: in units of the flux, which is a velocity times
        // the mean concentration.
        let (number, length) = (states.clone().map(|(m, _)| m).sum::<f64>(), nodes.clone().map(|(_, t)| t.length()));
        let mean = number / length.sum::<f64>();
        let unit = if mean > 0.0 { mean } else { 1.0 };
        let pairs = states.clone().zip(flux);
        series.analyse(pairs.map(|((_, widening), f)| Complex64::new(*f, unit * widening)))?;
        series.differentiate();
        let slopes = series.values();
        for (k, ((x, tangent), (m, widening))) in nodes.zip(states).enumerate() {
            let Complex64 { re: slope, im: widening_slope } = slopes[k];
            rates[k] = if k == 0 || k == half {
                -2.0 * slope - m * (widening_slope / unit) / tangent.y
            } else {
                -slope - (tangent.y * flux[k] + m * widening) / x.y
            };
        }
        Ok(())
    }
}

/// Moments of the volume of a body of revolution.
pub(crate) struct VolumeMoments {
    /// Place of the centroid on the axis (length).
    pub(crate) centroid: f64,
    /// Square root of the second moment along the axis over that across it.
    pub(crate) aspect_ratio: f64,
    /// Area of the surface (length squared).
    pub(crate) surface: f64,
}

impl VolumeMoments {
    /// Creates moments from the series at twice the nodes, by Gauss' theorem.
    pub(crate) fn of(profile: &Profile) -> Result<Self, SteadyError> {
        let fine = profile.resample_fine()?;
        let (tangents, rings) = (fine.tangents()?, Rings::new(fine.nodes()));
        let integral = |of: &dyn Fn(Vec2, Vec2) -> f64| -> f64 {
            let nodes = fine.positions.iter().zip(&tangents).zip(&rings.weights);
            nodes.map(|((x, t), weight)| weight * 2.0 * PI * x.y.abs() * of(*x, -t.perp())).sum()
        };
        let volume = integral(&|x, n| x.dot(n) / 3.0);
        let centroid = integral(&|x, n| 0.5 * x.x * x.x * n.x) / volume;
        let along = integral(&|x, n| (x.x - centroid).powi(3) / 3.0 * n.x);
        let across = 0.5 * integral(&|x, n| 0.25 * x.y.powi(3) * n.y);
        Ok(Self { centroid, aspect_ratio: (along / across).sqrt(), surface: integral(&|_, n| n.length()) })
    }
}

#[cfg(test)]
mod tests;
