//! Parameters of a description along which states are followed.

use motile::base::Region;
use motile::setup::{DropletShape, ExcludedVolume, Setup};

use crate::SteadyError;

/// Parameter of a description along which a branch of states can be followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Parameter {
    /// Activity zeta delta-mu of the droplet (force times length).
    Activity,
    /// Strength A of the step-like excluded volume (force times length).
    ExcludedVolume,
    /// Diffusion constant of the particles (length squared per time).
    Diffusion,
    /// Rate at which particles bind to the interface from the inside (length per time).
    Binding,
    /// Rate at which they unbind into the inside (1/time).
    Unbinding,
    /// Tension gamma0 of the interface without particles (force).
    Tension,
    /// Viscosity of the droplet (stress times time).
    ViscosityInside,
    /// Viscosity of the exterior fluid (stress times time) at a fixed viscosity of the droplet.
    ViscosityOutside,
    /// Viscosity of the droplet over the viscosity of the exterior fluid, at a fixed sum of both.
    ViscosityRatio,
    /// Viscosity of the cortex (force times time, in three dimensions over length).
    Cortex,
    /// Shear viscosity of the cortex in three dimensions (force times time per length).
    CortexShear,
    /// Friction of the interface with a substrate (force times time per length squared).
    Friction,
    /// Width of a channel (length).
    Width,
    /// Period of a channel, or side of a square box (length).
    Length,
    /// Radius of a tube (length).
    TubeRadius,
    /// Radius of the first rigid disc inside (length).
    NucleusRadius,
    /// Shear rate G of a flow that is imposed on the plane (1/time).
    ShearRate,
    /// Extension rate E of a flow that is imposed on the plane (1/time).
    ExtensionRate,
}

impl Parameter {
    /// All parameters with their names in command lines and files.
    pub const NAMES: [(&str, Self); 18] = [
        ("activity", Self::Activity),
        ("excluded-volume", Self::ExcludedVolume),
        ("diffusion", Self::Diffusion),
        ("binding", Self::Binding),
        ("unbinding", Self::Unbinding),
        ("tension", Self::Tension),
        ("viscosity-in", Self::ViscosityInside),
        ("viscosity-out", Self::ViscosityOutside),
        ("viscosity-ratio", Self::ViscosityRatio),
        ("cortex", Self::Cortex),
        ("cortex-shear", Self::CortexShear),
        ("friction", Self::Friction),
        ("width", Self::Width),
        ("length", Self::Length),
        ("tube-radius", Self::TubeRadius),
        ("nucleus-radius", Self::NucleusRadius),
        ("shear", Self::ShearRate),
        ("extension", Self::ExtensionRate),
    ];

    /// Returns the name in command lines and files, from [`Parameter::NAMES`].
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, parameter)| *parameter == self).map_or("", |(name, _)| name)
    }

    /// Returns the value in a description; `None` if the description has no such parameter, as the width outside of
    /// channels.
    #[must_use]
    pub fn get(self, setup: &Setup) -> Option<f64> {
        let droplet = setup.droplets.first()?;
        let inside = droplet.viscosity.unwrap_or(setup.viscosity);
        match self {
            Self::Activity => droplet.particles.map(|particles| particles.activity),
            Self::ExcludedVolume => match droplet.particles?.excluded_volume {
                ExcludedVolume::Step(strength) => Some(strength),
                _ => None,
            },
            Self::Diffusion => droplet.particles.map(|particles| particles.diffusion),
            Self::Binding => droplet.particles?.exchange.map(|exchange| exchange.binding),
            Self::Unbinding => droplet.particles?.exchange.map(|exchange| exchange.unbinding),
            Self::Tension => Some(droplet.tension),
            Self::ViscosityInside => Some(inside),
            Self::ViscosityOutside => Some(setup.viscosity),
            Self::ViscosityRatio => Some(inside / setup.viscosity),
            Self::Cortex => Some(droplet.cortex.viscosity).filter(|viscosity| *viscosity > 0.0),
            Self::CortexShear => Some(droplet.cortex.shear_viscosity).filter(|viscosity| *viscosity > 0.0),
            Self::Friction => Some(droplet.friction).filter(|friction| *friction > 0.0),
            Self::Width => match setup.region {
                Region::Channel { width, .. } => Some(width),
                _ => None,
            },
            Self::Length => match setup.region {
                Region::Channel { length, .. } => Some(length),
                Region::Box { lengths: [x, y] } if x == y => Some(x),
                _ => None,
            },
            Self::TubeRadius => match setup.region {
                Region::Tube { radius, .. } => Some(radius),
                _ => None,
            },
            Self::NucleusRadius => match setup.rigid_bodies.first()?.shape {
                DropletShape::Round { radius } => Some(radius),
                _ => None,
            },
            Self::ShearRate => (setup.region == Region::Plane).then_some(setup.flow.shear),
            Self::ExtensionRate => (setup.region == Region::Plane).then_some(setup.flow.extension),
        }
    }

    /// Returns the size of the value in a description, in units of which steps of it are taken: 0.01 at least, for
    /// values near zero.
    pub(crate) fn scale(self, setup: &Setup) -> f64 {
        self.get(setup).unwrap_or(0.0).abs().max(0.01)
    }

    /// Returns the description with this parameter at another value.
    ///
    /// # Errors
    /// Returns an error for a description without the parameter.
    pub fn with(self, setup: &Setup, value: f64) -> Result<Setup, SteadyError> {
        let missing = || {
            let what = format!("the scene has no parameter {}", self.name());
            SteadyError::unsupported(what, "Use another parameter, or a region or a droplet that has it")
        };
        self.get(setup).ok_or_else(missing)?;
        let mut setup = setup.clone();
        let droplet = &mut setup.droplets[0];
        let inside = droplet.viscosity.unwrap_or(setup.viscosity);
        match self {
            Self::Activity => droplet.particles.iter_mut().for_each(|particles| particles.activity = value),
            Self::ExcludedVolume => {
                droplet
                    .particles
                    .iter_mut()
                    .for_each(|particles| particles.excluded_volume = ExcludedVolume::Step(value));
            }
            Self::Diffusion => droplet.particles.iter_mut().for_each(|particles| particles.diffusion = value),
            Self::Binding | Self::Unbinding => {
                let exchange = droplet.particles.as_mut().and_then(|particles| particles.exchange.as_mut());
                exchange.into_iter().for_each(|exchange| {
                    *(if self == Self::Binding { &mut exchange.binding } else { &mut exchange.unbinding }) = value;
                });
            }
            Self::Tension => droplet.tension = value,
            Self::ViscosityInside => droplet.viscosity = Some(value),
            Self::ViscosityOutside => (setup.viscosity, droplet.viscosity) = (value, Some(inside)),
            Self::ViscosityRatio => {
                let sum = inside + setup.viscosity;
                (setup.viscosity, droplet.viscosity) = (sum / (1.0 + value), Some(sum * value / (1.0 + value)));
            }
            Self::Cortex => droplet.cortex.viscosity = value,
            Self::CortexShear => droplet.cortex.shear_viscosity = value,
            Self::Friction => droplet.friction = value,
            Self::Width => {
                if let Region::Channel { width, .. } = &mut setup.region {
                    *width = value;
                }
            }
            Self::Length => match &mut setup.region {
                Region::Channel { length, .. } => *length = value,
                Region::Box { lengths } => *lengths = [value; 2],
                _ => return Err(missing()),
            },
            Self::TubeRadius => {
                if let Region::Tube { radius, .. } = &mut setup.region {
                    *radius = value;
                }
            }
            Self::NucleusRadius => setup.rigid_bodies[0].shape = DropletShape::Round { radius: value },
            Self::ShearRate => setup.flow.shear = value,
            Self::ExtensionRate => setup.flow.extension = value,
        }
        Ok(setup)
    }
}

#[cfg(test)]
mod tests;
