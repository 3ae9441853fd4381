//! Errors of this crate.

use motile::SetupError;
use motile::active_interface::InterfaceError;
use motile::boundary_integrals::LayerError;
use motile_base::{InputError, Refusal, internal::Refuse};

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
    /// Iteration that has not converged.
    #[error("no convergence: the rate of change is {residual:.1e} (1/time) after {iterations} iterations. {remedy}")]
    NoConvergence {
        /// Largest rate of change of a Fourier coefficient over its unit (1/time).
        residual: f64,
        /// Number of iterations.
        iterations: usize,
        /// Remedy.
        remedy: &'static str,
    },
    /// Scene or request that this crate cannot solve for, or a search that has found nothing.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(SteadyError);

impl SteadyError {
    /// Returns the error for scene or request whose states are not of the kind that is solved for here.
    pub(crate) fn unsupported(what: impl Into<String>, remedy: &str) -> Self {
        Self::refused(what, "", remedy)
    }

    /// Returns the error for shape or concentration that the nodes do not resolve.
    pub(crate) fn unresolved(what: &str, nodes: usize, tail: f64) -> Self {
        let value = format!("the ratio of its highest Fourier modes to the largest is {tail:.1e}");
        Self::refused(format!("the {what} is not resolved by {nodes} nodes"), value, "Use more nodes")
    }

    /// Returns the error for linear equations that have no solution.
    pub(crate) fn singular(unknown: &str, remedy: &str) -> Self {
        Self::refused(format!("the linear equations of {unknown} are singular"), "", remedy)
    }

    /// Returns the error for a point that is not found while a parameter goes from one value to the other.
    pub(crate) fn not_found(what: &str, [from, to]: [f64; 2], remedy: &str) -> Self {
        Self::refused(format!("{what} was not found between {from} and {to}"), "", remedy)
    }
}
