//! Derived fields of discrete velocities, where they are known exactly.

use approx::assert_abs_diff_eq;
use motile_base::{Drive, InputError};
use stokes_grid::{
    CentreField, ChannelStokes, Grid, NodeField, PeriodicStokes, StaggeredField, StokesError, StokesSolver, Wall,
    WallMotion, divergence, flux, shear_strain_rate, streamfunction, vorticity, wall_shear_stress,
};

use crate::common::{largest, random, random_force, refused};

/// The velocity of a streamfunction given at the nodes.
fn velocity_of(psi: &NodeField) -> StaggeredField {
    let grid = *psi.grid();
    let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
    let at = |i: usize, j: usize| psi.values()[j % grid.node_rows() * nx + i % nx];
    let mut velocity = StaggeredField::zeros(grid);
    let (u, v) = velocity.components_mut();
    (0..nx * ny).for_each(|k| u[k] = (at(k % nx, k / nx + 1) - at(k % nx, k / nx)) / h);
    (0..nx * grid.node_rows()).for_each(|k| v[k] = -(at(k % nx + 1, k / nx) - at(k % nx, k / nx)) / h);
    velocity
}

#[test]
fn the_streamfunction_comes_back_from_its_velocity() {
    for grid in [Grid::periodic(40, 25, 0.1).unwrap(), Grid::channel(40, 25, 0.1).unwrap()] {
        let mut values = random(40 * grid.node_rows(), 4);
        if grid.has_walls() {
            values[..40].fill(0.0);
            values[40 * 25..].fill(0.7);
        } else {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            values.iter_mut().for_each(|v| *v -= mean);
        }
        let psi = NodeField::from_values(grid, values).unwrap();
        let mut velocity = velocity_of(&psi);
        if grid.has_walls() {
            assert_abs_diff_eq!(flux(&velocity), 0.7, epsilon = 1e-14);
        } else {
            velocity.components_mut().0.iter_mut().for_each(|u| *u += 3.0);
            velocity.components_mut().1.iter_mut().for_each(|v| *v -= 2.0);
        }
        let mut found = NodeField::zeros(grid);
        streamfunction(&velocity, &mut found).unwrap();
        for (a, b) in found.values().iter().zip(psi.values()) {
            assert_abs_diff_eq!(a, b, epsilon = 1e-13);
        }
        let mut div = CentreField::zeros(grid);
        divergence(&velocity, &mut div).unwrap();
        assert!(largest(div.values()) < 1e-12);
    }
}

/// sin(k x) along x has the divergence k cos(k x), of differences `sin(k h/2)/(h/2)` of that.
#[test]
fn divergence_of_a_wave() {
    let grid = Grid::periodic(20, 15, 0.1).unwrap();
    let mut velocity = StaggeredField::zeros(grid);
    let k = std::f64::consts::TAU / 2.0;
    velocity.components_mut().0.iter_mut().enumerate().for_each(|(n, u)| *u = (k * 0.1 * (n % 20) as f64).sin());
    let mut div = CentreField::zeros(grid);
    divergence(&velocity, &mut div).unwrap();
    for (n, found) in div.values().iter().enumerate() {
        let exact = (0.05 * k).sin() / 0.05 * (k * 0.1 * ((n % 20) as f64 + 0.5)).cos();
        assert_abs_diff_eq!(*found, exact, epsilon = 1e-12);
    }
}

#[test]
fn vorticity_is_minus_the_laplacian_of_the_streamfunction() {
    let grid = Grid::periodic(20, 15, 0.1).unwrap();
    let mut solver = PeriodicStokes::new(grid, 2.0).unwrap();
    let (mut velocity, mut psi, mut omega) =
        (StaggeredField::zeros(grid), NodeField::zeros(grid), NodeField::zeros(grid));
    solver.solve(&random_force(grid, 8), &mut velocity).unwrap();
    streamfunction(&velocity, &mut psi).unwrap();
    vorticity(&velocity, solver.walls(), &mut omega).unwrap();
    let at = |i: usize, j: usize| psi.values()[j % 15 * 20 + i % 20];
    for k in 0..300 {
        let (i, j) = (k % 20, k / 20);
        let sum = at(i + 1, j) + at(i + 19, j) + at(i, j + 1) + at(i, j + 14);
        assert_abs_diff_eq!(omega.values()[k], -(sum - 4.0 * at(i, j)) / 0.01, epsilon = 1e-12);
    }
}

#[test]
fn the_walls_hold_what_pushes_the_fluid() {
    let grid = Grid::channel(24, 15, 0.1).unwrap();
    let walls = WallMotion::from_fn(&grid, f64::sin, |x| 0.3 * x.cos()).unwrap();
    let force = random_force(grid, 5);
    let eta = 2.0;
    let mut solver = ChannelStokes::new(grid, eta).unwrap();
    solver.set_walls(walls.clone()).unwrap();
    solver.set_drive(Drive::Gradient(0.6)).unwrap();
    let mut velocity = StaggeredField::zeros(grid);
    let report = solver.solve(&force, &mut velocity).unwrap();
    let [mut bottom, mut top] = [vec![0.0; 24], vec![0.0; 24]];
    wall_shear_stress(&velocity, eta, &walls, Wall::Bottom, &mut bottom).unwrap();
    wall_shear_stress(&velocity, eta, &walls, Wall::Top, &mut top).unwrap();
    let held = 0.1 * (top.iter().sum::<f64>() - bottom.iter().sum::<f64>());
    let [length, width] = grid.lengths();
    let pushed = 0.01 * force.x().iter().sum::<f64>() - report.mean_pressure_gradient[0] * length * width;
    assert_abs_diff_eq!(held, -pushed, epsilon = 1e-12);
    let mut shear = NodeField::zeros(grid);
    shear_strain_rate(&velocity, &walls, &mut shear).unwrap();
    for i in 0..24 {
        assert_abs_diff_eq!(2.0 * eta * shear.values()[i], bottom[i], epsilon = 1e-12);
        assert_abs_diff_eq!(2.0 * eta * shear.values()[24 * 15 + i], top[i], epsilon = 1e-12);
    }
}

#[test]
fn fields_that_do_not_belong_together_are_errors() {
    let grid = Grid::periodic(8, 8, 0.1).unwrap();
    let channel = Grid::channel(8, 8, 0.1).unwrap();
    let velocity = StaggeredField::zeros(grid);
    let mismatch = |result| refused(&result, "belongs to another grid. Make both from the same grid");
    assert!(mismatch(divergence(&velocity, &mut CentreField::zeros(channel))));
    assert!(mismatch(streamfunction(&velocity, &mut NodeField::zeros(channel))));
    assert!(mismatch(vorticity(&velocity, &WallMotion::AT_REST, &mut NodeField::zeros(channel))));
    let sliding = WallMotion::uniform(&channel, 1.0, 1.0).unwrap();
    assert!(vorticity(&velocity, &sliding, &mut NodeField::zeros(grid)).is_err());
    let stress = wall_shear_stress(&velocity, 1.0, &WallMotion::AT_REST, Wall::Top, &mut [0.0; 8]);
    assert!(refused(&stress, "this needs a channel: the grid is a periodic box. Build the grid with Grid::channel"));
    let velocity = StaggeredField::zeros(channel);
    let stress = wall_shear_stress(&velocity, 1.0, &WallMotion::AT_REST, Wall::Top, &mut [0.0; 7]);
    assert!(matches!(stress, Err(StokesError::Input(InputError::WrongLength { expected: 8, found: 7, .. }))));
}
