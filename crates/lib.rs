//! Active droplets swimming in two-dimensional Stokes flow.

mod swimmer;

pub use swimmer::{InitialState, PeriodicBox, SetupError, Swimmer};
pub use {active_interface, elastic_solids, ib_core, stokes_grid};
