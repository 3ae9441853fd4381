//! A droplet of another viscosity, as the double layer sees it.

use std::ops::Range;

use crate::{FlowError, Vec2};

use super::stress::{Sources, StressKernel};

/// Nodes of a closed curve with weights and normals.
#[derive(Debug, Default)]
pub(crate) struct Droplet {
    /// Which markers.
    pub(crate) markers: Range<usize>,
    /// Whether its markers are equally spaced.
    pub(crate) even: bool,
    /// Its first node among those of all droplets.
    pub(crate) first: usize,
    /// Viscosity inside (stress times time).
    pub(crate) viscosity: f64,
    /// Viscosity inside less that of the surroundings.
    pub(crate) contrast: f64,
    /// Mean of its markers (length).
    pub(crate) centre: Vec2,
    /// Positions relative to the centre (length).
    pub(crate) positions: Vec<Vec2>,
    /// Outward normals times the arc length that belongs to the node.
    pub(crate) normals: Vec<Vec2>,
    /// These arc lengths.
    pub(crate) weights: Vec<f64>,
    /// Area (length squared) by the same quadrature.
    pub(crate) area: f64,
    /// Largest distance of a node from the centre.
    pub(crate) radius: f64,
    /// Largest distance of neighbouring nodes (length).
    pub(crate) longest: f64,
    pub(crate) sources: Sources,
}

impl Droplet {
    /// Takes over the positions of a droplet.
    pub(crate) fn load(&mut self, kernel: &StressKernel, positions: &[Vec2]) -> Result<(), FlowError> {
        let n = positions.len();
        if n < 8 {
            return Err(FlowError::Parameter {
                name: "the number of markers of an interface between different viscosities",
                value: n as f64,
                remedy: "give at least 8",
            });
        }
        self.centre = positions.iter().sum::<Vec2>() / n as f64;
        self.positions.clear();
        self.positions.extend(positions.iter().map(|x| x - self.centre));
        self.radius = self.positions.iter().map(Vec2::norm).fold(0.0, f64::max);
        self.longest = (0..n).map(|k| (self.positions[(k + 1) % n] - self.positions[k]).norm()).fold(0.0, f64::max);
        self.normals.clear();
        self.weights.clear();
        self.area = 0.0;
        for k in 0..n {
            let at = |shift: usize| self.positions[(k + shift) % n];
            // Fourth order: that of the curve's parameter, in which the trapezoidal rule is spectral.
            let d = (8.0 * (at(1) - at(n - 1)) - (at(2) - at(n - 2))) / 12.0;
            let normal = Vec2::new(d.y, -d.x);
            self.area += 0.5 * self.positions[k].dot(&normal);
            self.normals.push(normal);
            self.weights.push(d.norm());
        }
        if self.area <= 0.0 {
            return Err(FlowError::Unsupported {
                what: "a droplet of another viscosity whose markers run clockwise or that crosses itself",
                remedy: "give its markers in counter-clockwise order",
            });
        }
        let Self { positions, sources, .. } = self;
        kernel.load(positions.iter().copied(), sources);
        Ok(())
    }

    pub(crate) fn nodes(&self) -> usize {
        self.positions.len()
    }

    /// Its entries in vectors over all nodes, x components first.
    pub(crate) fn entries(&self, all: usize) -> impl Iterator<Item = usize> + use<> {
        let (first, count) = (self.first, self.nodes());
        (first..first + count).chain(all + first..all + first + count)
    }

    /// Whether a point relative to the centre lies inside, by the number of times the polygon goes around it.
    pub(crate) fn contains(&self, point: Vec2) -> bool {
        let n = self.nodes();
        let mut inside = false;
        for k in 0..n {
            let (a, b) = (self.positions[k], self.positions[(k + 1) % n]);
            if (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x) {
                inside = !inside;
            }
        }
        inside
    }

    /// The point of the polygon nearest to a point relative to the centre, if it is closer than `reach`.
    pub(crate) fn foot(&self, point: Vec2, reach: f64) -> Option<Foot> {
        let n = self.nodes();
        let mut best = None;
        let mut least = reach;
        let mut node = 0;
        while node < n {
            let (a, b) = (self.positions[node], self.positions[(node + 1) % n]);
            let along = b - a;
            let square = along.norm_squared();
            let fraction = if square > 0.0 { ((point - a).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
            let distance = (point - a - fraction * along).norm();
            if distance < least {
                least = distance;
                best = Some(Foot { node, fraction, distance });
            }
            // The next ones cannot come closer faster than they are apart.
            let skipped = ((distance - least) / self.longest) as usize;
            node += skipped.max(1);
        }
        best
    }
}

/// A point of a polygon.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Foot {
    /// First node of its segment.
    pub(crate) node: usize,
    /// How far along the segment, 0 to 1.
    pub(crate) fraction: f64,
    /// Distance to it (length).
    pub(crate) distance: f64,
}
