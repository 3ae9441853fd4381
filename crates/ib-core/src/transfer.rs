//! Spreading forces to the grid and interpolating velocities from it.

use stokes_grid::{Grid, StaggeredField};

use crate::{Kernel, MAX_SUPPORT, Role, Vec2};

/// The stencil of one marker for one velocity component: weights in x and in y.
#[derive(Debug, Clone, Copy, Default)]
struct Stencil {
    columns: [f64; MAX_SUPPORT],
    rows: [f64; MAX_SUPPORT],
    first_column: usize,
    first_row: i64,
}

/// Transfer between markers and a staggered grid, the adjoint pair of the immersed boundary method (thesis (2.33),
/// (2.34)):
///
/// * spreading: `f(x) = sum_k F_k delta_h(x - X_k)`, F_k the force (not density) of marker k;
/// * interpolation: `U_k = sum over grid points u(x) delta_h(x - X_k) h^2`.
///
/// Both use the same weights, computed once by [`Transfer::locate`], so that `sum_k F_k . U_k` equals
/// `sum f . u h^2` to round-off. Positions are wrapped into a periodic box; at a wall the weights beyond it are folded
/// back, odd for the x component and even for the y component, so that the interpolated velocity vanishes on the
/// wall (docs/method.md, section 2).
#[derive(Debug, Clone)]
pub struct Transfer<K> {
    kernel: K,
    grid: Grid,
    x_component: Vec<Stencil>,
    y_component: Vec<Stencil>,
}

impl<K: Kernel> Transfer<K> {
    /// A transfer between markers and the fields of `grid`.
    #[must_use]
    pub fn new(grid: Grid, kernel: K) -> Self {
        Self { kernel, grid, x_component: Vec::new(), y_component: Vec::new() }
    }

    /// The kernel.
    #[must_use]
    pub fn kernel(&self) -> &K {
        &self.kernel
    }

    /// Computes the weights of markers at `positions` (length, not wrapped). They must be finite: what is not lands somewhere in
    /// the box ([`crate::ImmersedBoundary`] refuses it).
    pub fn locate(&mut self, positions: &[Vec2]) {
        let (h, [x0, y0]) = (self.grid.spacing(), self.grid.origin());
        let (nx, ny) = (self.grid.nx() as f64, self.grid.ny() as f64);
        let wraps_y = !self.grid.has_walls();
        self.x_component.clear();
        self.y_component.clear();
        for position in positions {
            // Wrapping before the weights keeps the column arithmetic exact for droplets that have travelled far.
            let x = ((position.x - x0) / h).rem_euclid(nx);
            let y = (position.y - y0) / h;
            let y = if wraps_y { y.rem_euclid(ny) } else { y };
            self.x_component.push(self.stencil((Role::Normal, x), (Role::Tangential, y - 0.5)));
            self.y_component.push(self.stencil((Role::Tangential, x - 0.5), (Role::Normal, y)));
        }
    }

    #[inline]
    fn stencil(&self, x: (Role, f64), y: (Role, f64)) -> Stencil {
        let mut stencil = Stencil::default();
        let first = self.kernel.weights(x.0, x.1, &mut stencil.columns);
        stencil.first_column = first.rem_euclid(self.grid.nx() as i64) as usize;
        stencil.first_row = self.kernel.weights(y.0, y.1, &mut stencil.rows);
        stencil
    }

    /// Adds the force density of the located markers to `density` (force per volume), thesis (2.33). `forces` (force) has an
    /// entry for each of them.
    pub fn spread(&self, forces: &[Vec2], density: &mut StaggeredField) {
        let scale = 1.0 / (self.grid.spacing() * self.grid.spacing());
        let (normal, tangential) = (self.kernel.support(Role::Normal), self.kernel.support(Role::Tangential));
        let (fx, fy) = density.components_mut();
        for (stencil, force) in self.x_component.iter().zip(forces) {
            self.add(stencil, (normal, tangential), Component::X, scale * force.x, fx);
        }
        for (stencil, force) in self.y_component.iter().zip(forces) {
            self.add(stencil, (tangential, normal), Component::Y, scale * force.y, fy);
        }
    }

    /// The velocities at the located markers (length per time), thesis (2.34). `velocities` has an entry for each of them.
    pub fn interpolate(&self, velocity: &StaggeredField, velocities: &mut [Vec2]) {
        let (normal, tangential) = (self.kernel.support(Role::Normal), self.kernel.support(Role::Tangential));
        let (u, v) = (velocity.x(), velocity.y());
        for ((sx, sy), out) in self.x_component.iter().zip(&self.y_component).zip(velocities) {
            out.x = self.gather(sx, (normal, tangential), Component::X, u);
            out.y = self.gather(sy, (tangential, normal), Component::Y, v);
        }
    }

    #[inline]
    fn add(&self, stencil: &Stencil, support: (usize, usize), component: Component, value: f64, field: &mut [f64]) {
        let nx = self.grid.nx();
        let columns = &stencil.columns[..support.0];
        for (i, weight) in stencil.rows[..support.1].iter().enumerate() {
            let (row, sign) = self.fold(stencil.first_row + i as i64, component);
            let amount = sign * weight * value;
            let line = &mut field[row * nx..(row + 1) * nx];
            if let Some(window) = line.get_mut(stencil.first_column..stencil.first_column + support.0) {
                for (cell, column) in window.iter_mut().zip(columns) {
                    *cell += amount * column;
                }
            } else {
                for (j, column) in columns.iter().enumerate() {
                    line[(stencil.first_column + j) % nx] += amount * column;
                }
            }
        }
    }

    #[inline]
    fn gather(&self, stencil: &Stencil, support: (usize, usize), component: Component, field: &[f64]) -> f64 {
        let nx = self.grid.nx();
        let columns = &stencil.columns[..support.0];
        let mut sum = 0.0;
        for (i, weight) in stencil.rows[..support.1].iter().enumerate() {
            let (row, sign) = self.fold(stencil.first_row + i as i64, component);
            let line = &field[row * nx..(row + 1) * nx];
            let partial: f64 = if let Some(window) = line.get(stencil.first_column..stencil.first_column + support.0) {
                window.iter().zip(columns).map(|(cell, column)| cell * column).sum()
            } else {
                columns.iter().enumerate().map(|(j, c)| c * line[(stencil.first_column + j) % nx]).sum()
            };
            sum += sign * weight * partial;
        }
        sum
    }

    /// The stored row and the sign that stand for row `row` of the extended field.
    #[inline]
    fn fold(&self, row: i64, component: Component) -> (usize, f64) {
        let ny = self.grid.ny() as i64;
        if !self.grid.has_walls() {
            // A stencil reaches beyond the box by less than one period unless the box is smaller than the kernel.
            let wrapped = if (0..ny).contains(&row) { row } else { row.rem_euclid(ny) };
            return (wrapped as usize, 1.0);
        }
        match component {
            Component::X if (0..ny).contains(&row) => (row as usize, 1.0),
            Component::Y if (0..=ny).contains(&row) => (row as usize, 1.0),
            Component::X => {
                // Odd about both walls: period 2 ny, row r and 2 ny - 1 - r opposite.
                let r = row.rem_euclid(2 * ny);
                if r < ny { (r as usize, 1.0) } else { ((2 * ny - 1 - r) as usize, -1.0) }
            }
            Component::Y => {
                let r = row.rem_euclid(2 * ny);
                (if r <= ny { r } else { 2 * ny - r } as usize, 1.0)
            }
        }
    }
}

#[derive(Debug, Clone, Copy)]
enum Component {
    X,
    Y,
}
