//! What can go wrong on a grid.

pub(crate) mod checks;

use input_checks::InputError;

/// An error of this crate, with the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StokesError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A grid with too few cells in one direction.
    #[error("a grid of {nx} x {ny} cells is too small: use at least {minimum} cells in each direction")]
    GridTooSmall {
        /// Cells in x.
        nx: usize,
        /// Cells in y.
        ny: usize,
        /// The least number that works.
        minimum: usize,
    },
    /// A grid whose fields do not fit into memory.
    #[error("a grid of {nx} x {ny} cells is too large: use at most {maximum} cells in all")]
    GridTooLarge {
        /// Cells in x.
        nx: usize,
        /// Cells in y.
        ny: usize,
        /// The largest number of cells.
        maximum: usize,
    },
    /// A field made for another grid than that of the solver or transfer.
    #[error("{name} lives on another grid: make both from the same grid")]
    GridMismatch {
        /// The field.
        name: &'static str,
    },
    /// A periodic box where walls are needed, or the other way round.
    #[error("this needs {needed}: build the grid with {remedy}")]
    WrongBoundary {
        /// What is needed.
        needed: &'static str,
        /// The constructor to use.
        remedy: &'static str,
    },
    /// A result beyond the range of double precision.
    #[error("{name} is beyond the range of double precision: scale the forces down")]
    Overflow {
        /// The quantity.
        name: &'static str,
    },
    /// An iteration that did not reach its tolerance.
    #[error(
        "the relative residual is {residual:e} after {iterations} iterations, above {tolerance:e}: allow more \
         iterations, ask for less, or use viscosities that differ less"
    )]
    NoConvergence {
        /// Iterations done.
        iterations: usize,
        /// True relative residual at the end.
        residual: f64,
        /// What was asked for.
        tolerance: f64,
        /// Relative residuals at the start and after each iteration.
        history: Vec<f64>,
    },
}

input_checks::debug_as_explanation!(StokesError);
