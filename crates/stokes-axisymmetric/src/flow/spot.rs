//! The position of a place relative to a surface: its nearest point, and whether the place is inside.

use std::f64::consts::PI;

use motile_base::Vec2;

use super::{
    fixed_panels::LONGEST,
    meridian::{Grid, Meridian},
    panels::{Panels, Spot},
    waves::Point,
};

impl Meridian {
    /// Returns the spot of a place in the meridian plane (length): its nearest point of the surface and the way there.
    pub(super) fn spot(&self, grid: &Grid, place: Vec2, panels: &mut Panels) -> Spot {
        let mut nearest = (0, f64::INFINITY);
        for (j, node) in self.nodes.iter().enumerate() {
            let square = (node.place - place).length_squared();
            if square < nearest.1 {
                nearest = (j, square);
            }
        }
        let nearest = nearest.0;
        let mut foot = grid.parameters[nearest];
        let mut best = self.nodes[nearest].place - place;
        if best.length() < LONGEST * self.spacing {
            let step = PI / grid.nodes as f64;
            let range = [(foot - step).max(0.0), (foot + step).min(PI)];
            let distance = |t: f64, panels: &mut Panels| {
                panels.waves.fill(t);
                let Point { place: at, tangent } = self.at(&panels.waves);
                (at - place, tangent)
            };
            // Newton's method for the foot of the perpendicular, kept within two intervals; ends where it stalls.
            for _ in 0..40 {
                let (d, tangent) = distance(foot, panels);
                let next = (foot - d.dot(tangent) / tangent.length_squared()).clamp(range[0], range[1]);
                let moved = (next - foot).abs();
                foot = next;
                if moved < 1e-15 {
                    break;
                }
            }
            let (d, _) = distance(foot, panels);
            if d.length() <= best.length() {
                best = d;
            } else {
                foot = grid.parameters[nearest];
            }
        }
        Spot { place, foot, offset: best, gap: best.length() }
    }

    /// Returns true for a place in the meridian plane inside the closed curve through the nodes.
    pub(super) fn holds(&self, place: Vec2) -> bool {
        let mut inside = false;
        let mut before = Vec2::new(self.nodes[0].place.x, -self.nodes[0].place.y);
        let last = self.nodes[self.nodes.len() - 1].place;
        let image = Vec2::new(last.x, -last.y);
        for point in self.nodes.iter().map(|node| node.place).chain([image]) {
            // A ray up from the place crosses the upper half alone.
            if (before.x > place.x) != (point.x > place.x) {
                let height = before.y + (point.y - before.y) * (place.x - before.x) / (point.x - before.x);
                inside ^= height > place.y;
            }
            before = point;
        }
        inside
    }

    /// Returns true for a spot inside the surface, to the accuracy of the series close to the curve.
    pub(super) fn holds_spot(&self, spot: &Spot, panels: &mut Panels) -> bool {
        if spot.gap > self.spacing || spot.gap == 0.0 {
            return self.holds(spot.place);
        }
        panels.waves.fill(spot.foot);
        self.at(&panels.waves).normal().dot(spot.offset) > 0.0
    }
}
