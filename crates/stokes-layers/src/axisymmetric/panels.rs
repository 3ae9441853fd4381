//! Quadrature along a meridian for a target on it, close to it, or far away.

use std::f64::consts::PI;

use motile_base::Vec2;

use super::{
    meridian::{Grid, Meridian, Point, Waves},
    ring::Ring,
};

/// Gauss-Legendre points of a panel, and of the first panel beside a target on the curve.
const POINTS: usize = 16;
const FIRST_POINTS: usize = 28;
/// Length of the first panel beside a target on the curve and of the longest ones, in spacings of the nodes.
const FIRST: f64 = 0.4;
pub(super) const LONGEST: f64 = 6.0;
/// Power of the substitution that takes the logarithm at the target away.
const POWER: i32 = 5;
/// Distance over the spacing of nodes beyond which their own weights integrate to round-off: the error is
/// `exp(-2 pi d/h)`.
pub(super) const FAR: f64 = 5.5;
/// Length of the panels next to the foot of a target over its distance from the curve.
const NEXT: f64 = 1.5;

/// Way from a foot to a pole that is round-off: the radius of a ring there may be zero or less.
const SLIVER: f64 = 1e-14;

/// A target of a layer on a surface: place (length), parameter of the nearest point of the surface, that point less the
/// place (length) and its length; zero for a target on the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub(super) place: Vec2,
    pub(super) foot: f64,
    pub(super) offset: Vec2,
    pub(super) gap: f64,
}

/// A point of a quadrature: its weight in an integral over t, place on the source, and the ring through it as the
/// target sees it.
pub(super) struct Source<'a> {
    pub(super) weight: f64,
    pub(super) point: Point,
    pub(super) ring: Ring,
    pub(super) waves: &'a Waves,
    /// Number of the node, for a node.
    pub(super) node: Option<usize>,
    /// Waves of the middle between the foot and the point, and of half of the way, for a point near the foot.
    pub(super) halves: Option<[&'a Waves; 2]>,
}

/// Panels and working memory.
#[derive(Debug, Clone)]
pub(super) struct Panels {
    pub(super) gauss: Vec<(f64, f64)>,
    first: Vec<(f64, f64)>,
    pub(super) waves: Waves,
    middle: Waves,
    half: Waves,
    nodes: Vec<(f64, f64)>,
}

/// Points and weights of the Gauss-Legendre rule on (0, 1), by Newton's method.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    (0..count)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (mut before, mut value) = (1.0, x);
                for k in 2..=count {
                    let k = k as f64;
                    (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                slope = n * (x * value - before) / (x * x - 1.0);
                let step = value / slope;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

impl Panels {
    /// Panels for up to so many waves.
    pub(super) fn new(waves: usize) -> Self {
        let empty = Waves::new(waves + 1);
        Self {
            gauss: gauss(POINTS),
            first: gauss(FIRST_POINTS),
            waves: empty.clone(),
            middle: empty.clone(),
            half: empty,
            nodes: Vec::new(),
        }
    }

    /// Makes room for so many waves.
    pub(super) fn reserve(&mut self, waves: usize) {
        if self.waves.cos.len() < waves + 1 {
            *self = Self::new(waves);
        }
    }

    /// Offsets from the foot and weights of all points on both sides of it; the first point of the result is nearest.
    fn place(&mut self, foot: f64, spacing: f64, gap: Option<f64>) {
        self.nodes.clear();
        for (side, way) in [(-1.0, foot), (1.0, PI - foot)] {
            let (mut start, mut length) = (0.0, FIRST * spacing);
            if let Some(gap) = gap {
                length = NEXT * gap;
            } else {
                length = length.min(way);
                for (u, weight) in &self.first {
                    let factor = f64::from(POWER) * u.powi(POWER - 1);
                    self.nodes.push((side * length * u.powi(POWER), length * factor * weight));
                }
                start = length;
                length *= 2.0;
            }
            while start + SLIVER < way {
                length = length.min(LONGEST * spacing);
                // A short rest of the way belongs to the panel before it.
                if way - start < 1.25 * length {
                    length = way - start;
                }
                self.nodes.extend(self.gauss.iter().map(|(u, weight)| (side * (start + length * u), length * weight)));
                start += length;
                length *= 2.0;
            }
        }
    }

    /// Calls `visit` for all points of the quadrature for a target.
    pub(super) fn each(
        &mut self,
        (grid, source): (&Grid, &Meridian),
        spot: &Spot,
        with_gradient: bool,
        mut visit: impl FnMut(Source<'_>),
    ) {
        let target = spot.place.y;
        if spot.gap > FAR * source.spacing {
            for (j, ((point, weight), waves)) in source.nodes.iter().zip(&grid.weights).zip(&grid.waves).enumerate() {
                let ring = Ring::new(point.place - spot.place, target, point.place.y, with_gradient);
                visit(Source { weight: *weight, point: *point, ring, waves, node: Some(j), halves: None });
            }
            return;
        }
        let spacing = PI / grid.nodes as f64;
        let gap = (spot.gap > 0.0).then(|| {
            self.waves.fill(spot.foot);
            spot.gap / source.at(&self.waves).tangent.length()
        });
        self.place(spot.foot, spacing, gap);
        let nodes = std::mem::take(&mut self.nodes);
        let (foot_sin, foot_cos) = spot.foot.sin_cos();
        for &(offset, weight) in &nodes {
            let (s, c) = (0.5 * offset).sin_cos();
            let near = offset.abs() < LONGEST * spacing;
            let middle = (foot_sin * c + foot_cos * s, foot_cos * c - foot_sin * s);
            if near {
                self.half.fill_from((s, c));
                self.middle.fill_from(middle);
                self.waves.combine(&self.middle, &self.half);
            } else {
                self.waves.fill_from((middle.0 * c + middle.1 * s, middle.1 * c - middle.0 * s));
            }
            let point = source.at(&self.waves);
            let d =
                if near { source.difference(&self.middle, &self.half) + spot.offset } else { point.place - spot.place };
            let ring = Ring::new(d, target, point.place.y, with_gradient);
            let halves = near.then_some([&self.middle, &self.half]);
            visit(Source { weight, point, ring, waves: &self.waves, node: None, halves });
        }
        self.nodes = nodes;
    }
}

#[cfg(test)]
mod tests;
