//! The curves that layers lie on: points that bodies give, nodes of layers, and nodes that the grid sees.

use std::ops::Range;

use motile_base::{
    InputError, PeriodicSeries,
    internal::{at_least, spectrum::largest_wave},
};
use num_complex::Complex64;
use stokes_boundary_integrals::{LayerCurve, Settings};

use motile_base::Vec2;
use motile_scene::{FlowError, MarkerGroup, Markers};

/// If their own nodes are equally spaced, grid nodes of a curve are at most a grid spacing over this apart.
const FINER: f64 = 1.2;

/// Most markers of an interface.
const MOST_MARKERS: usize = 1 << 20;

/// A closed curve or one that is periodic in x.
#[derive(Debug, Clone)]
struct Curve {
    /// Markers and the periods that are added to their places.
    markers: Vec<(usize, i32)>,
    /// Advance of the curve in a turn of the parameter (length).
    advance: f64,
    /// First entries of its points, its nodes and its grid nodes in the lists of all curves.
    starts: [usize; 3],
    /// Series through values at its points, its nodes and its grid nodes.
    series: [PeriodicSeries; 3],
    length: f64,
}

/// The curves of all bodies.
#[derive(Debug, Clone)]
pub(super) struct LayerCurves {
    period: f64,
    spacing: f64,
    nodes: usize,
    groups: Vec<MarkerGroup>,
    curves: Vec<Curve>,
    interfaces: usize,
    /// Markers that are on no curve.
    pub(super) inner: Vec<usize>,
    /// At the points.
    points: Vec<Vec2>,
    values: Vec<Vec2>,
    /// Forces at the nodes, x then y, curve after curve.
    pub(super) forces: Vec<f64>,
    /// Viscosity times velocity there.
    pub(super) velocities: Vec<f64>,
    /// Positions, forces and velocities at the grid nodes.
    pub(super) grid: [Vec<Vec2>; 3],
}

impl LayerCurves {
    /// Is made for a region of that period in x and a grid of that spacing (length); so many nodes of an interface.
    pub(super) fn new(period: f64, spacing: f64, nodes: usize) -> Self {
        Self {
            period,
            spacing,
            nodes,
            groups: Vec::new(),
            curves: Vec::new(),
            interfaces: 0,
            inner: Vec::new(),
            points: Vec::new(),
            values: Vec::new(),
            forces: Vec::new(),
            velocities: Vec::new(),
            grid: Default::default(),
        }
    }

    /// Returns the lengths of the interfaces (length).
    pub(super) fn interface_lengths(&self) -> impl Iterator<Item = f64> {
        self.curves[..self.interfaces].iter().map(|curve| curve.length)
    }

    /// Returns the entries of the interfaces, which come first, in lists over all nodes.
    pub(super) fn interface_entries(&self) -> usize {
        2 * self.nodes * self.interfaces
    }

    /// Returns the curves as layers want them.
    pub(super) fn layers(&self) -> impl Iterator<Item = LayerCurve<'_>> + Clone {
        self.curves.iter().map(|curve| {
            let positions = &self.points[curve.starts[0]..][..curve.markers.len()];
            LayerCurve { positions, period: Vec2::new(curve.advance, 0.0), nodes: curve.series[1].len() }
        })
    }

    /// Finds out which markers are on which curve.
    fn arrange(&mut self, groups: &[MarkerGroup]) -> Result<(), FlowError> {
        // Not theirs until all of them are arranged.
        self.groups.clear();
        self.curves.clear();
        let mut starts = [0; 3];
        let mut curve = |markers: Vec<(usize, i32)>, periods: i32, nodes: usize| {
            let (points, own) = (PeriodicSeries::new(markers.len())?, PeriodicSeries::new(nodes)?);
            let series = [points, own.clone(), own];
            let curve = Curve { advance: f64::from(periods) * self.period, starts, series, length: 0.0, markers };
            starts[0] += curve.markers.len();
            starts[1] += nodes;
            Ok::<_, InputError>(curve)
        };
        let refuse = |body: usize, what: &'static str, found: usize, [least, most]: [usize; 2]| {
            let inside = (least..=most).contains(&found);
            if inside { Ok(()) } else { Err(FlowError::Count { body, what, found, least, most }) }
        };
        for (body, group) in groups.iter().enumerate().filter(|(_, group)| group.kind.is_curve()) {
            refuse(body, "markers", group.range.len(), [self.nodes, MOST_MARKERS])?;
            let periods = group.kind.advance().map_or(0, |advance| if advance > 0.0 { 1 } else { -1 });
            self.curves.push(curve(group.range.clone().map(|marker| (marker, 0)).collect(), periods, self.nodes)?);
        }
        self.interfaces = self.curves.len();
        for (body, group) in groups.iter().enumerate().filter(|(_, group)| !group.kind.is_curve()) {
            for surface in group.layers() {
                let count = surface.points.len();
                refuse(body, "points", count, Settings::NODES)?;
                let largest = surface.markers().map(|(marker, _)| marker).max().unwrap_or(0);
                at_least("the markers of a solid with a surface", group.range.len(), largest + 1)?;
                let markers = surface.markers().map(|(marker, shift)| (group.range.start + marker, shift));
                self.curves.push(curve(markers.collect(), surface.periods, count)?);
            }
        }
        let mut free = vec![true; groups.last().map_or(0, |group| group.range.end)];
        self.curves.iter().flat_map(|curve| &curve.markers).for_each(|(marker, _)| free[*marker] = false);
        self.inner = (0..free.len()).filter(|marker| free[*marker]).collect();
        let [points, nodes, _] = starts;
        self.points.resize(points, Vec2::ZERO);
        let most = self.curves.iter().map(|curve| curve.markers.len()).max();
        self.values.resize(most.unwrap_or(0), Vec2::ZERO);
        self.forces.resize(2 * nodes, 0.0);
        self.velocities.resize(2 * nodes, 0.0);
        self.groups.extend_from_slice(groups);
        Ok(())
    }

    /// Takes over positions and forces.
    pub(super) fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        for (body, group) in markers.groups().iter().enumerate() {
            for (what, list) in [("the position", markers.positions()), ("the force", markers.forces())] {
                let wrong = |v: &Vec2| !(v.x.is_finite() && v.y.is_finite());
                if let Some(marker) = list[group.range.clone()].iter().position(wrong) {
                    let v = list[group.range.start + marker];
                    return Err(FlowError::NonFinite { what, body, marker, x: v.x, y: v.y });
                }
            }
        }
        if self.groups != markers.groups() {
            self.arrange(markers.groups())?;
        }
        let mut first = 0;
        for curve in &mut self.curves {
            curve.starts[2] = first;
            let count = curve.markers.len();
            let points = &mut self.points[curve.starts[0]..][..count];
            for ((marker, shift), point) in curve.markers.iter().zip(&mut *points) {
                *point = markers.positions()[*marker] + Vec2::new(f64::from(*shift) * self.period, 0.0);
            }
            first += curve.fit(points, self.spacing)?;
            for list in &mut self.grid {
                list.resize(first.max(list.len()), Vec2::ZERO);
            }
            curve.load(points, &mut self.grid[0])?;
        }
        self.grid.iter_mut().for_each(|list| list.truncate(first));
        self.load_forces(markers.forces())
    }

    /// Takes over forces on all markers.
    pub(super) fn load_forces(&mut self, forces: &[Vec2]) -> Result<(), FlowError> {
        for curve in &mut self.curves {
            let values = &mut self.values[..curve.markers.len()];
            for ((marker, _), force) in curve.markers.iter().zip(&mut *values) {
                *force = forces[*marker];
            }
            curve.load_forces(values, &mut self.forces)?;
        }
        self.refine_forces()
    }

    /// Returns the forces at the grid nodes from those at the nodes.
    pub(super) fn refine_forces(&mut self) -> Result<(), FlowError> {
        for curve in &mut self.curves {
            let on_grid = curve.on_grid();
            let entries = curve.entries();
            let [_, nodes, grid] = &mut curve.series;
            let (x, y) = self.forces[entries].split_at(nodes.len());
            nodes.analyse(x.iter().zip(y).map(|(x, y)| Complex64::new(*x, *y)))?;
            grid.resample(nodes);
            let share = nodes.len() as f64 / grid.len() as f64;
            grid.scale(|_| share);
            grid.write_vectors(&mut self.grid[1][on_grid])?;
        }
        Ok(())
    }

    /// Adds the velocities at the grid nodes, times a factor, to those at the nodes.
    pub(super) fn add_grid(&mut self, factor: f64) -> Result<(), FlowError> {
        for curve in &mut self.curves {
            let (on_grid, entries) = (curve.on_grid(), curve.entries());
            let [_, nodes, grid] = &mut curve.series;
            grid.analyse_vectors(&self.grid[2][on_grid])?;
            nodes.resample(grid);
            let (x, y) = self.velocities[entries].split_at_mut(nodes.len());
            for ((x, y), velocity) in x.iter_mut().zip(y).zip(nodes.values()) {
                *x += factor * velocity.re;
                *y += factor * velocity.im;
            }
        }
        Ok(())
    }

    /// Writes velocities of the markers on curves, those at the nodes times a factor.
    pub(super) fn write(&mut self, factor: f64, out: &mut [Vec2]) -> Result<(), FlowError> {
        for curve in &mut self.curves {
            let entries = curve.entries();
            let [points, nodes, _] = &mut curve.series;
            let (x, y) = self.velocities[entries].split_at(nodes.len());
            nodes.analyse(x.iter().zip(y).map(|(x, y)| factor * Complex64::new(*x, *y)))?;
            drop_unpaired(nodes);
            points.resample(nodes);
            for ((marker, _), velocity) in curve.markers.iter().zip(points.values()) {
                out[*marker] = Vec2::new(velocity.re, velocity.im);
            }
        }
        Ok(())
    }
}

impl Curve {
    /// Its grid nodes.
    fn on_grid(&self) -> Range<usize> {
        self.starts[2]..self.starts[2] + self.series[2].len()
    }

    /// Its entries in lists over all nodes.
    fn entries(&self) -> Range<usize> {
        2 * self.starts[1]..2 * (self.starts[1] + self.series[1].len())
    }

    /// Measures it and says how many grid nodes it has.
    ///
    /// # Errors
    /// Returns an error for a curve so long that its transform would be too large.
    fn fit(&mut self, points: &[Vec2], spacing: f64) -> Result<usize, InputError> {
        let count = points.len();
        let closing = points[count - 1].distance(points[0] + Vec2::new(self.advance, 0.0));
        self.length = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() + closing;
        let nodes = self.series[1].len();
        let times = (FINER * self.length / (nodes as f64 * spacing)).ceil() as usize;
        let fine = nodes.saturating_mul(times.max(1));
        if self.series[2].len() != fine {
            self.series[2] = PeriodicSeries::new(fine)?;
        }
        Ok(fine)
    }

    /// Takes over positions at the points to the grid nodes.
    fn load(&mut self, positions: &[Vec2], out: &mut [Vec2]) -> Result<(), FlowError> {
        let on_grid = self.on_grid();
        let [points, nodes, grid] = &mut self.series;
        let (count, fine) = (points.len(), grid.len());
        let ramp = |k: usize, count: usize| self.advance * k as f64 / count as f64;
        points.analyse(positions.iter().enumerate().map(|(k, v)| Complex64::new(v.x - ramp(k, count), v.y)))?;
        nodes.resample(points);
        grid.resample(nodes);
        let out = &mut out[on_grid];
        grid.write_vectors(out)?;
        out.iter_mut().enumerate().for_each(|(k, v)| v.x += ramp(k, fine));
        Ok(())
    }

    /// Takes over forces at the points to the nodes.
    fn load_forces(&mut self, values: &[Vec2], forces: &mut [f64]) -> Result<(), FlowError> {
        let entries = self.entries();
        let [points, nodes, _] = &mut self.series;
        points.analyse_vectors(values)?;
        nodes.resample(points);
        let share = points.len() as f64 / nodes.len() as f64;
        let (x, y) = forces[entries].split_at_mut(nodes.len());
        for ((x, y), force) in x.iter_mut().zip(y).zip(nodes.values()) {
            (*x, *y) = (share * force.re, share * force.im);
        }
        Ok(())
    }
}

/// Leaves out the wave of a zigzag, which stands for both signs.
fn drop_unpaired(series: &mut PeriodicSeries) {
    let largest = largest_wave(series.len());
    series.scale(|m| if m <= largest { 1.0 } else { 0.0 });
}
