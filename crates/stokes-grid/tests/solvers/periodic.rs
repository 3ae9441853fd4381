//! The solver of a box against the discrete equations and where the discrete solution is known.

use std::f64::consts::PI;

use crate::common::{DiscreteFlow, distance, largest, random_force, refused, relative_distance, residuals};
use approx::assert_abs_diff_eq;
use motile_base::InputError;
use stokes_grid::{
    CentreField, Grid, PeriodicStokes, StaggeredField, StokesError, StokesSolver, WallMotion, divergence,
};

#[test]
fn momentum_and_continuity_hold_to_round_off() {
    for (nx, ny) in [(2, 2), (3, 5), (96, 64), (120, 120), (77, 101), (101, 77), (64, 7), (7, 64)] {
        let eta = 3.0;
        let grid = Grid::periodic(nx, ny, 0.05).unwrap();
        let force = random_force(grid, 7);
        let mut solver = PeriodicStokes::new(grid, eta).unwrap();
        let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
        let report = solver.solve(&force, &mut velocity).unwrap();
        solver.pressure(&force, &velocity, &mut pressure).unwrap();
        let [momentum, divergence] = residuals(eta, solver.walls(), &force, &velocity, &pressure, &report);
        assert!(momentum < 2e-12 && divergence < 5e-14, "{nx} x {ny}: {momentum:e}, {divergence:e}");
    }
}

#[test]
fn flows_are_found_from_their_forces() {
    for (nx, ny) in [(96, 64), (120, 120), (77, 101), (101, 77)] {
        let grid = Grid::periodic(nx, ny, 0.05).unwrap();
        let exact = DiscreteFlow::random(grid, 1.0, &WallMotion::AT_REST, [300.0, -200.0], 0.0, 11);
        let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
        let mut solver = PeriodicStokes::new(grid, 1.0).unwrap();
        let report = solver.solve(&exact.force, &mut velocity).unwrap();
        solver.pressure(&exact.force, &velocity, &mut pressure).unwrap();
        let mut rate = CentreField::zeros(grid);
        divergence(&velocity, &mut rate).unwrap();
        let in_velocity = relative_distance(&velocity, &exact.velocity);
        let in_pressure = distance(pressure.values(), exact.pressure.values()) / largest(exact.pressure.values());
        let scaled = largest(rate.values()) * 0.05 / largest(velocity.x());
        println!(
            "{nx} x {ny}: velocity {in_velocity:.1e}, pressure {in_pressure:.1e}, divergence times h / |u| {scaled:.1e}"
        );
        assert!(in_velocity < 1e-12 && in_pressure < 1e-12 && scaled < 2e-15);
        for (found, expected) in report.mean_pressure_gradient.iter().zip([300.0, -200.0]) {
            assert_abs_diff_eq!(*found, expected, epsilon = 1e-12 * largest(exact.force.x()));
        }
    }
}

#[test]
fn a_shear_wave_has_the_discrete_amplitude() {
    // u = f / (eta k^2) with the discrete k for a force along x that varies along y, and no pressure.
    let (nx, ny, h, eta, mode) = (10, 24, 0.1, 2.5, 3.0);
    let grid = Grid::periodic(nx, ny, h).unwrap();
    let wave: Vec<f64> = (0..nx * ny).map(|k| (2.0 * PI * mode * ((k / nx) as f64 + 0.5) / ny as f64).sin()).collect();
    let force = StaggeredField::from_components(grid, wave.clone(), vec![0.0; nx * ny]).unwrap();
    let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
    let mut solver = PeriodicStokes::new(grid, eta).unwrap();
    solver.solve(&force, &mut velocity).unwrap();
    solver.pressure(&force, &velocity, &mut pressure).unwrap();
    let k2 = (2.0 * (PI * mode / ny as f64).sin() / h).powi(2);
    for (u, f) in velocity.x().iter().zip(&wave) {
        assert_abs_diff_eq!(*u, f / (eta * k2), epsilon = 1e-15);
    }
    assert!(largest(velocity.y()) < 1e-16 && largest(pressure.values()) < 1e-14);
}

#[test]
fn a_mean_force_becomes_pressure_and_a_mean_velocity_is_added() {
    let grid = Grid::periodic(30, 20, 0.1).unwrap();
    let mut force = StaggeredField::zeros(grid);
    let (x, y) = force.components_mut();
    x.fill(2.0);
    y.fill(-3.0);
    let mut velocity = StaggeredField::zeros(grid);
    let mut solver = PeriodicStokes::new(grid, 1.0).unwrap();
    let report = solver.solve(&force, &mut velocity).unwrap();
    assert_eq!(report.mean_pressure_gradient, [2.0, -3.0]);
    assert_eq!(velocity, StaggeredField::zeros(grid));
    solver.set_mean_velocity([0.25, -0.5]).unwrap();
    solver.solve(&force, &mut velocity).unwrap();
    assert!(velocity.x().iter().all(|&u| u == 0.25) && velocity.y().iter().all(|&v| v == -0.5));
}

#[test]
fn work_is_one_transform_each_way() {
    let grid = Grid::periodic(12, 9, 0.1).unwrap();
    let force = random_force(grid, 3);
    let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
    let mut solver = PeriodicStokes::new(grid, 1.0).unwrap();
    for _ in 0..5 {
        solver.solve(&force, &mut velocity).unwrap();
    }
    let work = solver.work();
    assert_eq!((work.solves, work.forward_transforms, work.inverse_transforms, work.iterations), (5, 5, 5, 0));
    solver.pressure(&force, &velocity, &mut pressure).unwrap();
    assert_eq!((solver.work().forward_transforms, solver.work().inverse_transforms), (6, 6));
}

#[test]
fn bad_input_ends_in_an_error_that_names_it() {
    let grid = Grid::periodic(12, 9, 0.1).unwrap();
    for eta in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            PeriodicStokes::new(grid, eta),
            Err(StokesError::Input(InputError::NotPositive { name: "viscosity", .. }))
        ));
    }
    let channel = Grid::channel(12, 9, 0.1).unwrap();
    assert!(refused(
        &PeriodicStokes::new(channel, 1.0),
        "this needs a periodic box: the grid is a channel. Build the grid with Grid::periodic"
    ));
    let mut solver = PeriodicStokes::new(grid, 1.0).unwrap();
    assert!(matches!(solver.set_mean_velocity([0.0, f64::NAN]), Err(StokesError::Input(InputError::NotFinite { .. }))));
    let mut velocity = StaggeredField::zeros(grid);
    let found = solver.solve(&StaggeredField::zeros(channel), &mut velocity);
    assert!(refused(&found, "the force belongs to another grid"));
    for bad in [f64::NAN, f64::INFINITY] {
        let mut force = random_force(grid, 1);
        force.components_mut().1[17] = bad;
        assert!(matches!(
            solver.solve(&force, &mut velocity),
            Err(StokesError::Input(InputError::NotFinite { name: "the force", .. }))
        ));
        let in_pressure = solver.pressure(&force, &velocity, &mut CentreField::zeros(grid));
        assert!(matches!(in_pressure, Err(StokesError::Input(InputError::NotFinite { name: "the force", .. }))));
        assert_eq!(velocity, StaggeredField::zeros(grid));
    }
    let mut force = random_force(grid, 1);
    force.components_mut().0.iter_mut().for_each(|f| *f *= 1e307);
    assert!(refused(&solver.solve(&force, &mut velocity), "the velocity is beyond the range of double precision"));
    assert_eq!(velocity, StaggeredField::zeros(grid));
    assert_eq!(solver.work().solves, 0);
}
