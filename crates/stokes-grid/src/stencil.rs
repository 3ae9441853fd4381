//! Differences of neighbouring values on the staggered grid, row by row, without the division by h.

use crate::{StaggeredField, Wall, WallMotion};

/// Writes row `j` of h times the divergence, at the centres.
pub(crate) fn divergence(field: &StaggeredField, j: usize, out: &mut [f64]) {
    let nx = out.len();
    let (u, v, v_above) = around_centres(field, j);
    for (((out, u), v), v_above) in out.iter_mut().zip(u.windows(2)).zip(v).zip(v_above) {
        *out = (u[1] - u[0]) + (v_above - v);
    }
    let last = nx - 1;
    out[last] = (u[0] - u[last]) + (v_above[last] - v[last]);
}

/// Returns the rows of x components and of y components below and above row `j` of centres.
fn around_centres(field: &StaggeredField, j: usize) -> (&[f64], &[f64], &[f64]) {
    let nx = field.grid().nx();
    let above = if j + 1 == field.grid().node_rows() { 0 } else { j + 1 };
    (&field.x()[j * nx..][..nx], &field.y()[j * nx..][..nx], &field.y()[above * nx..][..nx])
}

/// Calls `take(i, h du/dx, h dv/dy)` for the centres of row `j`.
#[inline]
pub(crate) fn normal_steps(velocity: &StaggeredField, j: usize, mut take: impl FnMut(usize, f64, f64)) {
    let (u, v, v_above) = around_centres(velocity, j);
    for i in 0..u.len() {
        take(i, u[right(i, u.len())] - u[i], v_above[i] - v[i]);
    }
}

/// Calls `take(i, h du/dy, h dv/dx)` for the nodes of row `j`; on a wall du/dy is that to the velocity half a cell
/// away.
#[inline]
pub(crate) fn shear_steps(
    velocity: &StaggeredField,
    walls: &WallMotion,
    j: usize,
    mut take: impl FnMut(usize, f64, f64),
) {
    let grid = velocity.grid();
    let (nx, ny) = (grid.nx(), grid.ny());
    let u_row = |j: usize| &velocity.x()[j * nx..][..nx];
    let (above, below) = (u_row(j.min(ny - 1)), u_row(if j > 0 { j - 1 } else { ny - 1 }));
    let v = &velocity.y()[j * nx..][..nx];
    let [bottom, top] = [Wall::Bottom, Wall::Top].map(|wall| 2.0 * walls.stick(wall, grid.spacing()));
    for i in 0..nx {
        let u_step = if grid.has_walls() && j == 0 {
            bottom * (above[i] - walls.at(Wall::Bottom, i))
        } else if grid.has_walls() && j == ny {
            top * (walls.at(Wall::Top, i) - below[i])
        } else {
            above[i] - below[i]
        };
        take(i, u_step, v[i] - v[left(i, nx)]);
    }
}

/// Writes row `j` of `scale` times h times the curl, at nodes that do not lie on a wall.
#[inline]
pub(crate) fn curl(field: &StaggeredField, j: usize, scale: f64, out: &mut [f64]) {
    let nx = out.len();
    let below = if j == 0 { field.grid().ny() - 1 } else { j - 1 };
    let (fx_below, fx, fy) = (&field.x()[below * nx..][..nx], &field.x()[j * nx..][..nx], &field.y()[j * nx..][..nx]);
    out[0] = scale * ((fy[0] - fy[nx - 1]) - (fx[0] - fx_below[0]));
    for (((out, fy), fx), fx_below) in out[1..].iter_mut().zip(fy.windows(2)).zip(&fx[1..]).zip(&fx_below[1..]) {
        *out = scale * ((fy[1] - fy[0]) - (fx - fx_below));
    }
}

/// Writes x velocities `mean + above - below` between two rows of a streamfunction.
pub(crate) fn along(out: &mut [f64], below: &[f64], above: &[f64], mean: f64) {
    for ((out, below), above) in out.iter_mut().zip(below).zip(above) {
        *out = mean + (above - below);
    }
}

/// Writes y velocities `mean - (right - left)` on a row of a streamfunction.
pub(crate) fn across(out: &mut [f64], psi: &[f64], mean: f64) {
    for (out, psi) in out.iter_mut().zip(psi.windows(2)) {
        *out = mean - (psi[1] - psi[0]);
    }
    let last = psi.len() - 1;
    out[last] = mean - (psi[0] - psi[last]);
}

/// Returns the number of the column to the right in a periodic row.
pub(crate) fn right(i: usize, nx: usize) -> usize {
    if i + 1 == nx { 0 } else { i + 1 }
}

/// Returns the number of the column to the left in a periodic row.
pub(crate) fn left(i: usize, nx: usize) -> usize {
    if i == 0 { nx - 1 } else { i - 1 }
}
