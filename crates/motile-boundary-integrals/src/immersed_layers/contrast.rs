//! Interfaces between fluids of different viscosity among layers.

use std::f64::consts::TAU;

use motile_base::{PeriodicSeries, internal::spectrum::largest_wave};
use num_complex::Complex64;
use stokes_boundary_integrals::internal::gmres::{Gmres, Outcome};
use stokes_boundary_integrals::{InterfaceFlow, SingleLayer, Solution};

use crate::error::of_layers;
use motile_scene::{FlowError, checkpoint::SavedState};

/// Iterations before giving up.
const MOST_ITERATIONS: usize = 200;

/// Forces that take the place of other viscosities: with u the velocity that all forces have in fluid of one viscosity
/// eta, v the velocity of the interfaces ([`InterfaceFlow::solve_in`]) and L their single layer, forces q with
///
/// `L q = eta (v - u)`
///
/// leave v on the interfaces when they are added to their own. By uniqueness, the flow then equals the flow of the
/// interfaces everywhere, outside and inside, where forces count by eta over the viscosity there.
///
/// On a straight interface L multiplies the wave number k by 1/(4 k), which makes a preconditioner. A uniform force
/// along the normal moves nothing and is left out.
#[derive(Debug, Clone)]
pub(super) struct LayerContrast {
    tolerance: f64,
    /// Iterations before giving up.
    pub(super) most_iterations: usize,
    gmres: Gmres,
    series: PeriodicSeries,
    /// For each interface its first wave number (1/length).
    waves: Vec<f64>,
    /// Normals at the nodes of interfaces times the length that belongs to the node (length).
    pub(super) normals: Vec<f64>,
    /// At the nodes of interfaces.
    velocities: Vec<f64>,
    right: Vec<f64>,
    pub(super) unknown: Vec<f64>,
    /// Forces at all nodes, and viscosity times velocity.
    forces: Vec<f64>,
    response: Vec<f64>,
}

impl LayerContrast {
    /// Lists that [`LayerContrast::save`] writes.
    pub(super) const LISTS: usize = 2;

    pub(super) fn new(nodes: usize, tolerance: f64) -> Result<Self, FlowError> {
        Ok(Self {
            tolerance,
            most_iterations: MOST_ITERATIONS,
            gmres: Gmres::recycling(),
            series: PeriodicSeries::new(nodes)?,
            waves: Vec::new(),
            normals: Vec::new(),
            velocities: Vec::new(),
            right: Vec::new(),
            unknown: Vec::new(),
            forces: Vec::new(),
            response: Vec::new(),
        })
    }

    /// Finds velocities at the nodes of `interfaces` for viscosity times velocity `flow` of all forces in fluid of one
    /// viscosity.
    pub(super) fn solve(&mut self, interfaces: &mut InterfaceFlow, flow: &[f64]) -> Result<Solution, FlowError> {
        self.velocities.resize(flow.len(), 0.0);
        interfaces.solve_in(flow, &mut self.velocities).map_err(of_layers)
    }

    /// Adds the forces that take the place of other viscosities to those at the nodes of all layers, of which
    /// `interfaces` are the first, and their flow to `flow`, which is as before except for the forces inside of
    /// interfaces: these count by their fluid.
    pub(super) fn add_forces(
        &mut self,
        interfaces: &InterfaceFlow,
        layer: &mut SingleLayer,
        all: &mut [f64],
        flow: &mut [f64],
    ) -> Result<Outcome, FlowError> {
        let entries = self.velocities.len();
        if self.unknown.len() != entries {
            self.unknown.clear();
            self.gmres.forget();
        }
        for list in [&mut self.unknown, &mut self.right, &mut self.normals] {
            list.resize(entries, 0.0);
        }
        for list in [&mut self.forces, &mut self.response] {
            list.clear();
            list.resize(all.len(), 0.0);
        }
        self.waves.clear();
        for curve in 0..interfaces.len() {
            layer.normals(curve, &mut self.normals[layer.entries(curve)]).map_err(of_layers)?;
            self.waves.push(interfaces.perimeter(curve).map_or(1.0, |perimeter| TAU / perimeter));
        }
        let viscosity = interfaces.viscosity();
        for ((right, velocity), flow) in self.right.iter_mut().zip(&self.velocities).zip(&*flow) {
            *right = viscosity * velocity - flow;
        }
        let Self { gmres, series, waves, normals, right, unknown, forces, response, tolerance, .. } = self;
        let mut curves = LoadedCurves { series, waves, normals };
        curves.grow(right, |_| 0.0);
        let mut failure = None;
        let product = |y: &[f64], out: &mut [f64], _: f64| {
            curves.forces(y, forces);
            failure = layer.apply(forces, response).err();
            out.copy_from_slice(&response[..out.len()]);
            curves.complete(y, out);
        };
        let outcome = gmres.solve(product, right, unknown, *tolerance, self.most_iterations);
        if let Some(error) = failure {
            unknown.clear();
            return Err(of_layers(error));
        }
        let Outcome { iterations, residual } = outcome;
        if residual.is_nan() || residual > 2.0 * *tolerance {
            unknown.clear();
            let what = "the flow around interfaces to another viscosity";
            return Err(FlowError::NoConvergence { what, iterations, residual, tolerance: *tolerance });
        }
        curves.forces(unknown, forces);
        layer.apply(forces, response).map_err(of_layers)?;
        all.iter_mut().zip(forces).for_each(|(all, force)| *all += *force);
        flow.iter_mut().zip(response).for_each(|(flow, value)| *flow += *value);
        Ok(outcome)
    }

    /// Returns the last solution, from which the next one starts.
    pub(super) fn save(&self) -> SavedState {
        let lists = [self.unknown.clone(), self.gmres.save(self.unknown.len())];
        SavedState { counts: lists.iter().map(|list| list.len() as u64).collect(), reals: lists.concat() }
    }

    /// Takes back what [`LayerContrast::save`] wrote, which is where `saved` begins, and gives the numbers after it.
    pub(super) fn restore<'a>(&mut self, saved: &'a SavedState) -> Option<&'a [f64]> {
        let counts = saved.counts.first_chunk::<{ Self::LISTS }>()?.map(usize::try_from);
        let (unknown, rest) = saved.reals.split_at_checked(counts[0].ok()?)?;
        let (kept, rest) = rest.split_at_checked(counts[1].ok()?)?;
        self.gmres.restore(unknown.len(), kept);
        self.unknown = unknown.to_vec();
        Some(rest)
    }
}

/// Interfaces with their normals.
struct LoadedCurves<'a> {
    series: &'a mut PeriodicSeries,
    waves: &'a [f64],
    normals: &'a [f64],
}

impl LoadedCurves<'_> {
    /// Multiplies the modes of each curve by a function of its first wave number and the mode's number.
    fn scale(&mut self, values: &mut [f64], factor: impl Fn(f64, usize) -> f64) {
        let nodes = self.series.len();
        for (values, wave) in values.chunks_exact_mut(2 * nodes).zip(self.waves) {
            let (x, y) = values.split_at_mut(nodes);
            // The length is the series' own, so that the call cannot fail.
            let _ = self.series.analyse(x.iter().zip(&*y).map(|(x, y)| Complex64::new(*x, *y)));
            self.series.scale(|m| factor(*wave, m));
            for ((x, y), value) in x.iter_mut().zip(y).zip(self.series.values()) {
                (*x, *y) = (value.re, value.im);
            }
        }
    }

    /// Forces of densities `4 k y`, without the zigzag.
    fn forces(&mut self, y: &[f64], forces: &mut [f64]) {
        let nodes = self.series.len();
        let largest = largest_wave(nodes);
        forces[..y.len()].copy_from_slice(y);
        self.scale(&mut forces[..y.len()], |wave, m| {
            let share = TAU / (wave * nodes as f64);
            if m <= largest { 4.0 * wave * share * (m as f64).max(0.5) } else { 0.0 }
        });
    }

    /// Completes the product of the layer and the forces of y by what these do not have, the zigzag and uniform growth.
    fn complete(&mut self, y: &[f64], out: &mut [f64]) {
        let largest = largest_wave(self.series.len());
        out.iter_mut().zip(y).for_each(|(out, y)| *out -= y);
        self.scale(out, |_, m| if m <= largest { 1.0 } else { 0.0 });
        out.iter_mut().zip(y).for_each(|(out, y)| *out += y);
        self.grow(out, |i| y[i]);
    }

    /// Gives values the flux through each curve that others have, by a uniform normal component.
    fn grow(&self, values: &mut [f64], other: impl Fn(usize) -> f64) {
        let nodes = self.series.len();
        for (curve, wave) in self.waves.iter().enumerate() {
            let first = 2 * nodes * curve;
            let entries = first..first + 2 * nodes;
            let missing: f64 = entries.map(|i| self.normals[i] * (other(i) - values[i])).sum();
            for i in first..first + nodes {
                let normal = [self.normals[i], self.normals[i + nodes]];
                let factor = missing * wave / (TAU * normal[0].hypot(normal[1]));
                values[i] += factor * normal[0];
                values[i + nodes] += factor * normal[1];
            }
        }
    }
}
