//! Stokes solvers on staggered grids.

mod error;
mod field;
mod grid;
mod periodic;
mod solver;
mod transform;

pub use error::StokesError;
pub use field::{CentreField, NodeField, StaggeredField};
pub use grid::Grid;
pub use periodic::PeriodicStokes;
pub use solver::{SolveReport, StokesSolver, Work};
pub use transform::{RealFft2, Symbol};
