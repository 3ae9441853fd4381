//! Differences of neighbouring values on the staggered grid, row by row and without the division by h.

use crate::StaggeredField;

/// Row `j` of h times the divergence, at the centres.
pub(crate) fn divergence(field: &StaggeredField, j: usize, out: &mut [f64]) {
    let nx = out.len();
    let above = if j + 1 == field.grid().node_rows() { 0 } else { j + 1 };
    let (u, v, v_above) = (&field.x()[j * nx..][..nx], &field.y()[j * nx..][..nx], &field.y()[above * nx..][..nx]);
    for (((out, u), v), v_above) in out.iter_mut().zip(u.windows(2)).zip(v).zip(v_above) {
        *out = (u[1] - u[0]) + (v_above - v);
    }
    let last = nx - 1;
    out[last] = (u[0] - u[last]) + (v_above[last] - v[last]);
}

/// Row `j` of `scale` times h times the curl, at nodes that do not lie on a wall.
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

/// x velocities `mean + above - below` between two rows of a streamfunction.
pub(crate) fn along(out: &mut [f64], below: &[f64], above: &[f64], mean: f64) {
    for ((out, below), above) in out.iter_mut().zip(below).zip(above) {
        *out = mean + (above - below);
    }
}

/// y velocities `mean - (right - left)` on a row of a streamfunction.
pub(crate) fn across(out: &mut [f64], psi: &[f64], mean: f64) {
    for (out, psi) in out.iter_mut().zip(psi.windows(2)) {
        *out = mean - (psi[1] - psi[0]);
    }
    let last = psi.len() - 1;
    out[last] = mean - (psi[0] - psi[last]);
}

/// The column to the right in a periodic row.
pub(crate) fn right(i: usize, nx: usize) -> usize {
    if i + 1 == nx { 0 } else { i + 1 }
}

/// The column to the left in a periodic row.
pub(crate) fn left(i: usize, nx: usize) -> usize {
    if i == 0 { nx - 1 } else { i - 1 }
}
