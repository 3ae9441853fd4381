//! Errors of layers: the value that cannot be used and the remedy.

use motile_base::{
    InputError, Refusal, Vec2,
    internal::{Refuse, told_apart},
};

/// An error of this crate; its message names the offending value and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayerError {
    /// A number out of its range, or a list of the wrong length.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A position, force or velocity on a curve or at a point is not a finite number.
    #[error("{what} number {point} (curve {curve}) is ({x}, {y}). Use finite numbers only")]
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
    #[error("{kind} {curve} has {found} {what}. Use a number from {least} to {most}")]
    Count {
        /// Curve or wall.
        kind: &'static str,
        /// Its number.
        curve: usize,
        /// Nodes or points.
        what: &'static str,
        /// How many it has.
        found: usize,
        /// Minimum number.
        least: usize,
        /// Largest number.
        most: usize,
    },
    /// A curve runs clockwise or crosses itself.
    #[error("curve {curve} runs clockwise or crosses itself. List its points in counter-clockwise order")]
    Clockwise {
        /// Number of the curve.
        curve: usize,
    },
    /// A node of a curve lies beyond a wall.
    #[error(
        "node {node} of curve {curve} at ({x:.4}, {y:.4}) is {} beyond the wall, more than {}. Move the curve away, \
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
         so narrow a gap, and the speed may be off by 1 % or more. Use {needed} nodes or \
         more, or keep the body away from the wall",
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
    /// An interface beyond a rigid wall or inside an obstacle.
    #[error(
        "interface {curve} is beyond rigid wall {wall} at ({x:.4}, {y:.4}). Move it away, use a smaller time step or \
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
        "the relative residual is {} after {iterations} iterations, above {}. Use more nodes, allow more iterations, \
         or use a larger tolerance",
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
    /// A curve, wall, region or request that the solver cannot use.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(LayerError);

impl LayerError {
    /// Returns the error for a flow that cannot be imposed on the region.
    #[doc(hidden)]
    #[must_use]
    pub fn no_such_flow(flow: &str, remedy: &str) -> Self {
        Self::refused(format!("{flow} is not possible"), "", remedy)
    }

    /// Returns the error for rigid walls with a singular matrix, so that the forces on them are not determined.
    #[doc(hidden)]
    #[must_use]
    pub fn singular_walls() -> Self {
        let remedy = "Use more nodes, or leave more fluid between the walls";
        Self::refused("the forces on the rigid walls are not determined", "their equations are singular", remedy)
    }

    /// Returns the error for an axisymmetric region for curves in the plane.
    pub(crate) fn in_three_dimensions() -> Self {
        let remedy = "Use `AxisymmetricFlow`, or a two-dimensional region";
        Self::refused("the region is axisymmetric, but this flow is two-dimensional", "", remedy)
    }

    /// Returns the error for rigid walls in a region that is not a channel.
    pub(crate) fn no_channel() -> Self {
        let remedy = "Use a channel that is wider than they are";
        Self::refused("rigid walls and obstacles need a channel around them", "", remedy)
    }

    /// Returns the error for a curve that advances by `advance` in a turn of the parameter, neither by zero nor by the
    /// `period` along x.
    pub(crate) fn period(curve: usize, advance: Vec2, period: f64) -> Self {
        let value =
            format!("from its first point to the next image of it, it advances by ({}, {})", advance.x, advance.y);
        let closed = "Let a closed curve advance by (0, 0)";
        let remedy = if period == 0.0 {
            format!("{closed}. The region is not periodic along x, so it has no open curves")
        } else {
            format!("{closed} and an open curve by ({period}, 0) or (-{period}, 0), the period of the region")
        };
        Self::refused(format!("curve {curve} has the wrong period"), value, remedy)
    }

    /// Returns the error for rigid walls that cross or touch each other near a place, or a wall that crosses itself.
    pub(crate) fn walls_cross(first: usize, second: usize, place: Vec2) -> Self {
        let walls = if first == second {
            format!("wall {first} crosses itself")
        } else {
            format!("wall {first} crosses or touches wall {second}")
        };
        Self::refused(
            format!("{walls} near {}", motile_base::internal::place(place.x, place.y)),
            "",
            "Leave fluid between the walls",
        )
    }
}

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

/// Returns true if an error is a refusal whose text contains these words.
#[cfg(test)]
pub(crate) fn refused(error: &LayerError, words: &str) -> bool {
    matches!(error, LayerError::Refused { .. }) && error.to_string().contains(words)
}
