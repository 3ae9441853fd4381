//! The projection method against the streamfunction solvers, the discrete equations, and its own order in time.

use motile_base::{Drive, InputError, SolveReport};
use stokes_grid::{
    CentreField, ChannelStokes, Grid, PeriodicStokes, ProjectionStokes, StaggeredField, StokesError, StokesSolver,
    TwoPhaseStokes, Wall, WallMotion, WallTreatment, divergence,
};

use crate::common::{distance, largest, random_force, refused, relative_distance, residuals};

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

/// A channel with sliding walls and lagged wall values.
fn lagged(grid: Grid, eta: f64, drive: Drive) -> ProjectionStokes {
    let mut solver = channel_solver(grid, eta, &sliding(&grid), drive);
    solver.set_wall_treatment(WallTreatment::Lagged).unwrap();
    solver
}

/// The force at a time: two random ones that come and go.
fn force_at(grid: Grid, time: f64) -> StaggeredField {
    let mut force = random_force(grid, 21);
    force.combine(time.cos(), (1.3 * time).sin(), &random_force(grid, 22));
    force
}

/// The solution at time 1 after steps of length `step` from time 0.
fn at_time_one(solver: &mut ProjectionStokes, steps: usize) -> StaggeredField {
    let grid = *solver.grid();
    let mut velocity = StaggeredField::zeros(grid);
    for step in 0..=steps {
        solver.solve(&force_at(grid, step as f64 / steps as f64), &mut velocity).unwrap();
    }
    velocity
}

#[test]
fn lagged_walls_are_of_first_order_in_the_time_step() {
    for (nx, ny, drive) in [(24, 8, Drive::ZeroGradient), (15, 11, Drive::Flux(0.3)), (12, 2, Drive::ZeroFlux)] {
        let grid = Grid::channel(nx, ny, 0.1).unwrap();
        let exact = at_time_one(&mut channel_solver(grid, 2.0, &sliding(&grid), drive), 1);
        let errors = [100, 200, 400, 800].map(|steps| {
            let solver = &mut lagged(grid, 2.0, drive);
            let error = relative_distance(&at_time_one(solver, steps), &exact);
            // The slip on the walls is of the same order, and tells of the error.
            let mut slip = vec![0.0; nx];
            solver.wall_slip(Wall::Top, &mut slip).unwrap();
            assert!(largest(&slip) > 0.0 && largest(&slip) < 0.5 / steps as f64, "{steps}: {:e}", largest(&slip));
            error
        });
        let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
        println!("{nx} x {ny}: first error {:.1e}, orders {orders:.3?}", errors[0]);
        assert!(orders.iter().all(|order| (0.9..1.1).contains(order)), "{nx} x {ny}: {orders:?}");
    }
}

#[test]
fn the_first_solution_with_lagged_walls_is_exact_and_a_constant_force_leads_back_to_it() {
    let grid = Grid::channel(18, 9, 0.1).unwrap();
    let exact = run(&mut channel_solver(grid, 2.0, &sliding(&grid), Drive::ZeroFlux), &random_force(grid, 5));
    let mut solver = lagged(grid, 2.0, Drive::ZeroFlux);
    assert!(solver.has_memory() && solver.memory().is_empty());
    assert!(relative_distance(&run(&mut solver, &random_force(grid, 5)).0, &exact.0) < 1e-13);
    // Another force disturbs the walls; each solution for the first one then halves the slip, or nearly so.
    run(&mut solver, &random_force(grid, 6));
    let disturbed = relative_distance(&run(&mut solver, &random_force(grid, 5)).0, &exact.0);
    assert!(disturbed > 1e-3, "{disturbed:e}");
    let mut velocity = exact.0.clone();
    for _ in 0..400 {
        solver.solve(&random_force(grid, 5), &mut velocity).unwrap();
    }
    assert!(relative_distance(&velocity, &exact.0) < 1e-12);
    // And without memory the solution is exact again.
    solver.set_memory(&[]).unwrap();
    assert!(relative_distance(&run(&mut solver, &random_force(grid, 5)).0, &exact.0) < 1e-13);
}

#[test]
fn with_lagged_walls_the_equations_hold_for_walls_that_move_by_the_slip() {
    let (eta, grid) = (1.7, Grid::channel(31, 12, 0.05).unwrap());
    let walls = sliding(&grid);
    let mut solver = lagged(grid, eta, Drive::Flux(0.2));
    run(&mut solver, &scaled_force(grid, eta, 1));
    let force = scaled_force(grid, eta, 2);
    let (velocity, pressure, report) = run(&mut solver, &force);
    let moved = [Wall::Bottom, Wall::Top].map(|wall| {
        let mut slip = vec![0.0; 31];
        solver.wall_slip(wall, &mut slip).unwrap();
        assert!(largest(&slip) > 0.01 * largest(velocity.x()));
        slip.iter_mut().zip(walls.velocities(wall)).for_each(|(slip, wall)| *slip += wall);
        slip
    });
    let column = |x: f64| ((x - grid.origin()[0]) / 0.05).round() as usize;
    let effective = WallMotion::from_fn(&grid, |x| moved[0][column(x)], |x| moved[1][column(x)]).unwrap();
    let [momentum, divergence] = residuals(eta, &effective, &force, &velocity, &pressure, &report);
    let speed = largest(velocity.x());
    assert!(
        momentum < 2e-13 * eta * speed / 0.0025 && divergence < 2e-14 * speed / 0.05,
        "{momentum:e} {divergence:e}"
    );
}

#[test]
fn the_velocity_is_the_intermediate_one_minus_the_slope_of_the_potential() {
    let (nx, ny, h, eta) = (14, 9, 0.2, 3.0);
    for walled in [false, true] {
        let grid = if walled { Grid::channel(nx, ny, h) } else { Grid::periodic(nx, ny, h) }.unwrap();
        let treatments = if walled { vec![WallTreatment::Exact, WallTreatment::Lagged] } else { vec![] };
        for treatment in treatments.into_iter().map(Some).chain([None]) {
            let mut solver = ProjectionStokes::new(grid, eta).unwrap();
            if walled {
                solver.set_drive(Drive::Gradient(-0.3)).unwrap();
                solver.set_walls(sliding(&grid)).unwrap();
            } else {
                solver.set_mean_velocity([0.1, -0.2]).unwrap();
            }
            if let Some(treatment) = treatment {
                solver.set_wall_treatment(treatment).unwrap();
                solver.solve(&random_force(grid, 3), &mut StaggeredField::zeros(grid)).unwrap();
            }
            let force = random_force(grid, 4);
            let (velocity, pressure, _) = run(&mut solver, &force);
            let (mut starred, mut phi) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
            solver.intermediate_velocity(&force, &mut starred).unwrap();
            solver.potential(&force, &mut phi).unwrap();
            let p = phi.values();
            let left = |k: usize| if k.is_multiple_of(nx) { k + nx - 1 } else { k - 1 };
            let along: Vec<f64> = (0..nx * ny).map(|k| starred.x()[k] - (p[k] - p[left(k)]) / h).collect();
            assert!(distance(&along, velocity.x()) < 1e-13);
            let inner = if walled { nx..nx * ny } else { 0..nx * ny };
            let below = |k: usize| if k < nx { k + nx * (ny - 1) } else { k - nx };
            let across: Vec<f64> = inner.clone().map(|k| starred.y()[k] - (p[k] - p[below(k)]) / h).collect();
            assert!(distance(&across, &velocity.y()[inner]) < 1e-13);
            assert!((p.iter().sum::<f64>()).abs() < 1e-12);
            // (2.30) with its sign, and (2.23): the pressure is minus the viscosity times the divergence of v*.
            let mut rate = CentreField::zeros(grid);
            divergence(&starred, &mut rate).unwrap();
            rate.values_mut().iter_mut().for_each(|rate| *rate *= -eta);
            assert!(distance(rate.values(), pressure.values()) < 1e-11 * largest(pressure.values()));
        }
    }
}

#[test]
fn work_is_counted_in_transforms_along_and_across() {
    let counts = |solver: &ProjectionStokes| {
        let work = solver.work();
        assert_eq!(work.iterations, 0);
        [work.solves, work.forward_transforms, work.inverse_transforms, work.sine_cosine_transforms]
    };
    let grid = Grid::periodic(12, 9, 0.1).unwrap();
    let mut solver = ProjectionStokes::new(grid, 1.0).unwrap();
    let mut velocity = StaggeredField::zeros(grid);
    solver.solve(&random_force(grid, 3), &mut velocity).unwrap();
    assert_eq!(counts(&solver), [1, 3, 3, 0]);
    solver.pressure(&random_force(grid, 3), &velocity, &mut CentreField::zeros(grid)).unwrap();
    assert_eq!(counts(&solver), [1, 5, 5, 0]);
    let grid = Grid::channel(12, 9, 0.1).unwrap();
    let mut velocity = StaggeredField::zeros(grid);
    for treatment in [WallTreatment::Exact, WallTreatment::Lagged] {
        let mut solver = ProjectionStokes::new(grid, 1.0).unwrap();
        solver.set_wall_treatment(treatment).unwrap();
        for _ in 0..3 {
            solver.solve(&random_force(grid, 3), &mut velocity).unwrap();
        }
        assert_eq!(counts(&solver), [3, 6, 6, 18]);
        solver.pressure(&random_force(grid, 3), &velocity, &mut CentreField::zeros(grid)).unwrap();
        assert_eq!(counts(&solver), [3, 8, 7, 24]);
    }
}

#[test]
fn clones_and_restored_solvers_go_on_with_the_same_bits() {
    let grid = Grid::channel(20, 7, 0.1).unwrap();
    let mut solver = lagged(grid, 2.0, Drive::ZeroFlux);
    for seed in 0..3 {
        run(&mut solver, &random_force(grid, seed));
    }
    let memory = solver.memory().to_vec();
    let mut copy = solver.clone();
    let mut restored = lagged(grid, 2.0, Drive::ZeroFlux);
    restored.set_memory(&memory).unwrap();
    let mut restored_within = TwoPhaseStokes::new(lagged(grid, 2.0, Drive::ZeroFlux)).unwrap();
    assert!(restored_within.memory().is_empty());
    restored_within.set_memory(&memory).unwrap();
    // What is only computed on request leaves the memory as it is.
    solver.intermediate_velocity(&random_force(grid, 8), &mut StaggeredField::zeros(grid)).unwrap();
    solver.potential(&random_force(grid, 8), &mut CentreField::zeros(grid)).unwrap();
    assert_eq!(solver.memory(), memory);
    let expected = run(&mut solver, &random_force(grid, 9));
    assert_eq!(run(&mut copy, &random_force(grid, 9)), expected);
    assert_eq!(run(&mut restored, &random_force(grid, 9)), expected);
    assert_eq!(run(&mut restored_within, &random_force(grid, 9)), expected);
    assert_eq!(restored.memory(), solver.memory());
    assert_eq!(restored_within.memory(), solver.memory());
    assert_ne!(solver.memory(), memory);
}

#[test]
fn a_rewound_solver_repeats_its_last_solution() {
    let grid = Grid::channel(20, 7, 0.1).unwrap();
    let mut solver = lagged(grid, 2.0, Drive::ZeroFlux);
    for seed in 0..3 {
        let expected = run(&mut solver, &random_force(grid, seed));
        let memory = solver.memory().to_vec();
        for _ in 0..2 {
            solver.rewind();
            assert_eq!(run(&mut solver, &random_force(grid, seed)), expected);
            assert_eq!(solver.memory(), memory);
        }
    }
}

#[test]
fn a_viscosity_that_varies_is_solved_around_it_with_exact_walls() {
    let viscosity = |x: f64, y: f64| 2.0 + (3.0 * x).sin() * y.cos();
    for walled in [false, true] {
        let grid = if walled { Grid::channel(20, 14, 0.1) } else { Grid::periodic(20, 14, 0.1) }.unwrap();
        let mut flow = TwoPhaseStokes::new(ProjectionStokes::new(grid, 1.0).unwrap()).unwrap();
        let other: Box<dyn StokesSolver> = if walled {
            Box::new(ChannelStokes::new(grid, 1.0).unwrap())
        } else {
            Box::new(PeriodicStokes::new(grid, 1.0).unwrap())
        };
        let mut expected = TwoPhaseStokes::new(other).unwrap();
        flow.set_viscosity(viscosity).unwrap();
        expected.set_viscosity(viscosity).unwrap();
        let errors = differences(&mut flow, &mut expected, &random_force(grid, 2));
        assert!(errors.iter().all(|&e| e < 1e-9), "{errors:?}");
        assert_eq!(flow.work().iterations, expected.work().iterations);
    }
    let grid = Grid::channel(20, 14, 0.1).unwrap();
    let mut flow = TwoPhaseStokes::new(lagged(grid, 1.0, Drive::ZeroFlux)).unwrap();
    assert!(refused(&flow.set_viscosity(|_, _| 2.0), "lagged walls cannot be combined with a viscosity that varies"));
    assert_eq!(flow.set_viscosity(|_, _| 1.0), Ok(()));
}

/// Only the gradient of the potential lags (Cowley (3.1)): walls that are set to slide carry the fluid along at once.
#[test]
fn lagged_walls_have_new_velocities_in_the_next_solution() {
    let grid = Grid::channel(24, 8, 0.25).unwrap();
    let mut solver = lagged(grid, 2.0, Drive::ZeroGradient);
    let (rest, mut velocity) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
    solver.solve(&rest, &mut velocity).unwrap();
    solver.set_walls(sliding(&grid)).unwrap();
    let exact = run(&mut channel_solver(grid, 2.0, &sliding(&grid), Drive::ZeroGradient), &rest).0;
    let largest_slip = |solver: &mut ProjectionStokes| {
        let mut slip = vec![0.0; grid.nx()];
        solver.wall_slip(Wall::Bottom, &mut slip).unwrap();
        largest(&slip)
    };
    // The potential still lags, so that the first solution slips, but by less than the walls slide.
    solver.solve(&rest, &mut velocity).unwrap();
    assert!(largest_slip(&mut solver) < 0.7, "{}", largest_slip(&mut solver));
    assert!(relative_distance(&velocity, &exact) < 0.7);
    for _ in 0..80 {
        solver.solve(&rest, &mut velocity).unwrap();
    }
    assert!(largest_slip(&mut solver) < 1e-6 && relative_distance(&velocity, &exact) < 1e-6);
}

#[test]
fn memory_of_another_channel_or_of_no_solution_is_refused() {
    let solver = |ny: usize| lagged(Grid::channel(9, ny, 0.1).unwrap(), 1.0, Drive::ZeroFlux);
    let mut other = solver(7);
    let grid = *other.grid();
    other.solve(&random_force(grid, 3), &mut StaggeredField::zeros(grid)).unwrap();
    let memory = other.memory().to_vec();
    assert!(solver(7).set_memory(&memory).is_ok());
    assert!(solver(11).set_memory(&memory).is_err());
    for count in [0.0, -3.0, 1e300] {
        let wrong = [&[count], &memory[1..]].concat();
        assert!(solver(7).set_memory(&wrong).is_err(), "{count}");
    }
}

#[test]
fn forces_on_the_walls_do_nothing() {
    let grid = Grid::channel(20, 12, 0.1).unwrap();
    let force = random_force(grid, 3);
    let mut inner = force.clone();
    let (_, y) = inner.components_mut();
    y[..20].fill(f64::NAN);
    y[240..].fill(f64::NAN);
    let solver = &mut channel_solver(grid, 3.0, &sliding(&grid), Drive::Flux(0.37));
    assert_eq!(run(solver, &inner), run(solver, &force));
}

#[test]
fn bad_input_ends_in_an_error_that_names_it() {
    let (periodic, grid) = (Grid::periodic(12, 9, 0.1).unwrap(), Grid::channel(12, 9, 0.1).unwrap());
    for eta in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for grid in [periodic, grid] {
            let error = ProjectionStokes::new(grid, eta).unwrap_err();
            assert!(matches!(error, StokesError::Input(InputError::NotPositive { name: "viscosity", .. })), "{error}");
        }
    }
    let mut in_box = ProjectionStokes::new(periodic, 1.0).unwrap();
    let needed = "this needs a channel: the grid is a periodic box. Build the grid with Grid::channel";
    assert!(refused(&in_box.set_drive(Drive::ZeroFlux), needed));
    assert!(refused(&in_box.set_walls(WallMotion::uniform(&grid, 0.0, 1.0).unwrap()), needed));
    assert!(refused(&in_box.set_wall_treatment(WallTreatment::Lagged), needed));
    assert!(refused(&in_box.wall_slip(Wall::Top, &mut [0.0; 12]), needed));
    assert_eq!(in_box.wall_treatment(), WallTreatment::Exact);
    assert!(in_box.set_mean_velocity([f64::NAN, 0.0]).is_err());
    let mut solver = ProjectionStokes::new(grid, 1.0).unwrap();
    let needed = "this needs a periodic box: the grid is a channel. Build the grid with Grid::periodic";
    assert!(refused(&solver.set_mean_velocity([1.0, 0.0]), needed));
    assert!(matches!(solver.set_drive(Drive::Flux(f64::NAN)), Err(StokesError::Input(InputError::NotFinite { .. }))));
    let walls = WallMotion::uniform(&Grid::channel(13, 9, 0.1).unwrap(), 0.0, 1.0).unwrap();
    let expected = InputError::WrongLength { name: "the wall motion", expected: 12, found: 13 };
    assert_eq!(solver.set_walls(walls), Err(StokesError::Input(expected)));
    let expected = InputError::WrongLength { name: "the wall slip", expected: 12, found: 3 };
    assert_eq!(solver.wall_slip(Wall::Top, &mut [0.0; 3]), Err(StokesError::Input(expected)));
    assert!(solver.set_memory(&[1.0]).is_err());
    solver.set_wall_treatment(WallTreatment::Lagged).unwrap();
    assert!(solver.set_memory(&[1.0]).is_err() && solver.set_memory(&[f64::NAN; 57]).is_err());
    assert!(solver.memory().is_empty());
}

#[test]
fn a_refused_force_leaves_velocity_memory_and_counts_as_they_were() {
    let (periodic, channel) = (Grid::periodic(12, 9, 0.1).unwrap(), Grid::channel(12, 9, 0.1).unwrap());
    for mut solver in [ProjectionStokes::new(periodic, 1e-4).unwrap(), lagged(channel, 1e-4, Drive::ZeroGradient)] {
        let grid = *solver.grid();
        run(&mut solver, &random_force(grid, 0));
        let (memory, solves) = (solver.memory().to_vec(), solver.work().solves);
        let mut velocity = StaggeredField::zeros(grid);
        let other = Grid::channel(12, 8, 0.1).unwrap();
        let found = solver.solve(&StaggeredField::zeros(other), &mut velocity);
        assert!(refused(&found, "the force belongs to another grid"));
        let found = solver.solve(&random_force(grid, 1), &mut StaggeredField::zeros(other));
        assert!(refused(&found, "the velocity belongs to another grid"));
        for (bad, along_x) in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().zip([true, false, true]) {
            let mut force = random_force(grid, 1);
            let (x, y) = force.components_mut();
            if along_x {
                x[17] = bad;
            } else {
                y[17] = bad;
            }
            let named = |found: Result<(), StokesError>| {
                matches!(found, Err(StokesError::Input(InputError::NotFinite { name: "the force", .. })))
            };
            assert!(named(solver.solve(&force, &mut velocity).map(drop)));
            assert!(named(solver.pressure(&force, &velocity, &mut CentreField::zeros(grid))));
            assert!(named(solver.potential(&force, &mut CentreField::zeros(grid))));
            assert!(named(solver.intermediate_velocity(&force, &mut StaggeredField::zeros(grid))));
        }
        let mut force = random_force(grid, 1);
        force.components_mut().0.iter_mut().for_each(|f| *f *= 1e307);
        assert!(refused(&solver.solve(&force, &mut velocity), "the velocity is beyond the range of double precision"));
        assert_eq!(velocity, StaggeredField::zeros(grid));
        assert_eq!((solver.memory(), solver.work().solves), (&memory[..], solves));
    }
}
