//! The solver of a channel against a direct solution of the whole discrete system and where its solution is known.

use crate::common::{DiscreteFlow, distance, largest, random_force, refused, relative_distance, residuals};
use crate::dense;
use approx::assert_abs_diff_eq;
use motile_base::{Drive, InputError, SolveReport};
use stokes_grid::{
    CentreField, ChannelStokes, Grid, StaggeredField, StokesError, StokesSolver, Wall, WallMotion, flux,
    wall_shear_stress,
};

const DRIVES: [Drive; 4] = [Drive::ZeroGradient, Drive::Gradient(0.7), Drive::ZeroFlux, Drive::Flux(-0.4)];

fn driven(grid: Grid, eta: f64, walls: &WallMotion, drive: Drive) -> ChannelStokes {
    let mut solver = ChannelStokes::new(grid, eta).unwrap();
    solver.set_walls(walls.clone()).unwrap();
    solver.set_drive(drive).unwrap();
    solver
}

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
    WallMotion::from_fn(grid, |x| 0.3 + (2.0 * x).sin(), |x| (3.0 * x).cos() - 0.1).unwrap()
}

#[test]
fn the_solution_is_that_of_the_whole_discrete_system() {
    let eta = 1.7;
    let mut worst = [0.0f64; 3];
    for (nx, ny) in [(2, 2), (2, 3), (3, 2), (4, 4), (5, 7), (12, 6), (9, 11), (16, 8)] {
        let grid = Grid::channel(nx, ny, 0.11).unwrap();
        for (k, drive) in DRIVES.into_iter().enumerate() {
            for walls in [WallMotion::AT_REST, sliding(&grid)] {
                let force = random_force(grid, 100 + k as u64);
                let exact = dense::solve(grid, eta, &walls, drive, &force);
                let (velocity, pressure, report) = run(&mut driven(grid, eta, &walls, drive), &force);
                let errors = [
                    relative_distance(&velocity, &exact.velocity),
                    distance(pressure.values(), exact.pressure.values()) / largest(exact.pressure.values()),
                    (report.mean_pressure_gradient[0] - exact.gradient).abs() / exact.gradient.abs().max(1.0),
                ];
                assert!(errors.iter().all(|&e| e < 1e-12), "{nx} x {ny}, {drive:?}: {errors:?}");
                assert_eq!(report.mean_pressure_gradient[1], 0.0);
                worst = std::array::from_fn(|i| worst[i].max(errors[i]));
            }
        }
    }
    println!("largest relative errors of velocity, pressure, gradient: {worst:?}");
}

#[test]
fn flows_on_large_grids_are_found_from_their_forces_and_satisfy_the_equations() {
    let (eta, h) = (100.0, 0.05);
    for (nx, ny) in [(240, 40), (240, 100), (960, 400), (101, 53)] {
        let grid = Grid::channel(nx, ny, h).unwrap();
        let walls = sliding(&grid);
        for drive in DRIVES {
            let solver = &mut driven(grid, eta, &walls, drive);
            // What the drive leaves free is to be found.
            let (gradient, through) = drive.flux().map_or((drive.gradient(), 0.9), |flux| (0.3 * eta / (h * h), flux));
            let exact = DiscreteFlow::random(grid, eta, &walls, [gradient, 0.0], through, 9);
            assert_abs_diff_eq!(flux(&exact.velocity), through, epsilon = 1e-11);
            let (velocity, pressure, report) = run(solver, &exact.force);
            let difference = relative_distance(&velocity, &exact.velocity);
            let in_pressure = distance(pressure.values(), exact.pressure.values()) / largest(exact.pressure.values());
            let in_gradient = (report.mean_pressure_gradient[0] - gradient).abs() / largest(exact.force.x());
            println!("{nx} x {ny} {drive:?}: {difference:.1e}, pressure {in_pressure:.1e}, gradient {in_gradient:.1e}");
            assert!(difference < 1e-10 && in_pressure < 1e-10 && in_gradient < 1e-12);
            // The same for any force: the equations hold, to the round-off of their terms.
            let force = random_force(grid, 9);
            let (velocity, pressure, report) = run(solver, &force);
            let [momentum, divergence] = residuals(eta, &walls, &force, &velocity, &pressure, &report);
            let speed = largest(velocity.x()).max(largest(velocity.y()));
            let (momentum, divergence) = (momentum / (eta * speed / (h * h)), divergence / (speed / h));
            assert!(momentum < 2e-12 && divergence < 2e-15, "{momentum:e} {divergence:e}");
            for walls_of_v in [&velocity.y()[..nx], &velocity.y()[ny * nx..]] {
                assert!(walls_of_v.iter().all(|&v| v == 0.0));
            }
        }
    }
}

#[test]
fn poiseuille_flow_is_the_parabola_and_a_constant() {
    let (ny, h, eta, gradient) = (40, 0.05, 3.0, -2.0);
    let grid = Grid::channel(16, ny, h).unwrap();
    let width = ny as f64 * h;
    let solver = &mut driven(grid, eta, &WallMotion::AT_REST, Drive::Gradient(gradient));
    let (velocity, pressure, report) = run(solver, &StaggeredField::zeros(grid));
    for (k, u) in velocity.x().iter().enumerate() {
        let y = ((k / 16) as f64 + 0.5) * h;
        let expected = -gradient / (2.0 * eta) * (y * (width - y) + h * h / 4.0);
        assert_abs_diff_eq!(*u, expected, epsilon = 1e-14);
    }
    assert!(largest(velocity.y()) < 1e-15 && largest(pressure.values()) < 1e-12);
    assert_eq!(report.mean_pressure_gradient, [gradient, 0.0]);
    // Half of the pressure's push is held by each wall, in the discrete flow exactly.
    let mut stress = vec![0.0; 16];
    for (wall, sign) in [(Wall::Bottom, 1.0), (Wall::Top, -1.0)] {
        wall_shear_stress(&velocity, eta, &WallMotion::AT_REST, wall, &mut stress).unwrap();
        stress.iter().for_each(|s| assert_abs_diff_eq!(*s, -sign * gradient * width / 2.0, epsilon = 1e-12));
    }
    let parabola = -gradient * width.powi(3) / (12.0 * eta);
    assert_abs_diff_eq!(flux(&velocity) / parabola, 1.0 + 2.0 * (h / width).powi(2), epsilon = 1e-13);
}

#[test]
fn couette_flow_is_exact() {
    let grid = Grid::channel(12, 20, 0.1).unwrap();
    let walls = WallMotion::uniform(&grid, -0.5, 1.5).unwrap();
    let solver = &mut driven(grid, 3.0, &walls, Drive::ZeroGradient);
    let (velocity, _, _) = run(solver, &StaggeredField::zeros(grid));
    for (k, u) in velocity.x().iter().enumerate() {
        assert_abs_diff_eq!(*u, -0.5 + 2.0 * ((k / 12) as f64 + 0.5) / 20.0, epsilon = 2e-14);
    }
    assert_eq!(solver.walls(), &walls);
}

#[test]
fn a_closed_channel_balances_a_uniform_force_by_pressure() {
    let grid = Grid::channel(12, 9, 0.1).unwrap();
    let mut force = StaggeredField::zeros(grid);
    force.components_mut().0.fill(0.8);
    let solver = &mut driven(grid, 3.0, &WallMotion::AT_REST, Drive::ZeroFlux);
    let (velocity, _, report) = run(solver, &force);
    assert!(largest(velocity.x()) < 1e-15 && largest(velocity.y()) < 1e-15);
    assert_abs_diff_eq!(report.mean_pressure_gradient[0], 0.8, epsilon = 1e-14);
}

#[test]
fn an_imposed_flux_is_met_and_forces_on_the_walls_do_nothing() {
    let grid = Grid::channel(20, 12, 0.1).unwrap();
    let force = random_force(grid, 3);
    let mut inner = force.clone();
    let (_, y) = inner.components_mut();
    y[..20].fill(f64::NAN);
    y[240..].fill(f64::NAN);
    let solver = &mut driven(grid, 3.0, &sliding(&grid), Drive::Flux(0.37));
    let (velocity, pressure, _) = run(solver, &force);
    assert_abs_diff_eq!(flux(&velocity), 0.37, epsilon = 1e-14);
    let (again, pressure_again, _) = run(solver, &inner);
    assert_eq!(velocity, again);
    assert_eq!(pressure, pressure_again);
}

#[test]
fn work_is_one_transform_each_way() {
    let grid = Grid::channel(12, 9, 0.1).unwrap();
    let force = random_force(grid, 3);
    let mut velocity = StaggeredField::zeros(grid);
    let mut solver = ChannelStokes::new(grid, 1.0).unwrap();
    for _ in 0..3 {
        solver.solve(&force, &mut velocity).unwrap();
    }
    let work = solver.work();
    assert_eq!((work.solves, work.forward_transforms, work.inverse_transforms, work.iterations), (3, 3, 3, 0));
    let mut pressure = CentreField::zeros(grid);
    solver.pressure(&force, &velocity, &mut pressure).unwrap();
    assert_eq!((solver.work().forward_transforms, solver.work().inverse_transforms), (4, 4));
}

#[test]
fn bad_input_ends_in_an_error_that_names_it() {
    let grid = Grid::channel(12, 9, 0.1).unwrap();
    let other = Grid::channel(12, 8, 0.1).unwrap();
    let periodic = Grid::periodic(12, 9, 0.1).unwrap();
    let needed = "this needs a channel: the grid is a periodic box. Build the grid with Grid::channel";
    assert!(refused(&ChannelStokes::new(periodic, 1.0), needed));
    assert!(matches!(
        ChannelStokes::new(grid, f64::NAN),
        Err(StokesError::Input(InputError::NotPositive { name: "viscosity", .. }))
    ));
    assert!(refused(&WallMotion::uniform(&periodic, 0.0, 1.0), needed));
    assert!(matches!(
        WallMotion::uniform(&grid, 0.0, f64::INFINITY),
        Err(StokesError::Input(InputError::EntryNotFinite { .. }))
    ));
    let mut solver = ChannelStokes::new(grid, 1.0).unwrap();
    assert!(matches!(solver.set_drive(Drive::Flux(f64::NAN)), Err(StokesError::Input(InputError::NotFinite { .. }))));
    let walls = WallMotion::uniform(&Grid::channel(13, 9, 0.1).unwrap(), 0.0, 1.0).unwrap();
    let expected = StokesError::Input(InputError::WrongLength { name: "the wall motion", expected: 12, found: 13 });
    assert_eq!(solver.set_walls(walls), Err(expected));
    let mut velocity = StaggeredField::zeros(grid);
    let wrong = solver.solve(&StaggeredField::zeros(other), &mut velocity);
    assert!(refused(&wrong, "the force belongs to another grid"));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut force = random_force(grid, 1);
        force.components_mut().0[17] = bad;
        assert!(matches!(
            solver.solve(&force, &mut velocity),
            Err(StokesError::Input(InputError::NotFinite { name: "the force", .. }))
        ));
        let in_pressure = solver.pressure(&force, &velocity, &mut CentreField::zeros(grid));
        assert!(matches!(in_pressure, Err(StokesError::Input(InputError::NotFinite { name: "the force", .. }))));
        assert_eq!(velocity, StaggeredField::zeros(grid));
    }
}
