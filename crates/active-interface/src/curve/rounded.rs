//! Polygons whose corners are arcs.

use motile_base::Vec2;

use super::polygon::{raw_area, raw_perimeter};
use crate::InterfaceError;

/// Turn of a corner below which it is straight (radians): round-off.
const STRAIGHT: f64 = 1e-12;
/// Fraction of a side by which arcs may be too long for it: round-off.
const ROUND_OFF: f64 = 1e-12;

/// A polygon whose corners are arcs of one radius: straight sides and arcs that join them without a kink.
#[derive(Debug, Clone)]
pub(super) struct Rounded {
    arcs: Vec<ArcOfCorner>,
    /// Length along the curve at the end of each arc and of each side, in turn.
    ends: Vec<f64>,
    /// Signed area (length squared).
    pub(super) area: f64,
    /// Length of the curve.
    pub(super) perimeter: f64,
}

/// The arc in the place of a corner; of no length where the polygon goes straight on.
#[derive(Debug, Clone, Copy)]
struct ArcOfCorner {
    start: Vec2,
    end: Vec2,
    centre: Vec2,
    /// Angle by which the curve turns (radians), positive to the left.
    turn: f64,
}

impl Rounded {
    /// Creates the curve of a polygon without crossings and a positive radius (length).
    ///
    /// Each arc takes `r tan(turn/2)` of both sides of its corner away, and the area
    /// `r^2 (tan(turn/2) - turn/2)`.
    pub(super) fn new(points: &[Vec2], radius: f64) -> Result<Self, InterfaceError> {
        let count = points.len();
        let side = |k: usize| points[(k + 1) % count] - points[k % count];
        let turns: Vec<f64> = (0..count).map(|k| side(k + count - 1).angle_to(side(k))).collect();
        let cut = |k: usize| radius * (0.5 * turns[k % count].abs()).tan();
        for k in 0..count {
            let (needed, length) = (cut(k) + cut(k + 1), side(k).length());
            if needed.is_nan() || needed > length * (1.0 + ROUND_OFF) {
                let sum = (0.5 * turns[k].abs()).tan() + (0.5 * turns[(k + 1) % count].abs()).tan();
                return Err(InterfaceError::rounding_too_large(radius, points[k], length, length / sum));
            }
        }
        let (mut area, mut perimeter) = (raw_area(points), raw_perimeter(points));
        let mut arcs = Vec::with_capacity(count);
        for (k, (&corner, &turn)) in points.iter().zip(&turns).enumerate() {
            let (before, after) = (side(k + count - 1).normalize(), side(k).normalize());
            let [start, end] = [corner - before * cut(k), corner + after * cut(k)];
            let centre = start + before.perp() * (radius * turn.signum());
            let half = 0.5 * turn.abs();
            if turn.abs() > STRAIGHT {
                area -= turn.signum() * radius * radius * (half.tan() - half);
                perimeter -= 2.0 * radius * (half.tan() - half);
            }
            arcs.push(ArcOfCorner { start, end, centre, turn: if turn.abs() > STRAIGHT { turn } else { 0.0 } });
        }
        let mut ends = Vec::with_capacity(2 * count);
        let mut length = 0.0;
        for (k, arc) in arcs.iter().enumerate() {
            length += radius * arc.turn.abs();
            ends.push(length);
            length += arc.end.distance(arcs[(k + 1) % count].start);
            ends.push(length);
        }
        Ok(Self { arcs, ends, area, perimeter })
    }

    /// Returns the point at the fraction `t` in [0, 1] of the length.
    pub(super) fn point(&self, t: f64) -> Vec2 {
        let last = self.ends.len() - 1;
        let u = t * self.ends[last];
        let k = self.ends[..last].partition_point(|&end| end <= u);
        let start = if k == 0 { 0.0 } else { self.ends[k - 1] };
        let length = self.ends[k] - start;
        let x = if length > 0.0 { ((u - start) / length).clamp(0.0, 1.0) } else { 0.0 };
        let arc = &self.arcs[k / 2];
        if k.is_multiple_of(2) {
            arc.centre + Vec2::from_angle(arc.turn * x).rotate(arc.start - arc.centre)
        } else {
            arc.end.lerp(self.arcs[(k / 2 + 1) % self.arcs.len()].start, x)
        }
    }
}

#[cfg(test)]
mod tests;
