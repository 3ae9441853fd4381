//! Values of grid fields between grid points.

use stokes_grid::{CentreField, Grid, StaggeredField};

use crate::{FlowSample, Vec2};

/// A field on a shifted lattice of a grid, continued beyond walls by symmetry.
struct Lattice<'a> {
    values: &'a [f64],
    grid: &'a Grid,
    /// Position of entry (0, 0) in cells from the grid's lower left corner.
    shift: [f64; 2],
    /// Sign of the continuation beyond a wall.
    parity: f64,
}

impl Lattice<'_> {
    fn value(&self, column: i64, row: i64) -> f64 {
        let (nx, ny) = (self.grid.nx() as i64, self.grid.ny() as i64);
        let column = column.rem_euclid(nx);
        let (row, sign) = if !self.grid.has_walls() {
            (row.rem_euclid(ny), 1.0)
        } else if self.shift[1] == 0.0 {
            let r = row.rem_euclid(2 * ny);
            if r <= ny { (r, 1.0) } else { (2 * ny - r, self.parity) }
        } else {
            let r = row.rem_euclid(2 * ny);
            if r < ny { (r, 1.0) } else { (2 * ny - 1 - r, self.parity) }
        };
        sign * self.values[(row * nx + column) as usize]
    }

    /// Value and gradient (per cell) by bilinear interpolation at a position in cells.
    fn bilinear(&self, position: [f64; 2]) -> (f64, [f64; 2]) {
        let (x, y) = (position[0] - self.shift[0], position[1] - self.shift[1]);
        let (i, j) = (x.floor(), y.floor());
        let (s, t) = (x - i, y - j);
        let (i, j) = (i as i64, j as i64);
        let [a, b, c, d] = [self.value(i, j), self.value(i + 1, j), self.value(i, j + 1), self.value(i + 1, j + 1)];
        let value = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
        (value, [(1.0 - t) * (b - a) + t * (d - c), (1.0 - s) * (c - a) + s * (d - b)])
    }
}

impl Lattice<'_> {
    /// Value by cubic interpolation at a position in cells.
    fn cubic(&self, position: [f64; 2]) -> f64 {
        let (x, y) = (position[0] - self.shift[0], position[1] - self.shift[1]);
        let (i, j) = (x.floor(), y.floor());
        let (columns, rows) = (cubic_weights(x - i), cubic_weights(y - j));
        let (i, j) = (i as i64 - 1, j as i64 - 1);
        let mut sum = 0.0;
        for (row, wy) in (j..).zip(rows) {
            for (column, wx) in (i..).zip(columns) {
                sum += wx * wy * self.value(column, row);
            }
        }
        sum
    }
}

/// Lagrange weights of the points -1, 0, 1, 2 at t between 0 and 1.
fn cubic_weights(t: f64) -> [f64; 4] {
    let (a, b, c) = (t + 1.0, t - 1.0, t - 2.0);
    [-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0]
}

/// Fills `out` with velocity and pressure at `points` by cubic interpolation, for where errors are amplified; no gradient.
pub(crate) fn sample_smooth(
    velocity: &StaggeredField,
    pressure: &CentreField,
    points: &[Vec2],
    out: &mut [FlowSample],
) {
    let grid = velocity.grid();
    let (h, origin) = (grid.spacing(), grid.origin());
    let lattice = |values, shift, parity| Lattice { values, grid, shift, parity };
    let u = lattice(velocity.x(), [0.0, 0.5], -1.0);
    let v = lattice(velocity.y(), [0.5, 0.0], -1.0);
    let p = lattice(pressure.values(), [0.5, 0.5], 1.0);
    for (point, out) in points.iter().zip(out) {
        let position = [(point.x - origin[0]) / h, (point.y - origin[1]) / h];
        out.velocity = Vec2::new(u.cubic(position), v.cubic(position));
        out.pressure = p.cubic(position);
    }
}

/// Fills `out` with the flow at `points`: velocity and pressure bilinear between grid points, and the gradient of that.
pub(crate) fn sample(velocity: &StaggeredField, pressure: &CentreField, points: &[Vec2], out: &mut [FlowSample]) {
    let grid = velocity.grid();
    let (h, origin) = (grid.spacing(), grid.origin());
    let u = Lattice { values: velocity.x(), grid, shift: [0.0, 0.5], parity: -1.0 };
    let v = Lattice { values: velocity.y(), grid, shift: [0.5, 0.0], parity: -1.0 };
    let p = Lattice { values: pressure.values(), grid, shift: [0.5, 0.5], parity: 1.0 };
    for (point, out) in points.iter().zip(out) {
        let position = [(point.x - origin[0]) / h, (point.y - origin[1]) / h];
        let (ux, du) = u.bilinear(position);
        let (uy, dv) = v.bilinear(position);
        *out = FlowSample {
            velocity: Vec2::new(ux, uy),
            pressure: p.bilinear(position).0,
            gradient: [du.map(|d| d / h), dv.map(|d| d / h)],
        };
    }
}
