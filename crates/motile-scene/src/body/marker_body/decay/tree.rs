//! Sums over all pairs of many markers, those far from a marker taken together.

use std::ops::Range;

use motile_base::Vec2;

/// Most markers of a part that is not divided further.
const LEAF: usize = 8;
/// Distance over the radius of a part from which on it is taken together. What is left out falls with the square of
/// its inverse.
const FAR: f64 = 4.0;

/// A part of the markers and its two halves.
#[derive(Debug)]
struct Part {
    /// Places of its markers in the order of the tree.
    markers: Range<usize>,
    centre: Vec2,
    /// Largest distance of a marker from the centre (length).
    radius: f64,
    /// Number of the part behind this one and all that it is divided into.
    next: usize,
}

/// Total force of a part, and the sums of its forces times the distances from the centre along x and y.
#[derive(Debug, Clone, Copy, Default)]
struct Moments {
    force: Vec2,
    slopes: [Vec2; 2],
}

/// Markers divided into ever smaller parts.
#[derive(Debug)]
pub(super) struct Tree<'a> {
    positions: &'a [Vec2],
    order: Vec<usize>,
    /// Each part before its halves.
    parts: Vec<Part>,
}

impl<'a> Tree<'a> {
    pub(super) fn new(positions: &'a [Vec2]) -> Self {
        let mut tree = Self { positions, order: (0..positions.len()).collect(), parts: Vec::new() };
        tree.divide(0..positions.len());
        tree
    }

    /// Adds a part and all that it is divided into.
    fn divide(&mut self, markers: Range<usize>) {
        let Self { positions, order, parts } = self;
        let places = || order[markers.clone()].iter().map(|marker| positions[*marker]);
        let centre = places().sum::<Vec2>() / markers.len().max(1) as f64;
        let spread = places().fold(Vec2::ZERO, |spread, place| {
            let away = place - centre;
            Vec2::new(spread.x.max(away.x.abs()), spread.y.max(away.y.abs()))
        });
        let radius = places().map(|place| place.distance(centre)).fold(0.0, f64::max);
        let (part, half) = (parts.len(), markers.len() / 2);
        parts.push(Part { markers: markers.clone(), centre, radius, next: 0 });
        if markers.len() > LEAF {
            let along = |marker: &usize| if spread.x > spread.y { positions[*marker].x } else { positions[*marker].y };
            order[markers.clone()].select_nth_unstable_by(half, |a, b| along(a).total_cmp(&along(b)));
            self.divide(markers.start..markers.start + half);
            self.divide(markers.start + half..markers.end);
        }
        self.parts[part].next = self.parts.len();
    }

    fn moments(&self, Part { markers, centre, .. }: &Part, forces: &[Vec2]) -> Moments {
        let mut moments = Moments::default();
        for &marker in &self.order[markers.clone()] {
            let (force, away) = (forces[marker], self.positions[marker] - *centre);
            moments.force += force;
            moments.slopes[0] += away.x * force;
            moments.slopes[1] += away.y * force;
        }
        moments
    }

    /// Writes at each marker the sum over all others of `kernel(distance)` times their forces, the kernel with its
    /// derivative.
    pub(super) fn sum(&self, forces: &[Vec2], kernel: impl Fn(f64) -> [f64; 2], out: &mut [Vec2]) {
        let moments: Vec<Moments> = self.parts.iter().map(|part| self.moments(part, forces)).collect();
        for (target, out) in out.iter_mut().enumerate() {
            let (place, mut sum, mut number) = (self.positions[target], Vec2::ZERO, 0);
            while let Some(part) = self.parts.get(number) {
                let away = place - part.centre;
                let distance = away.length();
                if distance > FAR * part.radius && part.markers.len() > 1 {
                    let ([value, slope], Moments { force, slopes }) = (kernel(distance), moments[number]);
                    let towards = away * (-slope / distance);
                    sum += value * force + towards.x * slopes[0] + towards.y * slopes[1];
                    number = part.next;
                } else if part.markers.len() > LEAF {
                    number += 1;
                } else {
                    let others = self.order[part.markers.clone()].iter().filter(|other| **other != target);
                    sum += others
                        .map(|&other| kernel(place.distance(self.positions[other]))[0] * forces[other])
                        .sum::<Vec2>();
                    number = part.next;
                }
            }
            *out = sum;
        }
    }
}

#[cfg(test)]
mod tests;
