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

pub mod channel;
pub mod contrast;
pub mod curved_walls;
pub mod exchange;
pub mod fast_sums;
pub mod fixed_shapes;
pub mod flat;
pub mod growth;
pub mod headings;
pub mod imposed;
pub mod interfaces;
pub mod lateral;
mod order;
mod reference;
pub mod relaxation;
pub mod resolution;
pub mod scene;
pub mod solids;
pub mod swimmers;
mod table;
pub mod viscoelastic;

pub use fixed_shapes::Case;
pub use order::order;
pub use reference::{Reference, ReferenceFile};
pub use table::Table;

/// A study that could not be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The scene could not be set up.
    #[error(transparent)]
    Setup(#[from] motile::SetupError),
    /// The scene could not be run.
    #[error(transparent)]
    Scene(#[from] motile::scene::SceneError),
    /// The flow could not be computed.
    #[error(transparent)]
    Flow(#[from] motile::scene::FlowError),
    /// A body.
    #[error(transparent)]
    Body(#[from] motile::scene::BodyError),
    /// The grid.
    #[error(transparent)]
    Stokes(#[from] motile::stokes_grid::StokesError),
    /// The droplet.
    #[error(transparent)]
    Interface(#[from] motile::active_interface::InterfaceError),
    /// The analysis of a trajectory.
    #[error(transparent)]
    Analysis(#[from] motile::analysis::AnalysisError),
    /// The particles inside.
    #[error(transparent)]
    Interior(#[from] motile::interior::InteriorError),
    /// The solid.
    #[error(transparent)]
    Solid(#[from] motile::elastic_solids::SolidError),
    /// The boundary integrals.
    #[error(transparent)]
    BoundaryIntegral(#[from] motile::boundary_integrals::LayerError),
    /// The reference values.
    #[error("the reference values are not readable: {0}")]
    Reference(String),
}
