//! The boundary of a body as segments.

use crate::Vec2;

/// The boundary of a body: segments in any order, each with the inside of the body to its left.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Boundary {
    segments: Vec<[Vec2; 2]>,
    /// Centre and radius of each run of segments.
    circles: Vec<(Vec2, f64)>,
    low: Vec2,
    high: Vec2,
}

/// Segments that are looked at together.
const RUN: usize = 16;

/// The difference that is shortest over the periods.
fn nearest(mut difference: Vec2, periods: [Option<f64>; 2]) -> Vec2 {
    for (component, period) in difference.iter_mut().zip(periods) {
        if let Some(period) = period
            && component.abs() > 0.5 * period
        {
            *component -= period * (*component / period).round();
        }
    }
    difference
}

impl Boundary {
    /// Adds a segment from `start` to `end` (length), inside to its left.
    pub fn push(&mut self, start: Vec2, end: Vec2) {
        self.segments.push([start, end]);
    }

    /// Adds the closed polygon through `points`, counter-clockwise around the inside.
    pub fn push_loop(&mut self, points: &[Vec2]) {
        let next = points.iter().cycle().skip(1);
        self.segments.extend(points.iter().zip(next).map(|(&start, &end)| [start, end]));
    }

    pub(super) fn clear(&mut self) {
        self.segments.clear();
    }

    /// Prepares for questions.
    pub(super) fn finish(&mut self) {
        self.circles.clear();
        self.circles.extend(self.segments.chunks(RUN).map(|run| {
            let centre = run[run.len() / 2][0];
            let radius = run.iter().flatten().map(|point| (point - centre).norm()).fold(0.0, f64::max);
            (centre, radius)
        }));
        let far = Vec2::repeat(f64::INFINITY);
        (self.low, self.high) =
            self.segments.iter().flatten().fold((far, -far), |(low, high), point| (low.inf(point), high.sup(point)));
    }

    /// Whether the box around this boundary, displaced, comes within `reach` of that around another.
    pub(super) fn is_near(&self, other: &Self, shift: Vec2, periods: [Option<f64>; 2], reach: f64) -> bool {
        let middle = nearest(0.5 * (self.low + self.high) + shift - 0.5 * (other.low + other.high), periods);
        let room = 0.5 * (self.high - self.low + other.high - other.low);
        // Where a box is as wide as the period, some image is always near.
        (0..2).all(|k| middle[k].abs() <= room[k] + reach || periods[k].is_some_and(|period| 2.0 * room[k] >= period))
    }

    /// The distance of `point` to the boundary (length), negative inside, if it is below `reach`.
    pub(super) fn distance(&self, point: Vec2, periods: [Option<f64>; 2], reach: f64) -> Option<f64> {
        let mut best = (reach * reach, 0.0_f64);
        let mut found = false;
        for (&(centre, radius), run) in self.circles.iter().zip(self.segments.chunks(RUN)) {
            if nearest(point - centre, periods).norm_squared() > (radius + reach) * (radius + reach) {
                continue;
            }
            for [start, end] in run {
                let (along, from) = (end - start, nearest(point - start, periods));
                let part = (from.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                let square = (from - part * along).norm_squared();
                let height = from.perp(&along) / along.norm();
                // At a corner both sides are equally far; the one that the point stands more upright on says whether it
                // is inside.
                let tie = (square - best.0).abs() <= 1e-12 * (square + best.0);
                if (tie && height.abs() > best.1.abs()) || (!tie && square < best.0) {
                    best = (square, height);
                    found = true;
                }
            }
        }
        found.then(|| best.0.sqrt().copysign(best.1))
    }
}

#[cfg(test)]
mod tests;
