//! What can go wrong inside a droplet.

use ib_core::{BodyError, input::InputError};

/// An error of this crate, with the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InteriorError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A droplet whose number of markers changes.
    #[error(
        "a droplet with a gel or particles inside needs a fixed number of markers: give it equally spaced ones \
         (`Equidistributed`)"
    )]
    ChangingMarkers,
    /// A droplet whose interface has no particles that could be exchanged.
    #[error(
        "a droplet that exchanges particles with its inside needs some on its interface: give it a list of numbers"
    )]
    NoParticles,
    /// A mesh with so many nodes that it would not fit.
    #[error("the mesh inside would have some {nodes:.0} nodes, more than {most}: give a wider spacing")]
    TooFine {
        /// How many there would be.
        nodes: f64,
        /// The most.
        most: usize,
    },
    /// A mesh that has folded over.
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

ib_core::input::debug_as_explanation!(InteriorError);

impl From<InteriorError> for BodyError {
    fn from(error: InteriorError) -> Self {
        Self::Other(Box::new(error))
    }
}
