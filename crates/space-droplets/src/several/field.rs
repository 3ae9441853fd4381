//! The flow at any points of the fluid, for pictures.

use motile_base::{
    internal::{Refuse, all_finite},
    within,
};
use sphere_harmonics::{count, evaluate};

use super::SpaceDroplets;
use crate::SpaceError;
use crate::close::{Work, add_direct, add_direct_double, nearest, nearest_on_grid};
use crate::droplet::{fields, slices};
use crate::surface::{at, dot, put, vectors};

impl SpaceDroplets {
    /// Returns the velocity of the fluid (length per time) at points of the laboratory (length), outside and inside of
    /// droplets, in the state that was evaluated last:
    ///
    /// ```text
    /// eta(x) u(x) = eta_e u_imposed(x) + SUM INT G f dA/(8 pi) + SUM (eta_e - eta_i) INT T u n dA/(8 pi)
    /// ```
    ///
    /// Close to a surface, a sum over its points has a large relative error. If it exceeds `error`, from 1e-10 to 0.1,
    /// the polar rule about the nearest point is used, as for neighbours. It takes longer: 1e-3 is enough for pictures.
    ///
    /// # Errors
    /// Returns an error if a coordinate is not finite, if the error is out of its range, or if the droplets are between
    /// walls or in a box.
    pub fn velocities_at(&self, points: &[[f64; 3]], error: f64) -> Result<Vec<[f64; 3]>, SpaceError> {
        if self.surroundings.is_some() {
            let what = "the droplets have surroundings, whose flow cannot be sampled yet";
            return Err(SpaceError::refused(what, "", "Sample the flow of droplets in unbounded fluid"));
        }
        all_finite("the points", points.as_flattened())?;
        let digits = -within("the error of velocities", error, 1e-10, 0.1)?.ln();
        if points.is_empty() {
            return Ok(Vec::new());
        }
        let outside = self.droplets[0].viscosities[1];
        let gradient = self.droplets[0].gradient;
        let mut targets = vectors(points.len());
        let mut sums = vectors(points.len());
        for (k, point) in points.iter().enumerate() {
            put(&mut targets, k, *point);
            put(&mut sums, k, std::array::from_fn(|i| outside * dot(gradient[i], *point)));
        }
        let mut viscosities = vec![outside; points.len()];
        for (from, droplet) in self.droplets.iter().enumerate() {
            let (source, n) = (&self.sources[from], count(droplet.degree));
            let [inside, _] = droplet.viscosities;
            let contrast = outside - inside;
            let threshold = digits / (4 * droplet.degree + 2) as f64 * droplet.radius;
            let (mut part, mut work, mut row) = (vectors(points.len()), Work::new(droplet.degree)?, Vec::new());
            if contrast != 0.0 {
                let layers = [&source.normals, &droplet.flow.values];
                add_direct_double(&source.places, layers, &targets, [0.0; 3], &mut part);
                part.iter_mut().flatten().for_each(|value| *value *= contrast);
            }
            add_direct(&source.places, &source.forces, &targets, [0.0; 3], &mut part);
            let [positions, velocities] = [fields(&droplet.state, n), fields(&droplet.flow.velocities, n)];
            for (k, point) in points.iter().enumerate() {
                let place: [f64; 3] = std::array::from_fn(|i| point[i] - source.position[i]);
                if dot(place, place).sqrt() > source.reach + threshold {
                    continue;
                }
                let (start, distance) = nearest_on_grid(&droplet.surface, place);
                if distance < 0.0 {
                    viscosities[k] = inside;
                }
                if distance.abs() >= threshold {
                    continue;
                }
                let found = nearest(positions, place, start, &mut work.here)?;
                viscosities[k] = if found.distance < 0.0 { inside } else { outside };
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
                put(&mut part, k, flow);
            }
            for (sums, part) in sums.iter_mut().zip(&part) {
                sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            }
        }
        Ok(viscosities.iter().enumerate().map(|(k, viscosity)| at(&sums, k).map(|sum| sum / viscosity)).collect())
    }
}

#[cfg(test)]
mod tests;
