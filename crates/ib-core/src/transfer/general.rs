//! The transfer of one marker with any kernel, wherever it is.

use stokes_grid::Grid;

use super::lanes::Portable;
use super::locations::split;
use super::weights::weights;
use crate::{
    Kernel,
    kernel::{MAX_SUPPORT, Role},
};

/// Weights along one direction, of the points `first, first + 1, ...`.
#[derive(Debug, Clone, Copy)]
struct Line {
    first: i64,
    weights: [f64; MAX_SUPPORT],
    len: usize,
}

/// A component of a staggered field, for what lies beyond its walls.
#[derive(Debug, Clone, Copy)]
enum Component {
    X,
    Y,
}

/// Transfer with stencils that wrap around the box or are folded back at walls.
#[derive(Debug)]
pub(super) struct GeneralTransfer<'a, K> {
    pub(super) kernel: &'a K,
    pub(super) grid: &'a Grid,
}

// Not derived: a copy of the references does not need a kernel that can be copied.
impl<K> Clone for GeneralTransfer<'_, K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K> Copy for GeneralTransfer<'_, K> {}

impl<K: Kernel> GeneralTransfer<'_, K> {
    /// Adds `force` (force density times cells) at `place` (in units of h) to the rows of both components that are
    /// there, from `first_row` on.
    #[inline(never)]
    pub(super) fn add(&self, place: [f64; 2], force: [f64; 2], first_row: usize, fx: &mut [f64], fy: &mut [f64]) {
        let [[normal_x, tangential_x], [normal_y, tangential_y]] = place.map(|r| self.lines(r));
        self.add_component(Component::X, [normal_x, tangential_y], force[0], first_row, fx);
        self.add_component(Component::Y, [tangential_x, normal_y], force[1], first_row, fy);
    }

    /// Returns the velocity at `place`.
    #[inline(never)]
    pub(super) fn gather(&self, place: [f64; 2], u: &[f64], v: &[f64]) -> [f64; 2] {
        let [[normal_x, tangential_x], [normal_y, tangential_y]] = place.map(|r| self.lines(r));
        [
            self.gather_component(Component::X, normal_x, tangential_y, u),
            self.gather_component(Component::Y, tangential_x, normal_y, v),
        ]
    }

    /// Returns the weights in both roles. The points of the tangential role lie half way between the points of the
    /// normal one.
    fn lines(&self, r: f64) -> [Line; 2] {
        let mut lines = [Role::Normal, Role::Tangential].map(|role| Line {
            first: 0,
            weights: [0.0; MAX_SUPPORT],
            len: self.kernel.support(role),
        });
        let [normal, tangential] = &mut lines;
        if let Some(pieces) = self.kernel.pieces() {
            let (whole, t) = split(r + pieces.shift);
            for (line, found) in [normal, tangential].into_iter().zip(weights(Portable, &pieces, t)) {
                line.first = whole.saturating_sub(1);
                line.weights[..4].copy_from_slice(&found);
            }
        } else {
            normal.first = self.kernel.weights(Role::Normal, r, &mut normal.weights);
            tangential.first = self.kernel.weights(Role::Tangential, r - 0.5, &mut tangential.weights);
        }
        lines
    }

    fn add_component(&self, component: Component, [x, y]: [Line; 2], value: f64, first_row: usize, field: &mut [f64]) {
        let nx = self.grid.nx();
        let first = self.column(x.first);
        let mut columns = x.weights;
        columns.iter_mut().for_each(|column| *column *= value);
        for (i, weight) in y.weights[..y.len].iter().enumerate() {
            let (row, sign) = self.fold(y.first + i as i64, component);
            let weight = sign * weight;
            let row = row.wrapping_sub(first_row);
            let Some(line) = row.checked_mul(nx).and_then(|start| field.get_mut(start..)?.get_mut(..nx)) else {
                continue;
            };
            if let Some(window) = line.get_mut(first..first + x.len) {
                for (cell, column) in window.iter_mut().zip(&columns) {
                    *cell += weight * column;
                }
            } else {
                for (j, column) in columns[..x.len].iter().enumerate() {
                    line[self.wrapped(first + j)] += weight * column;
                }
            }
        }
    }

    fn gather_component(&self, component: Component, x: Line, y: Line, field: &[f64]) -> f64 {
        let nx = self.grid.nx();
        let first = self.column(x.first);
        let mut sums = [0.0; MAX_SUPPORT];
        for (i, weight) in y.weights[..y.len].iter().enumerate() {
            let (row, sign) = self.fold(y.first + i as i64, component);
            let weight = sign * weight;
            let line = &field[row * nx..(row + 1) * nx];
            if let Some(window) = line.get(first..first + x.len) {
                for (sum, cell) in sums.iter_mut().zip(window) {
                    *sum += weight * cell;
                }
            } else {
                for (j, sum) in sums[..x.len].iter_mut().enumerate() {
                    *sum += weight * line[self.wrapped(first + j)];
                }
            }
        }
        let part = |i: usize| sums[i] * x.weights[i];
        (part(0) + part(2)) + (part(1) + part(3)) + (part(4) + part(5))
    }

    /// Returns the stored column that stands for `column`.
    #[inline]
    fn column(&self, column: i64) -> usize {
        let nx = self.grid.nx() as i64;
        // Mostly one period away at most; the division is slow.
        let near = if column < 0 { column + nx } else { column };
        (if (0..nx).contains(&near) { near } else { column.rem_euclid(nx) }) as usize
    }

    /// Returns the stored column that stands for one from zero on.
    #[inline]
    fn wrapped(&self, column: usize) -> usize {
        let nx = self.grid.nx();
        if column < nx {
            column
        } else if column < 2 * nx {
            column - nx
        } else {
            column % nx
        }
    }

    /// Returns the stored row and the sign that stand for row `row` of the extended field.
    #[inline]
    fn fold(&self, row: i64, component: Component) -> (usize, f64) {
        let ny = self.grid.ny() as i64;
        if !self.grid.has_walls() {
            // A stencil reaches beyond the box by less than one period unless the box is smaller than the kernel.
            let wrapped = if (0..ny).contains(&row) { row } else { row.rem_euclid(ny) };
            return (wrapped as usize, 1.0);
        }
        // Between rows of cells, odd, or about rows of nodes, even, with the period 2 ny.
        let (end, sign) = match component {
            Component::X => (2 * ny - 1, -1.0),
            Component::Y => (2 * ny, 1.0),
        };
        let row = if (0..ny).contains(&row) { row } else { row.rem_euclid(2 * ny) };
        let mirrored = end - row;
        if row <= mirrored { (row as usize, 1.0) } else { (mirrored as usize, sign) }
    }
}
