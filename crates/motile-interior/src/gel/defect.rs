//! Topological defects of the director.

use std::f64::consts::{PI, TAU};

use motile_base::Vec2;

use super::elements::Elements;

/// Topological defect: a point around which the director makes whole turns.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct Defect {
    /// Position (length), where the director, linear between nodes, vanishes.
    pub position: [f64; 2],
    /// Charge: number of turns of the director along a counter-clockwise circle around the defect, 1 for asters and
    /// vortices.
    pub charge: i32,
}

/// Returns the defects, one in each triangle around which the director turns.
pub(super) fn defects(elements: &Elements, nodes: &[Vec2], angles: &[f64], directors: &[Vec2]) -> Vec<Defect> {
    let mut found = Vec::new();
    for (number, triangle) in elements.triangles.iter().enumerate() {
        let at = triangle.map(|node| angles[node]);
        let turn: f64 = [at[1] - at[0], at[2] - at[1], at[0] - at[2]].into_iter().map(wrapped).sum();
        let charge = (turn / TAU).round() as i32;
        if charge != 0 {
            let [a, b, c] = triangle.map(|node| directors[node]);
            let parts = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
            let whole: f64 = parts.iter().sum();
            let place = elements.place(number, nodes, parts.map(|part| part / whole));
            found.push(Defect { position: place.into(), charge });
        }
    }
    found
}

/// Returns the angle between -pi and pi, without whole turns.
fn wrapped(angle: f64) -> f64 {
    let turn = angle.rem_euclid(TAU);
    if turn > PI { turn - TAU } else { turn }
}
