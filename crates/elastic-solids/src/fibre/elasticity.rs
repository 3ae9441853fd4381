//! The discrete energy of a fibre and its exact gradient.

use motile_base::Vec2;

/// Elasticity of a chain of nodes: springs along its segments, and hinges at its nodes.
///
/// ```text
/// energy = sum over segments S/2 (l/L - 1)^2 L  +  sum over hinges B/2 (theta/M - kappa)^2 M
/// ```
///
/// with the length l of a segment, L at rest, and the angle theta by which the chain turns at a node. M is half of the
/// length at rest of the segments that meet there. At a clamped end, theta is the angle from the clamp to the segment,
/// and M half of the segment's length.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Elasticity {
    /// Lengths at rest of the segments (length); the last one of a closed chain leads to the first node.
    pub(super) lengths: Vec<f64>,
    /// Modulus of stretching of each segment (force).
    pub(super) stretching: Vec<f64>,
    /// Modulus of bending at each node (force times length squared).
    pub(super) bending: Vec<f64>,
    /// Curvature at rest at each node (1/length).
    pub(super) curvatures: Vec<f64>,
    /// Directions (unit vectors) of the clamps at the first and the last node, along the fibre.
    pub(super) clamps: [Option<Vec2>; 2],
    /// Vector from the first node to its image after the last node (length): zero for a closed chain, `None` for an
    /// open one.
    pub(super) advance: Option<Vec2>,
}

/// A hinge: its node, the segments before and after it, and the length M.
struct Hinge {
    node: usize,
    segments: [usize; 2],
    length: f64,
}

/// Returns the vector of a segment over the square of its length (1/length), turned by a right angle: the gradient of
/// its angle.
fn angle_gradient(segment: Vec2) -> Vec2 {
    segment.perp() / segment.length_squared()
}

/// Returns the angle from one vector to another (radians), from -pi to pi.
fn angle_between(from: Vec2, to: Vec2) -> f64 {
    from.perp_dot(to).atan2(from.dot(to))
}

impl Elasticity {
    /// Returns the numbers of the nodes of a segment.
    fn ends(&self, segment: usize) -> [usize; 2] {
        [segment, if segment + 1 < self.bending.len() { segment + 1 } else { 0 }]
    }

    /// Returns the vector along a segment (length).
    pub(super) fn segment(&self, nodes: &[Vec2], segment: usize) -> Vec2 {
        let [from, to] = self.ends(segment);
        let shift = if to == 0 { self.advance.unwrap_or(Vec2::ZERO) } else { Vec2::ZERO };
        nodes[to] + shift - nodes[from]
    }

    fn hinges(&self) -> impl Iterator<Item = Hinge> + '_ {
        let (count, segments) = (self.bending.len(), self.lengths.len());
        let closed = self.advance.is_some();
        (usize::from(!closed)..count - usize::from(!closed)).map(move |node| {
            let before = if node == 0 { segments - 1 } else { node - 1 };
            Hinge { node, segments: [before, node], length: 0.5 * (self.lengths[before] + self.lengths[node]) }
        })
    }

    /// Returns the clamped ends: number of the end, its node, its segment, the direction of the clamp, and half the
    /// length of the segment at rest (length), over which the clamp bends the fibre.
    fn clamped(&self) -> impl Iterator<Item = (usize, usize, usize, Vec2, f64)> + '_ {
        let last = self.lengths.len() - 1;
        let places = [(0, 0), (self.bending.len() - 1, last)];
        self.clamps.iter().zip(places).enumerate().filter_map(move |(end, (clamp, (node, segment)))| {
            Some((end, node, segment, (*clamp)?, 0.5 * self.lengths[segment]))
        })
    }

    /// Returns the angle at a clamped end (radians).
    fn clamped_angle(end: usize, clamp: Vec2, segment: Vec2) -> f64 {
        if end == 0 { angle_between(clamp, segment) } else { angle_between(segment, clamp) }
    }

    /// Returns the length l/L of each segment over its length at rest (no dimension).
    pub(super) fn stretches<'a>(&'a self, nodes: &'a [Vec2]) -> impl Iterator<Item = f64> + 'a {
        self.lengths.iter().enumerate().map(|(k, length)| self.segment(nodes, k).length() / length)
    }

    /// Returns the nodes with hinges, except for clamps, and the turning angles there (radians).
    pub(super) fn angles<'a>(&'a self, nodes: &'a [Vec2]) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.hinges().map(|Hinge { node, segments, .. }| {
            let [before, after] = segments.map(|segment| self.segment(nodes, segment));
            (node, angle_between(before, after))
        })
    }

    /// Returns the numbers of the nodes with hinges, clamps not among them, and the curvatures theta/M there
    /// (1/length).
    pub(super) fn measured_curvatures<'a>(&'a self, nodes: &'a [Vec2]) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.hinges().zip(self.angles(nodes)).map(|(hinge, (node, angle))| (node, angle / hinge.length))
    }

    /// Returns the energies of stretching and of bending (force times length) with `extra` curvature at rest at a node.
    pub(super) fn energies(&self, nodes: &[Vec2], extra: impl Fn(usize) -> f64) -> [f64; 2] {
        let springs = self.stretches(nodes).zip(self.lengths.iter().zip(&self.stretching));
        let stretching = springs.map(|(stretch, (length, modulus))| 0.5 * modulus * (stretch - 1.0).powi(2) * length);
        let hinge = |node: usize, angle: f64, length: f64| {
            0.5 * self.bending[node] * (angle / length - self.curvatures[node] - extra(node)).powi(2) * length
        };
        let bending = self.hinges().zip(self.angles(nodes)).map(|(at, (node, angle))| hinge(node, angle, at.length));
        let clamped = self.clamped().map(|(end, node, segment, clamp, length)| {
            hinge(node, Self::clamped_angle(end, clamp, self.segment(nodes, segment)), length)
        });
        [stretching.sum(), bending.chain(clamped).sum()]
    }

    /// Adds the forces at the nodes (force), minus the gradient of the energy with `extra` curvature at rest at a node.
    pub(super) fn add_forces(&self, nodes: &[Vec2], extra: impl Fn(usize) -> f64, forces: &mut [Vec2]) {
        for (k, (length, modulus)) in self.lengths.iter().zip(&self.stretching).enumerate() {
            let [from, to] = self.ends(k);
            let segment = self.segment(nodes, k);
            let now = segment.length();
            let pull = modulus * (now / length - 1.0) / now * segment;
            forces[from] += pull;
            forces[to] -= pull;
        }
        for Hinge { node, segments, length } in self.hinges() {
            let modulus = self.bending[node];
            if modulus == 0.0 {
                continue;
            }
            let [before, after] = segments.map(|segment| self.segment(nodes, segment));
            let moment = modulus * (angle_between(before, after) / length - self.curvatures[node] - extra(node));
            let [low, high] = [before, after].map(|segment| moment * angle_gradient(segment));
            forces[self.ends(segments[0])[0]] -= low;
            forces[self.ends(segments[1])[1]] -= high;
            forces[node] += low + high;
        }
        for (end, node, index, clamp, length) in self.clamped() {
            let segment = self.segment(nodes, index);
            let angle = Self::clamped_angle(end, clamp, segment);
            let moment = self.bending[node] * (angle / length - self.curvatures[node] - extra(node));
            let turn = if end == 0 { moment } else { -moment } * angle_gradient(segment);
            let [from, to] = self.ends(index);
            forces[to] -= turn;
            forces[from] += turn;
        }
    }

    /// Returns the torque with which the fibre turns the clamp of an end (force times length), counter-clockwise; zero
    /// without a clamp.
    pub(super) fn clamp_torque(&self, nodes: &[Vec2], which: usize, extra: impl Fn(usize) -> f64) -> f64 {
        let of_end = self.clamped().filter(|(end, ..)| *end == which);
        let torques = of_end.map(|(end, node, segment, clamp, length)| {
            let angle = Self::clamped_angle(end, clamp, self.segment(nodes, segment));
            let moment = self.bending[node] * (angle / length - self.curvatures[node] - extra(node));
            if end == 0 { moment } else { -moment }
        });
        torques.fold(0.0, |sum, torque| sum + torque)
    }
}
