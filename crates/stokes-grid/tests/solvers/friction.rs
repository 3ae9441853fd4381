//! Friction of the fluid with its substrate: the discrete equations, exact flows, and the limit of none.

use std::f64::consts::TAU;

use crate::common::{distance, largest, random_force, relative_distance, residuals};
use motile_base::Drive;
use stokes_grid::{
    CentreField, ChannelStokes, Grid, PeriodicStokes, StaggeredField, StokesSolver, TwoPhaseStokes, Vec2, WallMotion,
    flux,
};

const ETA: f64 = 1.7;

fn solved(solver: &mut dyn StokesSolver, force: &StaggeredField) -> ([f64; 2], StaggeredField) {
    let grid = *solver.grid();
    let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
    let report = solver.solve(force, &mut velocity).unwrap();
    solver.pressure(force, &velocity, &mut pressure).unwrap();
    // The friction is a force like any other.
    let mut whole = force.clone();
    whole.combine(1.0, -solver.friction(), &velocity);
    let [momentum, divergence] = residuals(ETA, solver.walls(), &whole, &velocity, &pressure, &report);
    let scale = largest(force.x()).max(largest(velocity.x()) / grid.spacing().powi(2));
    ([momentum / scale, divergence], velocity)
}

fn channel(grid: Grid, friction: f64, drive: Drive, walls: WallMotion) -> ChannelStokes {
    let mut solver = ChannelStokes::new(grid, ETA).unwrap();
    solver.set_walls(walls).unwrap();
    solver.set_drive(drive).unwrap();
    solver.set_friction(friction).unwrap();
    solver
}

/// From screening over many cells to screening within one, wide channels and narrow ones, odd sizes.
#[test]
fn solutions_satisfy_the_discrete_equations() {
    for (nx, ny) in [(2, 2), (5, 7), (12, 6), (16, 40), (33, 21)] {
        for friction in [1e-3, 1.0, 50.0, 1e5] {
            let grid = Grid::periodic(nx, ny, 0.11).unwrap();
            let mut solver = PeriodicStokes::new(grid, ETA).unwrap();
            solver.set_mean_velocity([0.3, -0.2]).unwrap();
            solver.set_friction(friction).unwrap();
            let (errors, _) = solved(&mut solver, &random_force(grid, 3));
            assert!(errors.iter().all(|e| *e < 1e-12), "box {nx} x {ny}, friction {friction}: {errors:?}");

            let grid = Grid::channel(nx, ny, 0.11).unwrap();
            let walls = WallMotion::from_fn(&grid, |x| 0.3 + (2.0 * x).sin(), |x| (3.0 * x).cos() - 0.1).unwrap();
            for drive in [Drive::ZeroGradient, Drive::Gradient(0.7), Drive::ZeroFlux, Drive::Flux(-0.4)] {
                let mut solver = channel(grid, friction, drive, walls.clone());
                let (errors, velocity) = solved(&mut solver, &random_force(grid, 5));
                assert!(errors.iter().all(|e| *e < 1e-11), "channel {nx} x {ny}, friction {friction}: {errors:?}");
                if let Some(wanted) = drive.flux() {
                    assert!((flux(&velocity) - wanted).abs() < 1e-12, "{} {wanted}", flux(&velocity));
                }
            }
        }
    }
}

/// Flow between plates with friction: `u = (G/alpha) (1 - cosh(q y)/cosh(q H/2))`, q^2 = alpha/eta, to second order.
#[test]
fn a_driven_channel_has_hartmanns_profile() {
    let (friction, gradient, height): (f64, f64, f64) = (40.0, -3.0, 1.0);
    let q = (friction / ETA).sqrt();
    let errors = [64, 128, 256].map(|rows| {
        let grid = Grid::channel(8, rows, height / rows as f64).unwrap();
        let mut solver = channel(grid, friction, Drive::Gradient(gradient), WallMotion::AT_REST);
        let mut velocity = StaggeredField::zeros(grid);
        solver.solve(&StaggeredField::zeros(grid), &mut velocity).unwrap();
        let middle = 0.5 * height - grid.origin()[1].abs();
        assert!(middle.abs() < 1e-12, "the middle is at y = 0");
        let profile = |x: Vec2| -gradient / friction * (1.0 - (q * x.y).cosh() / (0.5 * q * height).cosh());
        let exact = StaggeredField::from_fn(grid, |x| Vec2::new(profile(x), 0.0));
        distance(velocity.x(), exact.x())
    });
    let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
    assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.05), "{errors:?} {orders:?}");
    assert!(errors[2] < 4e-6, "{errors:?}");
}

/// The flow of one wave of force is divided by `eta k^2 + alpha` instead of `eta k^2`, to second order.
#[test]
fn a_wave_in_a_box_is_slowed_by_the_friction() {
    let friction = 200.0;
    let errors = [16, 32].map(|n| {
        let grid = Grid::periodic(n, n, 1.0 / n as f64).unwrap().with_origin([0.0; 2]).unwrap();
        let flow = |x: Vec2| Vec2::new((TAU * x.x).sin() * (TAU * x.y).cos(), -(TAU * x.x).cos() * (TAU * x.y).sin());
        let mut solver = PeriodicStokes::new(grid, ETA).unwrap();
        solver.set_friction(friction).unwrap();
        let mut velocity = StaggeredField::zeros(grid);
        let force = StaggeredField::from_fn(grid, |x| (2.0 * TAU * TAU * ETA + friction) * flow(x));
        solver.solve(&force, &mut velocity).unwrap();
        relative_distance(&velocity, &StaggeredField::from_fn(grid, flow))
    });
    assert!((errors[0] / errors[1]).log2() > 1.95 && errors[1] < 3e-3, "{errors:?}");
}

/// Setting no friction again gives the bits of a solver that never had any.
#[test]
fn without_friction_nothing_changes() {
    let grid = Grid::channel(24, 30, 0.1).unwrap();
    let force = random_force(grid, 9);
    let mut plain = ChannelStokes::new(grid, ETA).unwrap();
    let mut other = channel(grid, 3.0, Drive::ZeroGradient, WallMotion::AT_REST);
    other.set_friction(0.0).unwrap();
    assert_eq!(solved(&mut plain, &force).1, solved(&mut other, &force).1);
    let refused = plain.set_friction(-1.0);
    let text = refused.unwrap_err().to_string();
    assert!(text.contains("friction"), "{text}");
    assert!(plain.set_friction(f64::NAN).is_err());
}

/// Conjugate gradients over two viscosities solve the same equations: with one viscosity in two halves of equal size.
#[test]
fn two_viscosities_have_the_friction_of_their_solver() {
    let grid = Grid::periodic(20, 16, 0.1).unwrap();
    let force = random_force(grid, 11);
    let mut plain = PeriodicStokes::new(grid, 2.0 * ETA).unwrap();
    plain.set_friction(30.0).unwrap();
    let (mut expected, mut found) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
    plain.solve(&force, &mut expected).unwrap();
    // The preconditioner has another viscosity than the fluid, which is everywhere 2 ETA.
    let mut inner = PeriodicStokes::new(grid, ETA).unwrap();
    inner.set_friction(30.0).unwrap();
    let mut solver = TwoPhaseStokes::new(inner).unwrap().with_tolerance(1e-11).unwrap();
    solver.set_viscosity(|_, _| 2.0 * ETA).unwrap();
    solver.solve(&force, &mut found).unwrap();
    assert!(relative_distance(&found, &expected) < 1e-9, "{}", relative_distance(&found, &expected));
}
