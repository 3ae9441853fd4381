//! Errors of fields inside droplets.

use motile_base::InputError;
use motile_scene::BodyError;

/// Error of a field inside a droplet, with the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InteriorError {
    /// Number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Droplet whose number of markers changes.
    #[error(
        "a droplet with a gel or particles inside needs a fixed number of markers: give it equally spaced ones \
         (`Equidistributed`)"
    )]
    ChangingMarkers,
    /// Droplet without particles on its interface that could be exchanged.
    #[error("a droplet that exchanges particles with its inside has none on its interface: give it a list of numbers")]
    NoParticles,
    /// Mesh of too many nodes.
    #[error("the mesh would have some {nodes:.1e} nodes, more than {most}: give a wider spacing")]
    TooFine {
        /// Number of nodes that the mesh would have.
        nodes: f64,
        /// Largest number of nodes.
        most: usize,
    },
    /// Mesh with a triangle of negative area.
    #[error(
        "the mesh inside is folded at ({x:.4}, {y:.4}): the droplet is bent too far for a mesh that started as a disc; \
         give it more tension or less activity"
    )]
    Folded {
        /// x coordinate of a triangle of negative area (length).
        x: f64,
        /// y coordinate (length).
        y: f64,
    },
}

motile_base::debug_as_explanation!(InteriorError);

impl From<InteriorError> for BodyError {
    fn from(error: InteriorError) -> Self {
        Self::Other(Box::new(error))
    }
}
