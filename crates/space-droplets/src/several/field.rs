//! The flow at any points of the fluid, for pictures.

use std::sync::PoisonError;

use motile_base::{internal::all_finite, within};
use sphere_harmonics::{count, evaluate};

use super::SpaceDroplets;
use crate::SpaceError;
use crate::close::{Work, add_direct, add_direct_double, nearest, nearest_on_grid};
use crate::droplet::{fields, slices};
use crate::layers::Vectors;
use crate::surface::{at, dot, put, vectors};
use crate::surroundings::{Source, Sources, Targets, add_imposed, lists, lists_mut};

impl SpaceDroplets {
    /// Returns the velocity of the fluid (length per time) at points of the laboratory (length), outside and inside of
    /// droplets, in the state that was evaluated last:
    ///
    /// ```text
    /// eta(x) u(x) = eta_e u_imposed(x) + SUM INT G f dA/(8 pi) + SUM (eta_e - eta_i) INT T u n dA/(8 pi)
    /// ```
    ///
    /// Between walls and in a box, the flow that the surroundings add comes to it. Beyond walls, the velocity is zero.
    ///
    /// Close to a surface, a sum over its points has a large relative error. If it exceeds `error`, from 1e-10 to 0.1,
    /// the polar rule about the nearest point is used, as for neighbours. It takes longer: 1e-3 is enough for pictures.
    /// Walls reflect the sums over points. Next to a wall at the gap d from a droplet of radius R and degree p, the
    /// velocity is off by about `exp(-(4 p + 2) d/R)`.
    ///
    /// # Errors
    /// Returns an error if a coordinate is not finite, if the error is out of its range, or if the points are too far
    /// from the droplets along walls.
    pub fn velocities_at(&self, points: &[[f64; 3]], error: f64) -> Result<Vec<[f64; 3]>, SpaceError> {
        all_finite("the points", points.as_flattened())?;
        let digits = -within("the error of velocities", error, 1e-10, 0.1)?.ln();
        let mut found = vec![[0.0; 3]; points.len()];
        // Beyond walls, nothing flows.
        let in_fluid = |place: &[f64; 3]| {
            self.surroundings().is_none_or(|around| around.gap(place.each_ref().map(std::slice::from_ref)) >= 0.0)
        };
        let kept: Vec<usize> = (0..points.len()).filter(|&k| in_fluid(&points[k])).collect();
        if kept.is_empty() {
            return Ok(found);
        }
        let points = kept.iter().map(|&k| self.next_to_droplet(points[k], digits));
        let points = points.collect::<Vec<[f64; 3]>>();
        let outside = self.droplets[0].viscosities[1];
        let gradient = self.droplets[0].gradient;
        let mut targets = vectors(points.len());
        let mut sums = vectors(points.len());
        for (k, point) in points.iter().enumerate() {
            put(&mut targets, k, *point);
            put(&mut sums, k, std::array::from_fn(|i| outside * dot(gradient[i], *point)));
        }
        let mut viscosities = vec![outside; points.len()];
        let (mut shifts, mut one, mut plain) = (Vec::new(), vectors(1), vectors(1));
        for (from, droplet) in self.droplets.iter().enumerate() {
            let (source, n) = (&self.sources[from], count(droplet.degree));
            let [inside, _] = droplet.viscosities;
            let contrast = outside - inside;
            let threshold = self.threshold(from, digits);
            let (mut part, mut work, mut row) = (vectors(points.len()), Work::new(droplet.degree)?, Vec::new());
            if contrast != 0.0 {
                let layers = [&source.normals, &droplet.flow.values];
                add_direct_double(&source.places, layers, &targets, [0.0; 3], &mut part);
                part.iter_mut().flatten().for_each(|value| *value *= contrast);
            }
            add_direct(&source.places, &source.forces, &targets, [0.0; 3], &mut part);
            let [positions, velocities] = [fields(&droplet.state, n), fields(&droplet.flow.velocities, n)];
            for (k, point) in points.iter().enumerate() {
                self.find_copies(from, *point, source.reach + threshold, &mut shifts);
                for &shift in &shifts {
                    let place: [f64; 3] = std::array::from_fn(|i| point[i] - source.position[i] - shift[i]);
                    if dot(place, place).sqrt() > source.reach + threshold {
                        continue;
                    }
                    let (start, distance) = nearest_on_grid(&droplet.surface, place);
                    if distance.abs() >= threshold {
                        if distance < 0.0 {
                            viscosities[k] = inside;
                        }
                        continue;
                    }
                    let found = nearest(positions, place, start, &mut work.here)?;
                    if found.distance < 0.0 {
                        viscosities[k] = inside;
                    }
                    let forces = slices(&droplet.flow.forces);
                    let mut flow = self.close[from].single(positions, forces, place, &found, &mut work)?;
                    if contrast != 0.0 {
                        let normals = slices(&droplet.flow.normals);
                        self.close[from].double_row(positions, normals, place, &found, &mut work, &mut row)?;
                        let [x, y, z] = velocities;
                        for (k, [xx, xy, xz, yy, yz, zz]) in row.iter().enumerate() {
                            flow[0] += contrast * (xx * x[k] + xy * y[k] + xz * z[k]);
                            flow[1] += contrast * (xy * x[k] + yy * y[k] + yz * z[k]);
                            flow[2] += contrast * (xz * x[k] + yz * y[k] + zz * z[k]);
                        }
                        if found.distance < 0.0 {
                            // The row is for the difference to the velocity at the nearest point.
                            for (flow, field) in flow.iter_mut().zip(velocities) {
                                *flow -= contrast * evaluate(field, found.parameter)?;
                            }
                        }
                    }
                    if shift != [0.0; 3] {
                        // The surroundings sum the image over the grid: the flow takes the place of this sum.
                        put(&mut one, 0, *point);
                        plain.iter_mut().for_each(|list| list.fill(0.0));
                        let origin = shift.map(|x| -x);
                        if contrast != 0.0 {
                            let layers = [&source.normals, &droplet.flow.values];
                            add_direct_double(&source.places, layers, &one, origin, &mut plain);
                            plain.iter_mut().flatten().for_each(|value| *value *= contrast);
                        }
                        add_direct(&source.places, &source.forces, &one, origin, &mut plain);
                        let (before, sum) = (at(&part, k), at(&plain, 0));
                        flow = std::array::from_fn(|i| before[i] + flow[i] - sum[i]);
                    }
                    put(&mut part, k, flow);
                }
            }
            for (sums, part) in sums.iter_mut().zip(&part) {
                sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            }
        }
        self.add_surroundings(&targets, &mut sums)?;
        for (k, viscosity) in viscosities.iter().enumerate() {
            found[kept[k]] = at(&sums, k).map(|sum| sum / viscosity);
        }
        Ok(found)
    }

    /// Returns the distance from a droplet (length) below which a sum over its points is too coarse.
    fn threshold(&self, droplet: usize, digits: f64) -> f64 {
        let droplet = &self.droplets[droplet];
        digits / (4 * droplet.degree + 2) as f64 * droplet.radius
    }

    /// Lists the shifts to a droplet, which is first, and to its images that may come within a distance of a point.
    fn find_copies(&self, droplet: usize, point: [f64; 3], distance: f64, shifts: &mut Vec<[f64; 3]>) {
        shifts.clear();
        shifts.push([0.0; 3]);
        if let Some(surroundings) = self.surroundings() {
            let position = self.sources[droplet].position;
            let displacement = std::array::from_fn(|i| position[i] - point[i]);
            surroundings.images(displacement, distance, &mut |shift| shifts.push(shift));
        }
    }

    /// Returns the place with the same flow next to a droplet, for a point next to one of its images.
    fn next_to_droplet(&self, point: [f64; 3], digits: f64) -> [f64; 3] {
        let (mut shifts, mut best) = (Vec::new(), ([0.0; 3], f64::INFINITY));
        for (k, (droplet, source)) in self.droplets.iter().zip(&self.sources).enumerate() {
            let reach = source.reach + self.threshold(k, digits);
            self.find_copies(k, point, reach, &mut shifts);
            for &shift in &shifts {
                let place: [f64; 3] = std::array::from_fn(|i| point[i] - source.position[i] - shift[i]);
                if dot(place, place).sqrt() < reach && (shifts.len() > 1 || best.0 != [0.0; 3]) {
                    let (_, distance) = nearest_on_grid(&droplet.surface, place);
                    if distance.abs() < best.1 {
                        best = (shift, distance.abs());
                    }
                }
            }
        }
        std::array::from_fn(|i| point[i] - best.0[i])
    }

    /// Adds the flow of the surroundings, times the viscosity, at targets.
    fn add_surroundings(&self, targets: &Vectors, flow: &mut Vectors) -> Result<(), SpaceError> {
        let Some(surroundings) = &self.surroundings else { return Ok(()) };
        let mut surroundings = surroundings.write().unwrap_or_else(PoisonError::into_inner);
        add_imposed(&**surroundings, self.droplets[0].viscosities[1], targets, flow);
        let differences = self.droplets.iter().map(|droplet| {
            let [inside, outside] = droplet.viscosities;
            let scaled = |values: &Vec<f64>| values.iter().map(|value| (outside - inside) * value).collect();
            (inside != outside).then(|| droplet.flow.values.each_ref().map(scaled))
        });
        let differences: Vec<Option<Vectors>> = differences.collect();
        let mut all: Vec<Sources<'_>> = self.sources.iter().map(Source::forces).collect();
        for (source, velocities) in self.sources.iter().zip(&differences) {
            let [places, normals] = [&source.places, &source.normals].map(lists);
            let stresslets = |velocities| Sources::Stresslets { places, normals, velocities: lists(velocities) };
            all.extend(velocities.as_ref().map(stresslets));
        }
        surroundings.add_flow(&all, &mut [Targets { places: lists(targets), flow: lists_mut(flow) }])
    }
}

#[cfg(test)]
mod tests;
