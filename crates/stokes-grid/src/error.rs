//! Errors of solvers and grids: the value that cannot be used and the remedy.

use motile_base::{InputError, finite, told_apart};

/// An error of this crate; its message names the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StokesError {
    /// A number out of its range, or a list of the wrong length.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A grid with too few cells in one direction.
    #[error("a grid of {nx} x {ny} cells is too small: use at least {minimum} cells in each direction")]
    GridTooSmall {
        /// Cells in x.
        nx: usize,
        /// Cells in y.
        ny: usize,
        /// Least number in each direction.
        minimum: usize,
    },
    /// A grid whose fields do not fit into memory.
    #[error("a grid of {nx} x {ny} cells is too large: use at most {maximum} cells in all")]
    GridTooLarge {
        /// Cells in x.
        nx: usize,
        /// Cells in y.
        ny: usize,
        /// Largest number in all.
        maximum: usize,
    },
    /// A field made for another grid than that of the solver or transfer.
    #[error("{name} belongs to another grid: make both from the same grid")]
    GridMismatch {
        /// Name of the field.
        name: &'static str,
    },
    /// A periodic box where walls are needed, or the other way round.
    #[error("this needs {needed}: build the grid with {remedy}")]
    WrongBoundary {
        /// Boundaries that are needed.
        needed: &'static str,
        /// Constructor of a grid that has them.
        remedy: &'static str,
    },
    /// Lagged walls where a solution must not depend on the ones before.
    #[error(
        "lagged walls cannot be combined with a viscosity that varies in space, because its iteration needs solutions \
         that do not depend on each other: use the exact wall treatment"
    )]
    LaggedWalls,
    /// A result beyond the range of double precision.
    #[error("{name} is beyond the range of double precision: scale the forces down")]
    Overflow {
        /// Name of the quantity.
        name: &'static str,
    },
    /// An iteration that did not reach its tolerance.
    #[error(
        "the relative residual is {} after {iterations} iterations, above {}: allow more iterations, ask for less, or \
         use viscosities that differ less",
        told_apart([*residual, *tolerance])[0], told_apart([*residual, *tolerance])[1]
    )]
    NoConvergence {
        /// Iterations done.
        iterations: usize,
        /// True relative residual at the end.
        residual: f64,
        /// Relative residual asked for.
        tolerance: f64,
        /// Relative residuals at the start and after each iteration.
        history: Vec<f64>,
    },
}

motile_base::debug_as_explanation!(StokesError);

impl StokesError {
    /// Error of a `result` that is not finite: the first number given that is not, or an overflow.
    pub(crate) fn not_finite(result: &'static str, given: &[(&'static str, &[f64])]) -> Self {
        let found = given.iter().find_map(|&(name, values)| values.iter().find_map(|&value| finite(name, value).err()));
        found.map_or(Self::Overflow { name: result }, Self::Input)
    }
}
