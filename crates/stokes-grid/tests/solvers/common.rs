//! What the tests share: random fields, and the discrete Stokes equations written out term by term.

use stokes_grid::{CentreField, Grid, SolveReport, StaggeredField, Wall, WallMotion};

/// Numbers in [-1, 1) from a linear congruential generator.
pub(crate) fn random(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    (0..count)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
        .collect()
}

pub(crate) fn random_force(grid: Grid, seed: u64) -> StaggeredField {
    let (nx, ny) = (grid.nx(), grid.ny());
    StaggeredField::from_components(grid, random(nx * ny, seed), random(nx * grid.node_rows(), seed + 1)).unwrap()
}

/// The largest absolute value.
pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |a, b| a.max(b.abs()))
}

/// The largest absolute difference.
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m, (a, b)| m.max((a - b).abs()))
}

/// The largest difference of two velocities relative to the largest component of the second.
pub(crate) fn relative_distance(a: &StaggeredField, b: &StaggeredField) -> f64 {
    distance(a.x(), b.x()).max(distance(a.y(), b.y())) / largest(b.x()).max(largest(b.y()))
}

/// The largest residuals of a discrete solution: momentum (in units of force) and divergence.
pub(crate) fn residuals(
    viscosity: f64,
    walls: &WallMotion,
    force: &StaggeredField,
    velocity: &StaggeredField,
    pressure: &CentreField,
    report: &SolveReport,
) -> [f64; 2] {
    let grid = *velocity.grid();
    let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
    let (u, v, p) = (velocity.x(), velocity.y(), pressure.values());
    let right = |i: usize| (i + 1) % nx;
    let left = |i: usize| (i + nx - 1) % nx;
    // Rows beyond the ends: periodic images or ghosts behind the walls.
    let u_at = |i: usize, j: isize| match j {
        -1 if grid.has_walls() => 2.0 * walls.at(Wall::Bottom, i) - u[i],
        j if grid.has_walls() && j == ny as isize => 2.0 * walls.at(Wall::Top, i) - u[(ny - 1) * nx + i],
        j => u[j.rem_euclid(ny as isize) as usize * nx + i],
    };
    let row = |j: usize| if grid.has_walls() { j } else { j % ny };
    let [gx, gy] = report.mean_pressure_gradient;
    let (mut momentum, mut divergence) = (0.0f64, 0.0f64);
    for j in 0..ny {
        for i in 0..nx {
            let k = j as isize;
            let sum = u_at(left(i), k) + u_at(right(i), k) + u_at(i, k - 1) + u_at(i, k + 1);
            let lap = (sum - 4.0 * u_at(i, k)) / (h * h);
            let slope = (p[j * nx + i] - p[j * nx + left(i)]) / h + gx;
            momentum = momentum.max((viscosity * lap - slope + force.x()[j * nx + i]).abs());
            let div = (u[j * nx + right(i)] - u[j * nx + i] + v[row(j + 1) * nx + i] - v[j * nx + i]) / h;
            divergence = divergence.max(div.abs());
            if grid.has_walls() && j == 0 {
                continue;
            }
            let (below, above) = ((j + ny - 1) % ny, row(j + 1));
            let sum = v[j * nx + left(i)] + v[j * nx + right(i)] + v[below * nx + i] + v[above * nx + i];
            let lap = (sum - 4.0 * v[j * nx + i]) / (h * h);
            let slope = (p[j * nx + i] - p[below * nx + i]) / h + gy;
            momentum = momentum.max((viscosity * lap - slope + force.y()[j * nx + i]).abs());
        }
    }
    [momentum, divergence]
}
