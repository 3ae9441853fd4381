//! Linear theory of a round droplet whose interface resists its motion.

use motile_base::{finite, internal::at_least, not_negative};

use super::{LinearTheory, ModeFlow};
use crate::InterfaceError;

/// Modes of the tension of an uneven cortex. Higher modes decay as with a cortex of infinite viscosity.
const MODES: u32 = 10_000;

impl LinearTheory {
    /// Adds a cortex of this viscosity eta_s (force times time), which resists stretching of the interface: its tension
    /// is `gamma + eta_s Th`, with the rate of stretching Th of the fluid on the interface.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite.
    pub fn with_cortex(self, viscosity: f64) -> Result<Self, InterfaceError> {
        Ok(Self { cortex: not_negative("the viscosity of the cortex", viscosity)?, ..self })
    }

    /// Adds friction of the interface with a substrate, a force `-xi v` per length (xi in force times time per length
    /// squared), v being the velocity of the fluid.
    ///
    /// # Errors
    /// Returns an error for a friction that is negative or not finite.
    pub fn with_friction(self, friction: f64) -> Result<Self, InterfaceError> {
        Ok(Self { friction: not_negative("the friction", friction)?, ..self })
    }

    /// Returns the rates of change (1/time) of the amplitudes a of mode k of the radius (length) and b of the
    /// concentration (particles per length), as `[[aa, ab], [ba, bb]]`, `da/dt = aa a + ab b`. Mode k = 1 of the radius
    /// moves the circle.
    ///
    /// With `S = eta_in + eta_ext`, the velocity `(u cos k theta, w sin k theta)` of the interface solves for k >= 2
    ///
    /// ```text
    /// (2 S/R0) [[k, 1], [1, k]] (u, w) + (eta_s/R0^2) [[1, k], [k, k^2]] (u, w) + xi (u, w)
    ///     = (zeta b/R0) (1, k) - (gamma (k^2 - 1) a/R0^2) (1, 0)
    /// da/dt = u,     db/dt = -(c0/R0) (u + k w) - D k^2 b/R0^2
    /// ```
    ///
    /// # Errors
    /// Returns an error for k = 0.
    pub fn growth_matrix(&self, k: u32) -> Result<[[f64; 2]; 2], InterfaceError> {
        at_least("waves around the droplet", k as usize, 1)?;
        Ok(self.of_mode(k))
    }

    /// Returns the viscosity of a dilute emulsion of such droplets in two dimensions to first order in their area
    /// fraction (no dimension), `(eta/eta_ext - 1)/fraction`, for a tension that keeps them round:
    /// `2 - eta_ext/(eta_in + eta_ext + eta_s/R0)`, without friction.
    #[must_use]
    pub fn emulsion_coefficient(&self) -> f64 {
        2.0 - self.droplet.viscosity_outside / (self.viscosity_sum() + self.cortex / self.droplet.radius)
    }

    /// Returns the velocity (length per time) along theta = pi of a circle with the tension `gamma0 + difference
    /// cos(theta)` (force), whose cortex has the viscosity `eta_s + uneven cos(theta)` (force times time), eta_s as in
    /// [`LinearTheory::with_cortex`]. Friction is left out.
    ///
    /// The modes T_m of the total tension solve, with `b0 = eta_s/(2 S R0)` and `b1 = uneven/(2 S R0)`,
    ///
    /// ```text
    /// T_m (1 + m b0) + (b1/2) ((m - 1) T_(m-1) + (m + 1) T_(m+1)) = gamma_m,     V = T_1/(4 S)
    /// ```
    ///
    /// a continued fraction.
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite; an uneven part so large that the viscosity is negative
    /// somewhere.
    pub fn uneven_cortex_speed(&self, difference: f64, uneven: f64) -> Result<f64, InterfaceError> {
        finite("the difference of tensions", difference)?;
        let size = finite("the uneven part of the viscosity of the cortex", uneven)?.abs();
        not_negative("the least viscosity of the cortex", self.cortex - size)?;
        let unit = 2.0 * self.viscosity_sum() * self.droplet.radius;
        let (mean, half) = (self.cortex / unit, 0.5 * size / unit);
        // T_m = -ratio T_(m-1), which far up no longer depends on m.
        let mut ratio =
            if size > 0.0 { (mean - (mean * mean - 4.0 * half * half).max(0.0).sqrt()) / (2.0 * half) } else { 0.0 };
        for k in (2..MODES).rev() {
            let m = f64::from(k);
            ratio = half * (m - 1.0) / (1.0 + m * mean - half * (m + 1.0) * ratio);
        }
        let first = difference / (1.0 + mean - 2.0 * half * ratio);
        Ok(first / (4.0 * self.viscosity_sum()))
    }

    pub(super) fn resists(&self) -> bool {
        self.cortex > 0.0 || self.friction > 0.0
    }

    /// Returns four times the viscosity that a tension of mode 1 works against, `4 S + 2 eta_s/R0 + xi R0`.
    pub(super) fn drag(&self) -> f64 {
        let radius = self.droplet.radius;
        4.0 * self.viscosity_sum() + 2.0 * self.cortex / radius + self.friction * radius
    }

    /// Returns the velocities (u, w) of the interface in the frame of the fluid far away, by the amplitudes of the
    /// tension (1/viscosity) and of the radius (1/time).
    fn velocities(&self, k: u32) -> [[f64; 2]; 2] {
        let radius = self.droplet.radius;
        if k == 1 {
            // No force: u = w, the velocity of the circle.
            return [[-1.0 / self.drag(); 2], [0.0; 2]];
        }
        let m = f64::from(k);
        let (fluid, cortex, xi) = (2.0 * self.viscosity_sum() / radius, self.cortex / (radius * radius), self.friction);
        // The determinant without terms that cancel.
        let determinant =
            fluid * (m * m - 1.0) * (fluid + cortex * m) + xi * (2.0 * fluid * m + cortex * (1.0 + m * m) + xi);
        let pull = -1.0 / (radius * determinant);
        let push = -self.droplet.tension * (m * m - 1.0) / (radius * radius * determinant);
        [
            [pull * xi, pull * (fluid * (m * m - 1.0) + xi * m)],
            [push * (fluid * m + cortex * m * m + xi), -push * (fluid + cortex * m)],
        ]
    }

    /// Returns the matrix of [`LinearTheory::growth_matrix`].
    pub(super) fn of_mode(&self, k: u32) -> [[f64; 2]; 2] {
        let (droplet, m) = (self.droplet, f64::from(k));
        let [by_tension, by_radius] = self.velocities(k);
        let gathering = |[u, w]: [f64; 2]| -droplet.concentration / droplet.radius * (u + m * w);
        let spreading = droplet.diffusivity * m * m / (droplet.radius * droplet.radius);
        [
            [by_radius[0], -droplet.activity * by_tension[0]],
            [gathering(by_radius), -droplet.activity * gathering(by_tension) - spreading],
        ]
    }

    /// Returns the flow of amplitudes of the concentration and of the radius.
    pub(super) fn resisted_flow(&self, k: u32, concentration: f64, radius: f64) -> ModeFlow {
        let (droplet, m) = (self.droplet, f64::from(k));
        let [by_tension, by_radius] = self.velocities(k);
        let tension = -droplet.activity * concentration;
        let [mut u, mut w] = [0, 1].map(|i| tension * by_tension[i] + radius * by_radius[i]);
        if k == 1 {
            // The frame of the droplet. A displaced circle is in the flow of (2.12) to (2.15).
            let displaced = radius * droplet.tension / (2.0 * self.viscosity_sum() * droplet.radius);
            (u, w) = (-displaced, u + w + displaced);
        }
        let size = droplet.radius;
        let inside = -0.5 * m * (u + w);
        let outside = 0.5 * m * (u - w);
        ModeFlow {
            k,
            radius: size,
            viscosities: [droplet.viscosity_inside, droplet.viscosity_outside],
            alpha_inside: inside / size.powf(m + 1.0),
            beta_inside: (u - inside) / size.powf(m - 1.0),
            alpha_outside: outside * size.powf(m - 1.0),
            beta_outside: (u - outside) * size.powf(m + 1.0),
        }
    }
}

#[cfg(test)]
mod tests;
