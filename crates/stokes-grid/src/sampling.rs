//! Values of grid fields between grid points.

use motile_base::{FlowSample, Vec2, internal::all_points_finite, same_length};

use crate::{CentreField, Grid, StaggeredField, StokesError, Wall, WallMotion};

static AT_REST: WallMotion = WallMotion::AT_REST;

/// A field on a shifted lattice of a grid, continued beyond walls by symmetry.
struct Lattice<'a> {
    values: &'a [f64],
    grid: &'a Grid,
    /// Position of entry (0, 0) in cells from the grid's lower left corner.
    shift: [f64; 2],
    /// Factor of the continuation beyond the bottom and the top wall.
    parity: [f64; 2],
    /// Velocities along the walls, about which a component is continued.
    walls: &'a WallMotion,
}

impl<'a> Lattice<'a> {
    /// Returns the components of a velocity.
    fn of_velocity(velocity: &'a StaggeredField, walls: &'a WallMotion) -> [Self; 2] {
        let spacing = velocity.grid().spacing();
        let lattice = |values, shift, walls: &'a WallMotion| {
            let parity = [Wall::Bottom, Wall::Top].map(|wall| 1.0 - 2.0 * walls.stick(wall, spacing));
            Lattice { values, grid: velocity.grid(), shift, parity, walls }
        };
        [lattice(velocity.x(), [0.0, 0.5], walls), lattice(velocity.y(), [0.5, 0.0], &AT_REST)]
    }

    fn value(&self, column: i64, row: i64) -> f64 {
        let (nx, ny) = (self.grid.nx() as i64, self.grid.ny() as i64);
        let column = column.rem_euclid(nx);
        let at = |row: i64| self.values[(row * nx + column) as usize];
        if !self.grid.has_walls() {
            return at(row.rem_euclid(ny));
        }
        let inside = row.rem_euclid(2 * ny);
        // About rows of nodes or between rows of cells.
        let mirrored = 2 * ny - i64::from(self.shift[1] != 0.0) - inside;
        if inside <= mirrored {
            return at(inside);
        }
        let (wall, parity) = if row < 0 { (Wall::Bottom, self.parity[0]) } else { (Wall::Top, self.parity[1]) };
        parity * at(mirrored) + (1.0 - parity) * self.walls.at(wall, column as usize)
    }

    /// Returns the entry below and to the left of a point, and how far beyond it the point is, in cells.
    fn cell(&self, point: Vec2) -> ([i64; 2], [f64; 2]) {
        let (h, origin) = (self.grid.spacing(), self.grid.origin());
        let place = [0, 1].map(|k| (point[k] - origin[k]) / h - self.shift[k]);
        let first = place.map(f64::floor);
        // Whole periods, or distances between images in walls, are taken off first: a whole number may not hold them.
        let rows = if self.grid.has_walls() { 2 * self.grid.ny() } else { self.grid.ny() };
        let near = |entry: f64, count: usize| {
            if entry.abs() < 1e15 { entry as i64 } else { entry.rem_euclid(count as f64) as i64 }
        };
        ([near(first[0], self.grid.nx()), near(first[1], rows)], [place[0] - first[0], place[1] - first[1]])
    }

    /// Returns the value and gradient at a point by bilinear interpolation.
    fn bilinear(&self, point: Vec2) -> (f64, [f64; 2]) {
        let ([i, j], [s, t]) = self.cell(point);
        let [a, b, c, d] = [self.value(i, j), self.value(i + 1, j), self.value(i, j + 1), self.value(i + 1, j + 1)];
        let value = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
        let gradient = [(1.0 - t) * (b - a) + t * (d - c), (1.0 - s) * (c - a) + s * (d - b)];
        (value, gradient.map(|step| step / self.grid.spacing()))
    }
}

/// Returns the pressure (force per length) at a point (length), bilinear between the centres of grid cells.
///
/// The point may lie anywhere: a periodic field repeats, and beyond a wall the pressure continues symmetrically. A
/// coordinate that is not finite gives a value that is not finite.
#[must_use]
pub fn sample_pressure(pressure: &CentreField, point: Vec2) -> f64 {
    let (grid, walls) = (pressure.grid(), &AT_REST);
    Lattice { values: pressure.values(), grid, shift: [0.5; 2], parity: [1.0; 2], walls }.bilinear(point).0
}

/// Shifts a pressure (force per length) in a channel so that its mean over both walls is zero, as in an evaluation
/// without a grid; in a box nothing changes.
///
/// The mean over x of the pressure is the same at a wall and in the row of cells next to it, unless a force acts
/// there.
pub fn level_at_walls(pressure: &mut CentreField) {
    if !pressure.grid().has_walls() {
        return;
    }
    let row = pressure.grid().nx();
    let values = pressure.values_mut();
    let ends: f64 = values[..row].iter().chain(&values[values.len() - row..]).sum();
    let level = ends / (2.0 * row as f64);
    values.iter_mut().for_each(|value| *value -= level);
}

/// Fills `out` with the flow at `points` (length): velocity (length per time) and pressure (force per length), bilinear
/// between grid points, and the gradient of this velocity (1/time).
///
/// Errors are of second order in the spacing where the flow is smooth. `walls` are the velocities of the walls in that
/// flow ([`crate::StokesSolver::walls`]), about which the velocity continues antisymmetrically beyond a wall, or as its
/// slip length demands.
///
/// # Errors
/// Returns [`StokesError::Input`] if the numbers of samples and points differ or a point is not finite, and
/// [`StokesError::Refused`] if the fields belong to two grids.
pub fn sample_flow(
    velocity: &StaggeredField,
    pressure: &CentreField,
    walls: &WallMotion,
    points: &[Vec2],
    out: &mut [FlowSample],
) -> Result<(), StokesError> {
    same_length("the samples", points.len(), out.len())?;
    all_points_finite("the points to sample", points)?;
    velocity.grid().check([("the pressure", pressure.grid())])?;
    walls.check(velocity.grid())?;
    for (&point, out) in points.iter().zip(out) {
        let [(ux, du), (uy, dv)] = Lattice::of_velocity(velocity, walls).map(|component| component.bilinear(point));
        let velocity = Vec2::new(ux, uy);
        *out = FlowSample { velocity, pressure: sample_pressure(pressure, point), gradient: [du, dv] };
    }
    Ok(())
}

#[cfg(test)]
mod tests;
