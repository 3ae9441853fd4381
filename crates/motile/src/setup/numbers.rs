//! Dimensionless numbers of droplets.

use active_interface::{InterfaceError, polygon_moments};

use super::{DropletSetup, DropletShape, ExcludedVolume, Setup};
use crate::SetupError;

/// Markers of the polygon whose area approximates the area of a shape through points.
const CORNERS: usize = 1000;

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
    /// Dimensionless numbers of a droplet of the scene; `None` for one without activity. The exterior fluid is the
    /// scene's, also for a droplet inside another one.
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
                let area = polygon_moments(&self.curve()?.0.markers(CORNERS)?)?.area;
                (area / std::f64::consts::PI).sqrt()
            }
        })
    }
}
