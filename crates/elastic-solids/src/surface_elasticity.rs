//! Surface elasticity of solids.

use motile_base::{Vec2, not_negative};

use crate::{SolidError, forces::Bar, mesh::TriangleMesh};

/// Surface elasticity on the whole boundary of a mesh, without stress in the reference state, that resists stretching
/// and bending.
///
/// With l the length of a side of the boundary and theta the angle between two that follow each other, L and theta_0
/// the same in the reference state, and S the mean of the reference lengths of the two sides,
///
/// ```text
/// energy = sum over sides E_s/2 (l/L - 1)^2 L  +  sum over points B/2 (theta - theta_0)^2/S
/// ```
///
/// A soft solid that is compressed along its surface beyond a stretch of about 0.65 creases. Surface elasticity sets
/// the length, of the order of the cube root of B over the solid's shear modulus, below which it does not fold.
#[derive(Debug, Clone)]
pub(crate) struct SurfaceElasticity {
    stretching: f64,
    bending: f64,
    /// Sides of the boundary.
    sides: Vec<Bar>,
    /// Pairs of sides that follow each other, by index, and the reference angle between them (radians).
    hinges: Vec<([usize; 2], f64)>,
}

/// Returns the gradient of the direction angle of a side by its vector (1/length).
fn turned(side: Vec2) -> Vec2 {
    side.perp() / side.length_squared().max(f64::MIN_POSITIVE)
}

impl SurfaceElasticity {
    /// Creates a surface elasticity with its moduli of stretching E_s (force) and bending B (force times length
    /// squared).
    ///
    /// # Errors
    /// Returns an error for moduli that are negative or not finite.
    pub(crate) fn new(mesh: &TriangleMesh, stretching: f64, bending: f64) -> Result<Self, SolidError> {
        let stretching = not_negative("the stretching modulus of the surface", stretching)?;
        let bending = not_negative("the bending modulus of the surface", bending)?;
        let (mut sides, mut hinges) = (Vec::new(), Vec::new());
        for outline in mesh.boundary_loops() {
            let (first, count) = (sides.len(), outline.points.len());
            let next = outline.points.iter().cycle().skip(1);
            for (&from, &to) in outline.points.iter().zip(next) {
                let span = mesh.points()[to] - mesh.points()[from];
                let shift = mesh.period().map_or(0.0, |period| -period * (span.x / period).round());
                let side = Bar { ends: [from, to].map(|point| point as u32), shift, length: 0.0 };
                sides.push(Bar { length: side.span(mesh.points()).length(), ..side });
            }
            hinges.extend((0..count).map(|k| {
                let pair = [first + k, first + (k + 1) % count];
                let [a, b] = pair.map(|side: usize| sides[side].span(mesh.points()));
                (pair, a.angle_to(b))
            }));
        }
        Ok(Self { stretching, bending, sides, hinges })
    }

    /// Returns the moduli of stretching (force) and bending (force times length squared).
    pub(crate) fn moduli(&self) -> [f64; 2] {
        [self.stretching, self.bending]
    }

    /// Adds the forces of the surface (force) on the points of the mesh.
    pub(crate) fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) {
        for side in &self.sides {
            let span = side.span(positions);
            let pull =
                span.try_normalize().unwrap_or_default() * (self.stretching * (span.length() / side.length - 1.0));
            side.add_pull(pull, forces);
        }
        for (pair, rest) in &self.hinges {
            let [first, second] = pair.map(|side| self.sides[side]);
            let [a, b] = [first, second].map(|side| side.span(positions));
            let moment = self.bending * (a.angle_to(b) - rest) / (0.5 * (first.length + second.length));
            let [a, b] = [a, b].map(|side| moment * turned(side));
            first.add_pull(-a, forces);
            second.add_pull(b, forces);
        }
    }

    /// Returns the viscosity times the fastest rate at which the surface relaxes in fluid (force per length). It is the
    /// rate of waves of two sides, `(E_s/s + 4 B/s^3)/pi` with the mobility `1/(4 eta q)` at the wave number `q =
    /// pi/s`, s the shortest side.
    pub(crate) fn stiffness(&self) -> f64 {
        let shortest = self.sides.iter().map(|side| side.length).fold(f64::INFINITY, f64::min);
        (self.stretching / shortest + 4.0 * self.bending / shortest.powi(3)) / std::f64::consts::PI
    }

    /// Returns the elastic energy of the surface (energy).
    pub(crate) fn energy(&self, positions: &[Vec2]) -> f64 {
        let sides = self.sides.iter().map(|side| {
            let strain = side.span(positions).length() / side.length - 1.0;
            0.5 * self.stretching * strain * strain * side.length
        });
        let hinges = self.hinges.iter().map(|(pair, rest)| {
            let [first, second] = pair.map(|side| self.sides[side]);
            let angle = first.span(positions).angle_to(second.span(positions)) - rest;
            self.bending * angle * angle / (first.length + second.length)
        });
        sides.sum::<f64>() + hinges.sum::<f64>()
    }
}

#[cfg(test)]
mod tests;
