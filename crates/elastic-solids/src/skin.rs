//! Elastic skins on the surfaces of solids.

use ib_core::Vec2;
use ib_core::input::not_negative;

use crate::{SolidError, TriangleMesh};

/// A skin on the whole boundary of a mesh, without stress in the reference state, that resists stretching and bending.
///
/// With the length l and the turning angle theta of the sides of the boundary, L and theta_0 in the reference state,
/// and S the mean length of two sides
///
/// ```text
/// energy = sum over sides E_s/2 (l/L - 1)^2 L  +  sum over points B/2 (theta - theta_0)^2/S
/// ```
///
/// A soft solid that is compressed along its surface beyond a stretch of about 0.65 creases; a skin sets the length, of
/// the order of the cube root of B over the solid's shear modulus, below which it does not fold.
#[derive(Debug, Clone)]
pub(crate) struct Skin {
    stretching: f64,
    bending: f64,
    sides: Vec<Side>,
    /// Pairs of sides that follow each other, and the reference angle between them.
    hinges: Vec<([usize; 2], f64)>,
}

/// A side of the boundary between two points.
#[derive(Debug, Clone, Copy)]
struct Side {
    ends: [usize; 2],
    /// What to add to x of the second end across the seam of a periodic mesh (length).
    shift: f64,
    /// Reference length.
    length: f64,
}

impl Side {
    fn span(&self, positions: &[Vec2]) -> Vec2 {
        let [from, to] = self.ends.map(|point| positions[point]);
        Vec2::new(to.x + self.shift - from.x, to.y - from.y)
    }
}

/// The angle from one side to the next (radians).
fn turning(first: Vec2, second: Vec2) -> f64 {
    first.perp_dot(second).atan2(first.dot(second))
}

/// Change of the direction of a side with its vector.
fn turned(side: Vec2) -> Vec2 {
    side.perp() / side.length_squared().max(f64::MIN_POSITIVE)
}

impl Skin {
    /// A skin with its moduli of stretching E_s (force) and bending B (force times length squared).
    ///
    /// # Errors
    /// Moduli that are negative or not finite.
    pub(crate) fn new(mesh: &TriangleMesh, stretching: f64, bending: f64) -> Result<Self, SolidError> {
        let stretching = not_negative("the stretching modulus of the skin", stretching)?;
        let bending = not_negative("the bending modulus of the skin", bending)?;
        let (mut sides, mut hinges) = (Vec::new(), Vec::new());
        for outline in mesh.boundary_loops() {
            let (first, count) = (sides.len(), outline.points.len());
            let next = outline.points.iter().cycle().skip(1);
            for (&from, &to) in outline.points.iter().zip(next) {
                let span = mesh.points()[to] - mesh.points()[from];
                let shift = mesh.period().map_or(0.0, |period| -period * (span.x / period).round());
                let mut side = Side { ends: [from, to], shift, length: 0.0 };
                side.length = side.span(mesh.points()).length();
                sides.push(side);
            }
            hinges.extend((0..count).map(|k| {
                let pair = [first + k, first + (k + 1) % count];
                let [a, b] = pair.map(|side: usize| sides[side].span(mesh.points()));
                (pair, turning(a, b))
            }));
        }
        Ok(Self { stretching, bending, sides, hinges })
    }

    /// Adds its forces (force) on the points of the mesh.
    pub(crate) fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) {
        for side in &self.sides {
            let span = side.span(positions);
            let pull = span.normalize_or_zero() * (self.stretching * (span.length() / side.length - 1.0));
            forces[side.ends[0]] += pull;
            forces[side.ends[1]] -= pull;
        }
        for (pair, rest) in &self.hinges {
            let [first, second] = pair.map(|side| self.sides[side]);
            let [a, b] = [first, second].map(|side| side.span(positions));
            let moment = self.bending * (turning(a, b) - rest) / (0.5 * (first.length + second.length));
            let [a, b] = [a, b].map(|side| moment * turned(side));
            forces[first.ends[0]] -= a;
            forces[first.ends[1]] += a;
            forces[second.ends[0]] += b;
            forces[second.ends[1]] -= b;
        }
    }

    /// Viscosity times the fastest rate at which it relaxes in fluid (force per length): that of waves of two sides,
    /// `(E_s/s + 4 B/s^3)/pi` with the mobility `1/(4 eta q)` at the wave number `q = pi/s`, s the shortest side.
    pub(crate) fn stiffness(&self) -> f64 {
        let shortest = self.sides.iter().map(|side| side.length).fold(f64::INFINITY, f64::min);
        (self.stretching / shortest + 4.0 * self.bending / shortest.powi(3)) / std::f64::consts::PI
    }

    /// Its energy.
    pub(crate) fn energy(&self, positions: &[Vec2]) -> f64 {
        let sides = self.sides.iter().map(|side| {
            let strain = side.span(positions).length() / side.length - 1.0;
            0.5 * self.stretching * strain * strain * side.length
        });
        let hinges = self.hinges.iter().map(|(pair, rest)| {
            let [first, second] = pair.map(|side| self.sides[side]);
            let angle = turning(first.span(positions), second.span(positions)) - rest;
            self.bending * angle * angle / (first.length + second.length)
        });
        sides.sum::<f64>() + hinges.sum::<f64>()
    }
}

#[cfg(test)]
mod tests;
