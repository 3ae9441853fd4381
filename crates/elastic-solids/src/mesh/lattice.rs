//! Lattices of equilateral triangles.

use motile_base::{
    InputError, Vec2,
    internal::{all_points_finite, at_least},
    within,
};

use crate::SolidError;
use crate::error::{MOST_POINTS, length};
use crate::mesh::TriangleMesh;

/// Height of an equilateral triangle over its side.
pub(crate) const ROW_HEIGHT: f64 = 0.866_025_403_784_438_6;

/// Returns the strip of equilateral triangles, periodic in x: `columns` points a row, `rows` layers of triangles
/// (`rows + 1` rows of points) of side `spacing` (length). The lowest row starts at `corner` (length). The period is
/// `columns * spacing`, the thickness `rows * sqrt(3)/2 spacing`: the wall of Cowley section 4.1.
///
/// Points are numbered row by row from below.
///
/// # Errors
/// Returns an error for a spacing that is not positive, a corner that is not finite, fewer than three columns or one
/// row, more than 1e6 columns times rows.
pub fn equilateral_strip(corner: Vec2, columns: usize, rows: usize, spacing: f64) -> Result<TriangleMesh, SolidError> {
    strip(corner, columns, rows, [length("the lattice spacing", spacing)?, ROW_HEIGHT * spacing])
}

/// Returns the strip of almost equilateral triangles, periodic in x, that fills a rectangle of `size` = period and
/// thickness (length) exactly, with the lower left corner at `corner` (length). The rows are as many as fit `spacing`
/// (length) best, the columns as many as stretch the triangles least.
///
/// # Errors
/// Returns an error for sizes or a spacing that are not positive, a corner that is not finite, fewer than three columns
/// or one row, more than 1e6 columns times rows.
pub fn fitted_strip(corner: Vec2, size: [f64; 2], spacing: f64) -> Result<TriangleMesh, SolidError> {
    length("the lattice spacing", spacing)?;
    length("the period", size[0])?;
    let rows = count("rows of the strip", length("the thickness", size[1])? / (ROW_HEIGHT * spacing), 1)?;
    let height = size[1] / rows as f64;
    let columns = count("columns of the strip", size[0] / (height / ROW_HEIGHT), 3)?;
    strip(corner, columns, rows, [size[0] / columns as f64, height])
}

/// Returns the block of equilateral triangles of side `spacing` (length): `columns + 1` points in the even rows,
/// `columns` in the odd ones, `rows` layers of triangles. Its lower left point is `corner` (length); the sides to the
/// left and right are toothed.
///
/// Points are numbered row by row from below.
///
/// # Errors
/// Returns an error for a spacing that is not positive, a corner that is not finite, no column or no row, more than 1e6
/// columns times rows.
pub fn equilateral_block(corner: Vec2, columns: usize, rows: usize, spacing: f64) -> Result<TriangleMesh, SolidError> {
    length("the lattice spacing", spacing)?;
    all_points_finite("the corner of the block", &[corner])?;
    at_least("rows of the block", rows, 1)?;
    // A single column of several rows would hang together by points.
    at_least("columns of the block", columns, rows.min(2))?;
    check_size(columns, rows)?;
    let mut points = Vec::new();
    let mut starts = Vec::with_capacity(rows + 2);
    for row in 0..=rows {
        starts.push(points.len());
        let odd = row % 2;
        let first = corner + Vec2::new(0.5 * odd as f64, ROW_HEIGHT * row as f64) * spacing;
        points.extend((0..=columns - odd).map(|column| first + Vec2::new(column as f64 * spacing, 0.0)));
    }
    let mut triangles = Vec::new();
    for row in 0..rows {
        // The longer row has the base of `columns` triangles, the shorter one that of the `columns - 1` between them.
        let (long, short) = if row % 2 == 0 { (starts[row], starts[row + 1]) } else { (starts[row + 1], starts[row]) };
        triangles.extend((0..columns).map(|i| [long + i, long + i + 1, short + i]));
        triangles.extend((0..columns - 1).map(|i| [short + i, long + i + 1, short + i + 1]));
    }
    TriangleMesh::new(points, triangles)
}

fn strip(corner: Vec2, columns: usize, rows: usize, [dx, dy]: [f64; 2]) -> Result<TriangleMesh, SolidError> {
    all_points_finite("the corner of the strip", &[corner])?;
    at_least("columns of the strip", columns, 3)?;
    at_least("rows of the strip", rows, 1)?;
    check_size(columns, rows)?;
    let points = (0..=rows)
        .flat_map(|row| {
            let first = corner + Vec2::new(0.5 * dx * (row % 2) as f64, dy * row as f64);
            (0..columns).map(move |column| first + Vec2::new(dx * column as f64, 0.0))
        })
        .collect();
    let mut triangles = Vec::with_capacity(2 * columns * rows);
    for row in 0..rows {
        let (below, above) = (row * columns, (row + 1) * columns);
        // Odd rows stand half a spacing further right.
        let (lower, upper) = if row % 2 == 0 { (1, 0) } else { (0, 1) };
        for i in 0..columns {
            let j = (i + 1) % columns;
            let shifted = |k: usize| if k == 0 { i } else { j };
            triangles.push([below + i, below + j, above + shifted(upper)]);
            triangles.push([below + shifted(lower), above + j, above + i]);
        }
    }
    TriangleMesh::periodic(points, triangles, dx * columns as f64)
}

fn count(name: &'static str, exact: f64, minimum: usize) -> Result<usize, InputError> {
    at_least(name, within(name, exact, 0.0, MOST_POINTS)?.round() as usize, minimum)
}

fn check_size(columns: usize, rows: usize) -> Result<(), InputError> {
    within("the number of columns times that of rows", columns as f64 * rows as f64, 1.0, MOST_POINTS).map(drop)
}

#[cfg(test)]
mod tests;
