//! The numbers of a description that a branch may be followed in.

use motile::{DropletShape, Exclusion, Region, Setup};

use crate::SteadyError;

/// A number of a description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// Activity zeta delta-mu of the droplet (force times length).
    Activity,
    /// Strength A of the step-like excluded volume (force times length).
    ExcludedVolume,
    /// Diffusion constant of the particles (length squared per time).
    Diffusion,
    /// Tension gamma0 of the interface without particles (force).
    Tension,
    /// Viscosity of the droplet (stress times time).
    ViscosityInside,
    /// Viscosity of the exterior fluid (stress times time), that of the droplet being kept.
    ViscosityOutside,
    /// Viscosity of the droplet over that of the exterior fluid, their sum being kept.
    ViscosityRatio,
    /// Width of a channel (length).
    Width,
    /// Period of a channel, or side of a square box (length).
    Length,
    /// Radius of the first rigid disc inside (length).
    NucleusRadius,
}

impl Parameter {
    /// All of them, with the names that a command line has for them.
    pub const NAMES: [(&str, Self); 10] = [
        ("activity", Self::Activity),
        ("excluded-volume", Self::ExcludedVolume),
        ("diffusion", Self::Diffusion),
        ("tension", Self::Tension),
        ("viscosity-in", Self::ViscosityInside),
        ("viscosity-out", Self::ViscosityOutside),
        ("viscosity-ratio", Self::ViscosityRatio),
        ("width", Self::Width),
        ("length", Self::Length),
        ("nucleus-radius", Self::NucleusRadius),
    ];

    /// Its name on a command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, parameter)| *parameter == self).map_or("", |(name, _)| name)
    }

    /// Its value in a description; none where it has no such number.
    #[must_use]
    pub fn get(self, setup: &Setup) -> Option<f64> {
        let droplet = setup.droplets.first()?;
        let inside = droplet.viscosity.unwrap_or(setup.viscosity);
        match self {
            Self::Activity => droplet.particles.map(|particles| particles.activity),
            Self::ExcludedVolume => match droplet.particles?.excluded_volume {
                Exclusion::Step(strength) => Some(strength),
                _ => None,
            },
            Self::Diffusion => droplet.particles.map(|particles| particles.diffusion),
            Self::Tension => Some(droplet.tension),
            Self::ViscosityInside => Some(inside),
            Self::ViscosityOutside => Some(setup.viscosity),
            Self::ViscosityRatio => Some(inside / setup.viscosity),
            Self::Width => match setup.region {
                Region::Channel { width, .. } => Some(width),
                _ => None,
            },
            Self::Length => match setup.region {
                Region::Channel { length, .. } => Some(length),
                Region::Box { lengths: [x, y] } if x == y => Some(x),
                _ => None,
            },
            Self::NucleusRadius => match setup.rigid_bodies.first()?.shape {
                DropletShape::Round { radius } => Some(radius),
                _ => None,
            },
        }
    }

    /// The same description with another value of this number.
    ///
    /// # Errors
    /// A description without such a number.
    pub fn with(self, setup: &Setup, value: f64) -> Result<Setup, SteadyError> {
        let missing = || SteadyError::Unsupported {
            what: format!("the scene has no parameter {}", self.name()),
            remedy: "give another one, or a region or a droplet that has it",
        };
        self.get(setup).ok_or_else(missing)?;
        let mut setup = setup.clone();
        let droplet = &mut setup.droplets[0];
        let inside = droplet.viscosity.unwrap_or(setup.viscosity);
        match self {
            Self::Activity => droplet.particles.iter_mut().for_each(|particles| particles.activity = value),
            Self::ExcludedVolume => {
                droplet.particles.iter_mut().for_each(|particles| particles.excluded_volume = Exclusion::Step(value));
            }
            Self::Diffusion => droplet.particles.iter_mut().for_each(|particles| particles.diffusion = value),
            Self::Tension => droplet.tension = value,
            Self::ViscosityInside => droplet.viscosity = Some(value),
            Self::ViscosityOutside => (setup.viscosity, droplet.viscosity) = (value, Some(inside)),
            Self::ViscosityRatio => {
                let sum = inside + setup.viscosity;
                (setup.viscosity, droplet.viscosity) = (sum / (1.0 + value), Some(sum * value / (1.0 + value)));
            }
            Self::Width => {
                if let Region::Channel { width, .. } = &mut setup.region {
                    *width = value;
                }
            }
            Self::Length => match &mut setup.region {
                Region::Channel { length, .. } => *length = value,
                Region::Box { lengths } => *lengths = [value; 2],
                Region::Plane => {}
            },
            Self::NucleusRadius => setup.rigid_bodies[0].shape = DropletShape::Round { radius: value },
        }
        Ok(setup)
    }
}
