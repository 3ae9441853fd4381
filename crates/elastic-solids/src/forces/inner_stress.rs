//! Stresses in the triangles of a mesh of forces along its edges.

use motile_base::Vec2;

use crate::{forces::Bar, material::Mat2, mesh::TriangleMesh};

/// Adds the Cauchy stresses (force per deformed length) of `tension` (force) in the bar along edge `edge` to the
/// stresses of the neighbouring triangles: `t |r| n n / area`, a half for each of two, n along the bar.
pub(crate) fn add_stress_of_bar(
    (mesh, edge): (&TriangleMesh, usize),
    (bar, tension): (&Bar, f64),
    positions: &[Vec2],
    stresses: &mut [Mat2],
) {
    let span = bar.span(positions);
    let (left, right) = mesh.edges()[edge].triangles;
    let share = if right.is_some() { 0.5 } else { 1.0 };
    let along =
        Mat2::from_cols(span * span.x, span * span.y) * (share * tension / span.length().max(f64::MIN_POSITIVE));
    for triangle in std::iter::once(left).chain(right) {
        let [a, b, c] = mesh.raw_corners(triangle, positions);
        stresses[triangle] += along / (0.5 * (b - a).perp_dot(c - a));
    }
}
