//! Gaps at rigid surfaces that are too narrow for the nodes there.

use super::{Boundary, Surfaces, boundary::shifts};
use crate::{Domain, MarkerKind};
use motile_base::{
    PeriodicSeries, Vec2,
    boxes::{Frame, Periods},
};

/// Distance of nodes, over the breadth of a gap, up to which speeds are within 1 %. Measured for discs of radius 0.1
/// that approach discs of radius 0.1 to 3 at gaps of 0.001 to 0.1. They are at most 0.3 % off at 0.53, 2 % at 0.7, 11 %
/// at 0.8, 77 % at 1.2. For discs of radius 0.1 and 0.4 that approach a disc of radius 1.5 as a wall, at gaps of 0.02
/// to 0.3: at most 0.3 % off at 0.55, 2 % at 0.7, 8 % at 1.
const RESOLVED: f64 = 0.55;
/// Distance of a wall's nodes, over the breadth of a gap, above which a solution is of no use: 0.4 above a disc of
/// radius 1.5, discs turn the wrong way at 1.75, and approach it twice as fast as they should at 2.
const NONSENSE: f64 = 1.5;

/// Error of the outline that nodes carry, over the width of a film at a straight wall, above which speeds are off
/// by 1 %. Measured for ellipses of 0.8 x 0.2 along a wall at a gap of 0.02: 8.6 % off at 0.01, 1.3 % at 0.0032 and
/// 0.05 % at 0.0008.
const OUTLINE: f64 = 0.0025;

/// A gap at a rigid surface that is too narrow for the nodes there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CoarseGap {
    /// Number of the body.
    pub(crate) body: usize,
    /// Number of the body on the other side; `None` for a rigid wall.
    pub(crate) other: Option<usize>,
    /// The gap (length).
    pub(crate) width: f64,
    /// Its place (length).
    pub(crate) place: Vec2,
    /// Distance of the nodes on either side (length): of the body, and of the other body or the wall. The value for a
    /// droplet next to a wall is 0, because the droplet gives way.
    pub(crate) spacings: [f64; 2],
    /// Largest distance of nodes that resolves the gap (length).
    pub(crate) resolved: f64,
}

impl CoarseGap {
    /// Returns the largest distance of nodes over the one that resolves the gap.
    pub(crate) fn excess(&self) -> f64 {
        self.spacings[0].max(self.spacings[1]) / self.resolved
    }

    /// Returns true if what a wall does to the body is not a solution in any sense.
    pub(crate) fn is_of_no_use(&self) -> bool {
        self.other.is_none() && self.spacings[1] * RESOLVED > NONSENSE * self.resolved
    }
}

/// Returns the breadth of a gap (length) between surfaces of that sum of curvatures (1/length), over which it widens to
/// about twice its width. For two circles, it is half the distance of the poles of bipolar coordinates.
fn breadth(width: f64, curvature: f64) -> f64 {
    if curvature > 0.0 { (width * (2.0 / curvature + width)).sqrt() } else { f64::INFINITY }
}

/// The place where two boundaries are nearest.
#[derive(Debug, Clone, Copy)]
struct Nearest {
    width: f64,
    place: Vec2,
    /// Number of the side at the corner of the one, and of the other one's side.
    sides: [usize; 2],
}

/// Returns the nearest corner of a boundary, displaced, to another one below `reach` (length).
fn nearest(from: &Boundary, shift: Vec2, to: &Boundary, periods: Periods, reach: f64) -> Option<Nearest> {
    let mut least: Option<Nearest> = None;
    for (corner, place) in from.corners().enumerate() {
        let reach = least.map_or(reach, |least| least.width);
        if let Some(found) = to.nearest_within(place + shift, periods, reach) {
            least = Some(Nearest { width: found.distance().abs(), place, sides: [corner, found.side] });
        }
    }
    least
}

impl Boundary {
    /// Returns the curvature (1/length; positive where what is inside is convex) and mean length of the sides (length),
    /// over so many sides before and after one.
    fn local(&self, side: usize, reach: usize) -> [f64; 2] {
        let (sides, len) = (self.sides(), self.sides().len());
        let after = |k: usize| Some((k + 1) % len).filter(|&next| sides[k][1] == sides[next][0]);
        let before = |k: usize| Some((k + len - 1) % len).filter(|&last| sides[last][1] == sides[k][0]);
        let along = |k: usize| sides[k][1] - sides[k][0];
        let first = (0..reach).try_fold(side, |k, _| before(k).ok_or(k)).unwrap_or_else(|k| k);
        let (mut k, mut turn, mut length, mut count) = (first, 0.0, along(first).length(), 1.0);
        let mut apart = 0.0;
        for _ in 0..2 * reach {
            let Some(next) = after(k) else { break };
            turn += along(k).angle_to(along(next));
            apart += 0.5 * (along(k).length() + along(next).length());
            length += along(next).length();
            count += 1.0;
            k = next;
        }
        [if apart > 0.0 { turn / apart } else { 0.0 }, length / count]
    }
}

impl Surfaces {
    /// Returns the curvature of a body at one of its sides (1/length), and the distance of its nodes there (length).
    fn at(&self, body: usize, side: usize, nodes: usize) -> [f64; 2] {
        let boundary = &self.boundaries[body];
        let per_node = boundary.sides().len() as f64 / nodes as f64;
        let [curvature, length] = boundary.local(side, (per_node.round() as usize).max(1));
        [curvature, length * per_node]
    }

    /// Returns the largest distance of the nodes of a body (length).
    fn widest(&self, body: usize, nodes: usize) -> f64 {
        let boundary = &self.boundaries[body];
        boundary.longest_side() * boundary.sides().len() as f64 / nodes as f64
    }

    /// Returns the narrowest gap below `reach` (length) between two bodies, at least one of them an interface, images
    /// included but no body and its own; for bodies that do not overlap.
    pub(crate) fn narrower(&self, domain: &Domain, reach: f64) -> Option<f64> {
        self.least_between(domain.periods, reach, |one, other| one.is_curve() || other.is_curve()).map(|(gap, _)| gap)
    }

    /// Returns the narrowest gap below `reach` (length) between two solids, which may touch by design, and the solids.
    pub(crate) fn between_solids(&self, domain: &Domain, reach: f64) -> Option<(f64, [usize; 2])> {
        self.least_between(domain.periods, reach, |one, other| !one.is_curve() && !other.is_curve())
    }

    /// Returns the narrowest gap below `reach` (length) between two bodies of some kinds that do not overlap, and the
    /// bodies.
    fn least_between(
        &self,
        periods: Periods,
        reach: f64,
        kinds: impl Fn(MarkerKind, MarkerKind) -> bool,
    ) -> Option<(f64, [usize; 2])> {
        let mut least: Option<(f64, [usize; 2])> = None;
        for (body, boundary) in self.boundaries.iter().enumerate() {
            let Some(frame) = boundary.frame() else { continue };
            self.each_near(&frame, periods, reach, &mut |other| {
                if other >= body || !kinds(self.kinds[body], self.kinds[other]) {
                    return;
                }
                let pair = [boundary, &self.boundaries[other]];
                for [from, to] in [pair, [pair[1], pair[0]]] {
                    let reach = least.map_or(reach, |(gap, _)| gap);
                    let near = |frame: Frame| to.frame().is_some_and(|other| frame.is_near(&other, periods, reach));
                    let found = from.frame().filter(|frame| near(*frame));
                    if let Some(found) = found.and_then(|_| nearest(from, Vec2::ZERO, to, periods, reach)) {
                        least = Some((found.width, [other, body]));
                    }
                }
            });
        }
        least
    }

    /// Returns the pair of bodies, at least one of them rigid, whose gap so many nodes resolve worst, if they do not.
    pub(crate) fn coarse_pair(&self, domain: &Domain, nodes: usize) -> Option<CoarseGap> {
        let rigid = |body: usize| self.kinds[body] == MarkerKind::Rigid;
        let curves = || (0..self.boundaries.len()).filter(|&body| self.kinds[body].is_curve());
        if !curves().any(rigid) {
            return None;
        }
        let reach = curves().map(|body| self.widest(body, nodes)).fold(0.0, f64::max) / RESOLVED;
        let mut worst: Option<CoarseGap> = None;
        for body in curves().filter(|&body| rigid(body)) {
            let Some(frame) = self.boundaries[body].frame() else { continue };
            self.each_near(&frame, domain.periods, reach, &mut |other| {
                if !self.kinds[other].is_curve() || (rigid(other) && other > body) {
                    return;
                }
                let gap = self.gap_between([body, other], domain.periods, reach, nodes);
                worst = worse(worst, gap);
            });
        }
        worst
    }

    /// Returns the gap between two bodies, or a body and its own image, if the nodes do not resolve it.
    fn gap_between(&self, pair: [usize; 2], periods: Periods, reach: f64, nodes: usize) -> Option<CoarseGap> {
        let [body, other] = pair;
        let [one, two] = pair.map(|body| &self.boundaries[body]);
        let own = body == other;
        let images = if own { Periods::default() } else { periods };
        let mut least: Option<Nearest> = None;
        for shift in shifts(periods, own).into_iter().flatten() {
            let forward = nearest(one, shift, two, images, reach);
            let back = nearest(two, -1.0 * shift, one, images, reach);
            let back = back.map(|found| Nearest { sides: [found.sides[1], found.sides[0]], ..found });
            for found in [forward, back].into_iter().flatten() {
                least = Some(least.filter(|least| least.width <= found.width).unwrap_or(found));
            }
        }
        let Nearest { width, place, sides } = least?;
        // What is around a body is concave there.
        let sign = |inner: usize, outer: usize| if self.lies_in(inner, outer, periods) { -1.0 } else { 1.0 };
        let [first, second] = [0, 1].map(|k| self.at(pair[k], sides[k], nodes));
        let curvature = sign(other, body) * first[0] + sign(body, other) * second[0];
        let resolved = RESOLVED * breadth(width, curvature);
        Some(CoarseGap { body, other: Some(other), width, place, spacings: [first[1], second[1]], resolved })
            .filter(|gap| gap.excess() > 1.0)
    }

    /// Returns the gap between a rigid body and straight walls at two heights (length) that so many nodes resolve
    /// worst, if they do not. Every place of the body counts: the ends of a slender body are where nodes are too few
    /// first, and what they leave of the outline is felt where the film is narrowest.
    pub(crate) fn coarse_straight(&self, nodes: usize, heights: [f64; 2]) -> Option<CoarseGap> {
        let mut worst: Option<CoarseGap> = None;
        for body in (0..self.boundaries.len()).filter(|&body| self.kinds[body] == MarkerKind::Rigid) {
            let boundary = &self.boundaries[body];
            let width = |place: Vec2| (place.y - heights[0]).min(heights[1] - place.y);
            let reach = self.widest(body, nodes) / RESOLVED;
            if !boundary.corners().any(|place| width(place) < reach) {
                continue;
            }
            let errors = outline_errors(boundary, nodes).unwrap_or_default();
            for (side, place) in boundary.corners().enumerate() {
                let width = width(place);
                if width > 0.0 && width < reach {
                    let [curvature, spacing] = self.at(body, side, nodes);
                    // Errors of the outline fall with a high power of the distance of nodes.
                    let error = errors.get(side).map_or(0.0, |error| error / (OUTLINE * width));
                    let resolved = (RESOLVED * breadth(width, curvature)).min(spacing / error.powf(0.25));
                    let gap = CoarseGap { body, other: None, width, place, spacings: [spacing, 0.0], resolved };
                    worst = worse(worst, Some(gap).filter(|gap| gap.excess() > 1.0));
                }
            }
        }
        worst
    }

    /// Returns the gap between a body and rigid walls, whose nodes are so far apart at each side (length), that nodes
    /// resolve worst, if they do not.
    pub(crate) fn coarse_wall(
        &self,
        domain: &Domain,
        nodes: usize,
        walls: &Boundary,
        spacings: &[f64],
    ) -> Option<CoarseGap> {
        let wall_frame = walls.frame()?;
        let widest = spacings.iter().copied().fold(0.0, f64::max);
        let mean = spacings.iter().sum::<f64>() / spacings.len().max(1) as f64;
        let lengths = walls.sides().iter().map(|[start, end]| (end - start).length()).sum::<f64>();
        let per_node = (mean * walls.sides().len() as f64 / lengths).round().max(1.0) as usize;
        let mut worst: Option<CoarseGap> = None;
        for body in (0..self.boundaries.len()).filter(|&body| self.kinds[body].is_curve()) {
            let own = if self.kinds[body] == MarkerKind::Rigid { self.widest(body, nodes) } else { 0.0 };
            let (boundary, reach) = (&self.boundaries[body], widest.max(own) / RESOLVED);
            let near = boundary.frame().is_some_and(|frame| frame.is_near(&wall_frame, domain.periods, reach));
            let found = if near { nearest(boundary, Vec2::ZERO, walls, domain.periods, reach) } else { None };
            let Some(Nearest { width, place, sides }) = found else { continue };
            let [[curvature, spacing], [of_wall, _]] =
                [self.at(body, sides[0], nodes), walls.local(sides[1], per_node)];
            let spacing = if own > 0.0 { spacing } else { 0.0 };
            let wall = spacings.get(sides[1]).copied().unwrap_or(0.0);
            let resolved = RESOLVED * breadth(width, curvature + of_wall);
            let gap = CoarseGap { body, other: None, width, place, spacings: [spacing, wall], resolved };
            worst = worse(worst, Some(gap).filter(|gap| gap.excess() > 1.0));
        }
        worst
    }
}

/// Returns how far the outline that so many nodes carry is from each corner of a closed boundary (length).
fn outline_errors(boundary: &Boundary, nodes: usize) -> Option<Vec<f64>> {
    let corners: Vec<Vec2> = boundary.corners().collect();
    if corners.len() <= nodes {
        return None;
    }
    let mut fine = PeriodicSeries::new(corners.len()).ok()?;
    let mut coarse = PeriodicSeries::new(nodes).ok()?;
    fine.analyse_vectors(&corners).ok()?;
    coarse.resample(&fine);
    let mut carried = PeriodicSeries::new(corners.len()).ok()?;
    carried.resample(&coarse);
    Some(carried.values().iter().zip(&corners).map(|(z, x)| (x.x - z.re).hypot(x.y - z.im)).collect())
}

/// Returns the gap of two that is resolved worse.
fn worse(one: Option<CoarseGap>, other: Option<CoarseGap>) -> Option<CoarseGap> {
    one.into_iter().chain(other).max_by(|a, b| a.excess().total_cmp(&b.excess()))
}

#[cfg(test)]
mod tests;
