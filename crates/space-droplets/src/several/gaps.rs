//! Gaps between droplets.

use motile_base::internal::Refuse;
use sphere_harmonics::{Harmonics, Point, count};

use super::SpaceDroplets;
use crate::SpaceError;
use crate::close::{Work, nearest, nearest_on_grid};
use crate::closest::{margin, smallest, spacing};
use crate::droplet::fields;
use crate::surface::{at, dot};
use crate::surroundings::Surroundings;

/// Distance within which a droplet looks for its own images, over its size.
const FARTHEST: f64 = 1e3;

impl SpaceDroplets {
    /// Returns the smallest gap (length) between the surfaces of two droplets or their periodic images. It is
    /// negative if they overlap. It is exact for the shapes of these degrees, also between the points of their grids.
    ///
    /// # Errors
    /// Returns an error if there are no droplets of these two numbers, or the errors of [`SpaceDroplets::evaluate`].
    pub fn gap(&mut self, first: usize, second: usize) -> Result<f64, SpaceError> {
        self.evaluate()?;
        if first.max(second) >= self.droplets.len() || first == second {
            let what = format!("there are no two droplets {first} and {second}");
            return Err(SpaceError::refused(what, "", format!("Use two numbers below {}", self.droplets.len())));
        }
        self.present_gap(first, second)
    }

    /// Returns the smallest gap (length) between a droplet and walls, all other droplets, and the periodic images of
    /// all; `None` if there is nothing else. The state is the last one that was evaluated.
    ///
    /// # Errors
    /// Returns an error if the droplet does not exist.
    pub fn smallest_gap(&self, droplet: usize) -> Result<Option<f64>, SpaceError> {
        if droplet >= self.droplets.len() {
            let what = format!("there is no droplet {droplet}");
            return Err(SpaceError::refused(what, "", format!("There are {}", self.droplets.len())));
        }
        let mut best: Option<f64> = None;
        for other in (0..self.droplets.len()).filter(|other| *other != droplet) {
            let [here, there] = [&self.sources[droplet], &self.sources[other]];
            let distance = (0..3).map(|i| (here.position[i] - there.position[i]).powi(2)).sum::<f64>().sqrt();
            // Spheres around both, for droplets that are far and have no images.
            if self.surroundings.is_some() || best.is_none_or(|best| distance - here.reach - there.reach < best) {
                let gap = self.present_gap(droplet, other)?;
                best = Some(best.map_or(gap, |best| best.min(gap)));
            }
        }
        let Some(surroundings) = self.surroundings() else { return Ok(best) };
        let gaps = [self.gap_to_walls(droplet, &**surroundings)?, self.present_gap(droplet, droplet)?];
        Ok(gaps.into_iter().filter(|gap| gap.is_finite()).chain(best).reduce(f64::min))
    }

    /// Returns the gap between a droplet that exists and the walls; infinite if there are none.
    fn gap_to_walls(&self, droplet: usize, surroundings: &dyn Surroundings) -> Result<f64, SpaceError> {
        let (here, source) = (&self.droplets[droplet], &self.sources[droplet]);
        let gap = |place: [f64; 3]| {
            let place: [f64; 3] = std::array::from_fn(|i| place[i] + source.position[i]);
            surroundings.gap(place.each_ref().map(std::slice::from_ref))
        };
        let points = here.surface.grid.points().enumerate();
        let mut starts: Vec<(Point, f64)> =
            points.map(|(k, point)| (point, gap(at(&here.surface.positions, k)))).collect();
        if starts.iter().all(|(_, gap)| *gap == f64::INFINITY) {
            return Ok(f64::INFINITY);
        }
        let positions = fields(&here.state, count(here.degree));
        let sizes = (spacing(&here.surface), margin(&here.surface, source.reach));
        smallest(positions, &mut starts, sizes, &mut Harmonics::new(here.degree)?, |place| Ok(gap(place)))
    }

    /// Returns the gap between two droplets that exist, or their periodic images; infinite for one droplet without
    /// images.
    fn present_gap(&self, first: usize, second: usize) -> Result<f64, SpaceError> {
        let (here, other) = (&self.droplets[first], &self.droplets[second]);
        let [reach, own_reach] = [self.sources[second].reach, self.sources[first].reach];
        let (mut shifts, mut work) = (Vec::new(), Work::new(other.degree)?);
        let far = self.relative(first, second, [0.0; 3]);
        let mut distance = dot(far, far).sqrt();
        self.find_shifts(second, first, distance, &mut shifts);
        while shifts.is_empty() && distance < FARTHEST * (reach + own_reach) {
            distance = 2.0 * distance.max(0.5 * (reach + own_reach));
            self.find_shifts(second, first, distance, &mut shifts);
        }
        // The gap is below the distance of points by at most this.
        let (own_margin, step) = (margin(&here.surface, own_reach), reach * spacing(&other.surface));
        let below = |distance: f64| {
            let square = distance * distance - step * step;
            (if distance > 0.0 && square > 0.0 { square.sqrt() } else { distance - step }) - own_margin
        };
        // Points of the grid, with the image's shift, the nearest point of the other grid, and their distance.
        let (mut best, mut pairs) = (f64::INFINITY, Vec::<([f64; 3], usize, Point, f64)>::new());
        for &shift in &shifts {
            // Spheres around both, and around the other one.
            let centre: [f64; 3] = std::array::from_fn(|i| far[i] - shift[i]);
            if dot(centre, centre).sqrt() - own_reach - reach > best {
                continue;
            }
            for k in 0..here.surface.weights.len() {
                let place = self.relative(first, second, at(&here.surface.positions, k));
                let place: [f64; 3] = std::array::from_fn(|i| place[i] - shift[i]);
                if dot(place, place).sqrt() - reach - own_margin > best {
                    continue;
                }
                let (start, distance) = nearest_on_grid(&other.surface, place);
                best = best.min(distance);
                pairs.push((shift, k, start, distance));
            }
        }
        pairs.retain(|(.., distance)| below(*distance) <= best);
        let positions = fields(&other.state, count(other.degree));
        let mut here_at = Harmonics::new(here.degree)?;
        let points: Vec<Point> = here.surface.grid.points().collect();
        let mut gap = f64::INFINITY;
        for &shift in &shifts {
            let moved = |place: [f64; 3]| -> [f64; 3] {
                let place = self.relative(first, second, place);
                std::array::from_fn(|i| place[i] - shift[i])
            };
            let mut starts = Vec::new();
            for (_, k, start, _) in pairs.iter().filter(|(other, ..)| *other == shift) {
                let found = nearest(positions, moved(at(&here.surface.positions, *k)), *start, &mut work.here)?;
                starts.push((points[*k], found.distance));
            }
            let function = |place: [f64; 3]| {
                let (start, _) = nearest_on_grid(&other.surface, moved(place));
                Ok(nearest(positions, moved(place), start, &mut work.here)?.distance)
            };
            let sizes = (spacing(&here.surface), own_margin);
            let own = fields(&here.state, count(here.degree));
            gap = gap.min(smallest(own, &mut starts, sizes, &mut here_at, function)?);
        }
        Ok(gap)
    }
}

#[cfg(test)]
mod tests;
