//! Walls along which fluid slips: the discrete equations and plane flows.

use crate::common::{largest, random_force, refused, relative_distance, residuals};
use motile_base::Drive;
use stokes_grid::{
    CentreField, ChannelStokes, Grid, ProjectionStokes, StaggeredField, StokesSolver, TwoPhaseStokes, Vec2, Wall,
    WallMotion, flux, wall_shear_stress,
};

const ETA: f64 = 1.7;

fn channel(grid: Grid, friction: f64, drive: Drive, walls: WallMotion) -> ChannelStokes {
    let mut solver = ChannelStokes::new(grid, ETA).unwrap();
    solver.set_walls(walls).unwrap();
    solver.set_drive(drive).unwrap();
    solver.set_friction(friction).unwrap();
    solver
}

fn solved(solver: &mut dyn StokesSolver, force: &StaggeredField) -> ([f64; 2], StaggeredField) {
    let grid = *solver.grid();
    let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
    let report = solver.solve(force, &mut velocity).unwrap();
    solver.pressure(force, &velocity, &mut pressure).unwrap();
    let mut whole = force.clone();
    whole.combine(1.0, -solver.friction(), &velocity);
    let [momentum, divergence] = residuals(ETA, solver.walls(), &whole, &velocity, &pressure, &report);
    let scale = largest(force.x()).max(largest(velocity.x()) / grid.spacing().powi(2));
    ([momentum / scale, divergence / (1.0 + largest(velocity.x()))], velocity)
}

#[test]
fn solutions_satisfy_the_discrete_equations() {
    for (nx, ny) in [(2, 2), (5, 7), (12, 6), (16, 40), (33, 21)] {
        for slip in [[0.1, 0.1], [0.0, 0.4], [2.0, 0.0], [50.0, 0.01]] {
            for friction in [0.0, 3.0] {
                let grid = Grid::channel(nx, ny, 0.11).unwrap();
                let walls = WallMotion::from_fn(&grid, |x| 0.3 + (2.0 * x).sin(), |x| (3.0 * x).cos() - 0.1).unwrap();
                let walls = walls.with_slip(slip).unwrap();
                for drive in [Drive::ZeroGradient, Drive::Gradient(0.7), Drive::ZeroFlux, Drive::Flux(-0.4)] {
                    let mut solver = channel(grid, friction, drive, walls.clone());
                    let (errors, velocity) = solved(&mut solver, &random_force(grid, 5));
                    assert!(errors.iter().all(|e| *e < 1e-11), "{nx} x {ny}, {slip:?}, {friction}: {errors:?}");
                    if let Some(wanted) = drive.flux() {
                        assert!((flux(&velocity) - wanted).abs() < 1e-12, "{} {wanted}", flux(&velocity));
                    }
                }
            }
        }
    }
}

/// Couette flow to round-off; Poiseuille flow with the constant `G h^2/(8 eta)` that the grid adds, as without slip.
#[test]
fn plane_flows_are_exact() {
    let grid = Grid::channel(4, 30, 0.1).unwrap();
    let (h, width, slip, gradient): (f64, f64, _, f64) = (0.1, 3.0, [0.2, 1.0], -2.0);
    let sum = width + slip[0] + slip[1];
    let height = |x: Vec2| x.y - grid.origin()[1];
    let none = StaggeredField::zeros(grid);
    let walls = WallMotion::uniform(&grid, 0.0, 1.0).unwrap().with_slip(slip).unwrap();
    let (_, velocity) = solved(&mut channel(grid, 0.0, Drive::ZeroGradient, walls.clone()), &none);
    let exact = StaggeredField::from_fn(grid, |x| Vec2::new((height(x) + slip[0]) / sum, 0.0));
    assert!(relative_distance(&velocity, &exact) < 1e-14);
    let mut stress = [0.0; 4];
    for (wall, sign) in [(Wall::Bottom, 1.0), (Wall::Top, 1.0)] {
        wall_shear_stress(&velocity, ETA, &walls, wall, &mut stress).unwrap();
        assert!(stress.iter().all(|s| (s - sign * ETA / sum).abs() < 1e-13), "{stress:?}");
    }
    let walls = WallMotion::AT_REST.with_slip(slip).unwrap();
    let (_, velocity) = solved(&mut channel(grid, 0.0, Drive::Gradient(gradient), walls), &none);
    let p = (0.5 * width * width + slip[1] * width) / sum;
    let profile = |y: f64| -gradient / ETA * (-0.5 * y * y + p * (y + slip[0]) + h * h / 8.0);
    let exact = StaggeredField::from_fn(grid, |x| Vec2::new(profile(height(x)), 0.0));
    assert!(relative_distance(&velocity, &exact) < 1e-13);
}

/// Conjugate gradients over two viscosities solve the same equations: with one viscosity in two halves of equal size.
#[test]
fn two_viscosities_slip_like_their_solver() {
    let grid = Grid::channel(20, 16, 0.1).unwrap();
    let (force, walls) = (random_force(grid, 11), WallMotion::AT_REST.with_slip([0.1, 0.3]).unwrap());
    let mut plain = ChannelStokes::new(grid, 2.0 * ETA).unwrap();
    plain.set_walls(walls.clone()).unwrap();
    let (mut expected, mut found) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
    plain.solve(&force, &mut expected).unwrap();
    let mut solver = TwoPhaseStokes::new(channel(grid, 0.0, Drive::ZeroGradient, walls)).unwrap();
    solver = solver.with_tolerance(1e-11).unwrap();
    solver.set_viscosity(|_, _| 2.0 * ETA).unwrap();
    solver.solve(&force, &mut found).unwrap();
    assert!(relative_distance(&found, &expected) < 1e-9, "{}", relative_distance(&found, &expected));
}

#[test]
fn slip_is_refused_where_there_is_none() {
    let grid = Grid::channel(8, 8, 0.1).unwrap();
    assert!(WallMotion::AT_REST.with_slip([-0.1, 0.0]).is_err());
    assert!(WallMotion::AT_REST.with_slip([0.1, f64::NAN]).is_err());
    let mut projection = ProjectionStokes::new(grid, ETA).unwrap();
    let walls = WallMotion::AT_REST.with_slip([0.1, 0.1]).unwrap();
    assert!(refused(&projection.set_walls(walls), "slip"));
    // Without slip again, the bits are those of a solver that never had any.
    let force = random_force(grid, 3);
    let mut other = channel(grid, 0.0, Drive::ZeroFlux, WallMotion::AT_REST.with_slip([0.1, 0.2]).unwrap());
    other.set_walls(WallMotion::AT_REST).unwrap();
    let mut plain = channel(grid, 0.0, Drive::ZeroFlux, WallMotion::AT_REST);
    assert_eq!(solved(&mut plain, &force).1, solved(&mut other, &force).1);
}
