//! Stokes solvers on staggered grids.

mod error;
mod field;
mod grid;
mod solver;

pub use error::StokesError;
pub use field::{CentreField, NodeField, StaggeredField};
pub use grid::Grid;
pub use solver::{SolveReport, StokesSolver, Work};
