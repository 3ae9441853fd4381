//! What can go wrong.

use input_checks::InputError;

/// An error of this crate, with the offending value and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayerError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A region without images where they are needed.
    #[error("the double layer as a matrix is for boxes and channels: use `InterfaceFlow` in the plane")]
    NoPeriod,
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
    /// A curve that goes on by something else than the period of the region along x.
    #[error(
        "curve {curve} goes on by ({x}, {y}) in a turn: give (0, 0) for a closed curve, ({expected}, 0) or \
         (-{expected}, 0) for an open one in a region with that period along x"
    )]
    Period {
        /// Number of the curve.
        curve: usize,
        /// What it advances by in x.
        x: f64,
        /// What it advances by in y.
        y: f64,
        /// The period of the region along x (length), 0 if it has none.
        expected: f64,
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
    /// Rigid walls in a region that is no channel.
    #[error("rigid walls and obstacles stand in a channel: give one that is wider than they are")]
    NoChannel,
    /// Rigid walls that cross or touch each other, or themselves.
    #[error("wall {first} crosses or touches wall {second} near ({x}, {y}): leave fluid between them")]
    WallsCross {
        /// Number of a wall.
        first: usize,
        /// Number of the other one, the same where it crosses itself.
        second: usize,
        /// Where, in x.
        x: f64,
        /// Where, in y.
        y: f64,
    },
    /// Rigid walls whose forces cannot be found.
    #[error("the forces on the rigid walls cannot be found: use more nodes, or leave more fluid between the walls")]
    SingularWalls,
    /// An interface beyond a rigid wall or in an obstacle.
    #[error(
        "interface {curve} is beyond rigid wall {wall} at ({x}, {y}): move it away, use a smaller time step or more \
         nodes"
    )]
    CrossesWall {
        /// Number of the interface.
        curve: usize,
        /// Where, x coordinate (length).
        x: f64,
        /// Where, y coordinate (length).
        y: f64,
        /// Number of the wall.
        wall: usize,
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

input_checks::debug_as_explanation!(LayerError);
