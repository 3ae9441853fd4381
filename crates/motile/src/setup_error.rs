//! What keeps a scene from being set up.

use active_interface::InterfaceError;
use boundary_integral::LayerError;
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
    BoundaryIntegral(#[from] LayerError),
    /// The elastic walls.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A value that makes no scene.
    #[error("{key} = {value}: {remedy}")]
    Value {
        /// Where it stands in the description.
        key: String,
        /// What it is.
        value: String,
        /// What to give instead, and why.
        remedy: String,
    },
    /// A droplet that the region does not hold.
    #[error(
        "a region of {length} x {width} does not hold {name}: move it to the middle, make it smaller, or give a longer or \
         wider region"
    )]
    NoRoom {
        /// The droplet.
        name: String,
        /// Length of the region in x.
        length: f64,
        /// Length of the region in y, or distance of its walls.
        width: f64,
    },
    /// A scene file that cannot be understood.
    #[error("the scene file is not understood: {problem}")]
    File {
        /// The line and what is wrong with it.
        problem: String,
    },
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

impl SetupError {
    /// Something that boundary integrals do not have.
    pub(crate) fn needs_a_grid(what: &str) -> Self {
        let remedy = format!("{what} need a grid: give the method of immersed boundaries");
        Self::Value { key: "method".to_owned(), value: "integral".to_owned(), remedy }
    }
}
