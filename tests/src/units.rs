//! Descriptions of the same scenes in other units.

use motile::setup::{DropletSetup, DropletShape, ExcludedVolume, GridMethod, LayersMethod, Method, Particles};

/// A unit of length, of time and of force: what they are of those of the scene.
#[derive(Debug, Clone, Copy)]
pub struct Units {
    /// The radius of a droplet.
    pub length: f64,
    /// The time that is 1 otherwise.
    pub time: f64,
    /// The force that is 1 otherwise.
    pub force: f64,
}

impl Units {
    /// Units that are those of the scene.
    pub const PLAIN: Self = Self { length: 1.0, time: 1.0, force: 1.0 };

    /// A viscosity (stress times time).
    #[must_use]
    pub fn viscosity(self, value: f64) -> f64 {
        value * self.force * self.time / self.length
    }

    /// A droplet of radius 1 with the default particles and excluded volume.
    #[must_use]
    pub fn droplet(self, activity: f64, at: [f64; 2], viscosity: Option<f64>) -> DropletSetup {
        let Self { length, time, force } = self;
        let particles = Particles {
            activity: activity * force * length,
            excluded_volume: ExcludedVolume::Step(10.0 * force * length),
            diffusion: 0.1 * length * length / time,
            concentration: 100.0 / length,
            ..Particles::default()
        };
        DropletSetup {
            centre: at.map(|x| x * length),
            angle: 0.3,
            viscosity: viscosity.map(|value| self.viscosity(value)),
            tension: 10.0 * force,
            shape: DropletShape::Round { radius: length },
            particles: Some(particles),
            ..DropletSetup::default()
        }
    }

    /// A grid.
    #[must_use]
    pub fn grid(self, spacing: f64) -> Method {
        Method::Grid(GridMethod::of_spacing(spacing * self.length))
    }

    /// Layers beside a grid of a spacing given in the units of the default scene.
    #[must_use]
    pub fn layers(self, spacing: f64) -> Method {
        Method::Layers(LayersMethod::of_spacing(spacing * self.length))
    }
}
