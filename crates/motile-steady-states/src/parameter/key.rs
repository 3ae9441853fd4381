//! Keys of parameters in scene files.

use motile::base::Region;
use motile::setup::{DropletShape, ExcludedVolume, Setup};

use super::Parameter;

impl Parameter {
    /// Returns the key in scene files, such as `droplets.0.particles.activity`; for combinations of several keys, such
    /// as the ratio of the viscosities, the name. The keys of the viscosities count as if the droplet had its own
    /// viscosity.
    #[must_use]
    pub fn key(self, setup: &Setup) -> &'static str {
        let droplet = setup.droplets.first();
        let pressure = droplet.and_then(|droplet| droplet.particles).map(|particles| particles.excluded_volume);
        let in_tube = matches!(setup.region, Region::Tube { .. });
        match self {
            Self::Activity => "droplets.0.particles.activity",
            Self::ExcludedVolume if matches!(pressure, Some(ExcludedVolume::StepAt { .. })) => {
                "droplets.0.particles.excluded-volume.step-at.strength"
            }
            Self::ExcludedVolume => "droplets.0.particles.excluded-volume.step",
            Self::ExcludedVolumeThreshold => "droplets.0.particles.excluded-volume.step-at.threshold",
            Self::ExcludedVolumeSteepness => "droplets.0.particles.excluded-volume.step-at.steepness",
            Self::QuadraticExcludedVolume => "droplets.0.particles.excluded-volume.quadratic",
            Self::Diffusion => "droplets.0.particles.diffusion",
            Self::Concentration => "droplets.0.particles.concentration",
            Self::Binding => "droplets.0.particles.exchange.binding",
            Self::Unbinding => "droplets.0.particles.exchange.unbinding",
            Self::DiffusionInside => "droplets.0.particles.exchange.diffusion-inside",
            Self::NumberInside => "droplets.0.particles.exchange.number-inside",
            Self::Tension => "droplets.0.tension",
            Self::ViscosityInside => "droplets.0.viscosity",
            Self::ViscosityOutside => "viscosity",
            Self::Cortex => "droplets.0.cortex.viscosity",
            Self::CortexPerConcentration => "droplets.0.cortex.per-concentration",
            Self::CortexShear => "droplets.0.cortex.shear-viscosity",
            Self::Friction => "droplets.0.friction",
            Self::Radius => match droplet.map(|droplet| &droplet.shape) {
                Some(DropletShape::Squeezed { .. }) => "droplets.0.shape.squeezed.radius",
                _ => "droplets.0.shape.round.radius",
            },
            Self::NucleusRadius => "rigid-bodies.0.shape.round.radius",
            Self::Width => "region.channel.width",
            Self::Length if matches!(setup.region.without_slip(), Region::Channel { .. }) => "region.channel.length",
            Self::Slip => "region.channel.slip",
            Self::LowerSlip => "region.channel.slip.0",
            Self::UpperSlip => "region.channel.slip.1",
            Self::BoxX => "region.box.lengths.0",
            Self::BoxY => "region.box.lengths.1",
            Self::TubeRadius => "region.tube.radius",
            Self::PressureGradient if in_tube => "region.tube.drive.gradient",
            Self::PressureGradient => "region.channel.drive.gradient",
            Self::Flux if in_tube => "region.tube.drive.flux",
            Self::Flux => "region.channel.drive.flux",
            Self::ShearRate => "flow.shear",
            Self::ExtensionRate => "flow.extension",
            Self::LowerWall => "flow.wall-velocity.0",
            Self::UpperWall => "flow.wall-velocity.1",
            Self::PoiseuilleSpeed => "flow.poiseuille.speed",
            Self::PoiseuilleHalfWidth => "flow.poiseuille.half-width",
            Self::Length | Self::ViscosityRatio => self.name(),
        }
    }
}
