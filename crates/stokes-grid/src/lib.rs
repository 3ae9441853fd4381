//! Stokes solvers on staggered grids.

mod channel;
mod channel_modes;
mod checks;
mod drive;
mod error;
mod field;
mod grid;
mod mean_flow;
mod periodic;
mod rows;
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
pub use periodic::PeriodicStokes;
pub use solver::{SolveReport, StokesSolver, Work};
pub use symbol::Symbol;
pub use transform::RealFft2;
pub use walls::{Wall, WallMotion};
