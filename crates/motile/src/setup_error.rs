//! Errors of descriptions, from which no scene can be built.

use active_interface::InterfaceError;
use elastic_solids::SolidError;
use motile_boundary_integrals::LayerError;
use motile_interior::InteriorError;
use motile_scene::FlowError;
use stokes_grid::StokesError;

/// A scene that could not be set up.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// Error of the grid or the Stokes solver.
    #[error(transparent)]
    Stokes(#[from] StokesError),
    /// Error of a droplet's curve or particles.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// Error of the coupling of markers and fluid.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// Error of the scene as a whole.
    #[error(transparent)]
    Scene(#[from] motile_scene::SceneError),
    /// Error of the boundary integrals.
    #[error(transparent)]
    BoundaryIntegral(#[from] LayerError),
    /// Error of an elastic solid, its outline or its mesh.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// Error of a gel or of particles that fill a droplet.
    #[error(transparent)]
    Interior(#[from] InteriorError),
    /// Value out of its range, or one that does not fit the rest of the description.
    #[error("{key} = {value}: {remedy}")]
    Value {
        /// Key of the value, with those of the entries that it is in: `droplets[0].tension`.
        key: String,
        /// The value.
        value: String,
        /// Remedy: the value to give instead, and the reason.
        remedy: String,
    },
    /// Error in an entry of one of the description's lists.
    #[error("{key}: {source}")]
    Entry {
        /// Key of the entry in the description, with its name if it has one.
        key: String,
        /// Error of the entry.
        source: Box<Self>,
    },
    /// Body too large for the region and its periodic images.
    #[error(
        "a region of {length} x {width} does not hold it: move it to the middle, make it smaller, or give a longer or \
         wider region{hint}"
    )]
    NoRoom {
        /// Length of the region in x (length).
        length: f64,
        /// Length of the region in y, or distance of its walls (length).
        width: f64,
        /// Quantities that do not seem to be in the same units, if there are any.
        hint: String,
    },
    /// Scene file that is not TOML or has unknown keys.
    #[error("the scene file is not understood: {problem}")]
    File {
        /// Line of the file, and the problem there.
        problem: String,
    },
    /// Body that starts inside another one, or where another one is.
    #[error(
        "{key} overlaps {other} by {} at ({x:.4}, {y:.4}), more than {}: move them apart or make one of them smaller",
        motile_base::told_apart([*depth, *allowed])[0], motile_base::told_apart([*depth, *allowed])[1]
    )]
    Overlap {
        /// Key of the entry in the description, with its name if it has one.
        key: String,
        /// Key of the other body, with its name if it has one.
        other: String,
        /// Place of the contact in x (length).
        x: f64,
        /// Place of the contact in y (length).
        y: f64,
        /// Depth of the overlap (length).
        depth: f64,
        /// Depth that is allowed (length).
        allowed: f64,
    },
    /// Neighbouring interfaces that are periodic along x and give the fluid between them two viscosities.
    #[error(
        "the fluid between {key} and {other}, or the image of one, would have the viscosities {} and {}: give both \
         their insides there the same one, or turn one of them by its key `inside`",
        viscosities[0], viscosities[1]
    )]
    TwoViscosities {
        /// Key of the lower entry in the description, with its name if it has one.
        key: String,
        /// Key of the upper entry, or of the lower one again.
        other: String,
        /// The viscosities (stress times time).
        viscosities: [f64; 2],
    },
    /// Droplet that starts in touch with another one, or with its own image.
    #[error("{key} touches {other} at ({x:.4}, {y:.4}): leave a film of fluid between them")]
    Touch {
        /// Key of the entry in the description, with its name if it has one.
        key: String,
        /// Key of the other droplet, with its name if it has one.
        other: String,
        /// Place of the contact in x (length).
        x: f64,
        /// Place of the contact in y (length).
        y: f64,
    },
    /// Target error that no settings were measured for.
    #[error("no settings are known for an error of {target:e}: ask for one from {smallest:e} to {largest}")]
    TargetError {
        /// Relative error asked for (no dimension).
        target: f64,
        /// Smallest error that was measured.
        smallest: f64,
        /// Largest error that settings are given for.
        largest: f64,
    },
}

motile_base::debug_as_explanation!(SetupError);

impl SetupError {
    /// Error with the key of the entry that it is about, unless it names it itself.
    pub(crate) fn of(self, key: &str) -> Self {
        match self {
            Self::Value { .. } | Self::Entry { .. } => self,
            other => Self::Entry { key: key.to_owned(), source: Box::new(other) },
        }
    }
}
