//! Circles without overlaps in a region.

use std::ops::Range;

use active_interface::internal::SplitMix64;
use motile_base::{Region, Vec2, boxes::Periods};

use super::cells::Cells;

/// Tries of a circle at a free place.
const TRIES: usize = 100;
/// Rounds in which circles that overlap are moved apart.
const ROUNDS: usize = 4000;
/// Distance to which circles are moved apart, in units of the least, so that a finite number of rounds is enough.
const MORE: f64 = 1.01;

/// A circle on its way to a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    /// Its centre (length).
    pub(super) place: Vec2,
    /// Its radius (length).
    pub(super) radius: f64,
    /// Gap that it keeps (length).
    pub(super) gap: f64,
    /// True where it stays.
    pub(super) fixed: bool,
}

impl Circle {
    /// Returns the radius with half of the gap (length).
    pub(super) fn extent(&self) -> f64 {
        self.radius + 0.5 * self.gap
    }

    /// Returns the minimum distance from the centre of another one (length).
    fn least_distance(&self, other: &Self) -> f64 {
        self.radius + other.radius + self.gap.max(other.gap)
    }
}

/// The region that circles are put into.
pub(super) struct Room {
    lengths: Vec2,
    periods: Periods,
    cells: Cells,
}

impl Room {
    /// Creates the room of a region, for these circles; the fixed ones are in it.
    pub(super) fn new(region: &Region, circles: &[Circle]) -> Self {
        let reach = circles.iter().map(|circle| 2.0 * circle.radius + circle.gap).fold(0.0, f64::max);
        let gap = circles.iter().map(|circle| circle.gap).fold(0.0, f64::max);
        let cells = Cells::new(region, reach + gap, circles.len());
        let mut room = Self { lengths: region.lengths().into(), periods: region.periods().into(), cells };
        for (number, circle) in circles.iter().enumerate().filter(|(_, circle)| circle.fixed) {
            room.cells.add(number, room.periods.wrap(circle.place));
        }
        room
    }

    /// Half of the height in which the centre of a circle may lie (length).
    fn half_height(&self, circle: &Circle) -> f64 {
        let margin = if self.periods[1].is_some() { 0.0 } else { circle.radius + circle.gap };
        0.5 * self.lengths.y - margin
    }

    /// Puts circles of these numbers at random places, the largest first, with the cells in mind.
    pub(super) fn place_at_random(&mut self, circles: &mut [Circle], own: Range<usize>, random: &mut SplitMix64) {
        let mut order: Vec<usize> = own.collect();
        order.sort_by(|&a, &b| circles[b].radius.total_cmp(&circles[a].radius));
        for number in order {
            let half = self.half_height(&circles[number]);
            for _ in 0..TRIES {
                let [x, y] = [random.uniform(), random.uniform()].map(|part| part - 0.5);
                circles[number].place = Vec2::new(x * self.lengths.x, 2.0 * y * half);
                if self.is_free(circles, number) {
                    break;
                }
            }
            self.cells.add(number, circles[number].place);
        }
    }

    fn is_free(&self, circles: &[Circle], number: usize) -> bool {
        let circle = &circles[number];
        self.cells.near(circle.place).all(|other| {
            let between = self.periods.wrap(circle.place - circles[other].place);
            between.length() >= circle.least_distance(&circles[other])
        })
    }

    /// Moves circles apart until each has its gap from any other one and from walls; false if that fails.
    pub(super) fn move_apart(&mut self, circles: &mut [Circle]) -> bool {
        (0..ROUNDS).any(|_| self.round(circles))
    }

    /// Moves apart once each two circles that overlap; true if none did.
    fn round(&mut self, circles: &mut [Circle]) -> bool {
        let mut apart = true;
        self.cells.clear();
        for (number, circle) in circles.iter_mut().enumerate() {
            if !circle.fixed {
                circle.place = self.periods.wrap(circle.place);
                let half = self.half_height(circle);
                if self.periods[1].is_none() {
                    apart &= circle.place.y.abs() <= half * (1.0 + 1e-12);
                    circle.place.y = circle.place.y.clamp(-half, half);
                }
            }
            self.cells.add(number, self.periods.wrap(circle.place));
        }
        for number in 0..circles.len() {
            for other in self.cells.near(self.periods.wrap(circles[number].place)) {
                let [one, two] = [circles[number], circles[other]];
                if other >= number || (one.fixed && two.fixed) {
                    continue;
                }
                let between = self.periods.wrap(one.place - two.place);
                let (distance, least) = (between.length(), one.least_distance(&two));
                if distance < least {
                    apart = false;
                    let direction = if distance > 0.0 { between / distance } else { Vec2::X };
                    let step = direction * (MORE * least - distance);
                    let part = if one.fixed || two.fixed { 1.0 } else { 0.5 };
                    if !one.fixed {
                        circles[number].place += part * step;
                    }
                    if !two.fixed {
                        circles[other].place -= part * step;
                    }
                }
            }
        }
        apart
    }
}
