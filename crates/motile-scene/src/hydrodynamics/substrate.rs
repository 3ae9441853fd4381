//! The simplest flow.

use std::f64::consts::PI;

use motile_base::{FlowSample, InputError, SolveReport, Vec2, positive};

use super::{Domain, FlowWork, FluidView, Hydrodynamics, Markers};
use crate::FlowError;

/// Fluid that resists each marker alone, as a film on a substrate does: `v = F/zeta`, zeta a friction coefficient
/// (force over velocity), without walls and periods. Bodies do not feel each other through it; for trying bodies,
/// integrators and observers out, and as a pattern for your own flows.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("friction", "drag"))]
pub struct Substrate {
    friction: f64,
}

impl Substrate {
    /// Creates a substrate from the friction coefficient zeta of a marker (force over velocity).
    ///
    /// # Errors
    /// Returns an error for a coefficient that is not positive and finite.
    pub fn new(friction: f64) -> Result<Self, InputError> {
        Ok(Self { friction: positive("the friction coefficient", friction)? })
    }
}

impl Hydrodynamics for Substrate {
    /// Reports the viscosity zeta/(4 pi), at which a marker of a fluid moves about as easily. Markers at the spacing ds
    /// of a curve of tension gamma relax at most at the rate 4 gamma/(zeta ds): the stiffness is taken for ds = 0.05.
    fn fluid_view(&self) -> FluidView {
        let domain = Domain { origin: [0.0; 2], periods: [None; 2].into(), walls: None };
        let (viscosity, interface_stiffness) = (self.friction / (4.0 * PI), 1.0 / (PI * 0.05));
        FluidView {
            domain,
            viscosity,
            spacing: None,
            second_order: true,
            shape_modes: None,
            nodes: None,
            interface_stiffness,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let [_, forces, velocities] = markers.lists_mut();
        velocities.iter_mut().zip(forces).for_each(|(velocity, force)| *velocity = *force / self.friction);
        Ok(SolveReport::default())
    }

    fn sample(&mut self, _: &Markers, _: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        out.fill(FlowSample::default());
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }
}
