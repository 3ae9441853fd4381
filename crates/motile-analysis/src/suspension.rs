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

use motile_base::Vec2;
use motile_scene::{Handle, Hydrodynamics, MomentEllipse, SceneError, System};

use active_interface::observables::{Convention, Frame, InterfaceState, centroid_velocity};
use active_interface::{ActiveDroplet, InterfaceError, polygon_moments};

/// Distance between the centres of particles and area, over the radius, up to which it is round-off (no dimension).
const ROUND_OFF: f64 = 1e-9;

/// Droplet as one of many, at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Member {
    /// Droplet of the scene.
    pub droplet: Handle<ActiveDroplet>,
    /// Centroid of the area (length), not wrapped into the periods of the region.
    pub centroid: Vec2,
    /// Direction from the centre of its particles to the centroid of its area, in which it swims where it is alone (no
    /// dimension, of length 1); zero without particles, and if the centres coincide to round-off.
    pub heading: Vec2,
    /// Velocity of the centroid (length per time).
    pub velocity: Vec2,
    /// Velocity of the centroid relative to the imposed flow there (length per time).
    pub relative_velocity: Vec2,
    /// Area inside the smooth curve through the markers (length squared).
    pub area: f64,
    /// The ellipse with the moments of that area: deformation and inclination.
    pub shape: MomentEllipse,
    /// Stresslet in the axes x and y (force times length), of the sign of
    /// [`active_interface::observables::ForceMoments::stresslet`].
    pub stresslet: [[f64; 2]; 2],
    /// Number of particles on the interface.
    pub particles: f64,
}

impl Member {
    /// Returns all droplets of a scene in the present state, in the order in which they were added; the flow is
    /// computed if it is not known yet.
    ///
    /// # Errors
    /// Returns the errors of the flow; a droplet without area.
    pub fn all<H: Hydrodynamics>(system: &mut System<H>) -> Result<Vec<Self>, SceneError> {
        system.evaluate()?;
        let time = system.time();
        let handles: Vec<Handle<ActiveDroplet>> = system.bodies().map(|(handle, _)| handle).collect();
        let seen = handles.into_iter().map(|droplet| {
            let state = InterfaceState::of(system, droplet)?;
            Self::of(droplet, &state).map_err(|source| SceneError::Body {
                time,
                body: system.body(droplet).map(|body| motile_scene::Body::name(body).to_owned()).unwrap_or_default(),
                source: source.into(),
            })
        });
        seen.collect()
    }

    fn of(droplet: Handle<ActiveDroplet>, state: &InterfaceState<'_>) -> Result<Self, InterfaceError> {
        let moments = polygon_moments(state.markers)?;
        let next = state.markers.iter().cycle().skip(1);
        let middles = state.markers.iter().zip(next).map(|(from, to)| 0.5 * (from + to) - moments.centroid);
        let arms = || middles.clone().zip(state.numbers).map(|(place, number)| *number * place);
        let (behind, all) = (arms().sum::<Vec2>(), arms().map(Vec2::length).sum::<f64>());
        let polar = behind.length() > ROUND_OFF * all;
        let velocity = centroid_velocity(state.markers, state.velocities)?;
        let shape = MomentEllipse::of(state.markers)?;
        Ok(Self {
            droplet,
            centroid: moments.centroid,
            heading: (-behind).try_normalize().filter(|_| polar).unwrap_or_default(),
            velocity,
            relative_velocity: velocity - state.imposed.velocity_at(moments.centroid),
            area: shape.area,
            shape,
            stresslet: state.moments(Convention::FarField, &Frame::new(moments.centroid, 0.0)?)?.stresslet(),
            particles: state.numbers.iter().sum(),
        })
    }
}

#[cfg(test)]
mod tests;
