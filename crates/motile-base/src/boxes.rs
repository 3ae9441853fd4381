//! Search among many items of the plane by boxes around them, and boxes around those.

use serde::{Deserialize, Serialize};

use crate::Vec2;

/// Items in a box, and boxes in a box.
const GROUP: usize = 8;
/// Fraction of a distance that may be lost to round-off in comparisons of boxes.
const ROUND_OFF: f64 = 1e-12;

/// A box with sides along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    centre: Vec2,
    half: Vec2,
}

impl Frame {
    /// Creates the smallest box around points (length).
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = Vec2>) -> Self {
        let far = Vec2::splat(f64::INFINITY);
        let extend = |(low, high): (Vec2, Vec2), point: Vec2| (low.min(point), high.max(point));
        let (low, high) = points.into_iter().fold((far, -far), extend);
        Self { centre: 0.5 * (low + high), half: 0.5 * (high - low) }
    }

    fn corners(&self) -> [Vec2; 2] {
        [self.centre - self.half, self.centre + self.half]
    }

    /// Returns the square of the distance of a point from the nearest image of the box (length squared); zero inside.
    #[inline]
    fn squared_distance(&self, point: Vec2, periods: &Periods) -> f64 {
        let from = point - self.centre;
        if periods.tilt == 0.0 { self.squared_from(periods.wrap(from)) } else { self.squared_from_rows(from, periods) }
    }

    #[inline]
    fn squared_from(&self, from: Vec2) -> f64 {
        let away = from.abs() - self.half;
        away.x.max(0.0).powi(2) + away.y.max(0.0).powi(2)
    }

    /// Returns the least over the rows of images of a sheared domain, out of the way of those that are not.
    #[cold]
    #[inline(never)]
    fn squared_from_rows(&self, from: Vec2, periods: &Periods) -> f64 {
        periods.rows(from).map(|from| self.squared_from(from)).fold(f64::INFINITY, f64::min)
    }

    /// Returns true if the distance from an image of another box is at most `reach` (length).
    #[must_use]
    pub fn is_near(&self, other: &Self, periods: impl Into<Periods>, reach: f64) -> bool {
        let grown = Self { centre: other.centre, half: self.half + other.half };
        grown.squared_distance(self.centre, &periods.into()) <= reach * reach
    }

    /// Returns true if the box lies in an image of another one that is `reach` (length) larger on all sides.
    #[must_use]
    pub fn is_inside(&self, other: &Self, periods: impl Into<Periods>, reach: f64) -> bool {
        let mut images = periods.into().rows(self.centre - other.centre);
        images.any(|between| (0..2).all(|k| between[k].abs() + self.half[k] <= other.half[k] + reach))
    }

    /// Returns the longer side (length).
    #[must_use]
    pub fn size(&self) -> f64 {
        2.0 * self.half.max_element()
    }

    /// Returns the box displaced by `by` (length).
    #[must_use]
    pub fn moved(&self, by: Vec2) -> Self {
        Self { centre: self.centre + by, half: self.half }
    }
}

/// Periods of a domain in x and y (length; `None` if there is none), the images above being displaced along x where the
/// domain is sheared.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Periods {
    /// The periods in x and y (length).
    pub lengths: [Option<f64>; 2],
    /// Displacement along x of the image above (length), at most half the period in x in size.
    pub tilt: f64,
}

impl From<[Option<f64>; 2]> for Periods {
    fn from(lengths: [Option<f64>; 2]) -> Self {
        Self { lengths, tilt: 0.0 }
    }
}

impl std::ops::Deref for Periods {
    type Target = [Option<f64>; 2];

    fn deref(&self) -> &[Option<f64>; 2] {
        &self.lengths
    }
}

impl Periods {
    /// Returns a difference of places (length) less the whole periods in it. It is the shortest of its images where
    /// these are not displaced, close to the shortest where they are.
    #[inline]
    #[must_use]
    pub fn wrap(&self, mut difference: Vec2) -> Vec2 {
        for axis in [1, 0] {
            if let Some(period) = self.lengths[axis]
                && difference[axis].abs() > 0.5 * period
            {
                let count = (difference[axis] / period).round();
                difference[axis] -= period * count;
                if axis == 1 {
                    difference.x -= self.tilt * count;
                }
            }
        }
        difference
    }

    /// Returns the wrapped difference and, in a sheared domain, those to the images below and above.
    #[inline]
    pub(crate) fn rows(&self, difference: Vec2) -> impl Iterator<Item = Vec2> + use<> {
        let nearest = self.wrap(difference);
        let height = if self.tilt == 0.0 { None } else { self.lengths[1] };
        let beside = height.map(|height| {
            let step = Vec2::new(self.tilt, height);
            let along = Self { lengths: [self.lengths[0], None], tilt: 0.0 };
            [step, -step].map(|step| along.wrap(nearest + step))
        });
        std::iter::once(nearest).chain(beside.into_iter().flatten())
    }
}

/// Returns the shortest of a difference of places and its images (length), in a domain of these periods.
#[inline]
#[must_use]
pub fn nearest_image(difference: Vec2, periods: impl Into<Periods>) -> Vec2 {
    let periods = periods.into();
    let nearest = periods.wrap(difference);
    if periods.tilt == 0.0 {
        return nearest;
    }
    let shorter = |a: Vec2, b: Vec2| if b.length_squared() < a.length_squared() { b } else { a };
    periods.rows(difference).fold(nearest, shorter)
}

/// A tree of boxes around numbered items of the plane: eight items in a box, eight boxes in a box, up to one around
/// all. It knows the items by their numbers alone, and keeps its memory when it is built again.
///
/// Of N items that are spread out, a search for the nearest one looks at O(log N), and one for all within a reach at
/// O(log N) and those that it finds. All pairs of near neighbours take O(N log N). Building takes O(N), by places O(N
/// log N).
///
/// ```
/// use motile_base::{Vec2, boxes::{BoxTree, Frame}};
///
/// let points: Vec<Vec2> = (0..1000).map(|k| Vec2::new(f64::from(k), 0.0)).collect();
/// let mut tree = BoxTree::default();
/// tree.build(points.iter().map(|&point| Frame::around([point])));
/// let (mut nearest, mut squared, mut looks) = (0, f64::INFINITY, 0);
/// let place = Vec2::new(997.2, 0.3);
/// // In a domain of period 1000 along x.
/// tree.search(place, [Some(1000.0), None], squared, &mut |item| {
///     looks += 1;
///     let found = (points[item] - place).length_squared();
///     (nearest, squared) = if found < squared { (item, found) } else { (nearest, squared) };
///     squared
/// });
/// assert_eq!(nearest, 997);
/// assert!(looks <= 16);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BoxTree {
    /// Items in the order in which they share boxes; empty if that is the order of their numbers.
    order: Vec<usize>,
    /// Boxes around [`GROUP`] items each, then around as many of these boxes, and so on.
    levels: Vec<Vec<Frame>>,
    len: usize,
}

impl BoxTree {
    /// Removes all items, keeping the memory.
    pub fn clear(&mut self) {
        self.order.clear();
        self.levels.iter_mut().for_each(Vec::clear);
        self.len = 0;
    }

    /// Takes over items of which successive ones are close to one another, such as the sides of a polygon.
    pub fn build(&mut self, mut items: impl ExactSizeIterator<Item = Frame>) {
        self.clear();
        self.len = items.len();
        self.levels.resize_with(self.levels.len().max(1), Vec::new);
        while items.len() > 0 {
            let group = items.by_ref().take(GROUP).flat_map(|item| item.corners());
            self.levels[0].push(Frame::around(group));
        }
        let mut level = 0;
        while self.levels[level].len() > 1 {
            if self.levels.len() == level + 1 {
                self.levels.push(Vec::new());
            }
            let (below, above) = self.levels.split_at_mut(level + 1);
            let groups = below[level].chunks(GROUP);
            above[0].extend(groups.map(|group| Frame::around(group.iter().flat_map(Frame::corners))));
            level += 1;
        }
        self.levels.truncate(level + 1);
    }

    /// Takes over items in any order: they are sorted along a curve that fills the plane (Morton's).
    pub fn build_by_place(&mut self, items: &[Frame]) {
        let all = Frame::around(items.iter().flat_map(Frame::corners));
        let mut order = std::mem::take(&mut self.order);
        order.clear();
        order.extend(0..items.len());
        order.sort_unstable_by_key(|&item| (morton(items[item].centre, &all), item));
        self.build(order.iter().map(|&item| items[item]));
        self.order = order;
    }

    /// Returns the box around all items; `None` without any.
    #[must_use]
    pub fn frame(&self) -> Option<Frame> {
        self.levels.last()?.first().copied()
    }

    /// Calls `look` with the items near a point, those in the nearest boxes first, over all images where there are
    /// `periods` (length, in x and y). It receives and returns the square of the distance beyond which items do not
    /// matter (length squared).
    pub fn search(&self, point: Vec2, periods: impl Into<Periods>, squared: f64, look: &mut impl FnMut(usize) -> f64) {
        let periods = &periods.into();
        if self.frame().is_some_and(|all| all.squared_distance(point, periods) <= squared) {
            self.search_in(self.levels.len() - 1, 0, (point, periods), squared, look);
        }
    }

    fn search_in(
        &self,
        level: usize,
        frame: usize,
        (point, periods): (Vec2, &Periods),
        mut squared: f64,
        look: &mut impl FnMut(usize) -> f64,
    ) -> f64 {
        let Some(below) = level.checked_sub(1) else {
            return self.items(frame).fold(squared, |_, item| look(item));
        };
        let frames = &self.levels[below];
        let range = frame * GROUP..(frame * GROUP + GROUP).min(frames.len());
        let mut away = [f64::INFINITY; GROUP];
        for (away, frame) in away.iter_mut().zip(&frames[range.clone()]) {
            *away = frame.squared_distance(point, periods);
        }
        for _ in range.clone() {
            let (next, &nearest) =
                away.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).unwrap_or((0, &f64::INFINITY));
            if nearest > squared {
                break;
            }
            away[next] = f64::INFINITY;
            squared = self.search_in(below, range.start + next, (point, periods), squared, look);
        }
        squared
    }

    /// Calls `visit` with all items whose boxes come within `reach` (length) of an image of `frame`, and with some
    /// that do not, in no particular order.
    pub fn each_near(&self, frame: &Frame, periods: impl Into<Periods>, reach: f64, visit: &mut impl FnMut(usize)) {
        let periods = &periods.into();
        if let Some(level) = self.levels.len().checked_sub(1) {
            self.near_in(level, 0..self.levels[level].len(), (frame, periods, reach), visit);
        }
    }

    fn near_in(
        &self,
        level: usize,
        range: std::ops::Range<usize>,
        (frame, periods, reach): (&Frame, &Periods, f64),
        visit: &mut impl FnMut(usize),
    ) {
        for index in range {
            let around = &self.levels[level][index];
            let slack = ROUND_OFF * (around.size() + frame.size() + (around.centre - frame.centre).length());
            if !around.is_near(frame, *periods, reach + slack) {
                continue;
            }
            match level.checked_sub(1) {
                None => self.items(index).for_each(&mut *visit),
                Some(below) => {
                    let end = (index * GROUP + GROUP).min(self.levels[below].len());
                    self.near_in(below, index * GROUP..end, (frame, periods, reach), visit);
                }
            }
        }
    }

    /// Returns the numbers of the items in a box of the lowest level.
    fn items(&self, frame: usize) -> impl Iterator<Item = usize> {
        let range = frame * GROUP..(frame * GROUP + GROUP).min(self.len);
        range.map(|place| self.order.get(place).copied().unwrap_or(place))
    }
}

/// Returns the number of the cell of a point among 2^32 cells of a frame along Morton's curve.
fn morton(point: Vec2, frame: &Frame) -> u64 {
    let from = point - (frame.centre - frame.half);
    let cell = |axis: usize| (from[axis] / frame.half[axis] * f64::from(1 << 15)) as u64;
    (0..17).map(|bit| (cell(0) >> bit & 1) << (2 * bit) | (cell(1) >> bit & 1) << (2 * bit + 1)).sum()
}

#[cfg(test)]
mod tests;
