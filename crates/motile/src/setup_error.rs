//! What keeps a scene from being set up.

use active_interface::InterfaceError;
use boundary_integral::LayerError;
use elastic_solids::SolidError;
use interior_fields::InteriorError;
use motile_scene::FlowError;
use stokes_grid::StokesError;

/// A scene that could not be set up.
#[derive(thiserror::Error)]
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
    /// The bodies together.
    #[error(transparent)]
    Scene(#[from] motile_scene::SceneError),
    /// The boundary integrals.
    #[error(transparent)]
    BoundaryIntegral(#[from] LayerError),
    /// The elastic walls.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// What fills droplets.
    #[error(transparent)]
    Interior(#[from] InteriorError),
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
    /// What is wrong with an entry of the description.
    #[error("{key}: {source}")]
    Entry {
        /// Where it stands in the description, with its name if it has one of its own.
        key: String,
        /// What is wrong with it.
        source: Box<Self>,
    },
    /// A body that the region does not hold beside its images.
    #[error(
        "a region of {length} x {width} does not hold it: move it to the middle, make it smaller, or give a longer or \
         wider region"
    )]
    NoRoom {
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
    /// A body that starts inside another one, or where another one is.
    #[error(
        "{key} overlaps {other} by {depth:.3e} at ({x:.4}, {y:.4}), more than {allowed:.3e}: move them apart or make \
         one of them smaller"
    )]
    Overlap {
        /// Where it stands in the description, with its name if it has one of its own.
        key: String,
        /// The same of the other body.
        other: String,
        /// Where, in x.
        x: f64,
        /// Where, in y.
        y: f64,
        /// How deep (length).
        depth: f64,
        /// How deep it may be (length).
        allowed: f64,
    },
    /// A droplet that starts in touch with another one, or with its own image.
    #[error("{key} touches {other} at ({x:.4}, {y:.4}): leave a film of fluid between them")]
    Touch {
        /// Where it stands in the description, with its name if it has one of its own.
        key: String,
        /// The same of the other droplet.
        other: String,
        /// Where, in x.
        x: f64,
        /// Where, in y.
        y: f64,
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

motile_base::debug_as_explanation!(SetupError);

impl SetupError {
    /// The same with the place of what it is about, unless it says so itself.
    pub(crate) fn of(self, key: &str) -> Self {
        match self {
            Self::Value { .. } | Self::Entry { .. } => self,
            other => Self::Entry { key: key.to_owned(), source: Box::new(other) },
        }
    }
}
