//! Errors of solids, meshes and outlines.

use motile_base::{InputError, Vec2, positive, within};

use crate::material::Mat2;

/// An error of this crate; its message has the offending values and the remedy. Places are positions in the plane
/// (length).
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A deformation that inverts the material, flattens it, or is not finite.
    #[error(
        "the deformation gradient with the columns ({:.4}, {:.4}) and ({:.4}, {:.4}) has the determinant {:.3e}: it \
         must be positive", .gradient.x_axis.x, .gradient.x_axis.y, .gradient.y_axis.x, .gradient.y_axis.y,
        .gradient.determinant()
    )]
    NotOrientationPreserving {
        /// Deformation gradient.
        gradient: Mat2,
    },
    /// A triangle that names a point which does not exist.
    #[error("triangle {triangle} names point {point} of {points}: points are counted from 0")]
    NoSuchPoint {
        /// Index of the triangle.
        triangle: usize,
        /// Index of the point.
        point: usize,
        /// Number of points.
        points: usize,
    },
    /// A triangle without area.
    #[error("triangle {triangle} near ({:.4}, {:.4}) has the area {area:.1e}: its points must not lie on a line",
        .place.x, .place.y)]
    FlatTriangle {
        /// Index of the triangle.
        triangle: usize,
        /// First corner.
        place: Vec2,
        /// Area (length squared).
        area: f64,
    },
    /// A triangle of a periodic mesh whose corners cannot be told from their images.
    #[error("triangle {triangle} is {width:.4} wide, half the period {period} or more: use smaller triangles")]
    TriangleTooWide {
        /// Index of the triangle.
        triangle: usize,
        /// Width of the triangle (length).
        width: f64,
        /// Period of the mesh (length).
        period: f64,
    },
    /// A point that no triangle uses.
    #[error("point {point} at ({:.4}, {:.4}) belongs to no triangle: leave it out", .place.x, .place.y)]
    LoosePoint {
        /// Index of the point.
        point: usize,
        /// Position of the point.
        place: Vec2,
    },
    /// Two points of triangles at one place: the triangles there are not connected.
    #[error(
        "points {first} and {second} coincide at ({:.4}, {:.4}): make them one (in Gmsh: \"Coherence Mesh;\", or the \
         tool that removes duplicate nodes)", .place.x, .place.y
    )]
    CoincidentPoints {
        /// Index of a point.
        first: usize,
        /// Index of the other point.
        second: usize,
        /// Position of the latter.
        place: Vec2,
    },
    /// An edge with more than one triangle on a side.
    #[error(
        "the edge between points {first} and {second} has two triangles on one side, one of them {triangle}: triangles \
         must not overlap"
    )]
    FoldedMesh {
        /// Index of an end of the edge.
        first: usize,
        /// Index of the other end.
        second: usize,
        /// Index of one of the triangles.
        triangle: usize,
    },
    /// An island that a channel does not have.
    #[error(
        "island {number} of a channel with {found}: islands are counted from 0, give the number of an existing one"
    )]
    NoSuchIsland {
        /// Number of the island that was asked for.
        number: usize,
        /// Number of islands of the channel.
        found: usize,
    },
    /// An operation that is not supported.
    #[error("{what} is not possible: {remedy}")]
    Unsupported {
        /// Operation.
        what: &'static str,
        /// Remedy.
        remedy: &'static str,
    },
    /// A line that does not return to its start.
    #[error(
        "the outline ends at ({:.4}, {:.4}), {gap:.3e} from where it must: close it, or let a profile return to its \
         first height", .place.x, .place.y
    )]
    OpenOutline {
        /// End of the line.
        place: Vec2,
        /// Distance of the end from the start, or from the start of the next period (length).
        gap: f64,
    },
    /// A side or curve of an outline without length.
    #[error("a side of the outline at ({:.4}, {:.4}) has no length: points that follow each other must differ",
        .place.x, .place.y)]
    NoLength {
        /// Start of the side.
        place: Vec2,
    },
    /// Corners of a curve that do not increase.
    #[error("corner at {value}: give increasing numbers above {start} and below {end}")]
    CornersOutOfOrder {
        /// Parameter of the first corner out of order.
        value: f64,
        /// Parameter at the start of the curve.
        start: f64,
        /// Parameter at the end of the curve.
        end: f64,
    },
    /// A rounded corner that does not fit.
    #[error(
        "a corner of radius {radius} does not fit on the side of length {side:.4} from ({:.4}, {:.4}): give at most \
         {maximum:.4}", .place.x, .place.y
    )]
    RoundingTooLarge {
        /// Radius of the corner (length).
        radius: f64,
        /// Start of the side.
        place: Vec2,
        /// Length of the side (length).
        side: f64,
        /// Largest radius that fits there (length).
        maximum: f64,
    },
    /// Periodic outlines of different periods.
    #[error("one outline has the period {first}, another {second}: give them the same")]
    DifferentPeriods {
        /// Period of an outline (length).
        first: f64,
        /// Period of another one (length).
        second: f64,
    },
    /// An interior that extends to infinity.
    #[error("there are {lines} periodic outlines: give an even number, the two surfaces of each wall")]
    OpenRegion {
        /// Number of periodic outlines.
        lines: usize,
    },
    /// Outlines that cross.
    #[error(
        "outlines cross or touch near ({:.4}, {:.4}): move them apart, or use a smaller spacing where they only come \
         close", .place.x, .place.y
    )]
    Crossing {
        /// Place of the crossing.
        place: Vec2,
    },
    /// A line of a channel on the wrong side of the others.
    #[error(
        "the line through ({:.4}, {:.4}) is not below the upper side of the channel and above the lower one: \
         exchange or move them", .place.x, .place.y
    )]
    NotBetween {
        /// Point of the line.
        place: Vec2,
    },
    /// A hole that the mesh cannot resolve.
    #[error(
        "the hole at ({:.4}, {:.4}) is {width:.4} wide, less than the mesh spacing {spacing}: leave it out or use a \
         smaller spacing", .place.x, .place.y
    )]
    HoleTooSmall {
        /// Point of the outline of the hole.
        place: Vec2,
        /// Width of the hole (length).
        width: f64,
        /// Mesh spacing (length).
        spacing: f64,
    },
    /// A wall that the mesh cannot resolve.
    #[error(
        "the solid at ({:.4}, {:.4}) is {thickness:.4} thick, less than the mesh spacing {spacing}: make it thicker, \
         round its tip, or use a smaller spacing", .place.x, .place.y
    )]
    WallTooThin {
        /// Point of the outline of the solid.
        place: Vec2,
        /// Thickness of the solid there (length).
        thickness: f64,
        /// Mesh spacing (length).
        spacing: f64,
    },
    /// A triangulation that failed.
    #[error("the triangulation failed: {what}; use a smaller mesh spacing")]
    MeshingFailed {
        /// Reason.
        what: &'static str,
    },
    /// Text that is not a mesh file.
    #[error("line {line} of the mesh file: {what}")]
    Gmsh {
        /// Number of the line, from 1.
        line: usize,
        /// Fault of the line.
        what: String,
    },
    /// A group of triangles that cannot be written.
    #[error("group {tag} of triangles: {what}")]
    BadGroup {
        /// Number of the group.
        tag: i32,
        /// Fault of the group.
        what: &'static str,
    },
    /// An inverted triangle, or one of a solid that flows which is about to be.
    #[error(
        "triangle {triangle} near ({:.4}, {:.4}) is {}inverted (area ratio {jacobian:.4}): use a smaller time step or \
         mesh spacing, or stiffer material", .place.x, .place.y, if *jacobian > 0.0 { "as good as " } else { "" }
    )]
    Inverted {
        /// Index of the triangle.
        triangle: usize,
        /// Centroid of the triangle.
        place: Vec2,
        /// Deformed over reference area of the triangle, negative, or below 0.02 in a solid that flows.
        jacobian: f64,
    },
    /// A surface that has come to cross itself.
    #[error(
        "the surface crosses itself near ({:.4}, {:.4}), where the sides that start at the points {first} and {second} \
         meet: contact of a solid with itself is not in the model; give it surface elasticity that keeps it from creasing, stiffer \
         material, or use a smaller time step", .place.x, .place.y
    )]
    SelfContact {
        /// First point.
        place: Vec2,
        /// Index of the point at which a side starts.
        first: usize,
        /// Index of the point at which the other side starts.
        second: usize,
    },
    /// Points that found no equilibrium.
    #[error(
        "the inner points found no equilibrium, {residual:.1e} of the force is left: use a smaller strain or a stable \
         material"
    )]
    NotRelaxed {
        /// Residual force over the force at the boundary.
        residual: f64,
    },
}

motile_base::debug_as_explanation!(SolidError);

/// Most points of a mesh or an outline: sizes are bounded before anything is allocated.
pub(crate) const MOST_POINTS: f64 = 1e6;

/// Returns `value` if it is a length to compute with: positive, and such that its square is neither zero nor infinite.
pub(crate) fn length(name: &'static str, value: f64) -> Result<f64, InputError> {
    within(name, positive(name, value)?, 1e-100, 1e100)
}
