//! Results of flow computations.

use serde::{Deserialize, Serialize};

use crate::Vec2;

/// Velocity, pressure and velocity gradient of the flow at a point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FlowSample {
    /// Velocity (length per time).
    pub velocity: Vec2,
    /// Pressure (stress) without the mean pressure gradient [`SolveReport::mean_pressure_gradient`], to which you add
    /// the gradient times the place.
    ///
    /// The constant that a pressure is only known up to is the same for every method. In a box, the mean over the box
    /// is zero, in a channel the mean over both of its straight walls, and in unbounded fluid the pressure far away.
    pub pressure: f64,
    /// Velocity gradient `[[du/dx, du/dy], [dv/dx, dv/dy]]` (1/time).
    pub gradient: [[f64; 2]; 2],
}

/// Iterations, residual and mean pressure gradient of one solution of the Stokes equations.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SolveReport {
    /// Iterations; 0 for a direct solver.
    pub iterations: usize,
    /// Relative residual; 0 for a direct solver, which is exact to round-off.
    pub residual: f64,
    /// Mean pressure gradient (stress per length), the uniform part of grad p; in a periodic box the mean force
    /// density.
    ///
    /// In a straight tube it is the mean over the length of the tube, or if it has none the gradient far from all
    /// bodies, `-8 viscosity flux/(pi radius^4)`. In a tube of another shape there is none: its x component is not a
    /// number, and you get the pressure drop from samples near both ends, whose pressures are complete.
    pub mean_pressure_gradient: [f64; 2],
}
