//! Closed curves given node by node.

use input_checks::within;

use crate::{LayerError, Vec2, greens::Sources};

use super::{DoubleLayerMatrix, MOST_NODES};

/// Fewest nodes of a curve.
const LEAST_NODES: f64 = 8.0;

/// Nodes of a closed curve, at equally spaced values of some parameter, with weights and normals.
#[derive(Debug, Clone, Default)]
pub struct NodeCurve {
    /// Its first node among those of all curves.
    pub first: usize,
    /// Viscosity of the fluid outside of it (stress times time).
    pub outside: f64,
    /// Viscosity inside less that outside (stress times time).
    pub contrast: f64,
    /// Mean of its nodes (length).
    pub centre: Vec2,
    /// Positions relative to the centre (length).
    pub positions: Vec<Vec2>,
    /// Outward normals times the arc length that belongs to the node (length).
    pub normals: Vec<Vec2>,
    /// These arc lengths.
    pub weights: Vec<f64>,
    /// Area (length squared) by the same quadrature.
    pub area: f64,
    /// Largest distance of a node from the centre (length).
    pub radius: f64,
    /// Largest distance of neighbouring nodes (length).
    longest: f64,
    pub(super) sources: Sources,
}

impl NodeCurve {
    /// Takes over the positions of the nodes, counter-clockwise (length), the number of the first one, and the
    /// viscosities inside and outside (stress times time).
    ///
    /// # Errors
    /// Fewer than 8 nodes or more than 10,000, a clockwise curve.
    pub fn load(
        &mut self,
        matrix: &DoubleLayerMatrix,
        first: usize,
        [inside, outside]: [f64; 2],
        positions: &[Vec2],
    ) -> Result<(), LayerError> {
        let n = positions.len();
        within("the number of nodes of a curve", n as f64, LEAST_NODES, MOST_NODES as f64)?;
        (self.first, self.outside, self.contrast) = (first, outside, inside - outside);
        self.centre = positions.iter().sum::<Vec2>() / n as f64;
        self.positions.clear();
        self.positions.extend(positions.iter().map(|x| x - self.centre));
        self.radius = self.positions.iter().map(|v| v.length()).fold(0.0, f64::max);
        self.longest = (0..n).map(|k| (self.positions[(k + 1) % n] - self.positions[k]).length()).fold(0.0, f64::max);
        self.normals.clear();
        self.weights.clear();
        self.area = 0.0;
        for k in 0..n {
            let at = |shift: usize| self.positions[(k + shift) % n];
            // Fourth order: that of the curve's parameter, in which the trapezoidal rule is spectral.
            let d = (8.0 * (at(1) - at(n - 1)) - (at(2) - at(n - 2))) / 12.0;
            let normal = Vec2::new(d.y, -d.x);
            self.area += 0.5 * self.positions[k].dot(normal);
            self.normals.push(normal);
            self.weights.push(d.length());
        }
        if self.area <= 0.0 {
            return Err(LayerError::Clockwise { curve: self.first });
        }
        let Self { positions, sources, .. } = self;
        matrix.kernel.load(positions, sources);
        Ok(())
    }

    /// Number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether it has no nodes yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Its length (length).
    #[must_use]
    pub fn perimeter(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// Its entries in vectors over all nodes, x components first.
    pub fn entries(&self, all: usize) -> impl Iterator<Item = usize> + use<> {
        let (first, count) = (self.first, self.len());
        (first..first + count).chain(all + first..all + first + count)
    }

    /// Whether a point relative to the centre lies inside, by the number of times the polygon goes around it.
    #[must_use]
    pub fn contains(&self, point: Vec2) -> bool {
        let n = self.len();
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
    #[must_use]
    pub fn foot(&self, point: Vec2, reach: f64) -> Option<Foot> {
        let n = self.len();
        let mut best = None;
        let mut least = reach;
        let mut node = 0;
        while node < n {
            let (a, b) = (self.positions[node], self.positions[(node + 1) % n]);
            let along = b - a;
            let square = along.length_squared();
            let fraction = if square > 0.0 { ((point - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
            let distance = (point - a - fraction * along).length();
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
pub struct Foot {
    /// First node of its segment.
    pub node: usize,
    /// How far along the segment, 0 to 1.
    pub fraction: f64,
    /// Distance to it (length).
    pub distance: f64,
}
