//! Distances to the surfaces of solids.

use ib_core::Vec2;

use crate::error::{all_points_finite, at_least};
use crate::{Solid, SolidError};

/// A straight part of a surface, the solid to its left, with the outward normals (not of unit length) of the corners at
/// its ends.
#[derive(Debug, Clone, Copy)]
struct Side {
    from: Vec2,
    to: Vec2,
    normals: [Vec2; 2],
}

/// Signed distances from points to the surfaces of solids: positive in the fluid, negative inside a solid.
///
/// To be refilled when the solids have moved. Surfaces are sorted by x, so that a distance takes a look at few of them.
///
/// ```
/// use elastic_solids::mesh::equilateral_strip;
/// use elastic_solids::solid::SurfaceGap;
/// use elastic_solids::{Solid, SolidError};
/// use ib_core::Vec2;
///
/// let wall = Solid::springs(equilateral_strip(Vec2::zeros(), 20, 10, 0.1)?, 1.0)?;
/// let mut gap = SurfaceGap::new(Some(2.0));
/// gap.add(&wall)?;
/// gap.sort();
/// let top = 0.75_f64.sqrt();
/// assert!((gap.at(Vec2::new(7.3, top + 0.2)) - 0.2).abs() < 1e-12);
/// assert!((gap.at(Vec2::new(-1.0, top - 0.2)) + 0.2).abs() < 1e-12);
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SurfaceGap {
    period: Option<f64>,
    sides: Vec<Side>,
    /// Numbers of the sides over each interval of x, one list after another.
    listed: Vec<u32>,
    /// Where the list of each interval starts; one more than there are intervals.
    starts: Vec<usize>,
    left: f64,
    width: f64,
}

impl SurfaceGap {
    /// No surfaces yet, in a domain with this period in x (length), or without one.
    #[must_use]
    pub fn new(period: Option<f64>) -> Self {
        Self { period, sides: Vec::new(), listed: Vec::new(), starts: vec![0, 0], left: 0.0, width: 1.0 }
    }

    /// Forgets all surfaces, keeping the memory.
    pub fn clear(&mut self) {
        self.sides.clear();
    }

    /// Adds the surface of a solid where it is now. [`SurfaceGap::sort`] ends the additions.
    ///
    /// # Errors
    /// Positions that are not finite.
    pub fn add(&mut self, solid: &Solid) -> Result<(), SolidError> {
        all_points_finite("the positions of a solid", solid.positions())?;
        for boundary in solid.mesh().boundary_loops() {
            let polygon = solid.mesh().boundary_polygon(boundary, solid.positions());
            let advance = f64::from(boundary.periods) * solid.mesh().period().unwrap_or(0.0);
            self.add_loop(&polygon, Vec2::new(advance, 0.0));
        }
        Ok(())
    }

    /// A loop whose end is `advance` ahead of its start.
    fn add_loop(&mut self, polygon: &[Vec2], advance: Vec2) {
        let count = polygon.len();
        let corner = |k: usize| polygon[k % count] + advance * (k / count) as f64;
        let outward = |k: usize| {
            let along = (corner(k + 1) - corner(k)).try_normalize(0.0).unwrap_or_else(Vec2::zeros);
            Vec2::new(along.y, -along.x)
        };
        for k in 0..count {
            let normals = [outward(k + count - 1) + outward(k), outward(k) + outward(k + 1)];
            self.sides.push(Side { from: corner(k), to: corner(k + 1), normals });
        }
    }

    /// Sorts the surfaces by x. Until then distances are to what was sorted before.
    pub fn sort(&mut self) {
        let ends = || self.sides.iter().flat_map(|side| [side.from.x, side.to.x]);
        let (low, high) = ends().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let extent = self.period.unwrap_or(high - low);
        let intervals = (self.sides.len() / 4).clamp(1, 4096);
        self.left = if low.is_finite() { low } else { 0.0 };
        self.width = if extent > 0.0 && extent.is_finite() { extent / intervals as f64 } else { 1.0 };
        let mut counts = vec![0_usize; intervals + 1];
        for side in &self.sides {
            for interval in self.intervals_of(side, intervals) {
                counts[interval + 1] += 1;
            }
        }
        for k in 0..intervals {
            counts[k + 1] += counts[k];
        }
        self.listed.clear();
        self.listed.resize(counts[intervals], 0);
        let mut next = counts.clone();
        for (number, side) in self.sides.iter().enumerate() {
            for interval in self.intervals_of(side, intervals) {
                self.listed[next[interval]] = number as u32;
                next[interval] += 1;
            }
        }
        self.starts = counts;
    }

    fn intervals_of(&self, side: &Side, intervals: usize) -> impl Iterator<Item = usize> + use<> {
        let [low, high] = [side.from.x.min(side.to.x), side.from.x.max(side.to.x)]
            .map(|x| ((x - self.left) / self.width).floor() as i64);
        let (count, periodic) = (intervals as i64, self.period.is_some());
        let last = high.min(low + count - 1);
        (low..=last).map(move |k| if periodic { k.rem_euclid(count) } else { k.clamp(0, count - 1) } as usize)
    }

    /// The signed distance of a point from the nearest surface (length): negative inside a solid, infinite without
    /// surfaces.
    #[must_use]
    pub fn at(&self, point: Vec2) -> f64 {
        let count = (self.starts.len() - 1) as i64;
        let home = ((point.x - self.left) / self.width).floor();
        let mut nearest = Nearest { squared: f64::INFINITY, ..Nearest::default() };
        // Intervals from the point outwards, until they are further away than what has been found.
        let home_interval = if self.period.is_some() { home } else { home.clamp(0.0, count as f64 - 1.0) } as i64;
        for ring in 0..count {
            let reach = (ring - 1).max(0) as f64 * self.width;
            if reach * reach > nearest.squared || (self.period.is_some() && 2 * ring > count) {
                break;
            }
            for interval in [home_interval - ring, home_interval + ring] {
                let stored = if self.period.is_some() { interval.rem_euclid(count) } else { interval };
                if !(0..count).contains(&stored) || (ring == 0 && interval != home_interval) {
                    continue;
                }
                let stored = stored as usize;
                for &number in &self.listed[self.starts[stored]..self.starts[stored + 1]] {
                    nearest.consider(&self.sides[number as usize], self.image(point, number));
                }
                if ring == 0 {
                    break;
                }
            }
        }
        nearest.squared.sqrt() * if nearest.inside { -1.0 } else { 1.0 }
    }

    /// The image of a point nearest to a side.
    fn image(&self, point: Vec2, number: u32) -> Vec2 {
        let side = &self.sides[number as usize];
        let periods =
            self.period.map_or(0.0, |period| period * ((point.x - 0.5 * (side.from.x + side.to.x)) / period).round());
        Vec2::new(point.x - periods, point.y)
    }

    /// The smallest signed distance of points, such as the markers of an interface, and the number of that point.
    ///
    /// # Errors
    /// No points, or points that are not finite.
    pub fn smallest(&self, points: &[Vec2]) -> Result<(f64, usize), SolidError> {
        at_least("points", points.len(), 1)?;
        all_points_finite("the points", points)?;
        let gaps = points.iter().enumerate().map(|(number, &point)| (self.at(point), number));
        Ok(gaps.fold((f64::INFINITY, 0), |least, this| if this.0 < least.0 { this } else { least }))
    }
}

/// The nearest place of a surface so far.
#[derive(Debug, Clone, Copy, Default)]
struct Nearest {
    squared: f64,
    inside: bool,
}

impl Nearest {
    fn consider(&mut self, side: &Side, point: Vec2) {
        let (along, from) = (side.to - side.from, point - side.from);
        let length = along.norm_squared();
        let fraction = if length > 0.0 { (from.dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let away = from - along * fraction;
        let squared = away.norm_squared();
        if squared < self.squared {
            // At a corner the two sides that meet there decide together.
            let outward = if fraction == 0.0 {
                side.normals[0]
            } else if fraction == 1.0 {
                side.normals[1]
            } else {
                Vec2::new(along.y, -along.x)
            };
            *self = Self { squared, inside: away.dot(&outward) < 0.0 };
        }
    }
}

#[cfg(test)]
mod tests;
