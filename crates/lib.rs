//! Active droplets swimming in two-dimensional Stokes flow.

pub use {active_interface, elastic_solids, ib_core, stokes_grid};
