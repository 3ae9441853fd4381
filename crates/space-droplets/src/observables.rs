//! Measurements of a droplet.

use nalgebra::Matrix3;
use sphere_harmonics::{Point, count, evaluate};

use crate::surface::{at, dot};
use crate::{SpaceDroplet, SpaceError};

/// Measurements of a droplet whose flow is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Time (time).
    pub time: f64,
    /// Centroid in the laboratory (length).
    pub position: [f64; 3],
    /// Velocity of the centroid (length per time).
    pub velocity: [f64; 3],
    /// Speed (length per time).
    pub speed: f64,
    /// Unit vector along the velocity; zero for a droplet at rest.
    pub heading: [f64; 3],
    /// Volume (length cubed).
    pub volume: f64,
    /// Area (length squared).
    pub area: f64,
    /// Semi-axes of the ellipsoid with the same second moments of the volume, largest first (length).
    pub semi_axes: [f64; 3],
    /// Number of particles.
    pub particles: f64,
    /// Smallest and largest concentration on the grid (particles per area).
    pub concentrations: [f64; 2],
    /// First moments of the forces on the fluid, `INT f_i x_j dA` (force times length).
    pub force_moments: [[f64; 3]; 3],
    /// Stresslet of the far field: the symmetric traceless part of the force moments and, for two viscosities, of
    /// `-(eta_in - eta_out) INT (u_i n_j + u_j n_i) dA` (force times length).
    pub stresslet: [[f64; 3]; 3],
    /// Total force and torque on the fluid, which are zero to round-off if no repulsion acts.
    pub force_and_torque: [[f64; 3]; 2],
    /// Size of the two highest degrees over all of degree 1 and more, of the positions and of the particles.
    pub tails: [f64; 2],
}

/// Tail of the particles above which the degree is too low.
const LARGE_TAIL: f64 = 3e-2;
/// Tail of the shape above which the degree is too low.
const LARGE_SHAPE_TAIL: f64 = 1e-2;
/// Undershoot of the concentration, over its maximum, that is not round-off.
const UNDERSHOOT: f64 = 1e-6;

impl SpaceDroplet {
    /// Returns all measurements of the present state, and computes its flow if it is not known.
    ///
    /// # Errors
    /// Returns the errors of [`SpaceDroplet::evaluate`].
    pub fn observe(&mut self) -> Result<Observation, SpaceError> {
        self.evaluate()?;
        Ok(self.measured())
    }

    /// Returns all measurements of the state that was evaluated last.
    pub(crate) fn measured(&self) -> Observation {
        let n = count(self.degree);
        let (surface, flow) = (&self.surface, &self.flow);
        let velocity = flow.velocity;
        let speed = dot(velocity, velocity).sqrt();
        let volume = surface.volume();
        let centroid = surface.centroid(volume);
        let fold = |start: f64, pick: fn(f64, f64) -> f64| flow.concentrations.iter().copied().fold(start, pick);
        // Forces and positions have the same degree: the integral is the product of coefficients.
        let moment = |i: usize, j: usize| dot_lists(&flow.forces[i], &self.state[j * n..(j + 1) * n]);
        let force_moments: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| moment(i, j)));
        let contrast = self.viscosities[0] - self.viscosities[1];
        let stretch = |i: usize, j: usize| surface.integral(|k| flow.values[i][k] * surface.normals[j][k]);
        let full = |i: usize, j: usize| 0.5 * force_moments[i][j] - contrast * stretch(i, j);
        let full: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| full(i, j)));
        let trace = 2.0 * (full[0][0] + full[1][1] + full[2][2]) / 3.0;
        let stresslet = |i: usize, j: usize| full[i][j] + full[j][i] - if i == j { trace } else { 0.0 };
        let net = (4.0 * std::f64::consts::PI).sqrt();
        let twist = |i: usize, j: usize| force_moments[i][j] - force_moments[j][i];
        Observation {
            time: self.time,
            position: std::array::from_fn(|i| self.state[4 * n + i] + centroid[i]),
            velocity,
            speed,
            heading: if speed > 0.0 { velocity.map(|v| v / speed) } else { [0.0; 3] },
            volume,
            area: self.area(),
            semi_axes: self.semi_axes(),
            particles: self.particle_number(),
            concentrations: [fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max)],
            force_moments,
            stresslet: std::array::from_fn(|i| std::array::from_fn(|j| stresslet(i, j))),
            force_and_torque: [
                std::array::from_fn(|i| net * flow.forces[i][0]),
                [twist(2, 1), twist(0, 2), twist(1, 0)],
            ],
            tails: self.tails(),
        }
    }

    /// Returns the area (length squared) of the state that was evaluated last, or of a new droplet.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.surface.integral(|k| self.surface.area[k])
    }

    /// Returns the number of particles.
    #[must_use]
    pub fn particle_number(&self) -> f64 {
        (4.0 * std::f64::consts::PI).sqrt() * self.particles()[0]
    }

    /// Returns the semi-axes (length), largest first, of the ellipsoid with the same second moments of the volume. It
    /// belongs to the state that was evaluated last.
    #[must_use]
    pub fn semi_axes(&self) -> [f64; 3] {
        let surface = &self.surface;
        let volume = surface.volume();
        let centre = surface.centroid(volume);
        let second = |i: usize, j: usize| {
            let product = |k: usize| {
                let x: [f64; 3] = std::array::from_fn(|i| surface.positions[i][k] - centre[i]);
                // INT x_i x_j dV = INT x_i x_j (x.n) dA/5.
                x[i] * x[j] * dot(x, at(&surface.normals, k)) / 5.0
            };
            surface.integral(product)
        };
        let moments = Matrix3::from_fn(|i, j| second(i.min(j), i.max(j)));
        let mut axes = moments.symmetric_eigenvalues().map(|value| (5.0 * value.max(0.0) / volume).sqrt());
        axes.as_mut_slice().sort_by(|a, b| b.total_cmp(a));
        [axes[0], axes[1], axes[2]]
    }

    /// Returns the size of the two highest degrees over all of degree 1 and more, of the positions and of the
    /// particles (no dimension).
    #[must_use]
    pub fn tails(&self) -> [f64; 2] {
        let n = count(self.degree);
        let high = count(self.degree - 2);
        let size = |list: &[f64], from: usize| list[from..n].iter().map(|value| value * value).sum::<f64>();
        let tail = |fields: &[&[f64]]| {
            let sum = |from: usize| fields.iter().map(|field| size(field, from)).sum::<f64>();
            if sum(1) > 0.0 { (sum(high) / sum(1)).sqrt() } else { 0.0 }
        };
        // A uniform concentration has no modes but round-off: they count if they are a part of the mean.
        let m = self.particles();
        let particles = (size(m, high) / size(m, 0).max(f64::MIN_POSITIVE)).sqrt();
        [tail(&self.positions()), particles]
    }

    /// Returns the size of each degree l = 0, 1 .. of the particles per area of the unit sphere, the root of the sum
    /// of the squared coefficients (particles).
    #[must_use]
    pub fn modes(&self) -> Vec<f64> {
        let m = self.particles();
        let size = |l: usize| m[l * l..(l + 1) * (l + 1)].iter().map(|value| value * value).sum::<f64>().sqrt();
        (0..=self.degree).map(size).collect()
    }

    /// Returns the position in the frame of the droplet (length), the velocity in the laboratory (length per time) and
    /// the concentration (particles per area) at the parameter in this direction. Velocities and concentrations belong
    /// to the state that was evaluated last.
    ///
    /// # Errors
    /// Returns an error if the direction is not finite.
    pub fn at(&self, direction: [f64; 3]) -> Result<([f64; 3], [f64; 3], f64), SpaceError> {
        let n = count(self.degree);
        let point = Point::towards(direction);
        let vector = |list: &[f64]| -> Result<[f64; 3], SpaceError> {
            let mut vector = [0.0; 3];
            for (value, field) in vector.iter_mut().zip(list.chunks_exact(n)) {
                *value = evaluate(field, point)?;
            }
            Ok(vector)
        };
        // The concentration of the projected field, which is smooth between the points of the grid.
        let concentration = evaluate(&self.flow.scalar_concentration, point)?;
        Ok((vector(&self.state)?, vector(&self.flow.velocities)?, concentration))
    }

    /// Returns warnings about the present state, each with its remedy: negative concentrations, and highest degrees
    /// that are not small.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.doubts().into_iter().map(|(cause, _, message)| format!("{cause}: {message}")).collect()
    }

    /// Returns the warnings as cause, excess over the limit, and what to do.
    pub(crate) fn doubts(&self) -> Vec<(&'static str, f64, String)> {
        let of_law = self.tension.warning().map(|message| ("the tension law has a flaw", 1.0, message));
        let mut doubts: Vec<_> = of_law.into_iter().collect();
        let fold = |start: f64, pick: fn(f64, f64) -> f64| self.flow.concentrations.iter().copied().fold(start, pick);
        let (least, most) = (fold(f64::INFINITY, f64::min), fold(0.0, f64::max));
        let remedy = format!("Use a degree above {}, or let the parameters follow the edge", self.degree);
        let undershoot = -least / (UNDERSHOOT * most);
        if undershoot > 1.0 {
            let message = format!(
                "the minimum is {least:.3e}, because the edge of the particles is too sharp for the degree. {remedy}"
            );
            doubts.push(("the concentration is negative", undershoot, message));
        }
        let [shape, particles] = self.tails();
        let tails = [
            ("the shape is not resolved", shape, LARGE_SHAPE_TAIL),
            ("the particles are not resolved", particles, LARGE_TAIL),
        ];
        for (cause, tail, large) in tails {
            if tail > large {
                let message = format!("the highest two degrees are {tail:.1e} of all. {remedy}");
                doubts.push((cause, tail / large, message));
            }
        }
        doubts
    }
}

fn dot_lists(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests;
