//! Errors of layers: the value that cannot be used and the remedy.

use motile_base::{InputError, Vec2, told_apart};

/// An error of this crate; its message names the offending value and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayerError {
    /// A number out of its range, or a list of the wrong length.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A region without images where they are needed.
    #[error("the double layer as a matrix is for boxes and channels: use `InterfaceFlow` in the plane")]
    NoPeriod,
    /// A position, force or velocity on a curve or at a point is not a finite number.
    #[error("{what} number {point} (curve {curve}) is ({x}, {y}): give finite numbers")]
    NonFinite {
        /// Name of the quantity.
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
    /// A curve with too few or too many nodes or points.
    #[error("{kind} {curve} has {found} {what}: give it {least} to {most}")]
    Count {
        /// Curve or wall.
        kind: &'static str,
        /// Its number.
        curve: usize,
        /// Nodes or points.
        what: &'static str,
        /// How many it has.
        found: usize,
        /// Least number.
        least: usize,
        /// Largest number.
        most: usize,
    },
    /// A curve whose advance in a turn of the parameter is neither zero nor the period of the region along x.
    #[error(
        "curve {curve} advances by ({x}, {y}) in a turn: give (0, 0) for a closed curve, ({expected}, 0) or \
         (-{expected}, 0) for an open one in a region with that period along x"
    )]
    Period {
        /// Number of the curve.
        curve: usize,
        /// Advance in x (length).
        x: f64,
        /// Advance in y (length).
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
    #[error(
        "node {node} of curve {curve} at ({x:.4}, {y:.4}) is {} beyond the wall, more than {}: move the curve away, \
         use a smaller time step or more nodes",
        told_apart([*depth, *allowed])[0], told_apart([*depth, *allowed])[1]
    )]
    BeyondWall {
        /// Number of the curve.
        curve: usize,
        /// Number of the node.
        node: usize,
        /// Its x coordinate (length).
        x: f64,
        /// Its y coordinate (length).
        y: f64,
        /// Distance beyond the wall (length).
        depth: f64,
        /// Distance that passes for round-off (length).
        allowed: f64,
    },
    /// A film between a wall and a rigid body that the nodes of the body do not resolve.
    #[error(
        "the gap between rigid body {curve} and the wall is {}, below {}: its {nodes} nodes do not resolve the flow in \
         so narrow a gap, and its speed would be off by more than 1 %. Use {needed} nodes or more, or keep the body \
         away from the wall",
        told_apart([*gap, *least])[0], told_apart([*gap, *least])[1]
    )]
    NarrowGap {
        /// Number of the curve.
        curve: usize,
        /// The gap (length).
        gap: f64,
        /// The narrowest gap that the nodes resolve (length).
        least: f64,
        /// Number of nodes.
        nodes: usize,
        /// Number of nodes that resolve the gap.
        needed: usize,
    },
    /// Rigid walls in a region that is no channel.
    #[error("rigid walls and obstacles need a channel around them: use a channel wider than they are")]
    NoChannel,
    /// A flow imposed on a region that does not have it.
    #[error("{flow} is not possible: {remedy}")]
    NoSuchFlow {
        /// The flow and the region.
        flow: &'static str,
        /// Alternative.
        remedy: &'static str,
    },
    /// Rigid walls that cross or touch each other, or themselves.
    #[error("wall {first} crosses or touches wall {second} near ({x:.4}, {y:.4}): leave fluid between them")]
    WallsCross {
        /// Number of one wall.
        first: usize,
        /// Number of the other wall, equal to the first where a wall crosses itself.
        second: usize,
        /// x coordinate of the place (length).
        x: f64,
        /// y coordinate of the place (length).
        y: f64,
    },
    /// Rigid walls with a singular matrix, so that the forces on them are not determined.
    #[error("the forces on the rigid walls are not determined: use more nodes, or leave more fluid between the walls")]
    SingularWalls,
    /// A surface of revolution whose meridian meets the axis between its poles.
    #[error(
        "curve {curve} meets the axis between its poles, at x = {x:.4}: keep the meridian off the axis; in a run a \
         neck has pinched there, after which the droplet would be two, which is not in the model"
    )]
    MeetsAxis {
        /// Number of the curve.
        curve: usize,
        /// Place on the axis (length).
        x: f64,
    },
    /// A curve that is not the meridian of a surface of revolution with its mirror image.
    #[error(
        "point {point} of curve {curve} at ({x:.4}, {y:.4}) is not on the meridian of a surface of revolution: give an \
         even number of points, the first on the x axis, each the mirror image of its partner"
    )]
    NotAxisymmetric {
        /// Number of the curve.
        curve: usize,
        /// Number of the point.
        point: usize,
        /// Its x coordinate (length).
        x: f64,
        /// Its y coordinate (length).
        y: f64,
    },
    /// A region of three dimensions for curves of the plane.
    #[error("curves in the plane are no surfaces of revolution: use `AxisymmetricFlow`, or a region of the plane")]
    InThreeDimensions,
    /// A region of the plane for surfaces of revolution.
    #[error("bodies of revolution are in three dimensions: use the region space or tube")]
    InTwoDimensions,
    /// Disturbances of anything but one interface of revolution.
    #[error("disturbances are those of one interface of revolution, there are {found}: load one, and no rigid body")]
    NotOneInterface {
        /// Number of interfaces.
        found: usize,
    },
    /// Surfaces that leave too little room in a length of a straight tube that a pressure is given for.
    #[error(
        "a length of {length} of the tube has a pressure of its own, and the surfaces in it and the next ones are less \
         than a radius apart: give at least {least:.4}, or a flux in place of a pressure"
    )]
    ShortTube {
        /// The length (length).
        length: f64,
        /// Least length for these surfaces (length).
        least: f64,
    },
    /// Surfaces with singular equations.
    #[error("the velocities of the surfaces are not determined: use more nodes, or leave more fluid between them")]
    SingularSurfaces,
    /// An interface beyond a rigid wall or inside an obstacle.
    #[error(
        "interface {curve} is beyond rigid wall {wall} at ({x:.4}, {y:.4}): move it away, use a smaller time step or \
         more nodes"
    )]
    CrossesWall {
        /// Number of the interface.
        curve: usize,
        /// x coordinate of a node beyond the wall (length).
        x: f64,
        /// y coordinate of the node (length).
        y: f64,
        /// Number of the wall.
        wall: usize,
    },
    /// An iteration for a viscosity contrast that did not reach its tolerance.
    #[error(
        "the relative residual is {} after {iterations} iterations, above {}: use more nodes, allow more iterations, \
         or ask for less",
        told_apart([*residual, *tolerance])[0], told_apart([*residual, *tolerance])[1]
    )]
    NoConvergence {
        /// Iterations done.
        iterations: usize,
        /// Relative residual reached.
        residual: f64,
        /// Relative residual asked for.
        tolerance: f64,
    },
}

motile_base::debug_as_explanation!(LayerError);

/// Refuses vectors that are not finite; `curve` is the number of the curve that they belong to.
///
/// # Errors
/// Returns [`LayerError::NonFinite`] for the first such vector.
pub fn finite_vectors(what: &'static str, curve: usize, values: &[Vec2]) -> Result<(), LayerError> {
    match values.iter().position(|value| !(value.x.is_finite() && value.y.is_finite())) {
        Some(point) => Err(LayerError::NonFinite { what, curve, point, x: values[point].x, y: values[point].y }),
        None => Ok(()),
    }
}
