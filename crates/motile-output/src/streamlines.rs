//! Evenly spaced streamlines.
//!
//! After B. Jobard and W. Lefer, "Creating evenly-spaced streamlines of arbitrary density" (1997): each new line starts
//! at a fixed distance from an earlier one, and ends where it comes too near another. If a flow is its own mirror
//! image, lines are traced on one side of the mirror line and reflected.

mod mirrors;

use std::collections::VecDeque;

use crate::{OutputError, Raster, Samples};
use mirrors::Mirrors;
use motile::base::Vec2;

/// Smallest distances, in units of the spacing, of a line from others and from an earlier part of itself.
const NEAREST_OTHER: f64 = 0.35;
const NEAREST_SELF: f64 = 0.3;
/// Number of steps per spacing.
const STEPS: f64 = 8.0;
/// Length of the shortest line, in spacings.
const SHORTEST: f64 = 1.6;
/// Length of the longest line, in spacings; closed lines end before by meeting themselves.
const LONGEST: f64 = 400.0;
/// Velocity over the largest one below which a line ends: its direction depends on errors of the samples.
const STAGNANT: f64 = 1e-4;

/// Computes streamlines of a velocity field about `spacing` (length) apart, each a list of points (length) in the
/// direction of the flow. The first passes through `anchor` and determines the others, so that lines move along with an
/// anchor that moves with the flow. In periodic directions lines continue beyond the borders, unwrapped.
///
/// If the flow is its mirror image (to half a percent) in a level or upright line through the anchor or the middle of
/// the raster, so are the streamlines, and the first one is on that line or next to it.
///
/// # Errors
/// Returns [`OutputError::Streamlines`] for a spacing that is not positive and finite, or so small that there would be
/// more than a million cells of it.
pub fn streamlines(field: &Samples<Vec2>, spacing: f64, anchor: Vec2) -> Result<Vec<Vec<Vec2>>, OutputError> {
    let raster = &field.raster;
    let size = raster.size;
    if !(spacing.is_finite() && spacing > 0.0 && size[0] * size[1] / (spacing * spacing) < 1e6) {
        return Err(OutputError::Streamlines { spacing, size });
    }
    let fastest = field.values.iter().map(|v| v.length()).filter(|v| v.is_finite()).fold(0.0, f64::max);
    if fastest == 0.0 {
        return Ok(Vec::new());
    }
    let (near, mirrors) = (Neighbourhood::new(raster, spacing), Mirrors::of(field, anchor, spacing));
    let mut tracer = Tracer { field, spacing, slowest: STAGNANT * fastest, near, mirrors };
    let mut lines: Vec<Vec<Vec2>> = Vec::new();
    // Seeds beside the lines, and, when those are used up, wherever there is room left.
    let mut beside: VecDeque<Vec2> = VecDeque::new();
    let mut spare = spare_seeds(raster, spacing, anchor).into_iter();
    while let Some(seed) = beside.pop_front().or_else(|| spare.next()) {
        if let Some(line) = tracer.line(seed) {
            beside.extend(seeds_beside(&line, spacing));
            for image in tracer.mirrors.images(&line) {
                tracer.near.kept.push(true);
                image.iter().for_each(|&p| tracer.near.add(p, 0));
                lines.push(image);
            }
            lines.push(line);
        }
    }
    Ok(lines)
}

/// Seeds at both sides of a line, a spacing from it and from each other.
fn seeds_beside(line: &[Vec2], spacing: f64) -> Vec<Vec2> {
    let every = STEPS as usize;
    let beside = |pair: &[Vec2]| {
        let along = pair[1] - pair[0];
        let normal = Vec2::new(-along.y, along.x) * (1.001 * spacing / along.length().max(1e-300));
        [pair[0] + normal, pair[0] - normal]
    };
    line.windows(2).step_by(every).flat_map(beside).collect()
}

/// Seeds on a lattice over the raster, the one at the anchor first.
fn spare_seeds(raster: &Raster, spacing: f64, anchor: Vec2) -> Vec<Vec2> {
    let [nx, ny] = [0, 1].map(|k| (raster.size[k] / spacing).ceil() as usize);
    let [dx, dy] = [raster.size[0] / nx as f64, raster.size[1] / ny as f64];
    let mut seeds = vec![anchor];
    for j in 0..ny {
        for i in 0..nx {
            let mut seed = anchor + Vec2::new(i as f64 * dx, j as f64 * dy);
            for k in 0..2 {
                let start = raster.origin[k];
                seed[k] = start + (seed[k] - start).rem_euclid(raster.size[k]);
            }
            seeds.push(seed);
        }
    }
    seeds
}

/// Tracer that follows the field and keeps lines apart.
struct Tracer<'a> {
    field: &'a Samples<Vec2>,
    spacing: f64,
    slowest: f64,
    near: Neighbourhood,
    mirrors: Mirrors,
}

impl Tracer<'_> {
    /// Returns the streamline through a seed, which joins the neighbourhood. It is `None` if the seed is too near a
    /// line or the line too short.
    fn line(&mut self, seed: Vec2) -> Option<Vec<Vec2>> {
        if !self.field.raster.covers(seed)
            || !self.mirrors.is_ahead(seed)
            || self.mirrors.is_near_image(seed, self.spacing)
            || self.near.any(seed, self.spacing, |_| true)
        {
            return None;
        }
        self.near.kept.push(true);
        self.near.add(seed, 0);
        let mut ahead = self.follow(seed, 1.0);
        let end = self.closing(&ahead, seed);
        ahead.extend(end);
        let mut line: Vec<Vec2> = match end {
            Some(_) => Vec::new(),
            None => self.follow(seed, -1.0).into_iter().rev().collect(),
        };
        line.push(seed);
        line.extend(ahead);
        let length: f64 = line.windows(2).map(|w| (w[1] - w[0]).length()).sum();
        let keep = length >= SHORTEST * self.spacing;
        self.near.kept.pop();
        self.near.kept.push(keep);
        keep.then_some(line)
    }

    /// Returns the end of a line that has returned to its seed or to an image of it; `None` for other lines.
    fn closing(&self, ahead: &[Vec2], seed: Vec2) -> Option<Vec2> {
        let [.., before, last] = ahead else { return None };
        let end = self.near.nearest_image(seed, *last);
        let gap = end - last;
        let along = (last - before).normalize();
        let near = gap.length() < (NEAREST_SELF + 2.0 / STEPS) * self.spacing;
        (near && along.dot(gap) > 0.0 && along.perp_dot(gap).abs() < 0.1 * self.spacing).then_some(end)
    }

    /// Returns the line from a seed downstream (`sign` 1) or upstream (-1), without the seed.
    fn follow(&mut self, seed: Vec2, sign: f64) -> Vec<Vec2> {
        let apart = (2.0 * STEPS) as i64;
        let mut line = Vec::new();
        let mut p = seed;
        for count in 1..(LONGEST * STEPS) as i64 {
            let Some(next) = self.step(p, sign * self.spacing / STEPS) else { break };
            let next = self.mirrors.along(p, next);
            // Upstream points are numbered -1, -2, ...: points near along the line may be near in space.
            let number = if sign > 0.0 { count } else { -count };
            let (other, own) = (NEAREST_OTHER * self.spacing, NEAREST_SELF * self.spacing);
            if self.mirrors.is_near_image(next, other)
                || self.near.any(next, other, |place| place.is_none())
                || self.near.any(next, own, |place| place.is_some_and(|n| (n - number).abs() > apart))
            {
                break;
            }
            self.near.add(next, number);
            line.push(next);
            p = next;
        }
        line
    }

    /// Returns the step of a length along the field (classical Runge-Kutta on its direction); `None` if the field is
    /// not known.
    fn step(&self, p: Vec2, length: f64) -> Option<Vec2> {
        let direction = |p: Vec2| {
            let v = self.field.raster.covers(p).then(|| self.field.at(p))?;
            let speed = v.length();
            (speed > self.slowest).then(|| v / speed)
        };
        let a = direction(p)?;
        let b = direction(p + a * (0.5 * length))?;
        let c = direction(p + b * (0.5 * length))?;
        let d = direction(p + c * length)?;
        let next = p + (a + b * 2.0 + c * 2.0 + d) * (length / 6.0);
        self.field.raster.covers(next).then_some(next)
    }
}

/// Points of lines sorted into cells of at least one spacing, to find near ones; periodic as the raster.
struct Neighbourhood {
    raster: Raster,
    cells: [usize; 2],
    /// Points with the number of their line, and their number on it.
    points: Vec<Vec<(Vec2, usize, i64)>>,
    /// Flags of the lines that count, the last one for the present line.
    kept: Vec<bool>,
}

impl Neighbourhood {
    fn new(raster: &Raster, spacing: f64) -> Self {
        let cells = [0, 1].map(|k| ((raster.size[k] / spacing) as usize).max(1));
        Self { raster: *raster, cells, points: vec![Vec::new(); cells[0] * cells[1]], kept: Vec::new() }
    }

    fn cell(&self, p: Vec2) -> [usize; 2] {
        [0, 1].map(|k| {
            let t = (p[k] - self.raster.origin[k]) / self.raster.size[k];
            let t = if self.raster.periodic[k] { t.rem_euclid(1.0) } else { t.clamp(0.0, 1.0) };
            ((t * self.cells[k] as f64) as usize).min(self.cells[k] - 1)
        })
    }

    /// Adds a point to the present line.
    fn add(&mut self, p: Vec2, number: i64) {
        let [i, j] = self.cell(p);
        self.points[j * self.cells[0] + i].push((p, self.kept.len() - 1, number));
    }

    /// Returns the periodic image of `p` that is nearest to `q`.
    fn nearest_image(&self, mut p: Vec2, q: Vec2) -> Vec2 {
        for k in (0..2).filter(|&k| self.raster.periodic[k]) {
            p[k] -= self.raster.size[k] * ((p[k] - q[k]) / self.raster.size[k]).round();
        }
        p
    }

    /// Returns true if a wanted point of a line is nearer to `p` than `distance` (at most a spacing), over periodic
    /// images. The closure `wanted` is given its number on the present line, or `None` for other lines.
    fn any(&self, p: Vec2, distance: f64, wanted: impl Fn(Option<i64>) -> bool) -> bool {
        let at = self.cell(p);
        let around = |k: usize| {
            let (n, periodic) = (self.cells[k] as i64, self.raster.periodic[k]);
            (-1..=1).map(move |d| at[k] as i64 + d).filter_map(move |c| {
                let inside = (0..n).contains(&c);
                (inside || periodic).then(|| c.rem_euclid(n) as usize)
            })
        };
        let last = self.kept.len().wrapping_sub(1);
        let near = |&(q, line, number): &(Vec2, usize, i64)| {
            self.kept[line]
                && wanted((line == last).then_some(number))
                && (self.nearest_image(p, q) - q).length() < distance
        };
        around(1).any(|j| around(0).any(|i| self.points[j * self.cells[0] + i].iter().any(near)))
    }
}

#[cfg(test)]
mod tests;
