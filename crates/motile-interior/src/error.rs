//! Errors of fields inside droplets.

use motile_base::{
    InputError, Refusal,
    internal::{Refuse, place},
};
use motile_scene::BodyError;

/// Error of a field inside a droplet, with the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InteriorError {
    /// Number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Mesh with a triangle of negative area.
    #[error(
        "the mesh inside is folded at {}: the droplet is bent too far for a mesh that started as a disc. \
         Use a larger tension or a weaker activity",
        place(*x, *y)
    )]
    Folded {
        /// x coordinate of a triangle of negative area (length).
        x: f64,
        /// y coordinate (length).
        y: f64,
    },
    /// Droplet or mesh that cannot be used.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(InteriorError);

impl InteriorError {
    /// Returns the error for droplet whose number of markers changes.
    pub(crate) fn changing_markers() -> Self {
        let what = "a droplet with a gel or particles inside needs a fixed number of markers";
        Self::refused(what, "", "Use equally spaced markers (`Equidistributed`)")
    }

    /// Returns the error for droplet without particles on its interface that could be exchanged.
    pub(crate) fn no_particles() -> Self {
        let what = "a droplet that exchanges particles with its inside needs particles on its interface";
        Self::refused(what, "this droplet has none", "Build it with a list of particle numbers")
    }

    /// Returns the error for noise on particles that are exchanged with the inside.
    pub(crate) fn noisy() -> Self {
        let what = "particles that diffuse inside have no noise yet";
        let remedy = "Leave the noise out, or use a well-mixed inside (ActiveDroplet::with_well_mixed_interior)";
        Self::refused(what, "the droplet has noise on its particles", remedy)
    }

    /// Returns the error for an interface that does not enclose a layer next to a wall.
    pub(crate) fn not_below_wall() -> Self {
        let what = "a gel in a layer needs an interface along x that does not reach the wall on its inside";
        Self::refused(what, "", "Move the interface away from the wall, or exchange its sides")
    }

    /// Returns the error for mesh of too many nodes.
    pub(crate) fn too_fine(nodes: f64, most: usize) -> Self {
        let value = format!("it would have some {nodes:.1e} nodes, more than {most}");
        Self::refused("the mesh is too fine", value, "Use a larger spacing")
    }
}

impl From<InteriorError> for BodyError {
    fn from(error: InteriorError) -> Self {
        Self::Other(Box::new(error))
    }
}
