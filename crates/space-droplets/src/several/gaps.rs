//! Gaps between droplets.

use motile_base::internal::Refuse;
use sphere_harmonics::{Point, count};

use super::SpaceDroplets;
use crate::SpaceError;
use crate::close::{Work, nearest, nearest_on_grid};
use crate::droplet::fields;
use crate::surface::{at, dot};

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

    /// Returns the smallest gap (length) between a droplet and all others in the state that was evaluated last; `None`
    /// if there is no other one.
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
        Ok(best)
    }

    /// Returns the gap between two droplets that exist, or their periodic images.
    fn present_gap(&self, first: usize, second: usize) -> Result<f64, SpaceError> {
        let (here, other) = (&self.droplets[first], &self.droplets[second]);
        let (mut shifts, mut work) = (Vec::new(), Work::new(other.degree)?);
        let far = self.relative(first, second, [0.0; 3]);
        self.find_shifts(second, first, dot(far, far).sqrt(), &mut shifts);
        // The image that is nearest, at the point of the grid that is nearest to it.
        let mut best: Option<([f64; 3], Point, f64)> = None;
        for shift in shifts {
            for k in 0..here.surface.weights.len() {
                let place = self.relative(first, second, at(&here.surface.positions, k));
                let place = std::array::from_fn(|i| place[i] - shift[i]);
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
