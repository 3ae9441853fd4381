//! Active droplets swimming in two-dimensional Stokes flow.

mod swimmer;

pub use swimmer::{InitialState, PeriodicBox, RigidChannel, SetupError, Swimmer};
pub use {active_interface, boundary_integral, elastic_solids, ib_core, stokes_grid};
