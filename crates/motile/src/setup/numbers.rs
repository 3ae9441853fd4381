//! Dimensionless numbers of droplets.

use std::f64::consts::TAU;

use active_interface::{InterfaceError, polygon_moments};
use motile_base::internal::Refuse as _;

use super::{DropletSetup, DropletShape, ExcludedVolume, OutlineReport, Particles, Setup, checked::Checked};
use crate::SetupError;

/// Markers of the polygon whose area approximates the area of a shape through points.
const CORNERS: usize = 1000;
/// Peclet number (no dimension) above which droplets swim also in narrow regions; in unbounded fluid they do above 2.
const FAR_ABOVE_THRESHOLD: f64 = 10.0;
/// Ratio of a radius to the default radius beyond which the defaults are hardly meant.
const FAR: f64 = 4.0;

/// Dimensionless numbers that govern a droplet with active particles (none has a dimension), R being the radius of the
/// circle of its area. With the confinement (lengths of the region over R), they are all that a scene of one droplet
/// depends on.
///
/// ```
/// use motile::prelude::*;
///
/// let setup = Setup { droplets: vec![DropletSetup::active(-2.0)], ..Setup::default() };
/// let numbers = setup.numbers(&setup.droplets[0])?.ok_or("no particles")?;
/// assert_eq!((numbers.peclet, numbers.excluded_volume, numbers.viscosity_ratio), (10.0, Some(5.0), 1.0));
/// assert!(numbers.peclet > 2.0); // it swims
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numbers {
    /// Peclet number, abs(zeta_dmu) c0 R/((eta_in + eta_ext) D): advection by the flow that particles make over their
    /// diffusion. In unbounded fluid, a round droplet swims above 2 (Cowley (2.20)); negative where particles expand.
    pub peclet: f64,
    /// Strength of the step-like excluded volume over the activity, A/abs(zeta_dmu). If it is 1 or less, particles
    /// collapse.
    pub excluded_volume: Option<f64>,
    /// Tension without particles over what they add at c0, gamma0/(abs(zeta_dmu) c0).
    pub bare_tension: f64,
    /// Viscosity of the droplet over the viscosity of the exterior fluid, eta_in/eta_ext.
    pub viscosity_ratio: f64,
}

impl Setup {
    /// Returns the dimensionless numbers of a droplet of the scene; `None` if it has no activity. The exterior fluid is
    /// the fluid of the scene, also for a droplet inside another one.
    ///
    /// # Errors
    /// Returns an error for points that do not describe a closed curve.
    pub fn numbers(&self, droplet: &DropletSetup) -> Result<Option<Numbers>, SetupError> {
        let Some(particles) = droplet.particles.filter(|particles| particles.activity != 0.0) else { return Ok(None) };
        let inside = droplet.viscosity.unwrap_or(self.viscosity);
        let strength = particles.activity.abs();
        let pull = -particles.activity * particles.concentration * droplet.shape.radius()?;
        Ok(Some(Numbers {
            peclet: pull / ((inside + self.viscosity) * particles.diffusion),
            excluded_volume: match particles.excluded_volume {
                ExcludedVolume::Step(a) => Some(a / strength),
                _ => None,
            },
            bare_tension: droplet.tension / (strength * particles.concentration),
            viscosity_ratio: inside / self.viscosity,
        }))
    }

    /// Refuses droplets whose particles would collapse to a point early in a run. Their activity is at least as strong
    /// as the excluded volume, so that nothing stops particles that attract each other, and far above the threshold of
    /// swimming. Droplets after the first `listed` come from suspensions.
    pub(super) fn check_collapse(&self, listed: usize) -> Result<(), SetupError> {
        for (number, droplet) in self.droplets.iter().enumerate() {
            let Some(numbers) = self.numbers(droplet)? else { continue };
            let unbound = numbers.excluded_volume.is_some_and(|ratio| ratio <= 1.0);
            let Some(Particles { activity, excluded_volume: ExcludedVolume::Step(strength), .. }) = droplet.particles
            else {
                continue;
            };
            let [place, key] = if number < listed {
                [format!("droplets[{number}]"), "particles.activity".to_owned()]
            } else {
                ["suspension".to_owned(), "activity".to_owned()]
            };
            let remedy = format!(
                "the excluded volume is only {strength}, so the particles would collapse to a point. Use an activity \
                 weaker than -{strength}, or a larger excluded volume"
            );
            Checked { place: &place }.refuse_if(
                unbound && numbers.peclet > FAR_ABOVE_THRESHOLD,
                &key,
                activity,
                remedy,
            )?;
        }
        Ok(())
    }

    /// Returns a sentence for each kind of value that is legal but rarely meant. An activity may be positive, so that
    /// the droplet does not swim (of the first such droplet). An angle may be in degrees (the first one above a turn).
    /// The shape of an outline may differ from its polygon ([`OutlineReport::remarks`]). If all radii are far from 1,
    /// they may be in other units than the defaults (of the first droplet that keeps one).
    ///
    /// ```
    /// use motile::prelude::*;
    ///
    /// let setup = Setup { droplets: vec![DropletSetup::active(2.0)], ..Setup::default() };
    /// assert!(setup.hints()[0].starts_with("droplets[0].particles.activity = 2: "));
    /// assert!(Setup::default().hints().is_empty());
    /// ```
    #[must_use]
    pub fn hints(&self) -> Vec<String> {
        let active = self.droplets.iter().enumerate().map(|(number, droplet)| (number, droplet.activity()));
        let positive = active.filter(|(_, activity)| *activity > 0.0).take(1);
        let hint = |(number, activity)| {
            format!(
                "droplets[{number}].particles.activity = {activity}: particles with a positive activity push each \
                 other apart, so the droplet does not swim by itself. Use a negative activity for a swimmer"
            )
        };
        let outlines = self.outlines().unwrap_or_default();
        let remarks = outlines.iter().flat_map(OutlineReport::remarks);
        positive.map(hint).chain(self.angle_in_degrees()).chain(self.radius_in_other_units()).chain(remarks).collect()
    }

    /// Returns the hint for the first droplet with the default viscosity and diffusion, which are for lengths in radii,
    /// if the radii of all are far from 1.
    fn radius_in_other_units(&self) -> Option<String> {
        let mut radii = self.droplets.iter().map(|droplet| droplet.shape.radius());
        if radii.any(|radius| radius.map_or(true, |radius| (1.0 / FAR..FAR).contains(&radius))) {
            return None;
        }
        let (viscosity, diffusion) = (Self::default().viscosity, Particles::default().diffusion);
        self.droplets.iter().enumerate().find_map(|(number, droplet)| {
            // A concentration may have any unit, and so may an activity; whoever has set neither of these two hardly
            // thought of units.
            let usual = droplet.particles.is_some_and(|particles| particles.diffusion == diffusion);
            let hint = if usual && self.viscosity == viscosity { self.mixed_units(droplet) } else { String::new() };
            (!hint.is_empty()).then(|| format!("droplets[{number}]: {}", hint.trim_start_matches("; ")))
        })
    }

    /// Returns the hint for the first angle of a body that is more than a turn, if there is one.
    fn angle_in_degrees(&self) -> Option<String> {
        fn keyed(key: &str, angles: impl Iterator<Item = f64>) -> Vec<(String, f64)> {
            angles.enumerate().map(|(number, angle)| (format!("{key}[{number}].angle"), angle)).collect()
        }
        let lists = [
            keyed("droplets", self.droplets.iter().map(|droplet| droplet.angle)),
            keyed("rigid-bodies", self.rigid_bodies.iter().map(|body| body.angle)),
            keyed("shells", self.shells.iter().map(|shell| shell.angle)),
        ];
        let (key, angle) = lists.into_iter().flatten().find(|(_, angle)| angle.abs() > TAU)?;
        let radians = angle.to_radians();
        Some(format!("{key} = {angle}: angles are in radians. If you mean degrees, use {radians:.4}"))
    }
}

impl DropletShape {
    /// Returns the radius of the circle of its area (length).
    ///
    /// # Errors
    /// Returns an error if points do not describe a closed curve.
    pub fn radius(&self) -> Result<f64, InterfaceError> {
        Ok(match self {
            Self::Round { radius } | Self::Squeezed { radius, .. } => *radius,
            Self::Ellipse { half_axes: [along, across] } => (along * across).sqrt(),
            Self::Modes { radius, cosines, sines } => {
                let squares: f64 = cosines.iter().chain(sines).map(|a| a * a).sum();
                radius * (1.0 + 0.5 * squares).sqrt()
            }
            Self::Points(_) => {
                let area = polygon_moments(&self.curve().map_err(of_interface)?.0.markers(CORNERS)?)?.area;
                (area / std::f64::consts::PI).sqrt()
            }
            Self::Outline(_) => (self.curve().map_err(of_interface)?.0.area() / std::f64::consts::PI).sqrt(),
        })
    }
}

/// Returns the error of an interface that says the same.
fn of_interface(error: SetupError) -> InterfaceError {
    match error {
        SetupError::Interface(error) => error,
        other => InterfaceError::refused("the outline cannot be used", other.to_string(), "Correct the outline"),
    }
}
