//! A flow for tests of scenes.

use motile_base::{FlowSample, SolveReport, Vec2};

use super::{Domain, FlowWork, FluidView, Hydrodynamics, Markers};
use crate::{FlowError, saved_state::SavedState};

/// A periodic box with a grid spacing in which the fluid resists each marker alone, about as much as a grid does.
#[derive(Debug, Clone)]
pub(crate) struct DragBox {
    side: f64,
    viscosity: f64,
    spacing: f64,
    kept: SavedState,
}

impl DragBox {
    pub(crate) fn new(side: f64, viscosity: f64, spacing: f64) -> Self {
        Self { side, viscosity, spacing, kept: SavedState::default() }
    }
}

impl Hydrodynamics for DragBox {
    fn fluid_view(&self) -> FluidView {
        FluidView {
            domain: Domain { origin: [0.0; 2], periods: [Some(self.side); 2].into(), walls: None },
            viscosity: self.viscosity,
            spacing: Some(self.spacing),
            shape_modes: None,
            nodes: None,
            second_order: true,
            interface_stiffness: 1.0 / self.spacing,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let friction = 5.0 * self.viscosity;
        let [_, forces, velocities] = markers.lists_mut();
        velocities.iter_mut().zip(forces).for_each(|(velocity, force)| *velocity = *force / friction);
        Ok(SolveReport::default())
    }

    fn sample(&mut self, _: &Markers, _: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        out.fill(FlowSample::default());
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }

    fn save(&self) -> SavedState {
        self.kept.clone()
    }

    fn load(&mut self, saved: &SavedState) {
        self.kept = saved.clone();
    }
}
