//! Particles inside droplets.

use active_interface::ActiveDroplet;
use interior_fields::ParticlesInDroplet;
use motile_scene::Handle;

use super::{DropletSetup, Setup};
use crate::SetupError;

/// Spacing of a mesh over that of the markers where there is no grid.
const MARKERS_APART: f64 = 5.0;

impl Setup {
    /// The particles that diffuse inside a droplet, made to be the body `host`.
    pub(super) fn particles_inside(
        &self,
        setup: &DropletSetup,
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
    ) -> Result<Option<ParticlesInDroplet>, SetupError> {
        let Some((particles, exchange)) = setup.particles.as_ref().and_then(|all| Some((all, all.exchange?))) else {
            return Ok(None);
        };
        let Some(diffusion) = exchange.diffusion_inside else { return Ok(None) };
        let density = exchange.number(particles.concentration, droplet.initial_area())? / droplet.initial_area();
        let grid = || self.method.spacing().unwrap_or(MARKERS_APART * droplet.segment_lengths()[0]);
        let spacing = exchange.spacing_inside.unwrap_or_else(grid);
        Ok(Some(ParticlesInDroplet::new(droplet, host, exchange.rates()?, diffusion, |_| density, spacing)?))
    }
}
