//! The boundary of a body, and distances to it.

use motile_base::{
    Vec2,
    boxes::{BoxTree, Frame, Periods, nearest_image},
};

/// The boundary of a body: straight sides in any order, each with the inside of the body to its left.
///
/// Signed distances are exact, at corners too, and found by looking at few of the sides: [`Boundary::sort`] builds a
/// [`BoxTree`] of them.
///
/// ```
/// use motile_base::Vec2;
/// use motile_scene::gap::Boundary;
///
/// let mut square = Boundary::default();
/// square.push_loop(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y)));
/// square.sort();
/// let plane = [None, None];
/// assert_eq!(square.distance(Vec2::new(5.0, 6.0), plane), 5.0);
/// assert_eq!(square.distance(Vec2::new(1.5, 1.0), plane), -0.5);
/// // in a box of period 5, by way of the next image
/// assert_eq!(square.distance(Vec2::new(4.0, 1.0), [Some(5.0), None]), 1.0);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Boundary {
    sides: Vec<[Vec2; 2]>,
    tree: BoxTree,
}

/// Squared distances that differ by less than this part are equal.
const TIE: f64 = 1e-12;

/// The nearest place of a boundary so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest {
    squared: f64,
    /// Distance from the line through the side, positive outside.
    height: f64,
    /// Number of the side.
    pub(super) side: usize,
    /// How far along it the place is, from 0 at its start to 1 at its end.
    pub(super) part: f64,
    /// From there to the point (length).
    pub(super) away: Vec2,
}

impl Nearest {
    /// Looks at a side, and where it is so long that another image of it may be nearer, at that too.
    #[inline]
    fn look(&mut self, number: usize, side: &[Vec2; 2], point: Vec2, periods: Periods) {
        let along = side[1] - side[0];
        let from_middle = nearest_image(point - 0.5 * (side[0] + side[1]), periods);
        let other = |k: usize| {
            let period = periods[k]?;
            (from_middle[k].abs() + 0.5 * along[k].abs() > 0.5 * period).then(|| -period.copysign(from_middle[k]))
        };
        if periods.tilt != 0.0 {
            return self.look_at_rows(number, along, from_middle, periods);
        }
        let [x, y] = [other(0), other(1)];
        for dx in [Some(0.0), x].into_iter().flatten() {
            for dy in [Some(0.0), y].into_iter().flatten() {
                self.look_at(number, along, from_middle + Vec2::new(dx, dy));
            }
        }
    }

    /// Looks at the images of a side in a sheared domain, out of the way of domains that are not.
    #[cold]
    #[inline(never)]
    fn look_at_rows(&mut self, number: usize, along: Vec2, from_middle: Vec2, periods: Periods) {
        let row = |k: f64| Vec2::new(k * periods.tilt, k * periods[1].unwrap_or(0.0));
        for shift in [row(0.0), row(1.0), row(-1.0)] {
            let from = Periods { lengths: [periods[0], None], tilt: 0.0 }.wrap(from_middle + shift);
            let step = periods[0].unwrap_or(0.0);
            [0.0, step, -step].into_iter().for_each(|x| self.look_at(number, along, from + Vec2::new(x, 0.0)));
        }
    }

    /// Looks at a straight side along `along`, from whose middle the point is `from_middle` away.
    fn look_at(&mut self, side: usize, along: Vec2, from_middle: Vec2) {
        let length = along.length_squared();
        if length == 0.0 {
            return;
        }
        let part = (from_middle.dot(along) / length).clamp(-0.5, 0.5);
        let away = from_middle - part * along;
        let squared = away.length_squared();
        let height = from_middle.perp_dot(along) / length.sqrt();
        // At a corner both sides are equally far; the one that the point stands more upright on says whether it is
        // inside.
        let tie = self.squared.is_finite() && (squared - self.squared).abs() <= TIE * (squared + self.squared);
        if (tie && height.abs() > self.height.abs()) || (!tie && squared < self.squared) {
            *self = Self { squared, height, side, part: part + 0.5, away };
        }
    }

    /// Returns the signed distance (length). What is on a side has no height and is at no distance.
    pub(super) fn distance(&self) -> f64 {
        self.squared.sqrt().copysign(self.height)
    }
}

impl Boundary {
    /// Adds a side from `start` to `end` (length), the inside to its left.
    pub fn push(&mut self, start: Vec2, end: Vec2) {
        self.sides.push([start, end]);
    }

    /// Adds the closed polygon through `points`, counter-clockwise around the inside.
    pub fn push_loop(&mut self, points: &[Vec2]) {
        let next = points.iter().cycle().skip(1);
        self.sides.extend(points.iter().zip(next).map(|(&start, &end)| [start, end]));
    }

    /// Removes all sides, keeping the memory.
    pub fn clear(&mut self) {
        self.sides.clear();
        self.tree.clear();
    }

    /// Returns true without sides.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.sides.is_empty()
    }

    /// Prepares for questions after sides have been added.
    pub fn sort(&mut self) {
        self.tree.build(self.sides.iter().map(|&side| Frame::around(side)));
    }

    /// Returns the box around all of it; `None` without sides.
    pub(crate) fn frame(&self) -> Option<Frame> {
        self.tree.frame()
    }

    /// Returns the sides, each with its start and end.
    #[must_use]
    pub fn sides(&self) -> &[[Vec2; 2]] {
        &self.sides
    }

    /// Returns the longest side (length).
    pub(super) fn longest_side(&self) -> f64 {
        self.sides.iter().map(|[start, end]| (end - start).length()).fold(0.0, f64::max)
    }

    /// Returns the places where the sides start (length): the corners of closed polygons.
    pub fn corners(&self) -> impl Iterator<Item = Vec2> {
        self.sides.iter().map(|[start, _]| *start)
    }

    /// Returns the signed distance of `point` from the boundary (length), over all images where there are `periods`
    /// (length, in x and y). It is negative inside the body, infinite without sides, not a number for a point that is
    /// not finite.
    #[must_use]
    pub fn distance(&self, point: Vec2, periods: impl Into<Periods>) -> f64 {
        self.distance_if_within(point, periods.into(), f64::INFINITY).unwrap_or(f64::INFINITY)
    }

    /// Returns the signed distance if its magnitude is below `reach` (length); see [`Boundary::distance`].
    pub(crate) fn distance_within(&self, point: Vec2, periods: impl Into<Periods>, reach: f64) -> Option<f64> {
        self.nearest_within(point, periods, reach).map(|found| found.distance())
    }

    /// Returns the nearest place to `point` below `reach` (length).
    pub(super) fn nearest_within(&self, point: Vec2, periods: impl Into<Periods>, reach: f64) -> Option<Nearest> {
        let periods = periods.into();
        let mut found = Nearest { squared: reach * reach, height: 0.0, side: 0, part: 0.0, away: Vec2::ZERO };
        self.tree.search(point, periods, found.squared, &mut |side| {
            found.look(side, &self.sides[side], point, periods);
            // Sides that are equally far may say more of the sign.
            found.squared * (1.0 + 4.0 * TIE)
        });
        (found.squared < reach * reach).then_some(found)
    }

    /// Returns the smallest signed distance of points, such as the markers of an interface, and the number of that
    /// point; `None` without points or sides.
    #[must_use]
    pub fn smallest(&self, points: &[Vec2], periods: impl Into<Periods>) -> Option<(f64, usize)> {
        let periods = periods.into();
        let within = |point, reach| self.distance_if_within(point, periods, reach);
        smallest(points.iter().copied(), within).filter(|_| !self.is_empty())
    }

    /// As [`Boundary::distance_within`], not a number for a point that is not finite.
    pub(super) fn distance_if_within(&self, point: Vec2, periods: Periods, reach: f64) -> Option<f64> {
        let finite = point.x.is_finite() && point.y.is_finite();
        if finite { self.distance_within(point, periods, reach) } else { Some(f64::NAN) }
    }
}

/// Returns the smallest signed distance of points from boundaries, `within(point, reach)` where its magnitude is below
/// `reach`, and the number of that point.
pub(super) fn smallest(
    points: impl Iterator<Item = Vec2>,
    within: impl Fn(Vec2, f64) -> Option<f64>,
) -> Option<(f64, usize)> {
    let mut smallest: Option<(f64, usize)> = None;
    // The last point, if it is outside.
    let mut outside: Option<Vec2> = None;
    for (number, point) in points.enumerate() {
        let reach = match (smallest, outside) {
            // Nearer than twice the least distance to a point outside that is as far or farther: if this one is as far
            // it is outside too, as the line between the two does not reach the boundary.
            (Some((least, _)), Some(last)) if (point - last).length() < 2.0 * least => least,
            _ => f64::INFINITY,
        };
        let distance = within(point, reach);
        if let Some(distance) = distance
            && smallest.is_none_or(|(least, _)| distance.total_cmp(&least).is_lt())
        {
            smallest = Some((distance, number));
        }
        outside = distance.is_none_or(|distance| distance > 0.0).then_some(point);
    }
    smallest
}

/// Returns the displacements of an interface at which it is compared with a boundary: for one of another body its place
/// (that body's nearest image is looked for), and for its own, the places of its images.
pub(super) fn shifts(periods: Periods, own: bool) -> [Option<Vec2>; 4] {
    if !own {
        return [Some(Vec2::ZERO), None, None, None];
    }
    let Periods { lengths: [x, y], tilt } = periods;
    let both = x.zip(y);
    [
        x.map(|x| Vec2::new(x, 0.0)),
        y.map(|y| Vec2::new(tilt, y)),
        both.map(|(x, y)| Vec2::new(x + tilt, y)),
        both.map(|(x, y)| Vec2::new(x - tilt, -y)),
    ]
}

#[cfg(test)]
mod tests;
