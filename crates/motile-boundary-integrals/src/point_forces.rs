//! Forces on points in unbounded fluid: regularised Stokeslets.

use std::f64::consts::PI;

use motile_base::{FlowSample, Vec2};

/// Flow of forces on points in the plane, each spread over a blob `3 a^3/(2 pi (r^2 + a^2)^(5/2))` of the radius a
/// (Cortez 2001, SIAM J. Sci. Comput. 23, 1204).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PointForces {
    /// Radius a of the blobs (length).
    pub(crate) radius: f64,
    /// Viscosity of the fluid (stress times time).
    pub(crate) viscosity: f64,
}

impl PointForces {
    /// Returns the factors `[a, b]` of the velocity `(-F a + (F . x) x b)/(4 pi eta)` at the regularised distance R.
    fn factors(&self, r: f64) -> [f64; 2] {
        let e = self.radius;
        let b = (r + 2.0 * e) / ((r + e) * (r + e) * r);
        [(r + e).ln() - e * (r + 2.0 * e) / ((r + e) * r), b]
    }

    /// Adds the velocities at points (length per time) of forces (force) at places (length).
    pub(crate) fn add_velocities(&self, places: &[Vec2], forces: &[Vec2], points: &[Vec2], velocities: &mut [Vec2]) {
        let scale = 1.0 / (4.0 * PI * self.viscosity);
        for (point, velocity) in points.iter().zip(velocities) {
            let mut sum = Vec2::ZERO;
            for (place, force) in places.iter().zip(forces) {
                let x = *point - *place;
                let [a, b] = self.factors((x.length_squared() + self.radius * self.radius).sqrt());
                sum += (b * force.dot(x)) * x - a * *force;
            }
            *velocity += scale * sum;
        }
    }

    /// Adds the flow at points of forces (force) at places (length).
    pub(crate) fn add_samples(&self, places: &[Vec2], forces: &[Vec2], points: &[Vec2], samples: &mut [FlowSample]) {
        let (e, scale) = (self.radius, 1.0 / (4.0 * PI * self.viscosity));
        for (point, sample) in points.iter().zip(samples) {
            for (place, force) in places.iter().zip(forces) {
                let x = *point - *place;
                let r = (x.length_squared() + e * e).sqrt();
                let ([a, b], pull) = (self.factors(r), force.dot(x));
                sample.velocity += scale * ((b * pull) * x - a * *force);
                sample.pressure += pull / (2.0 * PI) * (r * r + e * e + e * r) / ((r + e) * r * r * r);
                // Derivatives by R, over R.
                let da = (1.0 / (r + e) + e * (r * r + 4.0 * e * r + 2.0 * e * e) / (r * (r + e)).powi(2)) / r;
                let db = b * (1.0 / (r + 2.0 * e) - 1.0 / r - 2.0 / (r + e)) / r;
                let (at, f) = (x.to_array(), force.to_array());
                for (i, row) in sample.gradient.iter_mut().enumerate() {
                    for (k, slope) in row.iter_mut().enumerate() {
                        let along = if i == k { pull } else { 0.0 };
                        let bent = b * (f[k] * at[i] + along) + db * pull * at[i] * at[k];
                        *slope += scale * (bent - da * f[i] * at[k]);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
