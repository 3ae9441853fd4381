//! The part of the images' flow that ends at the cut-off.

use std::f64::consts::PI;

use motile_base::internal::widely;

use super::split::Split;
use super::waves::{Block, TARGETS};
use crate::surface::dot;
use crate::surroundings::{Components, Sources, bounds};

/// Targets that are treated together.
const LANES: usize = 8;

/// Lists that the sums over images need.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near<'a> {
    pub(super) split: &'a Split,
    pub(super) size: [f64; 3],
    pub(super) cut_off: f64,
}

impl Near<'_> {
    /// Adds the flow of images within the cut-off, without the smooth part of the sources themselves, to a block.
    pub(super) fn add(&self, source: &Sources<'_>, targets: Components<'_>, block: &mut Block) {
        let last = targets[0].len().min(block.first + TARGETS);
        let here = bounds(targets.map(|list| &list[block.first..last]));
        let there = bounds(source.places());
        // Images n with a source within the cut-off of a target.
        let range = |i: usize| {
            let low = ((here[i][0] - there[i][1] - self.cut_off) / self.size[i]).ceil();
            let high = ((here[i][1] - there[i][0] + self.cut_off) / self.size[i]).floor();
            low as i64..=high as i64
        };
        self.pairs(None, source, targets, block);
        for x in range(0) {
            for y in range(1) {
                for z in range(2) {
                    let shift = [x as f64 * self.size[0], y as f64 * self.size[1], z as f64 * self.size[2]];
                    let apart = |i: usize| {
                        let (low, high) = (there[i][0] + shift[i], there[i][1] + shift[i]);
                        (low - here[i][1]).max(here[i][0] - high).max(0.0)
                    };
                    let apart = [apart(0), apart(1), apart(2)];
                    if [x, y, z] != [0, 0, 0] && dot(apart, apart) < self.cut_off * self.cut_off {
                        self.pairs(Some(shift), source, targets, block);
                    }
                }
            }
        }
    }

    /// Adds the flow of one image: what ends at the cut-off, or minus the smooth part for the sources themselves.
    fn pairs(&self, image: Option<[f64; 3]>, source: &Sources<'_>, targets: Components<'_>, block: &mut Block) {
        let last = targets[0].len().min(block.first + TARGETS);
        let (own, shift) = (image.is_none(), image.unwrap_or_default());
        let scale = 1.0 / self.cut_off;
        let power = if matches!(source, Sources::Forces { .. }) { scale } else { scale * scale };
        for first in (block.first..last).step_by(LANES) {
            let mut lanes = [[0.0; LANES]; 3];
            for (i, lanes) in lanes.iter_mut().enumerate() {
                for (t, lane) in lanes.iter_mut().enumerate() {
                    *lane = scale * (targets[i][(first + t).min(last - 1)] - shift[i]);
                }
            }
            let sums = widely(
                #[inline(always)]
                || match *source {
                    Sources::Forces { places, forces } => {
                        sums_of_forces(self.split, scale, &lanes, own, places, forces)
                    }
                    Sources::Stresslets { places, normals, velocities } => {
                        sums_of_doubles(self.split, scale, &lanes, own, places, [normals, velocities])
                    }
                },
            );
            for (out, sums) in block.sums.iter_mut().zip(sums) {
                for (t, sum) in sums.into_iter().enumerate().take(last - first) {
                    out[first - block.first + t] += power * sum / (8.0 * PI);
                }
            }
        }
    }
}

/// Returns the vector of a point.
#[inline(always)]
fn at(list: &Components<'_>, k: usize) -> [f64; 3] {
    [list[0][k], list[1][k], list[2][k]]
}

/// Returns the values of polynomials for all lanes, zero where the distance is beyond the cut-off.
#[inline(always)]
fn values<const F: usize>(powers: [&[f64]; F], squares: &[f64; LANES]) -> [[f64; LANES]; F] {
    let mut sums = [[0.0; LANES]; F];
    let len = powers[0].len();
    let powers = powers.map(|list| &list[..len]);
    let mut t = [0.0; LANES];
    for lane in 0..LANES {
        t[lane] = 2.0 * squares[lane].min(1.0) - 1.0;
    }
    for k in (0..len).rev() {
        for f in 0..F {
            for lane in 0..LANES {
                sums[f][lane] = sums[f][lane] * t[lane] + powers[f][k];
            }
        }
    }
    sums
}

#[inline(always)]
fn sums_of_forces(
    split: &Split,
    scale: f64,
    lanes: &[[f64; LANES]; 3],
    own: bool,
    places: Components<'_>,
    forces: Components<'_>,
) -> [[f64; LANES]; 3] {
    let mut sums = [[0.0; LANES]; 3];
    let [b, g, _] = &split.smooth;
    for k in 0..places[0].len() {
        let (x, f) = (at(&places, k).map(|x| scale * x), at(&forces, k));
        let (mut r, mut square) = ([[0.0; LANES]; 3], [0.0; LANES]);
        for i in 0..3 {
            for t in 0..LANES {
                r[i][t] = lanes[i][t] - x[i];
                square[t] += r[i][t] * r[i][t];
            }
        }
        if !own && square.iter().all(|&square| square >= 1.0) {
            continue;
        }
        let [b, g] = values([b, g], &square);
        for t in 0..LANES {
            let inverse = 1.0 / square[t].sqrt();
            let cubed = inverse / square[t];
            let (b, g) = match (own, square[t] < 1.0) {
                (true, true) => (-b[t], -g[t]),
                (true, false) => (-inverse, -cubed),
                (false, true) => (inverse - b[t], cubed - g[t]),
                (false, false) => (0.0, 0.0),
            };
            let along = g * (r[0][t] * f[0] + r[1][t] * f[1] + r[2][t] * f[2]);
            for i in 0..3 {
                sums[i][t] += b * f[i] + along * r[i][t];
            }
        }
    }
    sums
}

#[inline(always)]
fn sums_of_doubles(
    split: &Split,
    scale: f64,
    lanes: &[[f64; LANES]; 3],
    own: bool,
    places: Components<'_>,
    [normals, velocities]: [Components<'_>; 2],
) -> [[f64; LANES]; 3] {
    let mut sums = [[0.0; LANES]; 3];
    let [_, g, s] = &split.smooth;
    for k in 0..places[0].len() {
        let (x, n, u) = (at(&places, k).map(|x| scale * x), at(&normals, k), at(&velocities, k));
        let trace = dot(n, u);
        let (mut r, mut square) = ([[0.0; LANES]; 3], [0.0; LANES]);
        for i in 0..3 {
            for t in 0..LANES {
                r[i][t] = lanes[i][t] - x[i];
                square[t] += r[i][t] * r[i][t];
            }
        }
        if !own && square.iter().all(|&square| square >= 1.0) {
            continue;
        }
        let [g, s] = values([g, s], &square);
        for t in 0..LANES {
            let inverse = 1.0 / square[t].sqrt();
            let fifth = 3.0 * inverse / (square[t] * square[t]);
            let smooth = square[t] * s[t] - 3.0 * g[t];
            let (m, s) = match (own, square[t] < 1.0) {
                (true, true) => (-smooth, -s[t]),
                (true, false) => (0.0, -fifth),
                (false, true) => (-smooth, fifth - s[t]),
                (false, false) => (0.0, 0.0),
            };
            let across = [r[0][t], r[1][t], r[2][t]];
            let (a, b) = (dot(across, n), dot(across, u));
            for i in 0..3 {
                sums[i][t] += (2.0 * s * a * b - m * trace) * across[i] - m * (n[i] * b + u[i] * a);
            }
        }
    }
    sums
}
