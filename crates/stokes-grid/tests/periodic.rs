//! The periodic solver satisfies the discrete Stokes equations.

use stokes_grid::{CentreField, Grid, PeriodicStokes, StaggeredField, StokesSolver};

/// Numbers in [-1, 1) from a linear congruential generator.
fn random(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    (0..count)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
        .collect()
}

fn random_force(grid: Grid, seed: u64) -> StaggeredField {
    let (nx, ny) = (grid.nx(), grid.ny());
    StaggeredField::from_components(grid, random(nx * ny, seed), random(nx * grid.node_rows(), seed + 1)).unwrap()
}

#[test]
fn momentum_and_continuity_hold_to_round_off() {
    for (nx, ny) in [(2, 2), (3, 5), (96, 64), (120, 120), (77, 101), (101, 77), (64, 7), (7, 64)] {
        let (h, eta) = (0.05, 3.0);
        let grid = Grid::periodic(nx, ny, h).unwrap();
        let mut solver = PeriodicStokes::new(grid, eta).unwrap();
        let force = random_force(grid, 7);
        let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
        let report = solver.solve(&force, &mut velocity).unwrap();
        solver.pressure(&force, &velocity, &mut pressure).unwrap();
        let (u, v, p) = (velocity.x(), velocity.y(), pressure.values());
        let at = |f: &[f64], i: usize, j: usize| f[j % ny * nx + i % nx];
        let laplacian = |f: &[f64], i: usize, j: usize| {
            (at(f, i + 1, j) + at(f, i + nx - 1, j) + at(f, i, j + 1) + at(f, i, j + ny - 1) - 4.0 * at(f, i, j))
                / (h * h)
        };
        for j in 0..ny {
            for i in 0..nx {
                let [gx, gy] = report.mean_pressure_gradient;
                let rx = eta * laplacian(u, i, j) - (at(p, i, j) - at(p, i + nx - 1, j)) / h - gx + at(force.x(), i, j);
                let ry = eta * laplacian(v, i, j) - (at(p, i, j) - at(p, i, j + ny - 1)) / h - gy + at(force.y(), i, j);
                let div = (at(u, i + 1, j) - at(u, i, j) + at(v, i, j + 1) - at(v, i, j)) / h;
                assert!(rx.abs() < 2e-12 && ry.abs() < 2e-12, "{nx} x {ny}: {rx:e} {ry:e}");
                assert!(div.abs() < 1e-13, "{nx} x {ny}: {div:e}");
            }
        }
    }
}
