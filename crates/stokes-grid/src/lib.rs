//! Stokes solvers on staggered grids.

mod channel;
mod channel_modes;
mod checks;
mod drive;
mod error;
mod field;
mod grid;
mod kinematics;
mod mean_flow;
mod periodic;
mod projection;
mod projection_channel;
mod projection_periodic;
mod rows;
mod sine_cosine;
mod solver;
mod sums;
mod symbol;
mod transform;
mod walls;

pub use channel::ChannelStokes;
pub use drive::Drive;
pub use error::StokesError;
pub use field::{CentreField, NodeField, StaggeredField};
pub use grid::Grid;
pub use kinematics::{
    divergence, flux, normal_strain_rates, shear_strain_rate, streamfunction, vorticity, wall_shear_stress,
};
pub use periodic::PeriodicStokes;
pub use projection::ProjectionStokes;
pub use solver::{SolveReport, StokesSolver, Work};
pub use symbol::Symbol;
pub use transform::RealFft2;
pub use walls::{Wall, WallMotion};
