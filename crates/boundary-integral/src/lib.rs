//! Stokes flow of fluid interfaces by boundary integrals.

mod box_flow;
mod calculus;
mod channel_flow;
mod close;
mod contrast;
mod domain;
mod error;
mod expansion;
mod field;
mod gmres;
mod images;
mod interface;
mod lattice;
mod lattice_kernel;
mod layers;
mod logarithm;
mod near;
mod pair_kernel;
mod pair_sums;
mod planes;
mod sampler;
mod settings;
mod solver;
mod stress;
mod surroundings;
mod transform;
mod walls;

pub use calculus::{BandLimit, PeriodicCalculus, Resample, TensionPlacement};
pub use domain::{Channel, FluidDomain, FreeSpace, PeriodicBox};
pub use error::BoundaryIntegralError;
pub use settings::Settings;
pub use solver::BoundaryIntegral;
pub use stokes_grid::Drive;
