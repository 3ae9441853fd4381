//! What can go wrong.

use motile::SetupError;
use motile::active_interface::InterfaceError;
use motile::boundary_integral::LayerError;
use motile::ib_core::input::InputError;

/// An error of this crate, with the offending value and the remedy.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum SteadyError {
    /// A description that makes no scene.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The droplet.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// The flow.
    #[error(transparent)]
    Flow(#[from] LayerError),
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A scene that has no steady states of the kind that is solved for here.
    #[error("{what}: {remedy}")]
    Unsupported {
        /// What the scene has.
        what: String,
        /// What to give instead.
        remedy: &'static str,
    },
    /// The iteration for a state has not come to an end.
    #[error("no steady state was found: the rate of change is {residual:.1e} after {iterations} iterations, {remedy}")]
    NoConvergence {
        /// Largest rate of change that is left (1/time).
        residual: f64,
        /// Iterations.
        iterations: usize,
        /// What to do.
        remedy: &'static str,
    },
    /// A shape or concentration that the nodes do not resolve.
    #[error("the {what} is not resolved by {nodes} nodes (its last modes are {tail:.1e} of it): give more nodes")]
    Unresolved {
        /// Shape or concentration.
        what: &'static str,
        /// Nodes.
        nodes: usize,
        /// Size of the last modes over that of all.
        tail: f64,
    },
    /// A matrix that cannot be solved with.
    #[error("the linear equations of {what} are singular: {remedy}")]
    Singular {
        /// What they are of.
        what: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// Something that was looked for along a branch is not there.
    #[error("{what} was not found between {from} and {to}: {remedy}")]
    NotFound {
        /// What was looked for.
        what: &'static str,
        /// Start of the interval of the parameter.
        from: f64,
        /// End of the interval.
        to: f64,
        /// What to do.
        remedy: &'static str,
    },
}

motile::ib_core::input::debug_as_explanation!(SteadyError);
