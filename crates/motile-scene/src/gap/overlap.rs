//! Bodies that lie in one another before anything is computed for them.

use super::{Boundary, Surfaces};
use crate::{FluidView, threads};
use motile_base::{
    Vec2,
    boxes::{Frame, Periods},
};

/// Depth to which an interface may be inside another one, in units of [`Surfaces::contact_scale`]. Sides of length s
/// leave a curve of radius R by s/(8R) of their length, which is this at R = 6 s.
const CURVES: f64 = 0.02;
/// The like of an interface and a solid, or of two solids: films that drain at rest on a surface that only a grid
/// resolves come to this.
const CONTACT: f64 = 0.25;
/// Sides of a body, and depths below each over the size of the body, from which its inside is looked at.
const SIDES: usize = 16;
const DEPTHS: [f64; 4] = [0.5, 0.25, 0.125, 0.0625];

/// Two bodies, by their numbers, that have more in common than contact allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// The later one.
    pub body: usize,
    /// The earlier one.
    pub other: usize,
    /// Place where it is deepest (length).
    pub place: Vec2,
    /// Depth (length).
    pub depth: f64,
    /// Depth that is allowed (length).
    pub allowed: f64,
}

impl Surfaces {
    /// Returns the first two bodies that overlap; images of one and the same body are not looked at.
    ///
    /// ```
    /// use motile_base::Vec2;
    /// use motile_scene::{FluidView, Domain, MarkerKind, gap::{Boundary, Surfaces, Overlap}};
    ///
    /// let square = |x: f64| {
    ///     let mut square = Boundary::default();
    ///     square.push_loop(&[(x, 0.0), (x + 1.0, 0.0), (x + 1.0, 1.0), (x, 1.0)].map(|(x, y)| Vec2::new(x, y)));
    ///     (square, MarkerKind::Points)
    /// };
    /// let domain = Domain { origin: [0.0; 2], periods: [Some(6.0), None].into(), walls: None };
    /// let view = FluidView {
    ///     domain, viscosity: 1.0, spacing: Some(0.1), second_order: true, shape_modes: None, nodes: None,
    ///     interface_stiffness: 1.0,
    /// };
    /// assert_eq!(Surfaces::of([square(0.0), square(2.0)]).first_overlap(&view), None);
    /// // the image of the third overlaps the first
    /// let found = Surfaces::of([square(0.0), square(2.0), square(5.5)]).first_overlap(&view);
    /// let Some(Overlap { body, other, depth, .. }) = found else { panic!() };
    /// assert_eq!((body, other, depth), (2, 0, 0.25));
    /// ```
    #[must_use]
    pub fn first_overlap(&self, view: &FluidView) -> Option<Overlap> {
        let periods = view.domain.periods;
        // What lies closer inside an interface than contact is at the same place.
        let scale = self.contact_scale(view);
        let film = CONTACT * scale;
        self.boundaries.iter().enumerate().find_map(|(body, boundary)| {
            let mut first: Option<Overlap> = None;
            self.each_near(&boundary.frame()?, periods, 0.0, &mut |other| {
                let allowed = self.allowed(scale, [body, other]);
                if other < first.map_or(body, |first| first.other)
                    && let Some((place, depth)) = self.overlap(body, other, periods, film)
                    && depth > allowed
                {
                    first = Some(Overlap { body, other, place, depth, allowed });
                }
            });
            first
        })
    }

    /// Returns the depth to which a body may be inside another one (length), of a [`Surfaces::contact_scale`].
    pub(super) fn allowed(&self, scale: f64, bodies: [usize; 2]) -> f64 {
        let interfaces = bodies.iter().all(|&body| self.kinds[body].is_curve());
        (if interfaces { CURVES } else { CONTACT }) * scale
    }

    /// Returns the length that contacts are measured in. It is the grid spacing, and without a grid the longest side of
    /// an interface (length).
    pub(crate) fn contact_scale(&self, view: &FluidView) -> f64 {
        let interfaces = self.boundaries.iter().zip(&self.kinds).filter(|(_, kind)| kind.is_curve());
        view.spacing.unwrap_or_else(|| interfaces.map(|(boundary, _)| boundary.longest_side()).fold(0.0, f64::max))
    }

    /// Returns the innermost interface that each body lies in.
    pub(crate) fn surroundings(&self, periods: Periods, around: &mut Vec<Option<usize>>) {
        let of = |inner: usize| {
            let (frame, mut innermost) = (self.boundaries[inner].frame()?, None);
            // A part of the inner one may have crossed: [`Boundary::lies_in`].
            self.each_near(&frame, periods, frame.size(), &mut |outer| {
                if self.kinds[outer].advance().is_some() {
                    return;
                }
                let size = self.boundaries[outer].frame().map_or(f64::INFINITY, |frame| frame.size());
                if innermost.is_none_or(|least| (size, outer) < least) && self.lies_in(inner, outer, periods) {
                    innermost = Some((size, outer));
                }
            });
            innermost.map(|(_, outer)| outer).or_else(|| self.stratum(inner, periods))
        };
        around.resize(self.boundaries.len(), None);
        threads::each(0, around, self.corners.len(), &|inner, outer| *outer = of(inner));
    }

    /// Returns the deepest place that two bodies have in common, and how deep it is in both (length); for what lies
    /// inside an interface, the place where it reaches out furthest.
    fn overlap(&self, a: usize, b: usize, periods: Periods, film: f64) -> Option<(Vec2, f64)> {
        let [first, second] = [&self.boundaries[a], &self.boundaries[b]];
        if !first.frame()?.is_near(&second.frame()?, periods, 0.0) {
            return None;
        }
        if [a, b].iter().any(|&body| self.kinds[body].advance().is_some()) {
            return self.crossing(a, b, periods);
        }
        let deepest = |places: &mut dyn Iterator<Item = (Vec2, f64)>| places.max_by(|a, b| a.1.total_cmp(&b.1));
        for (outer, inner, kind) in [(first, second, self.kinds[a]), (second, first, self.kinds[b])] {
            if kind.holds_fluid() && inner.lies_in(outer, periods, film) {
                return deepest(&mut inner.corners().map(|corner| (corner, outer.distance(corner, periods))));
            }
        }
        let corners = |of: &Boundary, inside: &Boundary| {
            deepest(&mut of.corners().map(|corner| (corner, -inside.distance(corner, periods))))
        };
        // Where both are the same no corner is inside the other one, but everything is.
        let both = |place: Vec2| -first.distance(place, periods).max(second.distance(place, periods));
        let inside = |of: &Boundary| deepest(&mut of.inner_places().map(|place| (place, both(place))));
        let places = [corners(first, second), corners(second, first), inside(first), inside(second)];
        deepest(&mut places.into_iter().flatten())
    }
}

impl Boundary {
    /// Returns true if the body lies inside another one, or inside one of its images: most of its corners do, some of
    /// them deeper than `film` (length).
    pub(super) fn lies_in(&self, outer: &Self, periods: Periods, film: f64) -> bool {
        let [Some(small), Some(large)] = [self, outer].map(Self::frame) else { return false };
        // A part of the inner one may have crossed.
        if !small.is_inside(&large, periods, 0.5 * small.size()) {
            return false;
        }
        let asked = || self.some_sides().map(|[start, _]| outer.distance(start, periods));
        2 * asked().filter(|distance| *distance < 0.0).count() > asked().count() && asked().any(|d| d < -film)
    }

    /// Returns the places below its sides, some of them far inside.
    fn inner_places(&self) -> impl Iterator<Item = Vec2> {
        let size = self.frame().map_or(0.0, |frame| Frame::size(&frame));
        self.some_sides().flat_map(move |[start, end]| {
            let inwards = (end - start).perp().try_normalize().unwrap_or_default();
            DEPTHS.map(|depth| 0.5 * (start + end) + size * depth * inwards)
        })
    }

    /// At most [`SIDES`] of its sides, spread over it.
    pub(super) fn some_sides(&self) -> impl Iterator<Item = [Vec2; 2]> {
        self.sides().iter().step_by(self.sides().len().div_ceil(SIDES).max(1)).copied()
    }
}

#[cfg(test)]
mod tests;
