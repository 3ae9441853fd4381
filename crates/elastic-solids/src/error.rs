//! What can go wrong with an elastic solid.

use ib_core::input::{InputError, positive, within};

/// An error of this crate, with the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A deformation that inverts the material, flattens it, or is not finite.
    #[error(
        "the deformation gradient [[{a11:.4}, {a12:.4}], [{a21:.4}, {a22:.4}]] has the determinant {jacobian:.3e}: it \
         must be positive"
    )]
    NotOrientationPreserving {
        /// Entry 11.
        a11: f64,
        /// Entry 12.
        a12: f64,
        /// Entry 21.
        a21: f64,
        /// Entry 22.
        a22: f64,
        /// Determinant.
        jacobian: f64,
    },
    /// A triangle of points that do not exist.
    #[error("triangle {triangle} names point {point} of {points}: points are counted from 0")]
    NoSuchPoint {
        /// Which triangle.
        triangle: usize,
        /// The point it names.
        point: usize,
        /// How many there are.
        points: usize,
    },
    /// A triangle without area.
    #[error("triangle {triangle} near ({x:.4}, {y:.4}) has the area {area:.1e}: its points must not lie on a line")]
    FlatTriangle {
        /// Which triangle.
        triangle: usize,
        /// x of its first corner (length).
        x: f64,
        /// y of its first corner (length).
        y: f64,
        /// Its area.
        area: f64,
    },
    /// A triangle of a periodic mesh whose corners cannot be told from their images.
    #[error("triangle {triangle} is {width:.4} wide, half the period {period} or more: use smaller triangles")]
    TriangleTooWide {
        /// Which triangle.
        triangle: usize,
        /// Its width (length).
        width: f64,
        /// The period (length).
        period: f64,
    },
    /// A point that no triangle uses.
    #[error("point {point} at ({x:.4}, {y:.4}) belongs to no triangle: leave it out")]
    LoosePoint {
        /// Which point.
        point: usize,
        /// Its x (length).
        x: f64,
        /// Its y (length).
        y: f64,
    },
    /// Two points of triangles at one place: triangles there do not hang together.
    #[error(
        "points {first} and {second} coincide at ({x:.4}, {y:.4}): make them one (in Gmsh: \"Coherence Mesh;\", or the \
         tool that removes duplicate nodes)"
    )]
    CoincidentPoints {
        /// A point.
        first: usize,
        /// The other one.
        second: usize,
        /// x of the latter (length).
        x: f64,
        /// Its y (length).
        y: f64,
    },
    /// An edge with more than one triangle on a side.
    #[error(
        "the edge between points {first} and {second} has two triangles on one side, one of them {triangle}: triangles \
         must not overlap"
    )]
    FoldedMesh {
        /// A point of the edge.
        first: usize,
        /// The other point.
        second: usize,
        /// One of the triangles.
        triangle: usize,
    },
    /// An island that a channel does not have.
    #[error(
        "island {number} of a channel with {found}: islands are counted from 0, give the number of one that is there"
    )]
    NoSuchIsland {
        /// Its number.
        number: usize,
        /// How many there are.
        found: usize,
    },
    /// Something that cannot be done.
    #[error("{what} is not possible: {remedy}")]
    Unsupported {
        /// What was asked for.
        what: &'static str,
        /// What to do instead.
        remedy: &'static str,
    },
    /// A line that does not return to its start.
    #[error(
        "the outline ends at ({x:.4}, {y:.4}), {gap:.3e} from where it must: close it, or let a profile return to its \
         first height"
    )]
    OpenOutline {
        /// x of its end (length).
        x: f64,
        /// y of its end (length).
        y: f64,
        /// Distance from its start, or from the start of the next period (length).
        gap: f64,
    },
    /// A side or curve of an outline without length.
    #[error("a side of the outline at ({x:.4}, {y:.4}) has no length: points that follow each other must differ")]
    NoLength {
        /// x of its start (length).
        x: f64,
        /// y of its start (length).
        y: f64,
    },
    /// Corners of a curve that do not increase.
    #[error("corner at {value}: give increasing numbers above {start} and below {end}")]
    CornersOutOfOrder {
        /// The first one out of order.
        value: f64,
        /// Start of the curve.
        start: f64,
        /// End of the curve.
        end: f64,
    },
    /// A fillet that does not fit.
    #[error(
        "a fillet of radius {radius} does not fit on the side of length {side:.4} from ({x:.4}, {y:.4}): give at most \
         {maximum:.4}"
    )]
    FilletTooLarge {
        /// The radius (length).
        radius: f64,
        /// x of the side's start (length).
        x: f64,
        /// y of the side's start (length).
        y: f64,
        /// Length of the side.
        side: f64,
        /// Largest radius that fits there (length).
        maximum: f64,
    },
    /// Periodic outlines that do not repeat together.
    #[error("one outline has the period {first}, another {second}: give them the same")]
    DifferentPeriods {
        /// A period (length).
        first: f64,
        /// Another (length).
        second: f64,
    },
    /// An interior without an end.
    #[error("there are {lines} periodic outlines: give an even number, the two surfaces of each wall")]
    OpenRegion {
        /// How many there are.
        lines: usize,
    },
    /// Outlines that cross.
    #[error(
        "outlines cross or touch near ({x:.4}, {y:.4}): move them apart, or use a smaller spacing where they only come \
         close"
    )]
    Crossing {
        /// x of the place (length).
        x: f64,
        /// y of the place (length).
        y: f64,
    },
    /// A line of a channel on the wrong side of the others.
    #[error(
        "the line through ({x:.4}, {y:.4}) is not below the upper side of the channel and above the lower one: \
         exchange or move them"
    )]
    NotBetween {
        /// x of a point of it (length).
        x: f64,
        /// y of that point (length).
        y: f64,
    },
    /// A hole that the mesh cannot resolve.
    #[error(
        "the hole at ({x:.4}, {y:.4}) is {width:.4} wide, less than the mesh spacing {spacing}: leave it out or use a \
         smaller spacing"
    )]
    HoleTooSmall {
        /// x of a point of its outline (length).
        x: f64,
        /// y of that point (length).
        y: f64,
        /// Its width (length).
        width: f64,
        /// Mesh spacing (length).
        spacing: f64,
    },
    /// A wall that the mesh cannot resolve.
    #[error(
        "the solid at ({x:.4}, {y:.4}) is {thickness:.4} thick, less than the mesh spacing {spacing}: make it thicker, \
         round its tip, or use a smaller spacing"
    )]
    WallTooThin {
        /// x of a point of its outline (length).
        x: f64,
        /// y of that point (length).
        y: f64,
        /// Its thickness (length).
        thickness: f64,
        /// Mesh spacing (length).
        spacing: f64,
    },
    /// A triangulation that failed.
    #[error("the triangulation failed: {what}; use a smaller mesh spacing")]
    MeshingFailed {
        /// Why.
        what: &'static str,
    },
    /// Text that is not a mesh file.
    #[error("line {line} of the mesh file: {what}")]
    Gmsh {
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it.
        what: String,
    },
    /// A group of triangles that cannot be written.
    #[error("group {tag} of triangles: {what}")]
    BadGroup {
        /// Its number.
        tag: i32,
        /// What is wrong with it.
        what: &'static str,
    },
    /// An inverted triangle.
    #[error(
        "triangle {triangle} near ({x:.4}, {y:.4}) is inverted (area ratio {jacobian:.4}): use a smaller time step or \
         mesh spacing, or stiffer material"
    )]
    Inverted {
        /// Which triangle.
        triangle: usize,
        /// x of its middle (length).
        x: f64,
        /// y of its middle (length).
        y: f64,
        /// Its deformed over its reference area, negative.
        jacobian: f64,
    },
    /// Points that found no equilibrium.
    #[error(
        "the inner points found no equilibrium, {residual:.1e} of the force is left: use a smaller strain or a stable \
         material"
    )]
    NotRelaxed {
        /// Force left over that at the boundary.
        residual: f64,
    },
}

ib_core::input::debug_as_explanation!(SolidError);

/// Most points of a mesh or an outline: sizes are bounded before anything is allocated.
pub(crate) const MOST_POINTS: f64 = 1e6;

/// `value` if it is a length to compute with: positive, and such that its square is neither zero nor infinite.
pub(crate) fn length(name: &'static str, value: f64) -> Result<f64, InputError> {
    within(name, positive(name, value)?, 1e-100, 1e100)
}
