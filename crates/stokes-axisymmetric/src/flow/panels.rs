//! Quadrature along a meridian for a target on it, close to it, or far away.

use std::f64::consts::PI;

use motile_base::Vec2;

use super::{
    fixed_panels::{Fixed, LONGEST, POINTS, gauss},
    meridian::{Grid, Meridian},
    ring::{Ring, Wanted},
    waves::{Point, Waves},
};

/// Gauss-Legendre points of the first panel next to a target on the curve.
const FIRST_POINTS: usize = 28;
/// Length of the first panel next to a target on the curve, in spacings of the nodes.
const FIRST: f64 = 0.4;
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
    /// Place and, for double layers, the tangent.
    pub(super) point: Point,
    pub(super) ring: Ring,
    pub(super) waves: &'a Waves,
    /// Force per parameter and azimuth (force), where it is known.
    pub(super) force: Option<Vec2>,
    /// Waves of the middle between the foot and the point, and of half of the way, for a point near the foot.
    pub(super) halves: Option<[&'a Waves; 2]>,
}

impl Source<'_> {
    /// Returns the force per parameter and azimuth at this point of the surface that it belongs to.
    pub(super) fn force_on(&self, surface: &Meridian) -> Vec2 {
        self.force.unwrap_or_else(|| surface.force_of(self.waves))
    }
}

/// Panels and working memory.
#[derive(Debug, Clone)]
pub(super) struct Panels {
    pub(super) gauss: Vec<(f64, f64)>,
    first: Vec<(f64, f64)>,
    pub(super) waves: Waves,
    foot: Waves,
    middle: Waves,
    half: Waves,
    nodes: Vec<(f64, f64)>,
}

impl Panels {
    /// Creates panels for up to so many waves.
    pub(super) fn new(waves: usize) -> Self {
        let empty = Waves::new(waves + 1);
        Self {
            gauss: gauss(POINTS),
            first: gauss(FIRST_POINTS),
            waves: empty.clone(),
            foot: empty.clone(),
            middle: empty.clone(),
            half: empty,
            nodes: Vec::new(),
        }
    }

    /// Offsets from the foot and weights of all points between two parameters on both sides of it; the first point of
    /// the result is nearest.
    fn place(&mut self, foot: f64, [from, to]: [f64; 2], spacing: f64, gap: Option<f64>) {
        self.nodes.clear();
        for (side, way) in [(-1.0, foot - from), (1.0, to - foot)] {
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
        wanted: Wanted,
        mut visit: impl FnMut(Source<'_>),
    ) {
        let target = spot.place.y;
        if spot.gap > FAR * source.spacing {
            for (j, ((point, weight), waves)) in source.nodes.iter().zip(&grid.weights).zip(&grid.waves).enumerate() {
                let ring = Ring::new(point.place - spot.place, target, point.place.y, wanted);
                let force = Some(source.forces[j]);
                visit(Source { weight: *weight, point: *point, ring, waves, force, halves: None });
            }
            return;
        }
        let spacing = PI / grid.nodes as f64;
        let gap = (spot.gap > 0.0).then(|| {
            self.waves.fill(spot.foot);
            spot.gap / source.at(&self.waves).tangent.length()
        });
        let mut ends = [0.0, PI];
        if let Some(fixed) = &source.fixed {
            let near = fixed.near(spot.foot);
            ends = [near.start, near.end].map(|end| PI * end as f64 / fixed.count as f64);
            let near = near.start * POINTS..near.end * POINTS;
            let far = fixed.points.iter().zip(&source.fixed_forces).enumerate().filter(|(k, _)| !near.contains(k));
            for (_, (Fixed { weight, point, waves }, force)) in far {
                let ring = Ring::new(point.place - spot.place, target, point.place.y, wanted);
                visit(Source { weight: *weight, point: *point, ring, waves, force: Some(*force), halves: None });
            }
        }
        self.place(spot.foot, ends, spacing, gap);
        let nodes = std::mem::take(&mut self.nodes);
        self.foot.fill(spot.foot);
        let (foot_sin, foot_cos) = spot.foot.sin_cos();
        for &(offset, weight) in &nodes {
            let (s, c) = (0.5 * offset).sin_cos();
            let near = offset.abs() < LONGEST * spacing;
            if near {
                self.half.fill_from((s, c));
                self.middle.combine(&self.foot, &self.half);
                self.waves.combine(&self.middle, &self.half);
            } else {
                let (s, c) = (2.0 * s * c, 1.0 - 2.0 * s * s);
                self.waves.fill_from((foot_sin * c + foot_cos * s, foot_cos * c - foot_sin * s));
            }
            let way = near.then(|| source.difference(&self.middle, &self.half) + spot.offset);
            // Only a double layer has a normal.
            let point = match way {
                Some(d) if wanted == Wanted::Single => Point { place: spot.place + d, tangent: Vec2::ZERO },
                _ => source.at(&self.waves),
            };
            let ring = Ring::new(way.unwrap_or(point.place - spot.place), target, point.place.y, wanted);
            let halves = near.then_some([&self.middle, &self.half]);
            visit(Source { weight, point, ring, waves: &self.waves, force: None, halves });
        }
        self.nodes = nodes;
    }
}

#[cfg(test)]
mod tests;
