//! Errors of solids, meshes and outlines.

use motile_base::{
    InputError, Refusal, Vec2,
    internal::{Refuse, decimals, place},
    positive, within,
};

use crate::material::Mat2;

/// An error of this crate; its message has the offending values and the remedy. Places are positions in the plane
/// (length).
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An inverted triangle, or one of a solid that flows which is about to be.
    #[error(
        "triangle {triangle} near ({:.4}, {:.4}) is {}inverted (area ratio {jacobian:.4}). Use a smaller time step or \
         mesh spacing, or stiffer material", .place.x, .place.y, if *jacobian > 0.0 { "nearly " } else { "" }
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
        "the surface crosses itself near {}, where the sides that start at the points {first} and {second} \
         meet, because the model has no contact of a solid with itself. Use a stiffer material, add surface \
         elasticity, which keeps the surface from creasing, or use a smaller time step", at(*place)
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
        "the inner points found no equilibrium: {residual:.1e} of the force is left. Use a smaller strain or a stable \
         material"
    )]
    NoConvergence {
        /// Residual force over the force at the boundary.
        residual: f64,
    },
    /// An outline, channel, mesh, mesh file or request that cannot be used.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(SolidError);

impl SolidError {
    /// Returns the error for a deformation that inverts the material, flattens it, or is not finite.
    pub(crate) fn not_orientation_preserving(gradient: Mat2) -> Self {
        let [a, b] = [gradient.x_axis, gradient.y_axis].map(at);
        let what = format!("the deformation gradient with the columns {a} and {b} inverts or flattens the material");
        let value = format!("its determinant is {:.3e}", gradient.determinant());
        Self::refused(what, value, "Use a matrix with a positive determinant")
    }

    /// Returns the error for a triangle that names a point which does not exist.
    pub(crate) fn no_such_point(triangle: usize, point: usize, points: usize) -> Self {
        let what = format!("triangle {triangle} names point {point}, which does not exist");
        Self::refused(what, format!("the mesh has {points} points"), "Count the points from 0")
    }

    /// Returns the error for a triangle without area.
    pub(crate) fn flat_triangle(triangle: usize, place: Vec2, area: f64) -> Self {
        let what = format!("triangle {triangle} near {} is flat", at(place));
        Self::refused(what, format!("its area is {area:.1e}"), "Move its points off a common line")
    }

    /// Returns the error for a triangle of a periodic mesh whose corners cannot be distinguished from their images.
    pub(crate) fn triangle_too_wide(triangle: usize, width: f64, period: f64) -> Self {
        let value = format!("it is {} wide, which is half the period {period} or more", decimals(4, width));
        Self::refused(format!("triangle {triangle} is too wide"), value, "Use smaller triangles")
    }

    /// Returns the error for a point that no triangle uses.
    pub(crate) fn loose_point(point: usize, place: Vec2) -> Self {
        Self::refused(format!("point {point} at {} belongs to no triangle", at(place)), "", "Leave it out")
    }

    /// Returns the error for two points of triangles at one place, where the triangles are not connected.
    pub(crate) fn coincident_points(first: usize, second: usize, place: Vec2) -> Self {
        let what = format!("points {first} and {second} coincide at {}", at(place));
        let remedy = "Merge them (in Gmsh, use \"Coherence Mesh;\" or the tool that removes duplicate nodes)";
        Self::refused(what, "the triangles there are not connected", remedy)
    }

    /// Returns the error for an edge with more than one triangle on a side.
    pub(crate) fn folded_mesh(first: usize, second: usize, triangle: usize) -> Self {
        let what = format!("triangles overlap at the edge between points {first} and {second}");
        let value = format!("two of them, one being triangle {triangle}, are on one side of it");
        Self::refused(what, value, "Remove one of them, or move its points")
    }

    /// Returns the error for an island that a channel does not have.
    pub(crate) fn no_such_island(number: usize, found: usize) -> Self {
        let value = format!("the channel has {found}, counted from 0");
        Self::refused(format!("island {number} does not exist"), value, "Use the number of an existing island")
    }

    /// Returns the error for an operation that is not supported.
    pub(crate) fn unsupported(what: &str, remedy: &str) -> Self {
        Self::refused(format!("{what} is not possible"), "", remedy)
    }

    /// Returns the error for a line that ends at `place`, at a distance `gap` from its start or the start of the next
    /// period.
    pub(crate) fn open_outline(place: Vec2, gap: f64) -> Self {
        let value = format!("it ends at {}, {gap:.3e} from where it must", at(place));
        let remedy = "Close it, or let a profile return to its first height";
        Self::refused("the outline is not closed", value, remedy)
    }

    /// Returns the error for a side or curve of an outline without length.
    pub(crate) fn no_length(place: Vec2) -> Self {
        let what = format!("a side of the outline at {} has no length", at(place));
        Self::refused(what, "", "Use successive points that differ")
    }

    /// Returns the error for corners of a curve that do not increase.
    pub(crate) fn corners_out_of_order(value: f64, [start, end]: [f64; 2]) -> Self {
        let remedy = format!("Use increasing numbers above {start} and below {end}");
        Self::refused("the corners of the curve are out of order", format!("{value}"), remedy)
    }

    /// Returns the error for a rounded corner that does not fit on the side from `place`.
    pub(crate) fn rounding_too_large(radius: f64, place: Vec2, side: f64, maximum: f64) -> Self {
        let what = format!("a corner of radius {radius} does not fit on the side from {}", at(place));
        Self::refused(
            what,
            format!("the side is {} long", decimals(4, side)),
            format!("Use a radius of at most {}", decimals(4, maximum)),
        )
    }

    /// Returns the error for periodic outlines of different periods.
    pub(crate) fn different_periods(first: f64, second: f64) -> Self {
        Self::refused("outlines have different periods", format!("{first} and {second}"), "Give them the same period")
    }

    /// Returns the error for an interior that extends to infinity.
    pub(crate) fn open_region(lines: usize) -> Self {
        let what = "the solid extends to infinity";
        let value = format!("the number of periodic outlines is odd: {lines}");
        Self::refused(what, value, "Use two periodic outlines for each wall, one for each of its surfaces")
    }

    /// Outlines that cross.
    pub(crate) fn crossing(place: Vec2) -> Self {
        let remedy = "Move them apart, or use a smaller spacing if they only come close";
        Self::refused(format!("outlines cross or touch near {}", at(place)), "", remedy)
    }

    /// Returns the error for a line of a channel on the wrong side of the others.
    pub(crate) fn not_between(place: Vec2) -> Self {
        let what = format!("the line through {} is not between the two sides of the channel", at(place));
        let value = "it must be below the upper side and above the lower one";
        Self::refused(what, value, "Exchange the lines, or move them")
    }

    /// Returns the error for a hole that the mesh cannot resolve.
    pub(crate) fn hole_too_small(place: Vec2, width: f64, spacing: f64) -> Self {
        let what = format!("the hole at {} is too small for the mesh", at(place));
        let value = format!("it is {} wide, less than the mesh spacing {spacing}", decimals(4, width));
        Self::refused(what, value, "Leave it out, or use a smaller spacing")
    }

    /// Returns the error for a wall that the mesh cannot resolve.
    pub(crate) fn wall_too_thin(place: Vec2, thickness: f64, spacing: f64) -> Self {
        let what = format!("the solid at {} is too thin for the mesh", at(place));
        let value = format!("it is {} thick, less than the mesh spacing {spacing}", decimals(4, thickness));
        Self::refused(what, value, "Make it thicker, round its tip, or use a smaller spacing")
    }

    /// Returns the error for a triangulation that failed.
    pub(crate) fn meshing_failed(reason: &str) -> Self {
        Self::refused("the triangulation failed", reason, "Use a smaller mesh spacing")
    }

    /// Returns the error for a line of text that is not part of a mesh file.
    pub(crate) fn gmsh(line: usize, fault: impl Into<String>) -> Self {
        let remedy = "Save the mesh as ASCII, version 4.1, with triangles of three points in one plane";
        Self::refused(format!("line {line} of the mesh file cannot be used"), fault, remedy)
    }

    /// Returns the error for neighbouring nodes of a fibre at one place.
    pub(crate) fn coincident_nodes(first: usize, second: usize, place: Vec2) -> Self {
        let what = format!("the nodes {first} and {second} of a fibre coincide at {}", at(place));
        Self::refused(what, "", "Leave one of them out, or use a smaller time step if they have come together in a run")
    }

    /// Returns the error for a place in a mesh file.
    pub(crate) fn mesh_file(place: impl Into<String>, problem: impl Into<String>, remedy: &str) -> Self {
        Self::refused(format!("{} cannot be used", place.into()), problem, remedy)
    }

    /// Returns the error for a group of triangles that cannot be written.
    pub(crate) fn bad_group(tag: i32, fault: &str) -> Self {
        Self::refused(format!("group {tag} of triangles cannot be written"), fault, "Correct the group, or remove it")
    }
}

/// Returns the text of a place.
fn at(Vec2 { x, y }: Vec2) -> String {
    place(x, y)
}

/// Most points of a mesh or an outline: sizes are bounded before anything is allocated.
pub(crate) const MOST_POINTS: f64 = 1e6;

/// Returns `value` if it is a length to compute with: positive, and such that its square is neither zero nor infinite.
pub(crate) fn length(name: &'static str, value: f64) -> Result<f64, InputError> {
    within(name, positive(name, value)?, 1e-100, 1e100)
}

/// Returns true if an error is a refusal whose text contains these words.
#[cfg(test)]
pub(crate) fn refused(error: &SolidError, words: &str) -> bool {
    matches!(error, SolidError::Refused { .. }) && error.to_string().contains(words)
}

/// Returns the numbers in the text of an error.
#[cfg(test)]
pub(crate) fn numbers(error: &SolidError) -> Vec<f64> {
    let text = error.to_string();
    text.split(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c))).filter_map(|word| word.parse().ok()).collect()
}
