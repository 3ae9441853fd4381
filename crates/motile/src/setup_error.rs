//! What keeps a scene from being set up.

use active_interface::InterfaceError;
use boundary_integral::BoundaryIntegralError;
use elastic_solids::SolidError;
use ib_core::FlowError;
use stokes_grid::StokesError;

/// A scene that could not be set up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// The grid or the solver.
    #[error(transparent)]
    Stokes(#[from] StokesError),
    /// The droplet.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// The coupling.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// The boundary integrals.
    #[error(transparent)]
    BoundaryIntegral(#[from] BoundaryIntegralError),
    /// The elastic walls.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A droplet that starts inside a wall.
    #[error("the droplet reaches {depth} into a wall at ({x}, {y}): move it or make the channel wider there")]
    Overlap {
        /// Where, in x.
        x: f64,
        /// Where, in y.
        y: f64,
        /// How deep (length).
        depth: f64,
    },
    /// A box that does not hold a whole number of cells or is too small for the droplet.
    #[error("a box of {lx} x {ly} with cells of {spacing} {problem}")]
    Box {
        /// Length in x.
        lx: f64,
        /// Length in y.
        ly: f64,
        /// Grid spacing.
        spacing: f64,
        /// What is wrong, and the remedy.
        problem: &'static str,
    },
    /// An error that no settings were measured for.
    #[error("no settings are known for an error of {target:e}: ask for one from {smallest:e} to {largest}")]
    TargetError {
        /// The error asked for (no dimension).
        target: f64,
        /// The smallest that was measured.
        smallest: f64,
        /// The largest that is given settings for.
        largest: f64,
    },
}
