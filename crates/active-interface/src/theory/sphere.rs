//! Exact and approximate results for a spherical droplet in three dimensions.

use motile_base::{finite, internal::at_least, positive, within};

use super::RoundDroplet;
use crate::InterfaceError;

/// Linear and weakly nonlinear theory of a spherical droplet in unbounded fluid, with concentrations per area and the
/// tension per length in [`RoundDroplet`]: growth rates, the threshold of swimming, how it sets in.
///
/// ```
/// use active_interface::theory::{RoundDroplet, Sphere};
/// let droplet = RoundDroplet {
///     radius: 1.0, viscosity_inside: 100.0, viscosity_outside: 100.0,
///     tension: 60.0, activity: -0.5, concentration: 100.0, diffusivity: 0.1,
/// };
/// let theory = Sphere::new(droplet)?;
/// println!("threshold {:.2}", theory.activity_threshold()); // -0.50, in two dimensions -0.40
/// assert!((theory.activity_threshold() + 0.5).abs() < 1e-15);
/// assert!(theory.onset(10.0)? < 1.0); // small swimmers exist where the droplet at rest is stable
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere(RoundDroplet);

impl Sphere {
    /// Creates a theory of this droplet.
    ///
    /// # Errors
    /// Returns the errors of [`LinearTheory::new`](super::LinearTheory::new).
    pub fn new(droplet: RoundDroplet) -> Result<Self, InterfaceError> {
        super::LinearTheory::new(droplet).map(|_| Self(droplet))
    }

    /// Returns the rates of change (1/time) of the amplitudes a of the radius (length) and b of the concentration
    /// (particles per area) of a spherical harmonic of degree l, as `[[aa, ab], [ba, bb]]`, `da/dt = aa a + ab b`. They
    /// hold for all orders m. With `S = eta_in + eta_ext`, G the tension, g its slope by the concentration, `N = (2 l^2
    /// S - 2 eta_in + eta_ext)(2 l (l + 2) S + 3 eta_in)` and `P = (l + 2) eta_ext + (l - 1) eta_in`
    ///
    /// ```text
    /// aa = -G (l-1) l (l+1) (l+2) (2l+1) S/(R0 N)          ab = -g l (l+1) P/N
    /// ba = c0 G (l-1) l (l+1) (l+2) P/(R0^2 N)
    /// bb = c0 g l (l+1) ((2l^3+3l^2+4) eta_ext + (2l^3+3l^2-5) eta_in)/(R0 N) - D l (l+1)/R0^2
    /// ```
    ///
    /// # Errors
    /// Returns an error for a degree of zero.
    pub fn growth_matrix(&self, degree: u32) -> Result<[[f64; 2]; 2], InterfaceError> {
        at_least("the degree of a spherical harmonic", degree as usize, 1)?;
        let RoundDroplet { radius, viscosity_inside: i, viscosity_outside: e, tension, concentration, .. } = self.0;
        let (l, sum, slope) = (f64::from(degree), i + e, -self.0.activity);
        let all = (2.0 * l * l * sum - 2.0 * i + e) * (2.0 * l * (l + 2.0) * sum + 3.0 * i);
        let part = (l + 2.0) * e + (l - 1.0) * i;
        let cubic = 2.0 * l.powi(3) + 3.0 * l * l;
        let shape = tension * (l - 1.0) * l * (l + 1.0) * (l + 2.0) / all;
        let gathering = slope * l * (l + 1.0) / all;
        let spreading = self.0.diffusivity * l * (l + 1.0) / (radius * radius);
        Ok([
            [-shape * (2.0 * l + 1.0) * sum / radius, -gathering * part],
            [
                concentration * shape * part / (radius * radius),
                concentration * gathering * ((cubic + 4.0) * e + (cubic - 5.0) * i) / radius - spreading,
            ],
        ])
    }

    /// Returns the activity (force times length) below which the droplet at rest is unstable to l = 1: `-D (3 eta_in +
    /// 2 eta_ext)/(R0 c0)`.
    #[must_use]
    pub fn activity_threshold(&self) -> f64 {
        let RoundDroplet { radius, viscosity_inside, viscosity_outside, concentration, diffusivity, .. } = self.0;
        -diffusivity * (3.0 * viscosity_inside + 2.0 * viscosity_outside) / (radius * concentration)
    }

    /// Returns the activity over the threshold (no dimension) of the swimmer of small amplitude with the concentration
    /// `c0 + b1 cos(theta) + ...`, to the second order of b1 (particles per area), for a tension so large that the
    /// droplet stays a sphere and linear in the concentration:
    ///
    /// ```text
    /// 1 - (3 q - 1)/(15 (1 - q)) (b1/c0)^2,         q = (3 eta_in + 2 eta_ext)/(5 (eta_in + eta_ext))
    /// ```
    ///
    /// q is the ratio of the velocities along the surface that tensions of l = 2 and l = 1 cause. It is between 0.4 and
    /// 0.6, so that swimming sets in subcritically at any viscosities; in two dimensions all ratios are 1.
    ///
    /// # Errors
    /// Returns an error for an amplitude that is not finite.
    pub fn onset(&self, first_mode: f64) -> Result<f64, InterfaceError> {
        let amplitude = finite("the first mode of the concentration", first_mode)? / self.0.concentration;
        let (i, e) = (self.0.viscosity_inside, self.0.viscosity_outside);
        let ratio = (3.0 * i + 2.0 * e) / (5.0 * (i + e));
        Ok(1.0 - (3.0 * ratio - 1.0) / (15.0 * (1.0 - ratio)) * amplitude * amplitude)
    }

    /// Returns the velocity (length per time) along theta = pi of the droplet with the concentration `c0 + c1
    /// cos(theta)`. It is the velocity of [`marangoni_speed`].
    ///
    /// # Errors
    /// Returns an error for an amplitude that is not finite.
    pub fn swimming_speed(&self, first_mode: f64) -> Result<f64, InterfaceError> {
        let amplitude = finite("the first mode of the concentration", first_mode)?;
        marangoni_speed(-self.0.activity * amplitude, [self.0.viscosity_inside, self.0.viscosity_outside])
    }
}

/// Returns the velocity (length per time) along theta = pi of a spherical droplet with the tension `gamma0 + g
/// cos(theta)`, g in force per length, in fluid of another viscosity (stress times time, inside first): `2 g/(3 (2
/// eta_ext + 3 eta_in))` (Young, Goldstein and Block, The motion of bubbles in a vertical temperature gradient, 1959).
///
/// # Errors
/// Returns an error for viscosities that are not positive and finite, a tension that is not finite.
#[doc(alias("Marangoni", "thermocapillary", "bubble"))]
pub fn marangoni_speed(difference: f64, [inside, outside]: [f64; 2]) -> Result<f64, InterfaceError> {
    positive("the viscosity inside", inside)?;
    positive("the viscosity outside", outside)?;
    Ok(2.0 * finite("the difference of tensions", difference)? / (3.0 * (2.0 * outside + 3.0 * inside)))
}

/// Returns the velocity (length per time) of a spherical droplet of clean interface under a force, such as its weight
/// (Hadamard and Rybczynski, 1911): `F (eta_in + eta_ext)/(2 pi R0 eta_ext (2 eta_ext + 3 eta_in))`.
///
/// # Errors
/// Returns an error for a radius or viscosities (stress times time, inside first) that are not positive and finite, a
/// force that is not finite.
pub fn settling_speed(force: f64, radius: f64, [inside, outside]: [f64; 2]) -> Result<f64, InterfaceError> {
    positive("the radius", radius)?;
    positive("the viscosity inside", inside)?;
    positive("the viscosity outside", outside)?;
    let resistance = std::f64::consts::TAU * radius * outside * (2.0 * outside + 3.0 * inside);
    Ok(finite("the force", force)? * (inside + outside) / resistance)
}

/// Returns the drag on a rigid sphere along the axis of a closed tube over the drag in unbounded fluid, for a radius of
/// the sphere up to 0.6 tube radii, to 1e-4 at 0.1, 2e-4 at 0.3, 1.4e-2 at 0.5 (Haberman and Sayre, Motion of rigid and
/// fluid spheres in stationary and moving liquids inside cylindrical tubes, 1958, their approximation). Tighter tubes
/// and more digits are computed by `stokes_boundary_integrals::axisymmetric`.
///
/// # Errors
/// Returns an error for a ratio below 0 or above 0.6.
pub fn tube_drag(ratio: f64) -> Result<f64, InterfaceError> {
    let x = within("the radius of the sphere over that of the tube", ratio, 0.0, 0.6)?;
    let bottom = 1.0 - 2.1050 * x + 2.0865 * x.powi(3) - 1.7068 * x.powi(5) + 0.72603 * x.powi(6);
    Ok((1.0 - 0.75857 * x.powi(5)) / bottom)
}
