//! What a droplet warns of.

use super::PECLET_LIMIT;

/// What a user should know of a run, though it can go on.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DropletWarning {
    /// The markers are too far apart for the edge of the concentration.
    #[error(
        "the cell Peclet number is {peclet:.2}, above {PECLET_LIMIT}: the edge of the concentration is not resolved, use a \
         marker spacing below {spacing:.2e}"
    )]
    CellPeclet {
        /// `ds max|V_t - W| / D`.
        peclet: f64,
        /// The spacing that would do (length).
        spacing: f64,
    },
    /// The tension law has no plateau: contraction is stronger than repulsion at every concentration.
    #[error(
        "the activity {activity} is not balanced by the excluded volume at any concentration: there is no plateau, the \
         particles collapse towards a point (use |activity| below the strength of the excluded volume)"
    )]
    NoPlateau {
        /// The activity zeta delta-mu (force times length).
        activity: f64,
    },
}
