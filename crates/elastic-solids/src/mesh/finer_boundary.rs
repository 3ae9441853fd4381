//! More points on the boundary than inside.

use std::collections::HashMap;

use ib_core::Vec2;

use crate::{SolidError, TriangleMesh};

/// Cosine of the angle between neighbouring sides from which on the boundary has a corner there.
const CORNER: f64 = 0.8;

impl TriangleMesh {
    /// The mesh with a point more in the middle of each side of the boundary both of whose ends satisfy a condition on
    /// their place (length); the triangle there is divided. For surfaces that are to be resolved more finely than what
    /// lies below them.
    ///
    /// New points lie on the cubic through the four points about them, on the side itself next to corners.
    ///
    /// # Errors
    /// A mesh that is so coarse that triangles fold.
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
                let bend = if turns(before, own) || turns(own, after) { Vec2::ZERO } else { (before - after) / 16.0 };
                middles.insert([first, second], points.len());
                points.push(self.points[first] + 0.5 * own + bend);
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
