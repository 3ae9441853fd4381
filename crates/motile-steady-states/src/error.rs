//! Errors of this crate.

use motile::SetupError;
use motile::active_interface::InterfaceError;
use motile::boundary_integrals::LayerError;
use motile_base::InputError;

/// Error of a steady state, a branch or a limit cycle, with the offending value and the remedy.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum SteadyError {
    /// Description of a scene that cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Droplet or law of tension that cannot be used.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// Flow that cannot be solved for.
    #[error(transparent)]
    Flow(#[from] LayerError),
    /// Number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Scene whose steady states are not of the kind that is solved for here, or a request that makes no sense.
    #[error("{what}: {remedy}")]
    Unsupported {
        /// Offending part of the scene or request.
        what: String,
        /// Remedy.
        remedy: &'static str,
    },
    /// Iteration that has not converged.
    #[error("no convergence: the rate of change is {residual:.1e} (1/time) after {iterations} iterations; {remedy}")]
    NoConvergence {
        /// Largest rate of change of a Fourier coefficient over its unit (1/time).
        residual: f64,
        /// Number of iterations.
        iterations: usize,
        /// Remedy.
        remedy: &'static str,
    },
    /// Shape or concentration that the nodes do not resolve.
    #[error(
        "the {what} is not resolved by {nodes} nodes: its last Fourier modes are {tail:.1e} of it, give more nodes"
    )]
    Unresolved {
        /// Unresolved quantity: the shape or the concentration.
        what: &'static str,
        /// Number of nodes.
        nodes: usize,
        /// Ratio of the last Fourier coefficients to the largest.
        tail: f64,
    },
    /// Singular matrix.
    #[error("the linear equations of {what} are singular: {remedy}")]
    Singular {
        /// Unknown of the equations.
        what: &'static str,
        /// Remedy.
        remedy: &'static str,
    },
    /// Point that was looked for along a parameter and is not there.
    #[error("{what} was not found between {from} and {to}: {remedy}")]
    NotFound {
        /// Point looked for.
        what: &'static str,
        /// Value of the parameter where the search began.
        from: f64,
        /// Value where it ended.
        to: f64,
        /// Remedy.
        remedy: &'static str,
    },
}

motile_base::debug_as_explanation!(SteadyError);
