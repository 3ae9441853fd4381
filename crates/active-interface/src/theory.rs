//! Analytic solutions: the linear theory of a round droplet in unbounded fluid and of flat interfaces, the squirmer.

pub mod fits;
mod flat_interface;
mod resistance;
mod sphere;
mod squirmer_flow;

use motile_base::{finite, internal::at_least, not_negative, positive};

use crate::InterfaceError;
pub use flat_interface::{FlatInterface, Stratum, StratumEnd};
pub use sphere::{Sphere, marangoni_speed, settling_speed, tube_drag};
pub use squirmer_flow::SquirmerFlow;

/// Parameters of the linear theory of a round droplet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundDroplet {
    /// Radius R0 (length).
    pub radius: f64,
    /// Viscosity inside (stress times time).
    pub viscosity_inside: f64,
    /// Viscosity outside (stress times time).
    pub viscosity_outside: f64,
    /// Tension gamma(c0) of the uniform state (force): gamma0 - zeta_dmu c0, less the excluded volume.
    pub tension: f64,
    /// Activity (force times length), zeta_dmu for the linear law; for any law minus the slope of the tension,
    /// -d gamma/dc at c0. Negative for particles that contract.
    pub activity: f64,
    /// Mean concentration c0 (particles per length).
    pub concentration: f64,
    /// Diffusivity D along the interface (length squared per time).
    pub diffusivity: f64,
}

/// Linear theory of a round droplet in unbounded fluid (Cowley, section 2.1.1): growth rates, the threshold of
/// swimming, its speed, and the flow of a perturbed droplet.
///
/// ```
/// use active_interface::theory::{LinearTheory, RoundDroplet};
/// let droplet = RoundDroplet {
///     radius: 1.0, viscosity_inside: 100.0, viscosity_outside: 100.0,
///     tension: 60.0, activity: -0.5, concentration: 100.0, diffusivity: 0.1,
/// };
/// let theory = LinearTheory::new(droplet)?;
/// assert!((theory.activity_threshold() + 0.4).abs() < 1e-15);
/// assert!(theory.concentration_growth_rate(1) > 0.0); // it will swim
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
///
/// The interface may resist motion: by the viscosity of a cortex ([`LinearTheory::with_cortex`]) and by friction with a
/// substrate ([`LinearTheory::with_friction`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearTheory {
    droplet: RoundDroplet,
    /// Viscosity eta_s of the cortex (force times time).
    cortex: f64,
    /// Friction xi with a substrate (force times time per length squared).
    friction: f64,
}

impl LinearTheory {
    /// Creates a linear theory of this droplet.
    ///
    /// # Errors
    /// Returns an error for a radius, viscosity or concentration that is not positive, a negative diffusivity, values
    /// that are not finite.
    pub fn new(droplet: RoundDroplet) -> Result<Self, InterfaceError> {
        positive("the radius", droplet.radius)?;
        positive("the viscosity inside", droplet.viscosity_inside)?;
        positive("the viscosity outside", droplet.viscosity_outside)?;
        positive("the mean concentration", droplet.concentration)?;
        not_negative("the diffusivity", droplet.diffusivity)?;
        finite("the tension", droplet.tension)?;
        finite("the activity", droplet.activity)?;
        Ok(Self { droplet, cortex: 0.0, friction: 0.0 })
    }

    /// Returns the parameters of the droplet.
    #[must_use]
    pub fn droplet(&self) -> &RoundDroplet {
        &self.droplet
    }

    fn viscosity_sum(&self) -> f64 {
        self.droplet.viscosity_inside + self.droplet.viscosity_outside
    }

    /// Returns the growth rate (1/time) of mode k of the radius, eq. (2.18): -k gamma / (2 R0 (eta_in + eta_ext)) for
    /// k >= 2, and 0 for k = 1, which moves the circle, and k = 0, which changes its area.
    ///
    /// In a periodic box, the rate is smaller: for k = 2 and equal viscosities in a box of 6 R0 its size is 0.4187
    /// gamma/(eta R0) instead of 0.5. The viscosity of a cortex does not change it, because a circle relaxes without
    /// stretching. With friction, the concentration changes too: this is the entry of
    /// [`LinearTheory::growth_matrix`] for a uniform concentration.
    #[must_use]
    pub fn shape_growth_rate(&self, k: u32) -> f64 {
        if k < 2 {
            return 0.0;
        }
        if self.friction > 0.0 {
            return self.of_mode(k)[0][0];
        }
        -f64::from(k) * self.droplet.tension / (2.0 * self.droplet.radius * self.viscosity_sum())
    }

    /// Returns the growth rate (1/time) of mode k >= 1 of the concentration, eq. (2.19): -k (zeta_dmu c0 / (2 R0
    /// (eta_in + eta_ext)) + D k / R0^2). A cortex of viscosity eta_s adds `k eta_s/(2 R0)` to eta_in + eta_ext. With
    /// friction, this is the entry of [`LinearTheory::growth_matrix`] for a circle.
    #[must_use]
    pub fn concentration_growth_rate(&self, k: u32) -> f64 {
        if self.friction > 0.0 {
            return self.of_mode(k)[1][1];
        }
        let droplet = &self.droplet;
        let k = f64::from(k);
        let sum = self.viscosity_sum() + 0.5 * k * self.cortex / droplet.radius;
        let activity = droplet.activity * droplet.concentration / (2.0 * droplet.radius * sum);
        -k * (activity + droplet.diffusivity * k / (droplet.radius * droplet.radius))
    }

    /// Returns the threshold of the activity (force times length), which is negative. If the activity is stronger, the
    /// uniform state is unstable and the droplet swims. If it is weaker, the droplet stays at rest. Eq. (2.20):
    /// -2 D (eta_in + eta_ext) / (R0 c0). A cortex adds `eta_s/(2 R0)` to eta_in + eta_ext, and friction adds
    /// `xi R0/4`.
    #[must_use]
    pub fn activity_threshold(&self) -> f64 {
        let droplet = &self.droplet;
        -2.0 * droplet.diffusivity * (0.25 * self.drag()) / (droplet.radius * droplet.concentration)
    }

    /// Returns the velocity (length per time) of a round droplet with the concentration c0 + c1 cos(theta), along
    /// theta = pi, where there are fewest particles for c1 > 0, eq. (2.59): -zeta_dmu c1 / (4 (eta_in + eta_ext)). A
    /// cortex adds `2 eta_s/R0` to the denominator, and friction adds `xi R0`.
    ///
    /// # Errors
    /// Returns an error for an amplitude that is not finite.
    pub fn swimming_speed(&self, first_mode: f64) -> Result<f64, InterfaceError> {
        let amplitude = finite("the first mode of the concentration", first_mode)?;
        Ok(-self.droplet.activity * amplitude / self.drag())
    }

    /// Returns the flow due to the concentration c = c0 + concentration_amplitude cos(k theta) (particles per length)
    /// and the radius r = R0 + radius_amplitude cos(k theta) (length), to first order in both amplitudes, eqs. (2.9) to
    /// (2.15).
    ///
    /// # Errors
    /// Returns an error for k = 0, or amplitudes that are not finite.
    pub fn mode_flow(
        &self,
        k: u32,
        concentration_amplitude: f64,
        radius_amplitude: f64,
    ) -> Result<ModeFlow, InterfaceError> {
        at_least("waves around the droplet", k as usize, 1)?;
        let c = finite("the amplitude of the concentration", concentration_amplitude)?;
        let r = finite("the amplitude of the radius", radius_amplitude)?;
        let droplet = self.droplet;
        let radius = droplet.radius;
        let n = f64::from(k);
        if self.resists() {
            return Ok(self.resisted_flow(k, c, r));
        }
        let active = droplet.activity * radius * c;
        let scale = n / (4.0 * self.viscosity_sum());
        Ok(ModeFlow {
            k,
            radius,
            viscosities: [droplet.viscosity_inside, droplet.viscosity_outside],
            alpha_inside: -scale * (active - (n - 1.0) * droplet.tension * r) / radius.powf(n + 2.0),
            beta_inside: scale * (active - (n + 1.0) * droplet.tension * r) / radius.powf(n),
            alpha_outside: -scale * radius.powf(n - 2.0) * (active + (n + 1.0) * droplet.tension * r),
            beta_outside: scale * radius.powf(n) * (active + (n - 1.0) * droplet.tension * r),
        })
    }
}

/// Flow of one angular mode in and around a round droplet, the two-dimensional form of Lamb's solution.
///
/// ```text
/// v_r     = (alpha r^(k+1) + beta r^(k-1)) cos k theta,                   inside     (2.9)
///           (alpha r^(1-k) + beta r^(-k-1)) cos k theta,                  outside
/// v_theta = -((k+2) alpha r^(k+1) + k beta r^(k-1)) sin(k theta) / k,     inside     (2.10)
///           ((k-2) alpha r^(1-k) + k beta r^(-k-1)) sin(k theta) / k,     outside
/// p       = 4 eta (k+1) alpha r^k cos(k theta) / k,                       inside     (2.11)
///           4 eta (k-1) alpha r^-k cos(k theta) / k,                      outside
/// ```
/// In Cowley the outer v_theta has the opposite sign, with which the flow has sources. For k = 1, this is the frame of
/// the droplet: far away the fluid moves with `alpha_outside` along theta = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeFlow {
    k: u32,
    radius: f64,
    viscosities: [f64; 2],
    alpha_inside: f64,
    beta_inside: f64,
    alpha_outside: f64,
    beta_outside: f64,
}

impl ModeFlow {
    /// Returns the coefficients of eqs. (2.12) to (2.15): alpha and beta inside, alpha and beta outside (velocity over
    /// the power of r in the formulas above).
    #[must_use]
    pub fn coefficients(&self) -> [f64; 4] {
        [self.alpha_inside, self.beta_inside, self.alpha_outside, self.beta_outside]
    }

    /// Returns the velocity (v_r, v_theta) (length per time) at the polar coordinates r > 0 (length) and theta
    /// (radians).
    #[must_use]
    pub fn velocity(&self, r: f64, theta: f64) -> [f64; 2] {
        let k = f64::from(self.k);
        let (radial, azimuthal) = if r <= self.radius {
            let (a, b) = (self.alpha_inside * r.powf(k + 1.0), self.beta_inside * r.powf(k - 1.0));
            (a + b, -((k + 2.0) * a + k * b) / k)
        } else {
            let (a, b) = (self.alpha_outside * r.powf(1.0 - k), self.beta_outside * r.powf(-k - 1.0));
            (a + b, ((k - 2.0) * a + k * b) / k)
        };
        let (sin, cos) = (k * theta).sin_cos();
        [radial * cos, azimuthal * sin]
    }

    /// Returns the pressure (force per length), without the constants inside and outside.
    #[must_use]
    pub fn pressure(&self, r: f64, theta: f64) -> f64 {
        let k = f64::from(self.k);
        let radial = if r <= self.radius {
            self.viscosities[0] * (k + 1.0) * self.alpha_inside * r.powf(k)
        } else {
            self.viscosities[1] * (k - 1.0) * self.alpha_outside * r.powf(-k)
        };
        4.0 / k * radial * (k * theta).cos()
    }
}

#[cfg(test)]
mod tests;
