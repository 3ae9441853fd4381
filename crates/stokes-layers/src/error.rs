//! What can go wrong.

/// An error of this crate, with the offending value and the remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayerError {
    /// A quantity that must be positive and finite is not.
    #[error("{name} is {value}: give a positive finite number")]
    NotPositive {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity that must be finite is not.
    #[error("{name} is {value}: give a finite number")]
    NotFinite {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity outside the range in which the method works.
    #[error("{name} is {value}: give a value between {least} and {most}")]
    OutOfRange {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least value that works.
        least: f64,
        /// The largest value that works.
        most: f64,
    },
    /// A region without images where they are needed.
    #[error("the double layer as a matrix is for boxes and channels: use `InterfaceFlow` in the plane")]
    NoPeriod,
    /// A transform of another length than planned for.
    #[error(transparent)]
    Transform(#[from] fourier::FourierError),
    /// Slices of different length.
    #[error("{name} has {found} entries where {expected} are needed")]
    WrongLength {
        /// The slice.
        name: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
    /// A position, force or velocity on a curve or at a point is not a finite number.
    #[error("{what} number {point} (curve {curve}) is ({x}, {y}): give finite numbers")]
    NonFinite {
        /// What it is.
        what: &'static str,
        /// Number of the curve; 0 for points off the curves.
        curve: usize,
        /// Number of the point.
        point: usize,
        /// x component.
        x: f64,
        /// y component.
        y: f64,
    },
    /// A curve runs clockwise or crosses itself.
    #[error("curve {curve} runs clockwise or crosses itself: give its points in counter-clockwise order")]
    Clockwise {
        /// Number of the curve.
        curve: usize,
    },
    /// A node of a curve lies beyond a wall.
    #[error("node {node} of curve {curve} at ({x}, {y}) is {depth} beyond the wall, more than {allowed}")]
    BeyondWall {
        /// Number of the curve.
        curve: usize,
        /// Number of the node.
        node: usize,
        /// Its x coordinate.
        x: f64,
        /// Its y coordinate.
        y: f64,
        /// How far beyond (length).
        depth: f64,
        /// What is allowed (length).
        allowed: f64,
    },
    /// The solution for a viscosity contrast did not converge.
    #[error("the solution stopped at a residual of {residual:e} after {iterations} iterations, above {tolerance:e}")]
    NoConvergence {
        /// Iterations done.
        iterations: usize,
        /// Relative residual reached.
        residual: f64,
        /// Relative residual asked for.
        tolerance: f64,
    },
}

/// Refuses what is not a positive finite number.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), LayerError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(LayerError::NotPositive { name, value }) }
}

/// Refuses what is not a finite number.
pub(crate) fn finite(name: &'static str, value: f64) -> Result<(), LayerError> {
    if value.is_finite() { Ok(()) } else { Err(LayerError::NotFinite { name, value }) }
}

/// Refuses what is not between two bounds.
pub(crate) fn within(name: &'static str, value: f64, least: f64, most: f64) -> Result<(), LayerError> {
    let inside = (least..=most).contains(&value);
    if inside { Ok(()) } else { Err(LayerError::OutOfRange { name, value, least, most }) }
}

/// Refuses a slice of another length.
pub(crate) fn same_length(name: &'static str, found: usize, expected: usize) -> Result<(), LayerError> {
    if found == expected { Ok(()) } else { Err(LayerError::WrongLength { name, expected, found }) }
}
