//! Active droplets swimming in two-dimensional Stokes flow.

mod swimmer;

pub use swimmer::{InitialConcentration, PeriodicBox, SetupError, Swimmer};
pub use {active_interface, elastic_solids, ib_core, stokes_grid};
