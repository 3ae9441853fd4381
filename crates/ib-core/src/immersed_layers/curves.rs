//! The curves that layers lie on, as points that bodies give and as nodes that the grid sees.

use std::f64::consts::TAU;

use fourier::{PeriodicSeries, spectrum::largest_wave};
use num_complex::Complex64;
use stokes_layers::InterfaceFlow;

use crate::{FlowError, Markers, Vec2, hydrodynamics::MarkerGroup};

/// The distance of neighbouring grid nodes of a curve is at most a grid spacing over this, where the curve's own nodes
/// are equally spaced.
const FINER: f64 = 1.2;

/// A closed curve or one that is periodic in x.
#[derive(Debug, Clone)]
struct LayerCurve {
    /// Markers and the periods that are added to their places.
    markers: Vec<(usize, i32)>,
    /// Periods in x after which it meets itself.
    periods: i32,
    /// Modes that are kept.
    modes: usize,
    /// Where its points and its grid nodes stand in the lists of all curves.
    first: usize,
    first_fine: usize,
    points: PeriodicSeries,
    fine: PeriodicSeries,
}

/// The curves of all bodies.
#[derive(Debug, Clone)]
pub(super) struct LayerCurves {
    period: f64,
    spacing: f64,
    nodes: usize,
    groups: Vec<MarkerGroup>,
    curves: Vec<LayerCurve>,
    interfaces: usize,
    /// Markers that are on no curve.
    pub(super) inner: Vec<usize>,
    /// Positions and forces at the points of all curves, and velocities.
    points: [Vec<Vec2>; 2],
    velocities: Vec<Vec2>,
    /// Positions, forces, velocities at the grid nodes of all curves.
    fine: [Vec<Vec2>; 3],
}

impl LayerCurves {
    /// For a region of that period in x and a grid of that spacing (length).
    pub(super) fn new(period: f64, spacing: f64) -> Self {
        Self {
            period,
            spacing,
            nodes: 0,
            groups: Vec::new(),
            curves: Vec::new(),
            interfaces: 0,
            inner: Vec::new(),
            points: Default::default(),
            velocities: Vec::new(),
            fine: Default::default(),
        }
    }

    /// Number of interfaces, which come first.
    pub(super) fn interfaces(&self) -> usize {
        self.interfaces
    }

    /// Positions and forces at the points of each curve.
    pub(super) fn given(&self) -> impl Iterator<Item = [&[Vec2]; 2]> + Clone {
        self.curves.iter().map(|curve| {
            let range = curve.first..curve.first + curve.points.len();
            [&self.points[0][range.clone()], &self.points[1][range]]
        })
    }

    /// Positions at the grid nodes of all curves (length).
    pub(super) fn positions(&self) -> &[Vec2] {
        &self.fine[0]
    }

    /// Forces at the grid nodes (force).
    pub(super) fn forces(&self) -> &[Vec2] {
        &self.fine[1]
    }

    /// Velocities at the grid nodes (length per time), to be filled.
    pub(super) fn velocities_mut(&mut self) -> &mut [Vec2] {
        &mut self.fine[2]
    }

    /// Finds out which markers are on which curve.
    fn arrange(&mut self, groups: &[MarkerGroup], nodes: usize) {
        self.groups = groups.to_vec();
        self.nodes = nodes;
        self.curves.clear();
        let mut first = 0;
        let mut push = |curves: &mut Vec<LayerCurve>, markers: Vec<(usize, i32)>, periods: i32, modes: usize| {
            let count = markers.len();
            let points = PeriodicSeries::new(count);
            let fine = points.clone();
            curves.push(LayerCurve { markers, periods, modes, first, first_fine: 0, points, fine });
            first += count;
        };
        for group in groups.iter().filter(|group| group.kind.is_interface()) {
            let markers: Vec<_> = group.range.clone().map(|marker| (marker, 0)).collect();
            let modes = nodes.min(markers.len());
            push(&mut self.curves, markers, 0, modes);
        }
        self.interfaces = self.curves.len();
        for group in groups {
            for surface in &group.surfaces {
                let absolute = |&(marker, shift): &(usize, i32)| (group.range.start + marker, shift);
                let count = surface.markers.len();
                push(&mut self.curves, surface.markers.iter().map(absolute).collect(), surface.periods, count);
            }
        }
        let mut free = vec![true; groups.last().map_or(0, |group| group.range.end)];
        self.curves.iter().flat_map(|curve| &curve.markers).for_each(|(marker, _)| free[*marker] = false);
        self.inner = (0..free.len()).filter(|marker| free[*marker]).collect();
        self.points.iter_mut().for_each(|list| list.resize(first, Vec2::ZERO));
        let most = self.curves.iter().map(|curve| curve.points.len()).max();
        self.velocities.resize(most.unwrap_or(0), Vec2::ZERO);
    }

    /// Takes over positions and forces.
    pub(super) fn load(&mut self, markers: &Markers, nodes: usize) -> Result<(), FlowError> {
        markers.check()?;
        for (body, group) in markers.groups().iter().enumerate() {
            let range = group.range.clone();
            for (what, list) in [("the position", &markers.positions), ("the force", &markers.forces)] {
                let wrong = |v: &Vec2| !(v.x.is_finite() && v.y.is_finite());
                if let Some(marker) = list[range.clone()].iter().position(wrong) {
                    let v = list[range.start + marker];
                    return Err(FlowError::NonFinite { what, body, marker, x: v.x, y: v.y });
                }
            }
        }
        if self.groups != markers.groups() || self.nodes != nodes {
            self.arrange(markers.groups(), nodes);
        }
        let Self { period, curves, points, fine, .. } = self;
        let mut first_fine = 0;
        for curve in curves {
            let range = curve.first..curve.first + curve.points.len();
            let [positions, forces] = points.each_mut().map(|list| &mut list[range.clone()]);
            for (((marker, shift), position), force) in curve.markers.iter().zip(positions).zip(forces) {
                *position = markers.positions[*marker] + Vec2::new(f64::from(*shift) * *period, 0.0);
                *force = markers.forces[*marker];
            }
            let [positions, forces] = points.each_ref().map(|list| &list[range.clone()]);
            curve.first_fine = first_fine;
            first_fine += curve.refine(positions, forces, [*period, self.spacing], fine)?;
        }
        fine.iter_mut().for_each(|list| list.truncate(first_fine));
        Ok(())
    }

    /// Writes the velocities of the markers on curves: those of the layers, and those of the grid at the grid nodes.
    pub(super) fn write(&mut self, flow: &mut InterfaceFlow, out: &mut [Vec2]) -> Result<(), FlowError> {
        for (index, curve) in self.curves.iter_mut().enumerate() {
            let own = &mut self.velocities[..curve.points.len()];
            flow.velocities(index, own)?;
            let fine = &self.fine[2][curve.first_fine..curve.first_fine + curve.fine.len()];
            curve.fine.analyse_vectors(fine)?;
            let largest = largest_wave(curve.modes);
            curve.points.resample(&curve.fine);
            curve.points.scale(|m| if m <= largest { 1.0 } else { 0.0 });
            for (((marker, _), own), grid) in curve.markers.iter().zip(own).zip(curve.points.values()) {
                out[*marker] = *own + Vec2::new(grid.re, grid.im);
            }
        }
        Ok(())
    }
}

impl LayerCurve {
    /// Adds its grid nodes to the lists and says how many they are.
    fn refine(
        &mut self,
        positions: &[Vec2],
        forces: &[Vec2],
        [period, spacing]: [f64; 2],
        fine: &mut [Vec<Vec2>; 3],
    ) -> Result<usize, FlowError> {
        let count = positions.len();
        let advance = f64::from(self.periods) * period;
        let neighbours = positions.windows(2).map(|pair| pair[0].distance(pair[1]));
        let closing = positions[count - 1].distance(positions[0] + Vec2::new(advance, 0.0));
        let length = neighbours.sum::<f64>() + closing;
        let nodes = self.modes * ((FINER * length / (self.modes as f64 * spacing)).ceil() as usize).max(1);
        if self.fine.len() != nodes {
            self.fine = PeriodicSeries::new(nodes);
        }
        for list in fine.iter_mut() {
            list.resize(list.len().max(self.first_fine + nodes), Vec2::ZERO);
        }
        let largest = largest_wave(self.modes);
        let along = advance / TAU;
        for (list, values, scale, along) in
            [(0, positions, 1.0, along), (1, forces, count as f64 / nodes as f64, 0.0)]
        {
            let ramp = |k: usize, count: usize| along * TAU * k as f64 / count as f64;
            let samples = values.iter().enumerate().map(|(k, v)| Complex64::new(v.x - ramp(k, count), v.y));
            self.points.analyse(samples)?;
            self.points.scale(|m| if m <= largest { scale } else { 0.0 });
            self.fine.resample(&self.points);
            let out = &mut fine[list][self.first_fine..self.first_fine + nodes];
            self.fine.write_vectors(out)?;
            out.iter_mut().enumerate().for_each(|(k, v)| v.x += ramp(k, nodes));
        }
        Ok(nodes)
    }
}
