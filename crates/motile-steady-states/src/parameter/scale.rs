//! Sizes of parameters that steps of them are taken in.

use motile::setup::{DropletShape, Setup};

use super::Parameter;

/// Smallest size of a parameter, over the one that follows from the other parameters.
const LEAST: f64 = 0.05;

impl Parameter {
    /// Returns the size of the value in a description, in units of which steps of it are taken. For values near zero
    /// it is a twentieth of [`Parameter::natural`], so that it is the same in any units.
    pub(crate) fn scale(self, setup: &Setup) -> f64 {
        self.get(setup).unwrap_or(0.0).abs().max(LEAST * self.natural(setup)).max(f64::MIN_POSITIVE)
    }

    /// Returns the size of a parameter at which it competes with the others (in its unit): a combination of radius,
    /// mean concentration, viscosities and diffusion constant of its dimension. For example, it is the activity
    /// `(eta_in + eta_ext) D/(R c0)`, half of the threshold in the plane.
    pub(crate) fn natural(self, setup: &Setup) -> f64 {
        let Some(droplet) = setup.droplets.first() else { return 0.0 };
        let radius = match droplet.shape {
            DropletShape::Round { radius } | DropletShape::Squeezed { radius, .. } => radius,
            _ => 1.0,
        };
        let viscosity = droplet.viscosity.unwrap_or(setup.viscosity) + setup.viscosity;
        let rate = match droplet.particles {
            Some(particles) if particles.diffusion > 0.0 => particles.diffusion / (radius * radius),
            _ => {
                let flow = setup.flow.shear.abs().max(setup.flow.extension.abs());
                (droplet.tension / (viscosity * radius)).max(flow)
            }
        };
        let concentration = droplet.particles.map_or(1.0, |particles| particles.concentration);
        let tension = viscosity * radius * rate;
        match self {
            Self::Activity | Self::ExcludedVolume => tension / concentration,
            Self::QuadraticExcludedVolume => tension / (concentration * concentration),
            Self::Diffusion | Self::DiffusionInside => rate * radius * radius,
            Self::Binding | Self::LowerWall | Self::UpperWall | Self::PoiseuilleSpeed => rate * radius,
            Self::Unbinding | Self::ShearRate | Self::ExtensionRate => rate,
            Self::Tension => tension,
            Self::ViscosityInside | Self::ViscosityOutside => viscosity,
            Self::ViscosityRatio | Self::ExcludedVolumeSteepness => 1.0,
            Self::Cortex | Self::CortexShear => viscosity * radius,
            Self::CortexPerConcentration => viscosity * radius / concentration,
            Self::Friction => viscosity / radius,
            Self::Width
            | Self::Length
            | Self::TubeRadius
            | Self::NucleusRadius
            | Self::Radius
            | Self::BoxX
            | Self::BoxY
            | Self::Slip
            | Self::LowerSlip
            | Self::UpperSlip
            | Self::PoiseuilleHalfWidth => radius,
            Self::Concentration | Self::ExcludedVolumeThreshold => concentration,
            Self::NumberInside => concentration * radius.powi(if setup.region.is_axisymmetric() { 2 } else { 1 }),
            Self::PressureGradient => viscosity * rate / radius,
            Self::Flux => rate * radius.powi(if setup.region.is_axisymmetric() { 3 } else { 2 }),
        }
    }

    /// Returns the power of length in the unit of the parameter, with force, time and number as the other units, for
    /// interfaces of one dimension or two.
    pub(crate) fn power_of_length(self, dimensions: i32) -> i32 {
        match self {
            Self::Unbinding
            | Self::ShearRate
            | Self::ExtensionRate
            | Self::ViscosityRatio
            | Self::ExcludedVolumeSteepness
            | Self::NumberInside => 0,
            Self::Activity
            | Self::ExcludedVolume
            | Self::CortexPerConcentration
            | Self::Binding
            | Self::LowerWall
            | Self::UpperWall
            | Self::PoiseuilleSpeed
            | Self::Width
            | Self::Length
            | Self::TubeRadius
            | Self::NucleusRadius
            | Self::Radius
            | Self::BoxX
            | Self::BoxY
            | Self::Slip
            | Self::LowerSlip
            | Self::UpperSlip
            | Self::PoiseuilleHalfWidth => 1,
            Self::Diffusion | Self::DiffusionInside => 2,
            Self::QuadraticExcludedVolume | Self::Flux => 1 + dimensions,
            Self::Tension | Self::Cortex | Self::CortexShear => 1 - dimensions,
            Self::ViscosityInside | Self::ViscosityOutside | Self::Concentration | Self::ExcludedVolumeThreshold => {
                -dimensions
            }
            Self::Friction | Self::PressureGradient => -1 - dimensions,
        }
    }
}
