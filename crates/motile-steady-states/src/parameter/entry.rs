//! Entries of a description that parameters are the values of.

use motile::base::{Drive, Region};
use motile::setup::{DropletShape, ExcludedVolume, Setup};

use super::Parameter;

/// Returns the entry of a parameter that is one number of the description; `None` if the description lacks it.
pub(super) fn entry(parameter: Parameter, setup: &mut Setup) -> Option<&mut f64> {
    let droplet = setup.droplets.first_mut()?;
    match parameter {
        Parameter::Concentration => droplet.particles.as_mut().map(|particles| &mut particles.concentration),
        Parameter::Radius => match &mut droplet.shape {
            DropletShape::Round { radius } | DropletShape::Squeezed { radius, .. } => Some(radius),
            _ => None,
        },
        Parameter::ExcludedVolumeThreshold
        | Parameter::ExcludedVolumeSteepness
        | Parameter::QuadraticExcludedVolume => match (parameter, &mut droplet.particles.as_mut()?.excluded_volume) {
            (Parameter::ExcludedVolumeThreshold, ExcludedVolume::StepAt { threshold, .. }) => Some(threshold),
            (Parameter::ExcludedVolumeSteepness, ExcludedVolume::StepAt { steepness, .. }) => Some(steepness),
            (Parameter::QuadraticExcludedVolume, ExcludedVolume::Quadratic(strength)) => Some(strength),
            _ => None,
        },
        Parameter::CortexPerConcentration => Some(&mut droplet.cortex.per_concentration).filter(|value| **value > 0.0),
        Parameter::DiffusionInside => droplet.particles.as_mut()?.exchange.as_mut()?.diffusion_inside.as_mut(),
        Parameter::NumberInside => droplet.particles.as_mut()?.exchange.as_mut()?.number_inside.as_mut(),
        Parameter::BoxX | Parameter::BoxY => match &mut setup.region {
            Region::Box { lengths: [x, y] } => Some(if parameter == Parameter::BoxX { x } else { y }),
            _ => None,
        },
        Parameter::PressureGradient | Parameter::Flux => match &mut setup.region {
            Region::Channel { drive, .. } | Region::SlipChannel { drive, .. } | Region::Tube { drive, .. } => {
                match (parameter, drive) {
                    (Parameter::PressureGradient, Drive::Gradient(value)) | (Parameter::Flux, Drive::Flux(value)) => {
                        Some(value)
                    }
                    _ => None,
                }
            }
            _ => None,
        },
        Parameter::LowerWall => setup.flow.wall_velocity.as_mut().map(|[lower, _]| lower),
        Parameter::UpperWall => setup.flow.wall_velocity.as_mut().map(|[_, upper]| upper),
        Parameter::PoiseuilleSpeed => setup.flow.poiseuille.as_mut().map(|flow| &mut flow.speed),
        Parameter::PoiseuilleHalfWidth => setup.flow.poiseuille.as_mut().map(|flow| &mut flow.half_width),
        _ => None,
    }
}

/// Gives a shape another radius; a squeezed circle keeps its proportions.
pub(super) fn scale_radius(shape: &mut DropletShape, value: f64) {
    match shape {
        DropletShape::Round { radius } => *radius = value,
        DropletShape::Squeezed { radius, half_height, .. } => {
            *half_height *= value / *radius;
            *radius = value;
        }
        _ => {}
    }
}
