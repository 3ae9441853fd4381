//! The projection method against the streamfunction solvers, the discrete equations, and its own order in time.

use motile_base::{Drive, SolveReport};
use stokes_grid::{
    CentreField, ChannelStokes, Grid, PeriodicStokes, ProjectionStokes, StaggeredField, StokesSolver, WallMotion,
};

use crate::common::{distance, largest, random_force, relative_distance, residuals};

const DRIVES: [Drive; 4] = [Drive::ZeroGradient, Drive::Gradient(0.7), Drive::ZeroFlux, Drive::Flux(-0.4)];

/// Velocity, pressure and report for a force.
fn run(solver: &mut dyn StokesSolver, force: &StaggeredField) -> (StaggeredField, CentreField, SolveReport) {
    let grid = *solver.grid();
    let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
    // Whatever was there before.
    velocity.fill(0.5);
    let report = solver.solve(force, &mut velocity).unwrap();
    solver.pressure(force, &velocity, &mut pressure).unwrap();
    (velocity, pressure, report)
}

fn sliding(grid: &Grid) -> WallMotion {
    let [length, _] = grid.lengths();
    let k = std::f64::consts::TAU / length;
    WallMotion::from_fn(grid, |x| 0.3 + (k * x).sin(), |x| (2.0 * k * x).cos() - 0.1).unwrap()
}

fn channel_solver(grid: Grid, eta: f64, walls: &WallMotion, drive: Drive) -> ProjectionStokes {
    let mut solver = ProjectionStokes::new(grid, eta).unwrap();
    solver.set_walls(walls.clone()).unwrap();
    solver.set_drive(drive).unwrap();
    solver
}

/// Random forces whose velocities are of order one, whatever the units of length and viscosity.
fn scaled_force(grid: Grid, eta: f64, seed: u64) -> StaggeredField {
    let mut force = random_force(grid, seed);
    let unit = eta / grid.spacing().powi(2);
    let (x, y) = force.components_mut();
    x.iter_mut().chain(y).for_each(|f| *f *= unit);
    force
}

/// A drive in units of the cell and the viscosity.
fn scaled_drive(drive: Drive, h: f64, eta: f64) -> Drive {
    match drive {
        Drive::Gradient(gradient) => Drive::Gradient(gradient * eta / (h * h)),
        Drive::Flux(flux) => Drive::Flux(flux * h),
        drive => drive,
    }
}

/// Relative differences of velocity, pressure and mean pressure gradient of two solvers.
fn differences(one: &mut dyn StokesSolver, other: &mut dyn StokesSolver, force: &StaggeredField) -> [f64; 3] {
    let (velocity, pressure, report) = run(one, force);
    let (expected, expected_pressure, expected_report) = run(other, force);
    let (g, expected_g) = (report.mean_pressure_gradient, expected_report.mean_pressure_gradient);
    [
        relative_distance(&velocity, &expected),
        distance(pressure.values(), expected_pressure.values()) / largest(expected_pressure.values()),
        distance(&g, &expected_g) / largest(&expected_g).max(f64::MIN_POSITIVE),
    ]
}

#[test]
fn a_box_is_solved_as_by_the_streamfunction() {
    let mut worst = [0.0f64; 3];
    for (nx, ny) in [(2, 2), (2, 3), (3, 2), (5, 7), (96, 64), (77, 101), (64, 7), (7, 64), (400, 3), (3, 400)] {
        for (h, eta) in [(0.05, 3.0), (1e-6, 1e6), (1e5, 1e-4)] {
            let grid = Grid::periodic(nx, ny, h).unwrap();
            let (mut projection, mut streamfunction) =
                (ProjectionStokes::new(grid, eta).unwrap(), PeriodicStokes::new(grid, eta).unwrap());
            for mean in [[0.0; 2], [0.25, -0.5]] {
                projection.set_mean_velocity(mean).unwrap();
                streamfunction.set_mean_velocity(mean).unwrap();
                let errors = differences(&mut projection, &mut streamfunction, &scaled_force(grid, eta, 7));
                assert!(errors.iter().all(|&e| e < 5e-13), "{nx} x {ny}, h = {h}: {errors:?}");
                worst = std::array::from_fn(|i| worst[i].max(errors[i]));
            }
            assert_eq!(projection.mean_velocity(), [0.25, -0.5]);
        }
    }
    println!("largest relative differences of velocity, pressure, gradient: {worst:?}");
}

#[test]
fn a_channel_is_solved_as_by_the_streamfunction() {
    let mut worst = [0.0f64; 3];
    let sizes = [(2, 2), (2, 3), (3, 2), (4, 4), (5, 7), (12, 6), (9, 11), (101, 53), (240, 40), (400, 3), (3, 400)];
    for (nx, ny) in sizes {
        for (h, eta) in [(0.05, 3.0), (1e-6, 1e6), (1e5, 1e-4)] {
            let grid = Grid::channel(nx, ny, h).unwrap();
            for (walls, drive) in [WallMotion::AT_REST, sliding(&grid)].iter().flat_map(|w| DRIVES.map(|d| (w, d))) {
                let drive = scaled_drive(drive, h, eta);
                let mut projection = channel_solver(grid, eta, walls, drive);
                let mut streamfunction = ChannelStokes::new(grid, eta).unwrap();
                streamfunction.set_walls(walls.clone()).unwrap();
                streamfunction.set_drive(drive).unwrap();
                let errors = differences(&mut projection, &mut streamfunction, &scaled_force(grid, eta, 9));
                let small = errors[0] < 2e-12 && errors[1] < 5e-12 && errors[2] < 2e-11;
                assert!(small, "{nx} x {ny}, h = {h}, {drive:?}: {errors:?}");
                assert_eq!((projection.walls(), projection.drive()), (walls, drive));
                worst = std::array::from_fn(|i| worst[i].max(errors[i]));
            }
        }
    }
    println!("largest relative differences of velocity, pressure, gradient: {worst:?}");
}

#[test]
fn the_discrete_equations_hold_with_exact_walls() {
    let eta = 1.7;
    for (nx, ny) in [(2, 2), (3, 5), (240, 40), (101, 53), (960, 100)] {
        let grid = Grid::channel(nx, ny, 0.05).unwrap();
        let walls = sliding(&grid);
        for drive in DRIVES {
            let force = random_force(grid, 11);
            let (velocity, pressure, report) = run(&mut channel_solver(grid, eta, &walls, drive), &force);
            let [momentum, divergence] = residuals(eta, &walls, &force, &velocity, &pressure, &report);
            let speed = largest(velocity.x()).max(largest(velocity.y()));
            let (momentum, divergence) = (momentum / (eta * speed / 0.0025), divergence / (speed / 0.05));
            println!("{nx} x {ny} {drive:?}: momentum {momentum:.1e}, divergence {divergence:.1e}");
            assert!(momentum < 2e-12 && divergence < 2e-14, "{nx} x {ny} {drive:?}: {momentum:e} {divergence:e}");
        }
    }
}
