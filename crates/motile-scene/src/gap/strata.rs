//! Layers of fluid between interfaces that are periodic along x.
//!
//! Such interfaces lie above one another and do not cross. The fluid between two neighbours is the inside of one of
//! them, or of both, or of neither; then it is the exterior fluid.

use super::{Boundary, Surfaces};
use motile_base::{Vec2, boxes::Periods};

impl Surfaces {
    /// Sorts the interfaces that are periodic along x by their heights.
    pub(super) fn stack(&mut self) {
        let Self { strata, kinds, boundaries, .. } = self;
        strata.clear();
        strata.extend((0..kinds.len()).filter(|&body| kinds[body].advance().is_some() && !boundaries[body].is_empty()));
        strata.sort_by(|&a, &b| boundaries[a].height().total_cmp(&boundaries[b].height()));
    }

    /// Returns true if the inside of an interface that is periodic along x is above it.
    fn opens_up(&self, body: usize) -> bool {
        self.kinds[body].advance().is_some_and(|advance| advance > 0.0)
    }

    /// Returns the displacements of a body at which it is above or below the next images of an interface that is
    /// periodic along x. The value is -1 if it is then on the inner side of that one, and 1 on the outer.
    pub(super) fn images_across(
        &self,
        body: usize,
        interface: usize,
        Periods { lengths: [x, y], tilt }: Periods,
    ) -> impl Iterator<Item = (Vec2, f64)> {
        let [from, to] = [body, interface].map(|index| &self.boundaries[index]);
        let nearest = y.map_or(0.0, |y| -y * ((from.height() - to.height()) / y).round());
        let images: &[f64] = if y.is_some() { &[-1.0, 0.0, 1.0] } else { &[0.0] };
        let heights = images.iter().map(move |image| nearest + image * y.unwrap_or(0.0));
        heights.filter(move |height| body != interface || *height != 0.0).map(move |height| {
            let shift = Vec2::new(y.map_or(0.0, |y| tilt * (height / y).round()), height);
            let [inside, all] = from.some_sides().fold([0, 0], |[inside, all], [start, _]| {
                [inside + usize::from(to.distance(start + shift, [x, None]) < 0.0), all + 1]
            });
            (shift, if 2 * inside > all { -1.0 } else { 1.0 })
        })
    }

    /// How near the images of an interface that is periodic along x are to a body (length), each with its sign as in
    /// [`Surfaces::images_across`].
    fn distances_across(&self, body: usize, interface: usize, periods: Periods) -> impl Iterator<Item = (f64, f64)> {
        let [from, to] = [body, interface].map(|index| &self.boundaries[index]);
        self.images_across(body, interface, periods).map(move |(shift, sign)| {
            let distance = |[start, _]: [Vec2; 2]| to.distance(start + shift, [periods[0], None]).abs();
            (from.some_sides().map(distance).fold(f64::INFINITY, f64::min), sign)
        })
    }

    /// Returns true if a body is on the inner side of the nearest image of an interface that is periodic along x.
    pub(super) fn is_on_inner_side(&self, body: usize, interface: usize, periods: Periods) -> bool {
        let nearest = self.distances_across(body, interface, periods).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.is_some_and(|(_, sign)| sign < 0.0)
    }

    /// Returns the interface that a body lies inside of among those that are periodic along x.
    pub(super) fn stratum(&self, body: usize, periods: Periods) -> Option<usize> {
        if let Some(place) = self.strata.iter().position(|&interface| interface == body) {
            return self.owner(place, !self.opens_up(body), periods[1].is_some());
        }
        let places = self.strata.iter().enumerate().flat_map(|(place, &interface)| {
            let images = self.distances_across(body, interface, periods);
            images.map(move |(distance, sign)| (distance, place, (sign < 0.0) == self.opens_up(interface)))
        });
        let (_, place, above) = places.min_by(|a, b| a.0.total_cmp(&b.0))?;
        self.owner(place, above, periods[1].is_some())
    }

    /// Returns the place in the stack of the neighbour above or below.
    fn neighbour(&self, place: usize, above: bool, periodic: bool) -> Option<usize> {
        let count = self.strata.len();
        let next = if above { place + 1 } else { place.wrapping_sub(1) };
        if next < count {
            return Some(next);
        }
        (periodic && count > 1).then_some(if above { 0 } else { count - 1 })
    }

    /// Returns the interface that the fluid above or below another one is the inside of, the earlier one of two; `None`
    /// for the exterior fluid. If all interfaces of a box have their inside on one side, none of the fluid is exterior,
    /// and all of it has to be alike.
    fn owner(&self, place: usize, above: bool, periodic: bool) -> Option<usize> {
        let turned = |place: usize| self.opens_up(self.strata[place]);
        if periodic && (0..self.strata.len()).all(|other| turned(other) == turned(place)) {
            return None;
        }
        let own = (turned(place) == above).then_some(self.strata[place]);
        let other = self.neighbour(place, above, periodic).filter(|&next| turned(next) != above);
        own.into_iter().chain(other.map(|next| self.strata[next])).min()
    }

    /// Returns two neighbours, or one and its image, that give the fluid between them two viscosities, and these
    /// (stress times time), in exterior fluid of the given one.
    #[must_use]
    pub fn conflict(&self, periods: Periods, exterior: f64) -> Option<(usize, usize, [f64; 2])> {
        let periodic = periods[1].is_some();
        let inside = |body: usize| {
            let mut around = Some(body);
            let mut found = None;
            for _ in 0..=self.strata.len() {
                let Some(owner) = around.filter(|_| found.is_none()) else { break };
                found = self.kinds[owner].viscosity_inside();
                around = self.stratum(owner, periods);
            }
            found.unwrap_or(exterior)
        };
        let count = self.strata.len();
        (0..count).find_map(|place| {
            let body = self.strata[place];
            let alike = (0..count).all(|other| self.opens_up(self.strata[other]) == self.opens_up(body));
            let (other, viscosities) = if periodic && alike {
                (self.strata[(place + 1) % count], [inside(body), exterior])
            } else {
                let next = self.strata[self.neighbour(place, true, periodic)?];
                if !self.opens_up(body) || self.opens_up(next) {
                    return None;
                }
                (next, [body, next].map(inside))
            };
            (viscosities[0] != viscosities[1]).then_some((body, other, viscosities))
        })
    }

    /// Returns the place at which a body and an interface that is periodic along x, or two of these, have crossed
    /// furthest, and how far (length; negative where they are apart).
    pub(super) fn crossing(&self, a: usize, b: usize, periods: Periods) -> Option<(Vec2, f64)> {
        let depths = [[a, b], [b, a]].into_iter().flat_map(|[body, other]| {
            let [from, to] = [body, other].map(|index| &self.boundaries[index]);
            let open = self.kinds[other].advance().is_some();
            let closed = (!open).then_some((Vec2::ZERO, 1.0));
            let images = open.then(|| self.images_across(body, other, periods)).into_iter().flatten();
            let across = if open { [periods[0], None].into() } else { periods };
            images.chain(closed).flat_map(move |(shift, sign)| {
                from.corners().map(move |corner| (corner, -sign * to.distance(corner + shift, across)))
            })
        });
        depths.max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Boundary {
    /// Returns the mean height of some of its corners (length).
    pub(super) fn height(&self) -> f64 {
        let [sum, count] = self.some_sides().fold([0.0; 2], |[sum, count], [start, _]| [sum + start.y, count + 1.0]);
        sum / count
    }
}
