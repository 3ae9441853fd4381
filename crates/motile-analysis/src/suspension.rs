//! Measurements on many droplets: order, correlations, displacements, clusters; functions on plain slices.

mod clusters;
mod displacements;
mod fluctuations;
mod order;
mod pairs;

pub use clusters::cluster_sizes;
pub use displacements::{heading_correlation, mean_square_displacement, rotational_diffusion};
pub use fluctuations::number_fluctuations;
pub use order::{nematic_order, polar_order};
pub use pairs::{PairAverages, PairCorrelations};

use std::f64::consts::TAU;

use motile_base::{PeriodicSeries, Vec2};
use motile_scene::{Handle, Hydrodynamics, SceneError, System};

use active_interface::observables::{InterfaceState, centroid_velocity};
use active_interface::{ActiveDroplet, InterfaceError, polygon_moments};

/// Droplet as one of many, at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Member {
    /// Droplet of the scene.
    pub droplet: Handle<ActiveDroplet>,
    /// Centroid of the area (length), not wrapped into the periods of the region.
    pub centroid: Vec2,
    /// Direction from the centre of its particles to the centroid of its area, in which it swims where it is alone (no
    /// dimension, of length 1); zero without particles and for exactly uniform ones.
    pub heading: Vec2,
    /// Velocity of the centroid (length per time).
    pub velocity: Vec2,
    /// Area inside the smooth curve through the markers (length squared).
    pub area: f64,
    /// Number of particles on the interface.
    pub particles: f64,
}

impl Member {
    /// All droplets of a scene in the present state, in the order in which they were added; the flow is computed if it
    /// is not known yet.
    ///
    /// # Errors
    /// Those of the flow; a droplet without area.
    pub fn all<H: Hydrodynamics>(system: &mut System<H>) -> Result<Vec<Self>, SceneError> {
        system.evaluate()?;
        let time = system.time();
        let handles: Vec<Handle<ActiveDroplet>> = system.bodies().map(|(handle, _)| handle).collect();
        let mut series = None;
        let seen = handles.into_iter().map(|droplet| {
            let state = InterfaceState::of(system, droplet)?;
            Self::of(droplet, &state, &mut series).map_err(|source| SceneError::Body {
                time,
                body: system.body(droplet).map(|body| motile_scene::Body::name(body).to_owned()).unwrap_or_default(),
                source: source.into(),
            })
        });
        seen.collect()
    }

    fn of(
        droplet: Handle<ActiveDroplet>,
        state: &InterfaceState<'_>,
        series: &mut Option<PeriodicSeries>,
    ) -> Result<Self, InterfaceError> {
        let moments = polygon_moments(state.markers)?;
        let next = state.markers.iter().cycle().skip(1);
        let middles = state.markers.iter().zip(next).map(|(from, to)| 0.5 * (from + to) - moments.centroid);
        let behind: Vec2 = middles.zip(state.numbers).map(|(place, number)| *number * place).sum();
        Ok(Self {
            droplet,
            centroid: moments.centroid,
            heading: (-behind).try_normalize().unwrap_or_default(),
            velocity: centroid_velocity(state.markers, state.velocities)?,
            area: smooth_area(series, state.markers, moments.centroid)?,
            particles: state.numbers.iter().sum(),
        })
    }
}

/// Area inside the trigonometric interpolant of markers (length squared), about a place near them (length); `series`
/// is planned once for each number of markers.
fn smooth_area(series: &mut Option<PeriodicSeries>, markers: &[Vec2], about: Vec2) -> Result<f64, InterfaceError> {
    let series = match series {
        Some(planned) if planned.len() == markers.len() => planned,
        _ => series.insert(PeriodicSeries::new(markers.len())?),
    };
    series.analyse_vectors(markers)?;
    series.differentiate();
    let step = TAU / markers.len() as f64;
    let columns = markers.iter().map(|marker| *marker - about).zip(series.values());
    Ok(columns.map(|(at, tangent)| 0.5 * (at.x * tangent.im - at.y * tangent.re) * step).sum())
}

#[cfg(test)]
mod tests;
