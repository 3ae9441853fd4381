//! Parameters of a description along which states are followed.

mod entry;
mod key;
mod scale;

use motile::base::Region;
use motile::setup::{DropletShape, ExcludedVolume, Setup};

use crate::SteadyError;
use entry::{entry, scale_radius};

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
    /// Mean concentration c0 of the particles (1/length, in three dimensions over length squared).
    Concentration,
    /// Radius of the round droplet (length), at a fixed concentration c0.
    Radius,
    /// Threshold c_T of the step-like excluded volume (1/length, in three dimensions over length squared), if it does
    /// not follow from c0.
    ExcludedVolumeThreshold,
    /// Steepness a of the step-like excluded volume (no dimension), if it is not Cowley's.
    ExcludedVolumeSteepness,
    /// Strength B of the quadratic excluded volume (force times length squared).
    QuadraticExcludedVolume,
    /// Increase of the viscosity of the cortex per concentration (force times time times length).
    CortexPerConcentration,
    /// Diffusion constant of the particles inside (length squared per time).
    DiffusionInside,
    /// Number of particles inside at the start.
    NumberInside,
    /// Period of a box in x (length).
    BoxX,
    /// Period of a box in y (length).
    BoxY,
    /// Mean pressure gradient along a channel or tube (stress per length).
    PressureGradient,
    /// Flux along a channel or tube (area or volume per time).
    Flux,
    /// Velocity of the lower wall of a channel (length per time).
    LowerWall,
    /// Velocity of the upper wall of a channel (length per time).
    UpperWall,
    /// Velocity in the middle of a Poiseuille flow in the plane (length per time).
    PoiseuilleSpeed,
    /// Half width of a Poiseuille flow in the plane (length).
    PoiseuilleHalfWidth,
    /// Slip length of both walls of a channel, if they have the same (length).
    Slip,
    /// Slip length of the lower wall of a channel (length).
    LowerSlip,
    /// Slip length of the upper wall of a channel (length).
    UpperSlip,
}

impl Parameter {
    /// All parameters with their names in command lines and files.
    pub const NAMES: [(&str, Self); 37] = [
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
        ("concentration", Self::Concentration),
        ("radius", Self::Radius),
        ("excluded-volume-threshold", Self::ExcludedVolumeThreshold),
        ("excluded-volume-steepness", Self::ExcludedVolumeSteepness),
        ("excluded-volume-quadratic", Self::QuadraticExcludedVolume),
        ("cortex-per-concentration", Self::CortexPerConcentration),
        ("diffusion-inside", Self::DiffusionInside),
        ("number-inside", Self::NumberInside),
        ("box-x", Self::BoxX),
        ("box-y", Self::BoxY),
        ("pressure-gradient", Self::PressureGradient),
        ("flux", Self::Flux),
        ("lower-wall", Self::LowerWall),
        ("upper-wall", Self::UpperWall),
        ("poiseuille-speed", Self::PoiseuilleSpeed),
        ("poiseuille-half-width", Self::PoiseuilleHalfWidth),
        ("slip", Self::Slip),
        ("lower-slip", Self::LowerSlip),
        ("upper-slip", Self::UpperSlip),
    ];

    /// Returns the name in command lines and files, from [`Parameter::NAMES`].
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, parameter)| *parameter == self).map_or("", |(name, _)| name)
    }

    /// Returns the parameters that a description has, each number of it once: without the ratio of the viscosities, the
    /// sides of a box together and the slip lengths of both walls together. Slip lengths are left out if both are zero.
    #[must_use]
    pub fn independent(setup: &Setup) -> Vec<Self> {
        let combined = |parameter: &Self| match parameter {
            Self::ViscosityRatio | Self::Slip => true,
            Self::LowerSlip | Self::UpperSlip => setup.region.slip() == [0.0; 2],
            Self::Length => matches!(setup.region, Region::Box { .. }),
            Self::ShearRate | Self::ExtensionRate => setup.flow.is_none(),
            _ => false,
        };
        let all = Self::NAMES.into_iter().map(|(_, parameter)| parameter);
        all.filter(|parameter| !combined(parameter) && parameter.get(setup).is_some()).collect()
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
                ExcludedVolume::Step(strength) | ExcludedVolume::StepAt { strength, .. } => Some(strength),
                _ => None,
            },
            Self::Diffusion => droplet.particles.map(|particles| particles.diffusion),
            Self::Binding => droplet.particles?.exchange.map(|exchange| exchange.binding),
            Self::Unbinding => droplet.particles?.exchange.map(|exchange| exchange.unbinding),
            Self::Tension => Some(droplet.tension),
            Self::ViscosityInside => Some(inside),
            Self::ViscosityOutside => Some(setup.viscosity),
            Self::ViscosityRatio => Some(inside / setup.viscosity),
            Self::Cortex => Some(droplet.cortex.viscosity),
            Self::CortexShear => setup.region.is_axisymmetric().then_some(droplet.cortex.shear_viscosity),
            // In the plane, a substrate without friction has no velocity at which it floats.
            Self::Friction if setup.region == Region::Plane => Some(droplet.friction).filter(|value| *value > 0.0),
            Self::Friction => (!setup.region.is_axisymmetric()).then_some(droplet.friction),
            Self::Width => match setup.region.without_slip() {
                Region::Channel { width, .. } => Some(width),
                _ => None,
            },
            Self::Length => match setup.region.without_slip() {
                Region::Channel { length, .. } => Some(length),
                Region::Box { lengths: [x, y] } if x == y => Some(x),
                _ => None,
            },
            Self::Slip | Self::LowerSlip | Self::UpperSlip => {
                let [lower, upper] = setup.region.slip();
                let channel = matches!(setup.region.without_slip(), Region::Channel { .. });
                let value = if self == Self::UpperSlip { upper } else { lower };
                (channel && (self != Self::Slip || lower == upper)).then_some(value)
            }
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
            other => entry(other, &mut setup.clone()).copied(),
        }
    }

    /// Returns the description with this parameter at another value.
    ///
    /// # Errors
    /// Returns an error for a description without the parameter.
    pub fn with(self, setup: &Setup, value: f64) -> Result<Setup, SteadyError> {
        let missing = || {
            if self == Self::Slip && setup.region.slip() != [0.0; 2] {
                let what = format!("the walls have different slip lengths, {:?}", setup.region.slip());
                return SteadyError::unsupported(what, "Use lower-slip or upper-slip, one wall at a time");
            }
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
                droplet.particles.iter_mut().for_each(|particles| {
                    if let ExcludedVolume::Step(strength) | ExcludedVolume::StepAt { strength, .. } =
                        &mut particles.excluded_volume
                    {
                        *strength = value;
                    }
                });
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
                if let Region::Channel { width, .. } | Region::SlipChannel { width, .. } = &mut setup.region {
                    *width = value;
                }
            }
            Self::Length => match &mut setup.region {
                Region::Channel { length, .. } | Region::SlipChannel { length, .. } => *length = value,
                Region::Box { lengths } => *lengths = [value; 2],
                _ => return Err(missing()),
            },
            Self::Slip => setup.region = setup.region.with_slip([value; 2]),
            Self::LowerSlip => setup.region = setup.region.with_slip([value, setup.region.slip()[1]]),
            Self::UpperSlip => setup.region = setup.region.with_slip([setup.region.slip()[0], value]),
            Self::TubeRadius => {
                if let Region::Tube { radius, .. } = &mut setup.region {
                    *radius = value;
                }
            }
            Self::NucleusRadius => setup.rigid_bodies[0].shape = DropletShape::Round { radius: value },
            Self::ShearRate => setup.flow.shear = value,
            Self::ExtensionRate => setup.flow.extension = value,
            Self::Radius => scale_radius(&mut setup.droplets[0].shape, value),
            other => entry(other, &mut setup).into_iter().for_each(|entry| *entry = value),
        }
        Ok(setup)
    }
}

#[cfg(test)]
mod tests;
