//! Observables of interfaces that are periodic along x.

use std::f64::consts::TAU;

use motile_base::Vec2;
use motile_scene::{Body, BodyError, BodyFlow, FluidView, Observe};

use super::{FourierModes, MODES};
use crate::ActiveInterface;

/// Observables of an interface that is periodic along x, at one time.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PeriodicObservables {
    /// Mean height over x (length).
    pub height: f64,
    /// Length over one period (length).
    pub length: f64,
    /// Number of particles.
    pub particle_number: f64,
    /// Largest and smallest concentration (particles per length); `None` without particles.
    pub concentration_range: Option<[f64; 2]>,
    /// Fourier modes of the height (length) in the angle 2 pi x/L, L the period: the mean of y cos over x, twice, and
    /// so on; where the interface overhangs as integrals along it.
    pub height_modes: FourierModes,
    /// Fourier modes of the concentration (particles per length) in the angle 2 pi (s + x1/L), with the fraction s of
    /// the length of the interface from its first marker on along x, and the place x1 of that marker. The angle of a
    /// flat interface is the angle of the height modes, wherever the first marker has drifted. Zero without particles.
    pub concentration_modes: FourierModes,
    /// Flux of particles along x (1/time), its mean over the period, in the frame of the laboratory. A pattern at rest
    /// in fluid that moves as a whole has the flux of its particles with the fluid.
    pub flux: f64,
    /// Mean velocity of the fluid on the interface (length per time).
    pub velocity: Vec2,
}

/// Names of the modes that are entries, cos and sin in turn.
const HEIGHT_MODES: [[&str; 2]; MODES] = [
    ["height_cos_1", "height_sin_1"],
    ["height_cos_2", "height_sin_2"],
    ["height_cos_3", "height_sin_3"],
    ["height_cos_4", "height_sin_4"],
    ["height_cos_5", "height_sin_5"],
    ["height_cos_6", "height_sin_6"],
];
const CONCENTRATION_MODES: [[&str; 2]; MODES] = [
    ["concentration_cos_1", "concentration_sin_1"],
    ["concentration_cos_2", "concentration_sin_2"],
    ["concentration_cos_3", "concentration_sin_3"],
    ["concentration_cos_4", "concentration_sin_4"],
    ["concentration_cos_5", "concentration_sin_5"],
    ["concentration_cos_6", "concentration_sin_6"],
];

impl PeriodicObservables {
    /// Returns the names and values of all entries, in the order of the columns of a table. The entries of modes are
    /// the coefficients of cos and sin. Values that do not exist are `None`.
    #[must_use]
    pub fn entries(&self) -> Vec<(&'static str, Option<f64>)> {
        let [maximum, minimum] = [0, 1].map(|i| self.concentration_range.map(|range| range[i]));
        let mut entries = vec![
            ("height", Some(self.height)),
            ("length", Some(self.length)),
            ("particle_number", Some(self.particle_number)),
            ("concentration_max", maximum),
            ("concentration_min", minimum),
            ("flux", Some(self.flux)),
            ("velocity_x", Some(self.velocity.x)),
            ("velocity_y", Some(self.velocity.y)),
        ];
        for (names, modes) in [(HEIGHT_MODES, &self.height_modes), (CONCENTRATION_MODES, &self.concentration_modes)] {
            let pairs = names.into_iter().zip(modes.cosines.iter().zip(&modes.sines));
            entries.extend(pairs.flat_map(|([cos, sin], (a, b))| [(cos, Some(*a)), (sin, Some(*b))]));
        }
        entries
    }
}

impl Observe for ActiveInterface {
    type Observables = PeriodicObservables;

    /// Those of a closed interface are as if it were cut at its first marker, and their height is not a number:
    /// [`crate::ActiveDroplet`] has its own.
    fn observables(&self, _: &FluidView, flow: &BodyFlow<'_>) -> Result<PeriodicObservables, BodyError> {
        let (geometry, advance) = (self.geometry(), self.advance());
        let period = advance.abs();
        let count = self.marker_count();
        let nodes = || self.markers().iter().zip(&geometry.tangents).zip(&geometry.weights);
        let heights = nodes().map(|((marker, tangent), weight)| {
            (Vec2::from_angle(TAU * marker.x / period), tangent.x * weight * TAU / advance, marker.y)
        });
        let height_modes = FourierModes::sum(MODES, heights);
        let velocity: Vec2 = geometry.weights.iter().zip(flow.velocities).map(|(weight, u)| *weight * *u).sum();
        let forward = if advance < 0.0 { -1.0 } else { 1.0 };
        let first = self.markers().first().map_or(0.0, |marker| TAU * marker.x / period);
        let mut start = 0.0;
        let cells = self.particle_numbers().iter().zip(&geometry.lengths);
        let concentration_modes = FourierModes::sum(
            MODES,
            cells.map(|(number, length)| {
                let width = TAU * length / geometry.perimeter;
                let angle = first + forward * (start + 0.5 * width);
                start += width;
                (Vec2::from_angle(angle), width, number / length)
            }),
        );
        let flux = self
            .particle_numbers()
            .iter()
            .enumerate()
            .map(|(k, number)| 0.5 * number * (flow.velocities[k].x + flow.velocities[(k + 1) % count].x) / period);
        let concentrations = self.concentrations();
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let range = concentrations.iter().fold(range, |[most, least], c| [most.max(*c), least.min(*c)]);
        Ok(PeriodicObservables {
            height: height_modes.mean,
            length: geometry.perimeter,
            particle_number: self.number(),
            concentration_range: self.carries().then_some(range),
            height_modes,
            concentration_modes,
            flux: flux.sum(),
            velocity: velocity / geometry.weights.iter().sum::<f64>(),
        })
    }
}
