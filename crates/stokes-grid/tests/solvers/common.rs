//! Helpers of the tests: random fields, and the discrete Stokes equations written out term by term.

use std::f64::consts::{PI, TAU};

use motile_base::SolveReport;
use stokes_grid::{CentreField, Grid, StaggeredField, StokesError, Wall, WallMotion};

/// Returns true if a result is a refusal whose text contains these words.
pub(crate) fn refused<T>(result: &Result<T, StokesError>, words: &str) -> bool {
    matches!(result, Err(error @ StokesError::Refused { .. }) if error.to_string().contains(words))
}

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

/// A flow of the discrete equations.
pub(crate) struct DiscreteFlow {
    pub(crate) velocity: StaggeredField,
    /// With mean zero.
    pub(crate) pressure: CentreField,
    /// The force that it takes.
    pub(crate) force: StaggeredField,
}

impl DiscreteFlow {
    /// Noise and a wave as long as the grid, with a mean pressure gradient, in a channel with a flux through it.
    pub(crate) fn random(
        grid: Grid,
        viscosity: f64,
        walls: &WallMotion,
        gradient: [f64; 2],
        flux: f64,
        seed: u64,
    ) -> Self {
        let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
        let noise = random(nx * ny, seed);
        let psi = |i: usize, j: usize| match j {
            0 if grid.has_walls() => 0.0,
            j if grid.has_walls() && j == ny => flux,
            j => {
                let (i, j) = (i % nx, j % ny);
                let [x, y] = [i as f64 / nx as f64, j as f64 / ny as f64];
                noise[j * nx + i] + 0.2 * ny as f64 * (1.5 + (TAU * x + 1.0).sin()) * (PI * y).sin().powi(2)
            }
        };
        let u = (0..nx * ny).map(|k| (psi(k % nx, k / nx + 1) - psi(k % nx, k / nx)) / h).collect();
        let v = (0..nx * grid.node_rows()).map(|k| (psi(k % nx, k / nx) - psi(k % nx + 1, k / nx)) / h).collect();
        let velocity = StaggeredField::from_components(grid, u, v).unwrap();
        let mut pressure = random(nx * ny, seed + 1);
        let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
        pressure.iter_mut().for_each(|p| *p = viscosity / (h * h) * (*p - mean));
        let pressure = CentreField::from_values(grid, pressure).unwrap();
        let force = force_of(viscosity, walls, &velocity, &pressure, gradient);
        Self { velocity, pressure, force }
    }
}

/// The force that a velocity and a pressure need, `grad p - eta lap v`; none along y on walls.
fn force_of(
    viscosity: f64,
    walls: &WallMotion,
    velocity: &StaggeredField,
    pressure: &CentreField,
    [gx, gy]: [f64; 2],
) -> StaggeredField {
    let grid = *velocity.grid();
    let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
    let (u, v, p) = (velocity.x(), velocity.y(), pressure.values());
    let (right, left) = (|i: usize| (i + 1) % nx, |i: usize| (i + nx - 1) % nx);
    // Rows beyond the ends: periodic images or ghosts behind the walls.
    // Navier's condition between the wall's two rows: (u + ghost)/2 = U + b (u - ghost)/h.
    let ghost = |b: f64, u: f64, wall: f64| ((2.0 * b - h) * u + 2.0 * h * wall) / (2.0 * b + h);
    let u_at = |i: usize, j: isize| match j {
        -1 if grid.has_walls() => ghost(walls.slip()[0], u[i], walls.at(Wall::Bottom, i)),
        j if grid.has_walls() && j == ny as isize => {
            ghost(walls.slip()[1], u[(ny - 1) * nx + i], walls.at(Wall::Top, i))
        }
        j => u[j.rem_euclid(ny as isize) as usize * nx + i],
    };
    let mut force = StaggeredField::zeros(grid);
    let (fx, fy) = force.components_mut();
    for j in 0..ny {
        for i in 0..nx {
            let k = j as isize;
            let sum = u_at(left(i), k) + u_at(right(i), k) + u_at(i, k - 1) + u_at(i, k + 1);
            let lap = (sum - 4.0 * u_at(i, k)) / (h * h);
            fx[j * nx + i] = (p[j * nx + i] - p[j * nx + left(i)]) / h + gx - viscosity * lap;
            if grid.has_walls() && j == 0 {
                continue;
            }
            let (below, above) = ((j + ny - 1) % ny, if grid.has_walls() { j + 1 } else { (j + 1) % ny });
            let sum = v[j * nx + left(i)] + v[j * nx + right(i)] + v[below * nx + i] + v[above * nx + i];
            let lap = (sum - 4.0 * v[j * nx + i]) / (h * h);
            fy[j * nx + i] = (p[j * nx + i] - p[below * nx + i]) / h + gy - viscosity * lap;
        }
    }
    force
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
    let (u, v) = (velocity.x(), velocity.y());
    let needed = force_of(viscosity, walls, velocity, pressure, report.mean_pressure_gradient);
    // Forces along y on walls count for nothing.
    let inner = if grid.has_walls() { nx..nx * ny } else { 0..nx * ny };
    let momentum = distance(needed.x(), force.x()).max(distance(&needed.y()[inner.clone()], &force.y()[inner]));
    let row = |j: usize| if grid.has_walls() { j } else { j % ny };
    let mut divergence = 0.0f64;
    for j in 0..ny {
        for i in 0..nx {
            let along = u[j * nx + (i + 1) % nx] - u[j * nx + i];
            divergence = divergence.max(((along + v[row(j + 1) * nx + i] - v[j * nx + i]) / h).abs());
        }
    }
    [momentum, divergence]
}
