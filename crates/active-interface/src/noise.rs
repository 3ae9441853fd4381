//! Noise on the particles of an interface.

mod path;

use motile_base::{not_negative, positive};

use crate::{InterfaceError, concentration::Cells};
use path::BrownianPath;

/// Noise on the particles of an interface, as of particles that diffuse independently: the flux `-D dc/ds + sqrt(2 D c)
/// xi(s, t)`, xi white noise in place and time of unit strength. It moves particles from segment to segment, and so
/// keeps their number. With an exchange with a well-mixed inside, binding and unbinding have the noise of independent
/// events.
///
/// At equilibrium (no activity), concentrations fluctuate as in an ideal gas: each amplitude of `cos k theta` on a
/// circle of radius R has the variance `c0/(pi R)`. This holds for any length of steps, up to round-off. The noise of
/// the fluid is not included. Therefore, particles that push each other apart (a positive effective activity, `zeta_eff
/// > 0`) fluctuate less than at thermal equilibrium: `(c0/(pi R))/(1 + zeta_eff c0 R/(2 (eta_in + eta_ext) D k))`.
///
/// The random numbers follow a Brownian path per face, a function of seed, face and time. A step that is rejected
/// and retried therefore has the same path, and no bias.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("fluctuations", "stochastic", "Langevin", "random"))]
pub struct Noise {
    seed: u64,
    stream: u64,
    strength: f64,
}

impl Noise {
    /// Creates the noise of that seed. Equal seeds give equal noise.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { seed, stream: 0, strength: 1.0 }
    }

    /// Returns the noise with a number that makes it independent of others of the same seed, such as the number of the
    /// droplet.
    #[must_use]
    pub fn with_stream(self, stream: u64) -> Self {
        Self { stream, ..self }
    }

    /// Returns the noise with its amplitude multiplied by `strength` (no dimension): 1 if each unit of the particle
    /// number is one particle, `1/sqrt(m)` if each is m particles.
    ///
    /// # Errors
    /// Returns an error for a strength that is negative or not finite.
    pub fn with_strength(self, strength: f64) -> Result<Self, InterfaceError> {
        Ok(Self { strength: not_negative("the strength of the noise", strength)?, ..self })
    }

    /// Returns the standard deviation of the number of particles on a segment with that mean number, at equilibrium.
    pub(crate) fn deviation(&self, mean: f64) -> f64 {
        self.strength * mean.sqrt()
    }

    pub(crate) fn properties(&self) -> [(&'static str, f64); 3] {
        // Halves, which numbers hold exactly.
        let (high, low) = ((self.seed >> 32) as f64, (self.seed & 0xFFFF_FFFF) as f64);
        [
            ("the strength of the noise", self.strength),
            ("the seed of the noise", low + self.stream as f64 * 1e-3),
            ("the high part of the seed of the noise", high),
        ]
    }
}

/// Part of the time `R^2/D` over which a path is one tree.
const TREE: f64 = 1.0 / 16.0;

/// Noise over a step.
#[derive(Debug, Clone)]
pub(crate) struct Fluctuations {
    pub(crate) noise: Noise,
    path: BrownianPath,
    /// Time of the present state (time).
    pub(crate) time: f64,
    /// Rates of change of the numbers of segments (1/time); empty before the first step.
    rates: Vec<f64>,
    fluxes: Vec<f64>,
    /// Rate of change of the number inside (1/time).
    pub(crate) inside: f64,
}

impl Fluctuations {
    /// Creates the noise on an interface of a size (length) whose particles diffuse at a rate (length squared per
    /// time).
    pub(crate) fn new(noise: Noise, size: f64, diffusion: f64) -> Result<Self, InterfaceError> {
        let diffusion = positive("the diffusion constant of particles with noise", diffusion)?;
        let path = BrownianPath::new(noise.seed, noise.stream, TREE * size * size / diffusion);
        Ok(Self { noise, path, time: 0.0, rates: Vec::new(), fluxes: Vec::new(), inside: 0.0 })
    }

    /// Draws the noise of a step of `dt` (time) from the present time on. Fluxes across the faces have the variance `2
    /// D c/(ds dt)`, c the mean of the concentrations on both sides. On a surface of revolution with its mirror image,
    /// halves of rings have half of the fluxes.
    pub(crate) fn draw(&mut self, dt: f64, concentrations: &[f64], cells: Cells<'_>, diffusion: f64) {
        let Self { noise, path, time, rates, fluxes, inside } = self;
        let count = concentrations.len();
        let mirrored = !cells.faces.is_empty();
        fluxes.resize(count, 0.0);
        rates.resize(count, 0.0);
        *inside = 0.0;
        let amplitude = noise.strength * (if mirrored { 1.0 } else { 2.0 } * diffusion).sqrt() / dt;
        for k in 0..count {
            if mirrored && 2 * k > count {
                fluxes[k] = -fluxes[count - k];
                continue;
            }
            let before = if k == 0 { count - 1 } else { k - 1 };
            let spacing = 0.5 * (cells.lengths[k] + cells.lengths[before]);
            let face = cells.faces.get(k).copied().unwrap_or(1.0);
            let mean = 0.5 * (concentrations[k].max(0.0) + concentrations[before].max(0.0));
            let pole = mirrored && (k == 0 || 2 * k == count);
            let size = if pole { 0.0 } else { (mean * face / spacing).sqrt() };
            fluxes[k] = amplitude * size * path.increment(k as u64, *time, dt);
        }
        for (k, rate) in rates.iter_mut().enumerate() {
            *rate = fluxes[k] - fluxes[if k + 1 == count { 0 } else { k + 1 }];
        }
    }

    /// Adds the noise of binding and unbinding over the step, `sizes[k]` the rate of both together on segment k
    /// (1/time).
    pub(crate) fn draw_exchange(&mut self, dt: f64, sizes: impl Iterator<Item = f64>) {
        let count = self.rates.len() as u64;
        for ((k, rate), size) in (count..).zip(&mut self.rates).zip(sizes) {
            let amplitude = self.noise.strength * size.max(0.0).sqrt() / dt;
            // Beyond all faces, however many there are.
            let change = amplitude * self.path.increment(EXCHANGE + k, self.time, dt);
            *rate += change;
            self.inside -= change;
        }
    }

    /// Adds the noise to the rates of change of the numbers of segments (1/time).
    pub(crate) fn add(&self, rates: &mut [f64]) {
        if self.rates.len() == rates.len() {
            rates.iter_mut().zip(&self.rates).for_each(|(rate, noise)| *rate += noise);
        }
    }
}

/// Number of the first path of the exchange.
const EXCHANGE: u64 = 1 << 40;

#[cfg(test)]
mod tests;
