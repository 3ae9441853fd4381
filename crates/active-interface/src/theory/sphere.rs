//! Exact and approximate results for a spherical droplet in three dimensions.

use motile_base::{finite, internal::at_least, not_negative, positive, within};

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
///
/// The interface may have a cortex with a dilatational viscosity ([`Sphere::with_cortex`]) and a shear viscosity
/// ([`Sphere::with_shear_viscosity`]), after Boussinesq and Scriven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    droplet: RoundDroplet,
    /// Dilatational viscosity kappa_d of the cortex (force times time per length).
    dilatational: f64,
    /// Shear viscosity mu_s of the cortex (force times time per length).
    shear: f64,
}

impl Sphere {
    /// Creates a theory of this droplet.
    ///
    /// # Errors
    /// Returns the errors of [`LinearTheory::new`](super::LinearTheory::new).
    pub fn new(droplet: RoundDroplet) -> Result<Self, InterfaceError> {
        super::LinearTheory::new(droplet).map(|_| Self { droplet, dilatational: 0.0, shear: 0.0 })
    }

    /// Adds a cortex of this dilatational viscosity kappa_d (force times time per length), which resists changes of
    /// the area of the interface.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite.
    pub fn with_cortex(self, viscosity: f64) -> Result<Self, InterfaceError> {
        Ok(Self { dilatational: not_negative("the viscosity of the cortex", viscosity)?, ..self })
    }

    /// Adds a shear viscosity mu_s of the cortex (force times time per length), which resists changes of the shape of
    /// pieces of the interface at constant area.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite.
    pub fn with_shear_viscosity(self, viscosity: f64) -> Result<Self, InterfaceError> {
        Ok(Self { shear: not_negative("the shear viscosity of the cortex", viscosity)?, ..self })
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
    /// A cortex adds to the resistance to the velocity `u Y n + w grad Y` of the surface, with L = l (l+1),
    ///
    /// ```text
    /// 1/R0^2 [[4 kappa_d, -2 L kappa_d], [-2 kappa_d, L kappa_d + (L - 2) mu_s]]
    /// ```
    ///
    /// # Errors
    /// Returns an error for a degree of zero.
    pub fn growth_matrix(&self, degree: u32) -> Result<[[f64; 2]; 2], InterfaceError> {
        at_least("the degree of a spherical harmonic", degree as usize, 1)?;
        if self.has_cortex() {
            return Ok(self.resisted_growth(f64::from(degree)));
        }
        let droplet = self.droplet;
        let RoundDroplet { radius, viscosity_inside: i, viscosity_outside: e, tension, concentration, .. } = droplet;
        let (l, sum, slope) = (f64::from(degree), i + e, -droplet.activity);
        let all = (2.0 * l * l * sum - 2.0 * i + e) * (2.0 * l * (l + 2.0) * sum + 3.0 * i);
        let part = (l + 2.0) * e + (l - 1.0) * i;
        let cubic = 2.0 * l.powi(3) + 3.0 * l * l;
        let shape = tension * (l - 1.0) * l * (l + 1.0) * (l + 2.0) / all;
        let gathering = slope * l * (l + 1.0) / all;
        let spreading = droplet.diffusivity * l * (l + 1.0) / (radius * radius);
        Ok([
            [-shape * (2.0 * l + 1.0) * sum / radius, -gathering * part],
            [
                concentration * shape * part / (radius * radius),
                concentration * gathering * ((cubic + 4.0) * e + (cubic - 5.0) * i) / radius - spreading,
            ],
        ])
    }

    /// Returns the activity (force times length) below which the droplet at rest is unstable to l = 1: `-D (3 eta_in +
    /// 2 eta_ext + 2 kappa_d/R0)/(R0 c0)`. The shear viscosity of a cortex does not enter.
    #[must_use]
    pub fn activity_threshold(&self) -> f64 {
        let RoundDroplet { radius, concentration, diffusivity, .. } = self.droplet;
        -diffusivity * self.drag() / (radius * concentration)
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
    /// 0.6, so that swimming sets in subcritically at any viscosities; in two dimensions all ratios are 1. A cortex
    /// adds `2 kappa_d/R0` to the numerator and `(6 kappa_d + 4 mu_s)/R0` to the denominator. Swimming sets in
    /// supercritically where q is below a third.
    ///
    /// # Errors
    /// Returns an error for an amplitude that is not finite.
    pub fn onset(&self, first_mode: f64) -> Result<f64, InterfaceError> {
        let amplitude = finite("the first mode of the concentration", first_mode)? / self.droplet.concentration;
        let RoundDroplet { radius, viscosity_inside: i, viscosity_outside: e, .. } = self.droplet;
        let second = 5.0 * (i + e) + (6.0 * self.dilatational + 4.0 * self.shear) / radius;
        let ratio = self.drag() / second;
        Ok(1.0 - (3.0 * ratio - 1.0) / (15.0 * (1.0 - ratio)) * amplitude * amplitude)
    }

    /// Returns the velocity (length per time) along theta = pi of the droplet with the concentration `c0 + c1
    /// cos(theta)`. Without a cortex, it equals [`marangoni_speed`]. With the activity zeta it is
    /// `-2 zeta c1/(3 (3 eta_in + 2 eta_ext + 2 kappa_d/R0))`.
    ///
    /// # Errors
    /// Returns an error for an amplitude that is not finite.
    pub fn swimming_speed(&self, first_mode: f64) -> Result<f64, InterfaceError> {
        let amplitude = finite("the first mode of the concentration", first_mode)?;
        let speed = -2.0 * self.droplet.activity * amplitude / (3.0 * self.drag());
        Ok(finite("the speed", speed)?)
    }

    /// Returns the velocity (length per time) of the droplet under a force, such as its weight: [`settling_speed`] with
    /// `2 kappa_d/(3 R0)` of a cortex added to eta_in. A cortex of large kappa_d settles like a rigid sphere.
    ///
    /// # Errors
    /// Returns an error for a force that is not finite.
    pub fn settling_speed(&self, force: f64) -> Result<f64, InterfaceError> {
        let RoundDroplet { radius, viscosity_inside, viscosity_outside, .. } = self.droplet;
        settling_speed(force, radius, [viscosity_inside + 2.0 * self.dilatational / (3.0 * radius), viscosity_outside])
    }

    /// Returns the viscosity of a dilute emulsion of such droplets to first order in their volume fraction (no
    /// dimension), `(eta/eta_ext - 1)/fraction`, for a tension that keeps them round (Taylor, 1932):
    /// `(1 + 2.5 L)/(1 + L)` with `L = (eta_in + (6 kappa_d + 4 mu_s)/(5 R0))/eta_ext`.
    #[must_use]
    pub fn emulsion_coefficient(&self) -> f64 {
        let RoundDroplet { radius, viscosity_inside: i, viscosity_outside: e, .. } = self.droplet;
        let inside = i + (6.0 * self.dilatational + 4.0 * self.shear) / (5.0 * radius);
        (e + 2.5 * inside) / (e + inside)
    }

    fn has_cortex(&self) -> bool {
        self.dilatational > 0.0 || self.shear > 0.0
    }

    /// Returns the sum `3 eta_in + 2 eta_ext + 2 kappa_d/R0` that a tension of l = 1 works against.
    fn drag(&self) -> f64 {
        let RoundDroplet { radius, viscosity_inside: i, viscosity_outside: e, .. } = self.droplet;
        3.0 * i + 2.0 * e + 2.0 * self.dilatational / radius
    }

    /// Returns the growth matrix with a cortex.
    ///
    /// The resistance of the fluids is from Lamb's solution, and the cortex is singular except for mu_s:
    /// products of its entries that cancel are left out.
    fn resisted_growth(&self, l: f64) -> [[f64; 2]; 2] {
        let RoundDroplet { radius, viscosity_inside: i, viscosity_outside: e, .. } = self.droplet;
        let RoundDroplet { tension, activity, concentration, diffusivity, .. } = self.droplet;
        let (waves, squared) = (l * (l + 1.0), radius * radius);
        let uu = (i * (2.0 * l * l + l + 3.0) / l + e * (2.0 * l * l + 3.0 * l + 4.0) / (l + 1.0)) / radius;
        let uw = -3.0 * (i * (l + 1.0) + e * l) / radius;
        let wu = -3.0 * (i / l + e / (l + 1.0)) / radius;
        let ww = (2.0 * l + 1.0) * (i + e) / radius;
        let (stretching, shear) = (self.dilatational / squared, self.shear * (waves - 2.0) / squared);
        let determinant =
            uu * (ww + shear) - uw * wu + stretching * (uu * waves + 4.0 * (ww + shear) + 2.0 * uw + 2.0 * waves * wu);
        // Velocities u and w by the tension over R0, and by the force of a displacement along the normal.
        let by_tension = [-2.0 * (ww + shear) - uw, uu + 2.0 * wu].map(|value| value / (radius * determinant));
        let force = -tension * (l - 1.0) * (l + 2.0) / (squared * determinant);
        let by_shape = [force * (ww + shear + stretching * waves), force * (2.0 * stretching - wu)];
        let gathering = |[u, w]: [f64; 2]| -concentration / radius * (2.0 * u - waves * w);
        let spreading = diffusivity * waves / squared;
        [[by_shape[0], -activity * by_tension[0]], [gathering(by_shape), -activity * gathering(by_tension) - spreading]]
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
