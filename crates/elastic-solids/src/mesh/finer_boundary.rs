//! Meshes with a boundary that is finer than the inside.

use std::collections::HashMap;

use motile_base::Vec2;

use crate::SolidError;
use crate::mesh::TriangleMesh;

/// Cosine of the angle between neighbouring sides below which the boundary has a corner there: 37 degrees, where a
/// circle of ten points has 36.
const CORNER: f64 = 0.8;

impl TriangleMesh {
    /// Returns the mesh with another point in the middle of each side of the boundary both of whose ends satisfy a
    /// condition on their place (length); the triangle there is divided. Serves surfaces that are to be resolved more
    /// finely than the solid below them.
    ///
    /// New points lie on the cubic through the four points about them, next to corners on the side itself.
    ///
    /// # Errors
    /// Returns an error for a mesh that is so coarse that triangles fold.
    pub fn with_finer_boundary(&self, condition: impl Fn(Vec2) -> bool) -> Result<Self, SolidError> {
        let mut points = self.points.clone();
        let mut middles = HashMap::new();
        for outline in &self.loops {
            let count = outline.points.len();
            let at = |k: usize| outline.points[k % count];
            let side = |k: usize| {
                let mut side = self.points[at(k + 1)] - self.points[at(k)];
                side.x -= self.period.map_or(0.0, |period| period * (side.x / period).round());
                side
            };
            for k in 0..count {
                let [first, second] = [at(k), at(k + 1)];
                if !(condition(self.points[first]) && condition(self.points[second])) {
                    continue;
                }
                let [before, own, after] = [side(k + count - 1), side(k), side(k + 1)];
                let turns = |a: Vec2, b: Vec2| a.dot(b) < CORNER * a.length() * b.length();
                let corner = turns(before, own) || turns(own, after);
                let middle = if corner { 0.5 * own } else { middle(before, own, after) };
                middles.insert([first, second], points.len());
                // From the same end in either direction, also across the seam of a period.
                points.push(if first < second {
                    self.points[first] + middle
                } else {
                    self.points[second] + middle - own
                });
            }
        }
        let mut triangles = Vec::with_capacity(self.triangles.len() + middles.len());
        for &[a, b, c] in &self.triangles {
            let sides = [[a, b], [b, c], [c, a]].map(|side| middles.get(&side).copied());
            // All corners and new points in order; a fan about a new point covers them.
            let ring: Vec<usize> = [a, b, c]
                .into_iter()
                .zip(sides)
                .flat_map(|(corner, middle)| [Some(corner), middle])
                .flatten()
                .collect();
            let start = ring.iter().position(|point| *point >= self.points.len()).unwrap_or(0);
            let fan = |k: usize| ring[(start + k) % ring.len()];
            triangles.extend((1..ring.len() - 1).map(|k| [fan(0), fan(k), fan(k + 1)]));
        }
        Self::build(points, triangles, self.period)
    }
}

/// Returns the vector from the start of a side of a smooth line to its middle, on the cubic through its ends and the
/// ends of the sides before and after it, with the lengths of the sides as parameter.
fn middle(before: Vec2, own: Vec2, after: Vec2) -> Vec2 {
    let [a, b, c] = [before, own, after].map(Vec2::length);
    let knots = [(-a, -before), (0.0, Vec2::ZERO), (b, own), (b + c, own + after)];
    let at = 0.5 * b;
    let weight = |knot: f64| -> f64 {
        let others = knots.iter().filter(|(other, _)| *other != knot);
        others.map(|(other, _)| (at - other) / (knot - other)).product()
    };
    knots.iter().map(|(knot, place)| weight(*knot) * place).sum()
}
