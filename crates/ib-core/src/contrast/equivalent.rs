//! Forces that take the place of another viscosity.

use std::f64::consts::TAU;

use fourier::{InputError, PeriodicSeries};
use num_complex::Complex64;
use stokes_layers::dense::NodeCurve;
use stokes_layers::gmres::{Gmres, Outcome};

use crate::mobility::normal_taper;
use crate::{FlowError, Vec2};

/// Residual of the velocities on the droplets relative to them: well below the errors of the grid.
const TOLERANCE: f64 = 1e-4;
/// Iterations before giving up.
const MOST_ITERATIONS: usize = 120;

/// Forces q on the markers of droplets of another viscosity that, in a fluid of one viscosity, leave the velocities v
/// there:
///
/// `S q = eta v`, S the velocity times viscosity that forces have on the markers.
///
/// By uniqueness the flow of q is then that of the droplets, inside and outside. It is not the small difference of two
/// large flows, so that the errors of the grid are not multiplied by the ratio of viscosities, and it costs one solve
/// on the grid wherever it is wanted. Pressures inside are those of the fluid of one viscosity times the ratio, plus a
/// constant.
///
/// On a straight interface S multiplies the wave number k by 1/(4 k), along and across alike, which makes a
/// preconditioner; what is too short for the grid is left out. A uniform force along the normal moves nothing and is
/// fixed to what suits the iteration.
#[derive(Debug, Clone, Default)]
pub(crate) struct EquivalentForces {
    filters: Vec<Filter>,
    gmres: Gmres,
    right: Vec<f64>,
    unknown: Vec<f64>,
    forces: Vec<Vec2>,
    velocities: Vec<Vec2>,
}

/// Multiplication of the Fourier modes along a closed curve.
#[derive(Debug, Clone)]
struct Filter {
    series: PeriodicSeries,
    /// Wave number of the first mode (1/length).
    wave: f64,
}

impl Filter {
    fn new(nodes: usize) -> Result<Self, InputError> {
        Ok(Self { series: PeriodicSeries::new(nodes)?, wave: 0.0 })
    }

    /// Multiplies each mode of values, of which there are as many as nodes, by a function of its number.
    fn apply(
        &mut self,
        values: impl ExactSizeIterator<Item = Complex64>,
        factor: impl Fn(usize) -> f64,
    ) -> &[Complex64] {
        // The length is the series' own, so that the call cannot fail.
        let _ = self.series.analyse(values);
        self.series.scale(factor);
        self.series.values()
    }
}

/// The unknowns of one curve, x + i y.
fn densities(y: &[f64], curve: &NodeCurve) -> impl ExactSizeIterator<Item = Complex64> {
    let (x, y) = y.split_at(y.len() / 2);
    let of_curve = curve.first..curve.first + curve.weights.len();
    x[of_curve.clone()].iter().zip(&y[of_curve]).map(|(&x, &y)| Complex64::new(x, y))
}

/// Droplets with their filters.
struct FilteredCurves<'a> {
    curves: &'a [NodeCurve],
    filters: &'a mut [Filter],
    nodes: usize,
    /// Grid spacing (length).
    spacing: f64,
}

impl FilteredCurves<'_> {
    /// Forces of densities `4 k y`, without what the grid does not resolve.
    fn forces(&mut self, y: &[f64], forces: &mut [Vec2]) {
        for (curve, filter) in self.curves.iter().zip(&mut *self.filters) {
            let (first, wave, h) = (curve.first, filter.wave, self.spacing);
            let factor = |m| 4.0 * wave * (m as f64).max(0.5) * normal_taper(wave * m as f64 * h);
            let values = filter.apply(densities(y, curve), factor);
            for ((force, value), weight) in forces[first..].iter_mut().zip(values).zip(&curve.weights) {
                *force = *weight * Vec2::new(value.re, value.im);
            }
        }
    }

    /// What the grid resolves of velocities, as a vector of unknowns.
    fn smooth(&mut self, velocities: &[Vec2], out: &mut [f64]) {
        for (curve, filter) in self.curves.iter().zip(&mut *self.filters) {
            let (first, wave, h) = (curve.first, filter.wave, self.spacing);
            let values = velocities[first..][..filter.series.len()].iter().map(|v| Complex64::new(v.x, v.y));
            for (i, value) in filter.apply(values, |m| normal_taper(wave * m as f64 * h)).iter().enumerate() {
                (out[first + i], out[self.nodes + first + i]) = (value.re, value.im);
            }
        }
    }

    /// Mean of the normal component over a curve.
    fn growth(&self, curve: &NodeCurve, y: &[f64]) -> f64 {
        let flux = curve.normals.iter().enumerate().map(|(i, normal)| {
            let i = curve.first + i;
            y[i] * normal.x + y[self.nodes + i] * normal.y
        });
        flux.sum::<f64>() / curve.perimeter()
    }

    /// Adds a uniform normal component to a curve.
    fn grow(&self, curve: &NodeCurve, amount: f64, y: &mut [f64]) {
        for (i, (normal, weight)) in curve.normals.iter().zip(&curve.weights).enumerate() {
            let normal = amount / weight * normal;
            y[curve.first + i] += normal.x;
            y[self.nodes + curve.first + i] += normal.y;
        }
    }
}

impl EquivalentForces {
    /// The last solution, from which the next one starts.
    pub(crate) fn guess(&self) -> &[f64] {
        &self.unknown
    }

    /// Starts the next solution from this one, if it fits.
    pub(crate) fn start_from(&mut self, guess: &[f64]) {
        self.unknown.clear();
        self.unknown.extend_from_slice(guess);
    }

    /// Finds the forces for velocities times viscosity `target` at the droplets' nodes; `respond` gives those of
    /// forces.
    pub(crate) fn solve(
        &mut self,
        curves: &[NodeCurve],
        spacing: f64,
        target: &[Vec2],
        mut respond: impl FnMut(&[Vec2], &mut [Vec2]) -> Result<(), FlowError>,
    ) -> Result<Outcome, FlowError> {
        let nodes = target.len();
        if self.unknown.len() != 2 * nodes {
            // The last solution is no guess for other nodes.
            self.unknown.clear();
        }
        for (index, curve) in curves.iter().enumerate() {
            let count = curve.len();
            let known = self.filters.get(index).map(|filter| filter.series.len());
            if known != Some(count) {
                self.filters.truncate(index);
                self.filters.push(Filter::new(count)?);
                if known.is_some() {
                    self.unknown.clear();
                }
            }
            self.filters[index].wave = TAU / curve.perimeter();
        }
        self.unknown.resize(2 * nodes, 0.0);
        self.right.resize(2 * nodes, 0.0);
        self.forces.resize(nodes, Vec2::ZERO);
        self.velocities.resize(nodes, Vec2::ZERO);

        let Self { filters, gmres, right, unknown, forces, velocities } = self;
        let mut filtered = FilteredCurves { curves, filters, nodes, spacing };
        filtered.smooth(target, right);
        for curve in curves {
            let growth = filtered.growth(curve, right);
            filtered.grow(curve, -growth, right);
        }
        let mut failure = None;
        let product = |y: &[f64], out: &mut [f64], _: f64| {
            filtered.forces(y, forces);
            if failure.is_none()
                && let Err(error) = respond(forces, velocities)
            {
                failure = Some(error);
            }
            filtered.smooth(velocities, out);
            // Unresolved modes are kept as they are, and the growth that no force gives.
            for (curve, filter) in filtered.curves.iter().zip(&mut *filtered.filters) {
                let (first, wave) = (curve.first, filter.wave);
                let values = filter.apply(densities(y, curve), |m| 1.0 - normal_taper(wave * m as f64 * spacing));
                for (i, value) in values.iter().enumerate() {
                    out[first + i] += value.re;
                    out[nodes + first + i] += value.im;
                }
            }
            for curve in filtered.curves {
                let growth = filtered.growth(curve, y) - filtered.growth(curve, out);
                filtered.grow(curve, growth, out);
            }
        };
        let outcome = gmres.solve(product, right, unknown, TOLERANCE, MOST_ITERATIONS);
        if let Some(error) = failure {
            unknown.fill(0.0);
            return Err(error);
        }
        let Outcome { iterations, residual } = outcome;
        if residual.is_nan() || residual > 2.0 * TOLERANCE {
            unknown.fill(0.0);
            let what = "the flow around droplets of another viscosity";
            return Err(FlowError::NoConvergence { what, iterations, residual, tolerance: TOLERANCE });
        }
        filtered.forces(unknown, forces);
        Ok(outcome)
    }

    /// The same, to be changed.
    pub(crate) fn forces_mut(&mut self) -> &mut [Vec2] {
        &mut self.forces
    }

    /// The forces found last, node by node.
    pub(crate) fn forces(&self) -> &[Vec2] {
        &self.forces
    }
}
