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
    /// Value and gradient (per cell) by cubic interpolation at a position in cells.
    fn cubic(&self, position: [f64; 2]) -> (f64, [f64; 2]) {
        let (x, y) = (position[0] - self.shift[0], position[1] - self.shift[1]);
        let (i, j) = (x.floor(), y.floor());
        let ((columns, column_slopes), (rows, row_slopes)) = (cubic_weights(x - i), cubic_weights(y - j));
        let (i, j) = (i as i64 - 1, j as i64 - 1);
        let (mut value, mut gradient) = (0.0, [0.0; 2]);
        for (row, (weight, slope)) in (j..).zip(rows.into_iter().zip(row_slopes)) {
            let (mut along, mut across) = (0.0, 0.0);
            for (column, (weight, slope)) in (i..).zip(columns.into_iter().zip(column_slopes)) {
                let entry = self.value(column, row);
                along += weight * entry;
                across += slope * entry;
            }
            value += weight * along;
            gradient = [gradient[0] + weight * across, gradient[1] + slope * along];
        }
        (value, gradient)
    }
}

/// Lagrange weights of the points -1, 0, 1, 2 at t between 0 and 1, and their slopes.
fn cubic_weights(t: f64) -> ([f64; 4], [f64; 4]) {
    let (a, b, c) = (t + 1.0, t - 1.0, t - 2.0);
    let weights = [-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0];
    let slopes = [
        -(b * c + t * c + t * b) / 6.0,
        (b * c + a * c + a * b) / 2.0,
        -(t * c + a * c + a * t) / 2.0,
        (t * b + a * b + a * t) / 6.0,
    ];
    (weights, slopes)
}

/// Velocity and its gradient at a point by cubic interpolation between grid points.
pub(crate) fn smooth_velocity(velocity: &StaggeredField, point: Vec2) -> (Vec2, [[f64; 2]; 2]) {
    let grid = velocity.grid();
    let (h, origin) = (grid.spacing(), grid.origin());
    let u = Lattice { values: velocity.x(), grid, shift: [0.0, 0.5], parity: -1.0 };
    let v = Lattice { values: velocity.y(), grid, shift: [0.5, 0.0], parity: -1.0 };
    let position = [(point.x - origin[0]) / h, (point.y - origin[1]) / h];
    let ((ux, du), (uy, dv)) = (u.cubic(position), v.cubic(position));
    (Vec2::new(ux, uy), [du.map(|d| d / h), dv.map(|d| d / h)])
}

/// Pressure at a point, bilinear between grid points.
pub(crate) fn pressure(pressure: &CentreField, point: Vec2) -> f64 {
    let grid = pressure.grid();
    let (h, origin) = (grid.spacing(), grid.origin());
    let lattice = Lattice { values: pressure.values(), grid, shift: [0.5, 0.5], parity: 1.0 };
    lattice.bilinear([(point.x - origin[0]) / h, (point.y - origin[1]) / h]).0
}

/// Fills `out` with the flow at `points`: velocity and pressure bilinear between grid points, and the gradient of that.
pub(crate) fn sample(velocity: &StaggeredField, pressure: &CentreField, points: &[Vec2], out: &mut [FlowSample]) {
    let grid = velocity.grid();
    let (h, origin) = (grid.spacing(), grid.origin());
    let u = Lattice { values: velocity.x(), grid, shift: [0.0, 0.5], parity: -1.0 };
    let v = Lattice { values: velocity.y(), grid, shift: [0.5, 0.0], parity: -1.0 };
    for (point, out) in points.iter().zip(out) {
        let position = [(point.x - origin[0]) / h, (point.y - origin[1]) / h];
        let ((ux, du), (uy, dv)) = (u.bilinear(position), v.bilinear(position));
        *out = FlowSample {
            velocity: Vec2::new(ux, uy),
            pressure: self::pressure(pressure, *point),
            gradient: [du.map(|d| d / h), dv.map(|d| d / h)],
        };
    }
}
