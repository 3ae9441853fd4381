//! A body that is pulled by a constant force.

use motile::base::Vec2;
use motile::scene::{Body, BodyError, FluidView, MarkerKind};

/// Points on a circle about the origin that move with the fluid, with a constant force on the fluid shared among them.
#[derive(Debug, Clone)]
pub(crate) struct Weight {
    points: Vec<Vec2>,
    force: Vec2,
}

impl Weight {
    /// That many points at that radius (length), with that force in all.
    pub(crate) fn new(count: usize, radius: f64, force: Vec2) -> Self {
        let place = |k: usize| {
            let (s, c) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            radius * Vec2::new(c, s)
        };
        Self { points: (0..count).map(place).collect(), force }
    }
}

impl Body for Weight {
    fn name(&self) -> &str {
        "weight"
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.points.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.points);
    }

    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        forces.fill(self.force / self.points.len() as f64);
        Ok(())
    }

    fn state_len(&self) -> usize {
        2 * self.points.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        for (pair, point) in state.chunks_exact_mut(2).zip(&self.points) {
            pair.copy_from_slice(&point.to_array());
        }
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        for (point, pair) in self.points.iter_mut().zip(state.chunks_exact(2)) {
            *point = Vec2::new(pair[0], pair[1]);
        }
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        for (pair, velocity) in rate.chunks_exact_mut(2).zip(velocities) {
            pair.copy_from_slice(&velocity.to_array());
        }
    }
}
