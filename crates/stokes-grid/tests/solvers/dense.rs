//! The whole discrete system of a channel, written out term by term and solved by LU factorisation.

use motile_base::Drive;
use nalgebra::{DMatrix, DVector};
use stokes_grid::{CentreField, Grid, StaggeredField, Wall, WallMotion};

pub(crate) struct Dense {
    pub(crate) velocity: StaggeredField,
    pub(crate) pressure: CentreField,
    /// Mean pressure gradient along x.
    pub(crate) gradient: f64,
}

/// Unknowns: u, v on the inner rows, p with mean zero, and the mean pressure gradient.
pub(crate) fn solve(grid: Grid, viscosity: f64, walls: &WallMotion, drive: Drive, force: &StaggeredField) -> Dense {
    assert!(grid.has_walls());
    let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
    let (us, vs) = (nx * ny, nx * (ny - 1));
    let u = |i: usize, j: usize| j * nx + i % nx;
    // Row 0 of v is on the wall.
    let v = |i: usize, j: usize| us + (j - 1) * nx + i % nx;
    let p = |i: usize, j: usize| us + vs + j * nx + i % nx;
    let g = us + vs + nx * ny;
    let mut matrix = DMatrix::<f64>::zeros(g + 1, g + 1);
    let mut right = DVector::<f64>::zeros(g + 1);
    let eta = viscosity / (h * h);
    for j in 0..ny {
        for i in 0..nx {
            let row = u(i, j);
            matrix[(row, row)] -= 4.0 * eta;
            matrix[(row, u(i + 1, j))] += eta;
            matrix[(row, u(i + nx - 1, j))] += eta;
            if j > 0 {
                matrix[(row, u(i, j - 1))] += eta;
            } else {
                matrix[(row, row)] -= eta;
                right[row] -= 2.0 * eta * walls.at(Wall::Bottom, i);
            }
            if j + 1 < ny {
                matrix[(row, u(i, j + 1))] += eta;
            } else {
                matrix[(row, row)] -= eta;
                right[row] -= 2.0 * eta * walls.at(Wall::Top, i);
            }
            matrix[(row, p(i, j))] -= 1.0 / h;
            matrix[(row, p(i + nx - 1, j))] += 1.0 / h;
            matrix[(row, g)] -= 1.0;
            right[row] -= force.x()[j * nx + i];
        }
    }
    for j in 1..ny {
        for i in 0..nx {
            let row = v(i, j);
            matrix[(row, row)] -= 4.0 * eta;
            matrix[(row, v(i + 1, j))] += eta;
            matrix[(row, v(i + nx - 1, j))] += eta;
            if j > 1 {
                matrix[(row, v(i, j - 1))] += eta;
            }
            if j + 1 < ny {
                matrix[(row, v(i, j + 1))] += eta;
            }
            matrix[(row, p(i, j))] -= 1.0 / h;
            matrix[(row, p(i, j - 1))] += 1.0 / h;
            right[row] -= force.y()[j * nx + i];
        }
    }
    for j in 0..ny {
        for i in 0..nx {
            let row = p(i, j);
            if i == 0 && j == 0 {
                // The divergence of this cell follows from that of the others; the mean of p takes its place.
                (0..nx * ny).for_each(|k| matrix[(row, us + vs + k)] = 1.0);
                continue;
            }
            matrix[(row, u(i + 1, j))] += 1.0 / h;
            matrix[(row, u(i, j))] -= 1.0 / h;
            if j + 1 < ny {
                matrix[(row, v(i, j + 1))] += 1.0 / h;
            }
            if j > 0 {
                matrix[(row, v(i, j))] -= 1.0 / h;
            }
        }
    }
    if let Some(flux) = drive.flux() {
        (0..us).for_each(|k| matrix[(g, k)] = h / nx as f64);
        right[g] = flux;
    } else {
        matrix[(g, g)] = 1.0;
        right[g] = drive.gradient();
    }
    let solution = matrix.lu().solve(&right).expect("the system is regular");
    let mut y = vec![0.0; nx * (ny + 1)];
    y[nx..nx * ny].copy_from_slice(&solution.as_slice()[us..us + vs]);
    Dense {
        velocity: StaggeredField::from_components(grid, solution.as_slice()[..us].to_vec(), y).unwrap(),
        pressure: CentreField::from_values(grid, solution.as_slice()[us + vs..g].to_vec()).unwrap(),
        gradient: solution[g],
    }
}
