//! Gaps between bodies and to walls, and the repulsion that keeps them open.

mod boundary;
mod films;
mod load;
mod overlap;
mod repulsion;
mod resolution;
mod solid_gap;
mod strata;
mod surface_curve;

pub use boundary::Boundary;
pub(crate) use films::{Films, Surroundings};
pub use load::RepulsionLoad;
pub use overlap::Overlap;
pub use repulsion::Repulsion;
pub(crate) use resolution::CoarseGap;
pub use solid_gap::{NearestSolid, SolidEntered, SolidGap};
pub use surface_curve::{SurfaceCurve, SurfacePoint};

use crate::{Body, Domain, FluidView, MarkerKind, Markers, threads};
use boundary::{shifts, smallest};
use motile_base::{
    Vec2,
    boxes::{BoxTree, Frame, Periods},
};

/// How far boundaries are looked for during steps, in units of what a contact is measured in.
pub(crate) const REACH: f64 = 4.0;

/// The narrowest gap between an interface and another body, or between an interface and its own image in a periodic
/// domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gap {
    /// Number of the body whose corner it is measured from.
    pub(crate) body: usize,
    /// Place of that corner (length).
    pub(crate) place: Vec2,
    /// Number of the other body.
    pub(crate) other: usize,
    /// The gap (length); negative where the corner is inside the other body, or outside of the interface that its body
    /// lies in.
    pub(crate) width: f64,
}

/// Gaps that were found: the narrowest one, and the one that has closed furthest beyond what contact allows. Another
/// one may be narrower than that.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Gaps {
    pub(crate) narrowest: Option<Gap>,
    pub(crate) crossed: Option<Overlap>,
}

impl Gaps {
    /// Takes one more into account, which may be so deep (length). Of equal ones that between the first bodies counts.
    fn add(&mut self, gap: Gap, allowed: f64) {
        let Gap { body, other, place, width } = gap;
        let narrower =
            |least: Gap| width < least.width || width == least.width && [body, other] < [least.body, least.other];
        if self.narrowest.is_none_or(narrower) {
            self.narrowest = Some(gap);
        }
        let depth = -width;
        if depth > allowed {
            self.cross(Overlap { body, other, place, depth, allowed });
        }
    }

    /// Takes one that has closed into account: of those that are as deep the first.
    fn cross(&mut self, overlap: Overlap) {
        if self.crossed.is_none_or(|most| overlap.depth - overlap.allowed > most.depth - most.allowed) {
            self.crossed = Some(overlap);
        }
    }

    /// These and the ones of later bodies.
    fn and(mut self, later: Self) -> Self {
        if let Some(gap) = later.narrowest {
            self.add(gap, f64::INFINITY);
        }
        if let Some(overlap) = later.crossed {
            self.cross(overlap);
        }
        self
    }
}

/// The surfaces of all bodies at one state, and what the bodies are; keeps its memory.
#[derive(Debug, Clone, Default)]
pub struct Surfaces {
    kinds: Vec<MarkerKind>,
    boundaries: Vec<Boundary>,
    /// Numbers of the bodies that have a surface, the boxes around them, and the tree of these.
    numbers: Vec<usize>,
    frames: Vec<Frame>,
    tree: BoxTree,
    /// The interfaces that are periodic along x, from the lowest to the highest.
    strata: Vec<usize>,
    /// The first corner of each body.
    firsts: Vec<usize>,
    /// The corners of all bodies, in the order of the sides that start there; none for bodies without markers.
    corners: Vec<Corner>,
}

/// A corner of a surface.
#[derive(Debug, Clone, Copy)]
struct Corner {
    /// The marker that it is; `None` for a fixed place.
    marker: Option<usize>,
    /// The corner at the other end of the side that starts here.
    next: usize,
}

impl Surfaces {
    /// Creates the surfaces of bodies that are not yet in a scene.
    #[must_use]
    pub fn of(bodies: impl IntoIterator<Item = (Boundary, MarkerKind)>) -> Self {
        let (mut boundaries, kinds): (Vec<Boundary>, _) = bodies.into_iter().unzip();
        boundaries.iter_mut().for_each(Boundary::sort);
        let mut surfaces = Self { boundaries, kinds, ..Self::default() };
        surfaces.sort();
        surfaces
    }

    /// Puts boxes around the bodies.
    fn sort(&mut self) {
        self.frames.clear();
        self.frames.extend(self.boundaries.iter().filter_map(Boundary::frame));
        self.numbers.clear();
        self.numbers.extend((0..self.boundaries.len()).filter(|&body| !self.boundaries[body].is_empty()));
        self.tree.build_by_place(&self.frames);
        self.stack();
    }

    /// Calls `visit` with the bodies whose boxes come within `reach` (length) of an image of `frame`, and with some
    /// others, in no particular order.
    fn each_near(&self, frame: &Frame, periods: Periods, reach: f64, visit: &mut impl FnMut(usize)) {
        self.tree.each_near(frame, periods, reach, &mut |place| visit(self.numbers[place]));
    }

    /// Lays out the surfaces of bodies with their markers where they are now, and the period in x (length; 0 if there
    /// is none).
    pub(crate) fn update(&mut self, markers: &Markers, period: f64) {
        let Self { kinds, boundaries, firsts, corners, .. } = self;
        boundaries.resize_with(markers.groups().len(), Boundary::default);
        kinds.clear();
        firsts.clear();
        corners.clear();
        for group in markers.groups() {
            kinds.push(group.kind);
            firsts.push(corners.len());
            for curve in &group.surfaces {
                let (first, count) = (corners.len(), curve.points.len());
                corners.extend(curve.points.iter().enumerate().map(|(k, (point, _))| Corner {
                    marker: point.marker().map(|marker| group.range.start + marker),
                    next: first + (k + 1) % count,
                }));
            }
        }
        threads::each(0, boundaries, markers.len(), &|body, boundary| {
            let group = &markers.groups()[body];
            boundary.clear();
            for curve in &group.surfaces {
                curve.add_to(boundary, &markers.positions[group.range.clone()], period);
            }
            boundary.sort();
        });
        self.sort();
    }

    /// Returns two interfaces, or one and its own image, without fluid between them: the body, the other one and where
    /// (length). Of interfaces inside one another that is a gap below what the polygons through their markers resolve
    /// of the curves.
    #[must_use]
    pub fn contact(&self, view: &FluidView) -> Option<(usize, usize, Vec2)> {
        let interfaces = |bodies: [usize; 2]| bodies.iter().all(|&body| self.kinds[body].is_curve());
        let scale = self.contact_scale(view);
        let narrowest = self.gaps(view, scale, interfaces).narrowest;
        let closed = |gap: &Gap| {
            let (bodies, periods) = ([gap.body, gap.other], view.domain.periods);
            let nested = self.lies_in(gap.body, gap.other, periods) || self.lies_in(gap.other, gap.body, periods);
            gap.width <= if nested { self.allowed(scale, bodies) } else { 0.0 }
        };
        narrowest.filter(closed).map(|gap| (gap.body, gap.other, gap.place))
    }

    /// Returns the smallest signed distance of a corner of an interface from solids (length), the interface, the number
    /// of the corner in it, and where that is (length).
    pub(crate) fn nearest_solid(&self, periods: Periods) -> Option<(f64, usize, usize, Vec2)> {
        let of_kind = |closed: bool| {
            let bodies = self.boundaries.iter().zip(&self.kinds).enumerate();
            bodies.filter_map(move |(body, (surface, kind))| (kind.is_curve() == closed).then_some((body, surface)))
        };
        let within = |place: Vec2, reach: f64| {
            let distances = of_kind(false).filter_map(|(_, solid)| solid.distance_if_within(place, periods, reach));
            distances.min_by(|a, b| a.abs().total_cmp(&b.abs()))
        };
        let gaps = of_kind(true).filter_map(|(body, surface)| {
            let (distance, corner) = smallest(surface.corners(), within)?;
            Some((distance, body, corner, surface.corners().nth(corner)?))
        });
        gaps.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Returns true if a body lies inside an interface, or inside one of its images.
    fn lies_in(&self, inner: usize, outer: usize, periods: Periods) -> bool {
        if inner == outer || !self.kinds[outer].holds_fluid() {
            return false;
        }
        if self.kinds[outer].advance().is_some() {
            return self.is_on_inner_side(inner, outer, periods);
        }
        self.boundaries[inner].lies_in(&self.boundaries[outer], periods, 0.0)
    }

    /// Returns the gaps that are looked at during steps, below `bound` (length) or four times what contacts are
    /// measured in.
    pub(crate) fn gaps_near(&self, view: &FluidView, bound: f64) -> Gaps {
        self.gaps(view, bound.max(REACH * self.contact_scale(view)), |_| true)
    }

    /// Returns the narrowest gap, however wide: looked for in a reach that grows until there is one.
    pub(crate) fn narrowest(&self, view: &FluidView) -> Option<Gap> {
        let size = self.tree.frame()?.size();
        let mut reach = REACH * self.contact_scale(view);
        while reach > 0.0 && reach < size {
            let found = self.gaps(view, reach, |_| true).narrowest;
            if found.is_some() {
                return found;
            }
            reach *= 4.0;
        }
        self.gaps(view, f64::INFINITY, |_| true).narrowest
    }

    /// Returns the gaps below `reach` (length) between pairs of bodies: from the corners of interfaces to all bodies,
    /// and from the corners of other bodies to interfaces; between others only where they have crossed.
    pub(crate) fn gaps(&self, view: &FluidView, reach: f64, pairs: impl Fn([usize; 2]) -> bool + Sync) -> Gaps {
        let (scale, domain) = (self.contact_scale(view), &view.domain);
        let of_body = |body: usize, gaps: &mut Gaps| {
            let Some(frame) = self.boundaries[body].frame() else { return };
            self.each_near(&frame, domain.periods, reach, &mut |other| {
                let (bodies, some) = ([body, other], self.kinds[body].is_curve() || self.kinds[other].is_curve());
                if (body == other && !some) || !pairs(bodies) {
                    return;
                }
                let (allowed, before) = (self.allowed(scale, bodies), gaps.narrowest);
                self.add_gaps(bodies, domain, [if some { reach } else { scale }, allowed], gaps);
                if !some {
                    gaps.narrowest = before;
                }
            });
        };
        let count = threads::pieces(self.corners.len());
        let (mut found, len) = ([Gaps::default(); threads::PIECES], self.boundaries.len().div_ceil(count));
        threads::each(0, &mut found[..count], self.corners.len(), &|number, gaps| {
            (number * len..self.boundaries.len()).take(len).for_each(|body| of_body(body, gaps));
        });
        found.into_iter().reduce(Gaps::and).unwrap_or_default()
    }

    /// Returns the pairs of bodies, at least one of them an interface, whose gap is below `reach` (length), each once,
    /// and the gaps (length). A body and its own image are a pair of one number.
    pub(crate) fn pairs_near(&self, view: &FluidView, reach: f64) -> Vec<([usize; 2], f64)> {
        let mut pairs = Vec::new();
        for (body, from) in self.boundaries.iter().enumerate() {
            let Some(frame) = from.frame() else { continue };
            self.each_near(&frame, view.domain.periods, reach, &mut |other| {
                if other > body || !(self.kinds[body].is_curve() || self.kinds[other].is_curve()) {
                    return;
                }
                let mut gaps = Gaps::default();
                self.add_gaps([body, other], &view.domain, [reach, f64::INFINITY], &mut gaps);
                self.add_gaps([other, body], &view.domain, [reach, f64::INFINITY], &mut gaps);
                pairs.extend(gaps.narrowest.map(|gap| ([other, body], gap.width)));
            });
        }
        pairs.sort_by_key(|(bodies, _)| *bodies);
        pairs
    }

    /// Looks at the gaps from the corners of one body to the boundary of another one or of its images, below
    /// `reach` and with the depth that is allowed (length).
    fn add_gaps(&self, [body, other]: [usize; 2], domain: &Domain, [reach, allowed]: [f64; 2], gaps: &mut Gaps) {
        let [from, boundary] = [body, other].map(|index| &self.boundaries[index]);
        let [Some(frame), Some(large)] = [from, boundary].map(Boundary::frame) else { return };
        let own = other == body;
        let mut look = |shift: Vec2, periods: Periods, sign: &dyn Fn() -> f64| {
            if !frame.moved(shift).is_near(&large, periods, reach) {
                return;
            }
            let sign = sign();
            for place in from.corners() {
                let distance = boundary.distance_within(place + shift, periods, reach);
                if let Some(distance) = distance {
                    gaps.add(Gap { body, place, other, width: sign * distance }, allowed);
                }
            }
        };
        if self.kinds[other].advance().is_some() {
            for (shift, sign) in self.images_across(body, other, domain.periods) {
                look(shift, [domain.periods[0], None].into(), &|| sign);
            }
            return;
        }
        let periods = if own { Periods::default() } else { domain.periods };
        let sign = || if self.lies_in(body, other, periods) { -1.0 } else { 1.0 };
        shifts(domain.periods, own).into_iter().flatten().for_each(|shift| look(shift, periods, &sign));
    }
}

impl Boundary {
    /// Creates the boundary of a body where it is now, sorted, in a domain of these periods (length, in x and y).
    #[must_use]
    pub fn of(body: &dyn Body, periods: impl Into<Periods>) -> Self {
        let periods = periods.into();
        let mut markers = vec![Vec2::ZERO; body.marker_count()];
        body.write_markers(&mut markers);
        let mut boundary = Self::default();
        let period = periods[0].unwrap_or(0.0);
        body.surfaces().iter().for_each(|curve| curve.add_to(&mut boundary, &markers, period));
        boundary.sort();
        boundary
    }
}

/// Boundary of a body and the points that gaps are measured from: its corners, or markers if it has none.
#[derive(Debug)]
pub(crate) struct Outline {
    boundary: Boundary,
    points: Vec<Vec2>,
    kind: MarkerKind,
}

impl Outline {
    pub(crate) fn of(body: &dyn Body, periods: Periods) -> Self {
        let boundary = Boundary::of(body, periods);
        let mut points: Vec<Vec2> = boundary.corners().collect();
        if boundary.is_empty() {
            points.resize(body.marker_count(), Vec2::ZERO);
            body.write_markers(&mut points);
        }
        Self { boundary, points, kind: body.kind() }
    }

    /// Returns the smallest signed distance of the points of another body from the boundary (length), positive for most
    /// of those inside an interface: what lies in it is measured from within.
    fn smallest(&self, other: &Self, periods: Periods) -> Option<f64> {
        let distances = || other.points.iter().map(|&point| self.boundary.distance(point, periods));
        if let (Some(_), Some(_)) = (self.kind.advance(), periods[1]) {
            // The nearest image may be above or below.
            return distances().map(f64::abs).reduce(f64::min);
        }
        let within = self.kind.holds_fluid() && 2 * distances().filter(|d| *d < 0.0).count() > other.points.len();
        let smallest = distances().map(|distance| if within { -distance } else { distance }).reduce(f64::min);
        smallest.filter(|_| !self.boundary.is_empty())
    }

    /// Returns the gap to another body; see [`crate::System::gap`].
    pub(crate) fn gap(&self, other: &Self, periods: Periods) -> Option<f64> {
        [self.smallest(other, periods), other.smallest(self, periods)].into_iter().flatten().reduce(f64::min)
    }
}

/// Returns the smallest distance of the points to the nearer of two walls at the heights `walls` (below, above). It is
/// the gap that is left between an interface and the walls (length).
///
/// Negative where a point lies beyond a wall, infinite without points, not a number if a height or the y coordinate of
/// a point is not one. For a polygon this is the exact distance, since the nearest point of a polygon to a straight
/// wall is a corner.
///
/// ```
/// use motile_base::Vec2;
/// use motile_scene::gap::wall_gap;
/// let markers = [Vec2::new(0.0, -1.0), Vec2::new(5.0, 0.5)];
/// assert_eq!(wall_gap(&markers, [-1.5, 1.25]), 0.5);
/// ```
#[must_use]
pub fn wall_gap(positions: &[Vec2], walls: [f64; 2]) -> f64 {
    let [bottom, top] = walls;
    positions.iter().fold(f64::INFINITY, |least, position| {
        let [below, above] = [position.y - bottom, top - position.y];
        // Unlike `f64::min`, this keeps what is not a number.
        [below, above].into_iter().fold(least, |least, gap| if gap < least || gap.is_nan() { gap } else { least })
    })
}

#[cfg(test)]
mod tests;
