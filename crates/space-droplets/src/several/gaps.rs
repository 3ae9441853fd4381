//! Gaps between droplets.

use motile_base::internal::Refuse;
use sphere_harmonics::{Point, count};

use super::SpaceDroplets;
use crate::SpaceError;
use crate::close::{Work, nearest, nearest_on_grid};
use crate::droplet::fields;
use crate::surface::{at, dot};
use crate::surroundings::lists;

/// Distance within which a droplet looks for its own images, over its size.
const FARTHEST: f64 = 1e3;

impl SpaceDroplets {
    /// Returns the smallest gap (length) between the surfaces of two droplets or their periodic images, from the points
    /// of the first's grid.
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
    /// all, in the state that was evaluated last; `None` if there is nothing else.
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
        let gaps = [surroundings.gap(lists(&self.sources[droplet].places)), self.present_gap(droplet, droplet)?];
        Ok(gaps.into_iter().filter(|gap| gap.is_finite()).chain(best).reduce(f64::min))
    }

    /// Returns the gap between two droplets that exist, or their periodic images; infinite for one droplet without
    /// images.
    fn present_gap(&self, first: usize, second: usize) -> Result<f64, SpaceError> {
        let (here, other) = (&self.droplets[first], &self.droplets[second]);
        let reaches = self.sources[first].reach + self.sources[second].reach;
        let (mut shifts, mut work) = (Vec::new(), Work::new(other.degree)?);
        let far = self.relative(first, second, [0.0; 3]);
        let mut distance = dot(far, far).sqrt();
        self.find_shifts(second, first, distance, &mut shifts);
        while shifts.is_empty() && distance < FARTHEST * reaches {
            distance = 2.0 * distance.max(0.5 * reaches);
            self.find_shifts(second, first, distance, &mut shifts);
        }
        // The image that is nearest, at the point of the grid that is nearest to it.
        let mut best: Option<([f64; 3], Point, f64)> = None;
        for shift in shifts {
            // Spheres around both, and around the other one.
            let centre: [f64; 3] = std::array::from_fn(|i| far[i] - shift[i]);
            if best.is_some_and(|best| dot(centre, centre).sqrt() - reaches > best.2) {
                continue;
            }
            for k in 0..here.surface.weights.len() {
                let place = self.relative(first, second, at(&here.surface.positions, k));
                let place: [f64; 3] = std::array::from_fn(|i| place[i] - shift[i]);
                if best.is_some_and(|best| dot(place, place).sqrt() - self.sources[second].reach > best.2) {
                    continue;
                }
                let (start, distance) = nearest_on_grid(&other.surface, place);
                if best.is_none_or(|best| distance < best.2) {
                    best = Some((place, start, distance));
                }
            }
        }
        let Some((place, start, _)) = best else { return Ok(f64::INFINITY) };
        let positions = fields(&other.state, count(other.degree));
        Ok(nearest(positions, place, start, &mut work.here)?.distance)
    }
}
