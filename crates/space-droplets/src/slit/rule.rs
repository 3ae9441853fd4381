//! Wave vectors of the walls' flow.

use std::f64::consts::PI;

use motile_base::internal::gauss_legendre;

use crate::surroundings::{Components, Sources, Targets, bounds};

/// Exponent of what is left out if all digits count.
pub(super) const DIGITS: f64 = 36.0;
/// Gauss-Legendre points over k in any case, if all digits count (measured).
const POINTS: f64 = 26.0;
/// More of them for each root of the largest k, which are for points next to walls.
const POINTS_NEAR_WALLS: f64 = 3.0;
/// More of them for each radian of the fastest wave, which are for points that are far apart.
const POINTS_APART: f64 = 0.7;
/// Most of them, with which there are some million wave vectors.
const MOST_POINTS: usize = 4000;
/// Angles more than a plane wave needs: two for each index of the Green's function, and two for a dipole.
const MORE_ANGLES: usize = 6;

/// Places of sources and targets, with lengths in units of half of the slit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// Point of the mid-plane that is the origin of waves, and what makes lengths units.
    pub(super) origin: [f64; 3],
    pub(super) scale: f64,
    /// Sum of the minimum distances of a source and of a target from the walls.
    gap: f64,
    /// Largest lateral distance of a source from a target, or more.
    pub(super) reach: f64,
}

impl Extent {
    /// Measures sources and targets with these minimum distances from the walls (length).
    pub(super) fn new(lower: f64, half: f64, gaps: [f64; 2], sources: &[Sources<'_>], targets: &[Targets<'_>]) -> Self {
        let nothing = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        let join = |all: [[f64; 2]; 3], places: Components<'_>| {
            let more = bounds(places);
            std::array::from_fn(|i| [all[i][0].min(more[i][0]), all[i][1].max(more[i][1])])
        };
        let from = sources.iter().map(Sources::places).fold(nothing, join);
        let to = targets.iter().map(|target| target.places).fold(nothing, join);
        let mut origin = [0.0, 0.0, lower + half];
        let mut reach = 0.0_f64;
        for i in 0..2 {
            let ([a, b], [c, d]) = (from[i], to[i]);
            origin[i] = 0.5 * (a.min(c) + b.max(d));
            reach = reach.hypot((b - c).max(d - a));
        }
        Self { origin, scale: 1.0 / half, gap: (gaps[0] + gaps[1].max(0.0)) / half, reach: reach / half }
    }

    /// Returns a place in units of half of the slit.
    #[inline(always)]
    pub(super) fn local(&self, places: &Components<'_>, k: usize) -> [f64; 3] {
        std::array::from_fn(|i| self.scale * (places[i][k] - self.origin[i]))
    }
}

/// Wave vectors of one length.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    pub(super) k: f64,
    /// Weight of each wave vector, over (2 pi)^2 and 8 pi.
    pub(super) weight: f64,
    /// Number of angles from 0 to pi; the others give the complex conjugate.
    pub(super) angles: usize,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Rule {
    pub(super) rings: Vec<Ring>,
    /// Gauss-Legendre rules by their number of points, to use them again.
    gauss: Vec<Vec<(f64, f64)>>,
}

impl Rule {
    /// Chooses the wave vectors for sources and targets and an exponent of what is left out. Returns false if they
    /// would be too many.
    pub(super) fn update(&mut self, extent: &Extent, digits: f64) -> bool {
        // Targets on a wall, with sources on it as well, would need all wave vectors.
        let most = digits / extent.gap.max(1e-3);
        let least = POINTS * digits / DIGITS;
        let points = (least + POINTS_NEAR_WALLS * most.sqrt() + POINTS_APART * most * extent.reach) as usize;
        if points > MOST_POINTS {
            return false;
        }
        if self.gauss.len() <= points {
            self.gauss.resize(points + 1, Vec::new());
        }
        let gauss = &mut self.gauss[points];
        if gauss.is_empty() {
            *gauss = gauss_legendre(points);
        }
        self.rings.clear();
        self.rings.extend(gauss.iter().map(|(x, weight)| {
            let t = 0.5 * (1.0 + x);
            let k = most * t * t;
            let angles = angles(k * extent.reach, (k * extent.gap - digits).exp());
            let area = k * most * t * weight * PI / angles as f64;
            Ring { k, weight: 2.0 * area / (4.0 * PI * PI * 8.0 * PI), angles }
        }));
        true
    }
}

/// Returns half of the number of angles that integrate a wave exp(i x cos(angle)) up to an error.
fn angles(x: f64, error: f64) -> usize {
    // The bound (x/2)^n/n! of the Bessel function.
    let (mut bound, mut order) = (1.0, 0);
    while bound > error || (order as f64) < 0.5 * x {
        order += 1;
        bound *= 0.5 * x / order as f64;
    }
    (order + MORE_ANGLES).div_ceil(2)
}
