//! A droplet and the flow around it at one time.

use anyhow::{Context, Result};
use motile::{
    active_interface::{ActiveDroplet, curve::polygon_moments},
    ib_core::{Domain, FlowSample, Hydrodynamics, System},
};

use crate::{Raster, SolidShape, Vec2, solid_shape, solids};

/// The cells of a domain that is bounded by walls or periodic, those of a grid of spacing `spacing` (length) if they
/// are no more than `most` in a direction, and larger ones otherwise.
///
/// # Errors
/// A domain without end.
pub fn domain_raster(domain: &Domain, spacing: f64, most: usize) -> Result<Raster> {
    let [x, y] = domain.origin;
    let periodic = domain.periods.map(|period| period.is_some());
    let width = domain.periods[0].context("a domain without end in x cannot be drawn")?;
    let height = domain.periods[1].or(domain.walls.map(|[below, above]| above - below));
    let height = height.context("a domain without end in y cannot be drawn")?;
    let origin = [x, domain.walls.map_or(y, |[below, _]| below)];
    let coarsening = (width.max(height) / spacing / most as f64).max(1.0);
    let cells = [width, height].map(|side| ((side / (spacing * coarsening)).round() as usize).max(1));
    Raster::new(origin, [width, height], cells, periodic)
}

/// The mean of the values of the two segments that meet at each marker.
#[must_use]
pub fn at_markers(segments: &[f64]) -> Vec<f64> {
    let before = segments.iter().cycle().skip(segments.len().saturating_sub(1));
    segments.iter().zip(before).map(|(here, before)| 0.5 * (here + before)).collect()
}

/// The droplet of a scene and the flow on a raster, at one time.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// When.
    pub time: f64,
    /// The sample points of the flow.
    pub raster: Raster,
    /// The flow at them.
    pub flow: Vec<FlowSample>,
    /// The interface (length).
    pub markers: Vec<Vec2>,
    /// Concentration at the markers (particles per length).
    pub concentration: Vec<f64>,
    /// Centroid (length).
    pub centroid: Vec2,
    /// Elastic solids.
    pub solids: Vec<SolidShape>,
}

impl Snapshot {
    /// The first droplet of a system at its present state.
    ///
    /// # Errors
    /// No droplet, or a flow that cannot be computed.
    pub fn take<H: Hydrodynamics>(system: &mut System<H>, raster: Raster) -> Result<Self> {
        let mut flow = vec![FlowSample::default(); raster.len()];
        system.sample(&raster.points(), &mut flow)?;
        let droplets = system.bodies::<ActiveDroplet>().next();
        let (_, droplet) = droplets.context("a scene without a droplet cannot be drawn")?;
        Ok(Self {
            time: system.time(),
            raster,
            flow,
            markers: droplet.markers().to_vec(),
            concentration: at_markers(droplet.concentrations()),
            centroid: polygon_moments(droplet.markers())?.centroid,
            solids: solids(system).map(solid_shape).collect(),
        })
    }

    /// Pressures at the sample points (force per length).
    #[must_use]
    pub fn pressure(&self) -> Vec<f64> {
        self.flow.iter().map(|sample| sample.pressure).collect()
    }

    /// Velocities at the sample points (length per time).
    #[must_use]
    pub fn velocity(&self) -> Vec<Vec2> {
        self.flow.iter().map(|sample| sample.velocity).collect()
    }

    /// Vorticities dv/dx - du/dy at the sample points (1/time).
    #[must_use]
    pub fn vorticity(&self) -> Vec<f64> {
        self.flow.iter().map(|sample| sample.gradient[1][0] - sample.gradient[0][1]).collect()
    }
}

#[cfg(test)]
mod tests;
