//! The repulsion between droplets.

use motile_scene::Repulsion;
use sphere_harmonics::{Harmonics, count};

use super::SpaceDroplets;
use crate::SpaceError;
use crate::close::{Nearest, nearest, nearest_on_grid};
use crate::droplet::fields;
use crate::surface::{at, dot};

impl SpaceDroplets {
    /// Adds the repulsion to the forces of all droplets.
    pub(super) fn repel(&mut self, repulsion: Repulsion) -> Result<(), SpaceError> {
        for source in &mut self.sources {
            source.pushed.iter_mut().chain(&mut source.pushes).for_each(|list| list.fill(0.0));
        }
        let mut nears = std::mem::take(&mut self.nears);
        let mut outcome = Ok(());
        for (to, near) in nears.iter_mut().enumerate() {
            for from in 0..self.droplets.len() {
                self.find_shifts(from, to, repulsion.range(), &mut near.shifts);
                outcome = outcome.and_then(|()| near.work.fit(self.droplets[from].degree).map_err(SpaceError::from));
                for &shift in &near.shifts {
                    outcome = outcome.and_then(|()| self.repel_pair(repulsion, to, (from, shift), &mut near.work.here));
                }
            }
        }
        self.nears = nears;
        outcome?;
        for (droplet, source) in self.droplets.iter_mut().zip(&mut self.sources) {
            for i in 0..3 {
                let mut coefficients = std::mem::take(&mut droplet.flow.scalar_concentration);
                droplet.surface.grid.forward(&source.pushed[i], &mut coefficients)?;
                let pushes = coefficients.iter().zip(&source.pushes[i]);
                droplet.flow.forces[i].iter_mut().zip(pushes).for_each(|(force, (a, b))| *force += a + b);
                droplet.flow.scalar_concentration = coefficients;
            }
        }
        Ok(())
    }

    /// Adds the forces between a droplet and another one, or an image of it.
    fn repel_pair(
        &mut self,
        repulsion: Repulsion,
        to: usize,
        (from, shift): (usize, [f64; 3]),
        here: &mut Harmonics,
    ) -> Result<(), SpaceError> {
        for k in 0..self.droplets[to].surface.weights.len() {
            let place = self.relative(to, from, at(&self.droplets[to].surface.positions, k));
            let place: [f64; 3] = std::array::from_fn(|i| place[i] - shift[i]);
            if dot(place, place).sqrt() >= self.sources[from].reach + repulsion.range() {
                continue;
            }
            let other = &self.droplets[from];
            let (start, distance) = nearest_on_grid(&other.surface, place);
            let spacing = 2.0 * other.radius / other.degree as f64;
            if distance.abs() > repulsion.range() + spacing {
                continue;
            }
            let found = nearest(fields(&other.state, count(other.degree)), place, start, here)?;
            self.push(repulsion, (to, k), (from, &found), here)?;
        }
        Ok(())
    }

    /// Adds the force between a point of one surface and the nearest point of another: half of the pressure, because
    /// the other surface pushes as well.
    fn push(
        &mut self,
        repulsion: Repulsion,
        (to, k): (usize, usize),
        (from, found): (usize, &Nearest),
        here: &mut Harmonics,
    ) -> Result<(), SpaceError> {
        if found.distance <= 0.0 {
            return Err(self.overlap(from, to));
        }
        let surface = &self.droplets[to].surface;
        let pressure = 0.5 * surface.area[k] * repulsion.pressure(found.distance);
        let force = found.offset.map(|x| pressure * x / found.distance);
        let weight = surface.weights[k];
        here.place(found.parameter)?;
        for (i, force) in force.into_iter().enumerate() {
            self.sources[to].pushed[i][k] += force;
            for (push, value) in self.sources[from].pushes[i].iter_mut().zip(here.values()) {
                *push -= weight * force * value;
            }
        }
        Ok(())
    }
}
