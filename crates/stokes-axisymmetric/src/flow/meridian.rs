//! Meridians: series of sines and cosines on half a turn, and surfaces of revolution.

use std::f64::consts::PI;

use motile_base::Vec2;
use nalgebra::DMatrix;

use super::{
    fixed_panels::FixedPanels,
    truncation::Truncation,
    waves::{LANES, Pair, Point, Waves, chunk, dot},
};
use stokes_boundary_integrals::LayerError;

/// Half a turn of a number of points, with the transforms between values there and series.
#[derive(Debug, Clone)]
pub(super) struct Half {
    /// Intervals of the half turn.
    intervals: usize,
    /// cos(pi m/intervals) for m = 0 .. 2 intervals - 1.
    cosines: Vec<f64>,
    /// Truncation of forces at the points, if there are more than nodes.
    truncation: Option<Truncation>,
}

impl Half {
    pub(super) fn new(intervals: usize) -> Self {
        let angle = |m: usize| PI * m as f64 / intervals as f64;
        let cosines = (0..2 * intervals).map(|m| angle(m).cos()).collect();
        Self { intervals, cosines, truncation: None }
    }

    /// Returns the truncation of forces at the points to so many nodes, always of one number.
    ///
    /// # Errors
    /// Returns the errors of [`Truncation::new`].
    pub(super) fn truncation(&mut self, nodes: usize) -> Result<&mut Truncation, LayerError> {
        let made = self.truncation.take().map_or_else(|| Truncation::new(nodes, self.intervals), Ok)?;
        Ok(self.truncation.insert(made))
    }

    pub(super) fn intervals(&self) -> usize {
        self.intervals
    }

    /// cos(k t) and sin(k t) at point j of the intervals' ends.
    fn wave(&self, k: usize, j: usize) -> (f64, f64) {
        let (turn, m) = (2 * self.intervals, k * j);
        // sin(x) = cos(x - pi/2) has no table of its own where pi/2 is between two entries.
        let cos = self.cosines[m % turn];
        if self.intervals.is_multiple_of(2) {
            (cos, self.cosines[(m + turn - self.intervals / 2) % turn])
        } else {
            (cos, (PI * (m % turn) as f64 / self.intervals as f64).sin())
        }
    }

    /// Returns the series through values at the points 0 to `intervals`: (even part, odd part) of point j from `value`,
    /// truncated to the waves below `waves`.
    pub(super) fn analyse(&self, waves: usize, value: impl Fn(usize) -> (f64, f64), out: &mut Pair) {
        let n = self.intervals;
        out.cos.fill(0.0);
        out.sin.fill(0.0);
        for j in 0..=n {
            let (even, odd) = value(j);
            let weight = if j == 0 || j == n { 1.0 } else { 2.0 } / n as f64;
            for k in 0..waves {
                let (cos, sin) = self.wave(k, j);
                out.cos[k] += weight * if k == 0 || k == n { 0.5 } else { 1.0 } * cos * even;
                out.sin[k] += weight * sin * odd;
            }
        }
    }

    /// Returns the values (even part, odd part) at point j.
    pub(super) fn value(&self, series: &Pair, waves: usize, j: usize) -> (f64, f64) {
        let mut sums = (0.0, 0.0);
        for k in 0..waves {
            let (cos, sin) = self.wave(k, j);
            sums.0 += series.cos[k] * cos;
            sums.1 += series.sin[k] * sin;
        }
        sums
    }
}

/// Plan shared by all surfaces of one number of nodes: nodes `t_j = pi (j + 1/2)/N`, their waves, quadrature weights.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    /// N, the number of nodes.
    pub(super) nodes: usize,
    pub(super) parameters: Vec<f64>,
    pub(super) waves: Vec<Waves>,
    /// Weights of Fejer, exact for sines, which all integrands of surfaces of revolution are.
    pub(super) weights: Vec<f64>,
}

impl Grid {
    pub(super) fn new(nodes: usize) -> Self {
        let n = nodes as f64;
        let parameters: Vec<f64> = (0..nodes).map(|j| PI * (j as f64 + 0.5) / n).collect();
        let waves = parameters.iter().map(|t| {
            let mut waves = Waves::new(nodes + 1);
            waves.fill(*t);
            waves
        });
        let waves: Vec<Waves> = waves.collect();
        let weights = waves.iter().map(|waves| Self::weight(nodes, waves)).collect();
        Self { nodes, waves, parameters, weights }
    }

    /// Returns the weight of one of so many nodes, with its waves, in integrals of sines from 0 to pi.
    pub(super) fn weight(nodes: usize, waves: &Waves) -> f64 {
        let wave = |k: usize| (if k == nodes { 2.0 } else { 4.0 }) / (nodes as f64 * k as f64) * waves.sin[k];
        (1..=nodes).step_by(2).map(wave).sum()
    }

    /// Returns the largest wave that the nodes carry, of sines; cosines have one less.
    pub(super) fn largest(&self) -> usize {
        self.nodes
    }

    /// Returns the matrix from coefficients to values at the nodes: cosines 0 .. N - 1 at the rows of the x components,
    /// sines 1 .. N at the entries of the r components, with a factor.
    pub(super) fn add_values(&self, factor: f64, matrix: &mut DMatrix<f64>, start: usize) {
        let n = self.nodes;
        for (j, waves) in self.waves.iter().enumerate() {
            for k in 0..n {
                matrix[(start + j, start + k)] += factor * waves.cos[k];
                matrix[(start + n + j, start + n + k)] += factor * waves.sin[k + 1];
            }
        }
    }

    /// Returns the coefficients of even values x and odd values r at the nodes.
    pub(super) fn analyse(&self, x: &[f64], r: &[f64], out: &mut Pair) {
        out.cos.fill(0.0);
        out.sin.fill(0.0);
        let factor = 2.0 / self.nodes as f64;
        for ((waves, x), r) in self.waves.iter().zip(x).zip(r) {
            for k in 0..self.nodes {
                out.cos[k] += factor * if k == 0 { 0.5 } else { 1.0 } * waves.cos[k] * x;
                out.sin[k + 1] += factor * if k + 1 == self.nodes { 0.5 } else { 1.0 } * waves.sin[k + 1] * r;
            }
        }
    }
}

/// A surface of revolution: x a series of cosines, the distance r from the axis one of sines, both in t from 0 to pi.
/// The force on it per t and angle, x a series of sines and r one of cosines.
#[derive(Debug, Clone)]
pub(super) struct Meridian {
    pub(super) shape: Pair,
    /// Derivative by t: cosines of r, sines of x.
    slope: Pair,
    /// Force on the fluid per parameter and azimuth (force).
    pub(super) force: Pair,
    /// Places and forces at the nodes.
    pub(super) nodes: Vec<Point>,
    pub(super) forces: Vec<Vec2>,
    /// Panels of a surface that keeps its shape, and the forces there.
    pub(super) fixed: Option<FixedPanels>,
    pub(super) fixed_forces: Vec<Vec2>,
    /// Largest distance of two nodes (length).
    pub(super) spacing: f64,
    /// Points that the surface was given by, on the closed curve of meridian and mirror image.
    pub(super) points: usize,
}

impl Meridian {
    pub(super) fn new(grid: &Grid) -> Self {
        let pair = || Pair::new(grid.largest() + 1);
        let nodes = vec![Point::default(); grid.nodes];
        let forces = vec![Vec2::ZERO; grid.nodes];
        let [shape, slope, force] = [pair(), pair(), pair()];
        let (fixed, fixed_forces) = (None, Vec::new());
        Self { shape, slope, force, nodes, forces, fixed, fixed_forces, spacing: 0.0, points: 0 }
    }

    /// Keeps the points of panels for a shape that stays as it is.
    pub(super) fn fix(&mut self, grid: &Grid) {
        let fixed = FixedPanels::new(grid.nodes, |waves| self.at(waves));
        self.fixed_forces = vec![Vec2::ZERO; fixed.points.len()];
        self.fixed = Some(fixed);
    }

    /// Takes over a shape whose coefficients have been set.
    pub(super) fn update(&mut self, grid: &Grid) {
        let Self { shape, slope, .. } = self;
        for (k, (cos, sin)) in slope.cos.iter_mut().zip(&mut slope.sin).enumerate() {
            (*cos, *sin) = (k as f64 * shape.sin[k], -(k as f64) * shape.cos[k]);
        }
        self.spacing = 0.0;
        for (j, waves) in grid.waves.iter().enumerate() {
            self.nodes[j] = self.at(waves);
            self.spacing = self.spacing.max(self.nodes[j].tangent.length() * PI / grid.nodes as f64);
        }
    }

    /// Returns the place and tangent at the parameter of waves.
    pub(super) fn at(&self, waves: &Waves) -> Point {
        let mut sums = [[0.0; LANES]; 4];
        for k in (0..self.shape.cos.len()).step_by(LANES) {
            let (cos, sin) = (chunk(&waves.cos, k), chunk(&waves.sin, k));
            let (x, r) = (chunk(&self.shape.cos, k), chunk(&self.shape.sin, k));
            let (x_slope, r_slope) = (chunk(&self.slope.sin, k), chunk(&self.slope.cos, k));
            for i in 0..LANES {
                sums[0][i] += x[i] * cos[i];
                sums[1][i] += r[i] * sin[i];
                sums[2][i] += x_slope[i] * sin[i];
                sums[3][i] += r_slope[i] * cos[i];
            }
        }
        let [x, r, x_slope, r_slope] = sums.map(|lanes| lanes.iter().sum());
        Point { place: Vec2::new(x, r), tangent: Vec2::new(x_slope, r_slope) }
    }

    /// Returns the place at t + s less that at t, accurate relative to itself, from the waves of t + s/2 and s/2.
    pub(super) fn difference(&self, middle: &Waves, half: &Waves) -> Vec2 {
        let (mut x, mut r) = ([0.0; LANES], [0.0; LANES]);
        for k in (0..self.shape.cos.len()).step_by(LANES) {
            let (cos, sin) = (chunk(&middle.cos, k), chunk(&middle.sin, k));
            let (b, a, h) = (chunk(&self.shape.cos, k), chunk(&self.shape.sin, k), chunk(&half.sin, k));
            for i in 0..LANES {
                x[i] -= b[i] * sin[i] * h[i];
                r[i] += a[i] * cos[i] * h[i];
            }
        }
        2.0 * Vec2::new(x.iter().sum(), r.iter().sum())
    }

    /// Takes over forces whose coefficients have been set.
    pub(super) fn update_forces(&mut self, grid: &Grid) {
        for (j, waves) in grid.waves.iter().enumerate() {
            self.forces[j] = self.force_of(waves);
        }
        let fixed = self.fixed.iter().flat_map(|fixed| &fixed.points);
        self.fixed_forces = fixed.map(|point| self.force_of(&point.waves)).collect();
    }

    pub(super) fn force_of(&self, waves: &Waves) -> Vec2 {
        Vec2::new(dot(&self.force.sin, &waves.sin), dot(&self.force.cos, &waves.cos))
    }

    /// Returns the volume (length cubed), `pi INT r^2 |x_t| dt`, and area of the surface (length squared).
    pub(super) fn measures(&self, grid: &Grid) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (Point { place, tangent }, weight) in self.nodes.iter().zip(&grid.weights) {
            sums[0] -= weight * PI * place.y * place.y * tangent.x;
            sums[1] += weight * 2.0 * PI * place.y * tangent.length();
        }
        sums
    }

    /// Returns the mean over the area of even values at the nodes.
    pub(super) fn mean(&self, grid: &Grid, values: impl Iterator<Item = f64>) -> f64 {
        let [mut sum, mut area] = [0.0; 2];
        for ((Point { place, tangent }, weight), value) in self.nodes.iter().zip(&grid.weights).zip(values) {
            let weight = weight * place.y * tangent.length();
            sum += weight * value;
            area += weight;
        }
        sum / area
    }
}
