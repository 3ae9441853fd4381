//! Errors of solvers and grids: the value that cannot be used and the remedy.

use motile_base::{
    InputError, Refusal, finite,
    internal::{Refuse, told_apart},
};

/// An error of this crate; its message names the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StokesError {
    /// A number out of its range, or a list of the wrong length.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An iteration that did not reach its tolerance.
    #[error(
        "the relative residual is {} after {iterations} iterations, above {}. Allow more iterations, use a larger \
         tolerance, or use viscosities that differ less",
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
    /// A grid, field or request that a solver cannot use.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(StokesError);

impl StokesError {
    /// Returns the error for error of a `result` that is not finite: the first number given that is not, or an
    /// overflow.
    pub(crate) fn not_finite(result: &'static str, given: &[(&'static str, &[f64])]) -> Self {
        let found = given.iter().find_map(|&(name, values)| values.iter().find_map(|&value| finite(name, value).err()));
        found.map_or_else(|| Self::overflow(result), Self::Input)
    }

    /// Returns the error for a result beyond the range of double precision.
    pub(crate) fn overflow(name: &str) -> Self {
        let what = format!("{name} is beyond the range of double precision");
        Self::refused(what, String::new(), "Scale the forces down")
    }

    /// Returns the error for a grid with fewer cells than `minimum` in one direction.
    pub(crate) fn grid_too_small(nx: usize, ny: usize, minimum: usize) -> Self {
        let remedy = format!("Use at least {minimum} cells in each direction");
        Self::refused("the grid is too small", format!("{nx} x {ny} cells"), remedy)
    }

    /// Returns the error for a grid of more than `maximum` cells, whose fields do not fit into memory.
    pub(crate) fn grid_too_large(nx: usize, ny: usize, maximum: usize) -> Self {
        let remedy = format!("Use at most {maximum} cells in all");
        Self::refused("the grid is too large for the memory", format!("{nx} x {ny} cells"), remedy)
    }

    /// Returns the error for the field `name`, which was made for another grid than the grid of the solver.
    #[doc(hidden)]
    #[must_use]
    pub fn grid_mismatch(name: &str) -> Self {
        Self::refused(format!("{name} belongs to another grid"), String::new(), "Make both from the same grid")
    }

    /// Returns the error for a periodic box where walls are needed.
    pub(crate) fn needs_channel() -> Self {
        Self::refused("this needs a channel", "the grid is a periodic box", "Build the grid with Grid::channel")
    }

    /// Returns the error for a channel where a periodic box is needed.
    pub(crate) fn needs_box() -> Self {
        Self::refused("this needs a periodic box", "the grid is a channel", "Build the grid with Grid::periodic")
    }

    /// Returns the error for walls with slip, whose sines along y are not known.
    pub(crate) fn no_slip_only() -> Self {
        let what = "the projection cannot have walls with slip, because its sine transforms vanish on the walls";
        Self::refused(what, String::new(), "Use `ChannelStokes`, or walls without slip")
    }

    /// Returns the error for lagged walls where a solution must not depend on the solutions before it.
    pub(crate) fn lagged_walls() -> Self {
        let what = "lagged walls cannot be combined with a viscosity that varies in space, because its iteration needs \
                    solutions that do not depend on each other";
        Self::refused(what, String::new(), "Use the exact wall treatment")
    }
}

/// Returns true if a result is a refusal whose text contains these words.
#[cfg(test)]
pub(crate) fn refused<T>(result: &Result<T, StokesError>, words: &str) -> bool {
    matches!(result, Err(error @ StokesError::Refused { .. }) if error.to_string().contains(words))
}
