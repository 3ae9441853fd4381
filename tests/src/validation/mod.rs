//! Comparisons of motile with exact and independently computed values.
//!
//! Each module is one study: a function from resolutions to rows with errors. Tests run the cheap resolutions and
//! assert orders and bounds; the study `validation` runs all of them and prints the tables of the documentation.
//!
//! ```
//! use motile_tests::validation::{fixed_shapes, Case};
//! use motile::ib_core::BSpline;
//! let row = fixed_shapes::errors(&BSpline::<4>, true, 0.1, Case::Circle)?;
//! assert!(row.maximum < 0.02); // 2 per cent of the largest velocity on 60 x 60 cells
//! # Ok::<(), motile_tests::validation::StudyError>(())
//! ```

pub mod contrast;
pub mod coupled;
pub mod curved_walls;
pub mod exchange;
pub mod fast_sums;
pub mod fixed_shapes;
pub mod flat;
pub mod growth;
pub mod headings;
pub mod imposed;
pub mod interfaces;
mod order;
mod reference;
pub mod relaxation;
pub mod round_swimmer;
pub mod scene;
pub mod solids;
pub mod surfactant;
pub mod swimmers;
mod table;
pub mod viscoelastic;

pub use fixed_shapes::Case;
pub use order::order;
pub use reference::Reference;
pub use table::Table;

/// A study that could not be run.
pub type StudyError = anyhow::Error;
