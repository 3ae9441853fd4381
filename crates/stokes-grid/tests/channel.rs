mod common;
use common::*;
use stokes_grid::*;

#[test]
fn momentum_and_continuity_hold_to_round_off() {
    for (nx, ny) in [(2, 2), (2, 3), (3, 2), (4, 5), (24, 16), (25, 7), (240, 40), (64, 100)] {
        let grid = Grid::channel(nx, ny, 0.05).unwrap();
        let walls = WallMotion::from_fn(&grid, |x| (2.0 * x).sin() + 0.3, |x| x.cos()).unwrap();
        for drive in [Drive::ZeroGradient, Drive::Gradient(0.7), Drive::ZeroFlux, Drive::Flux(-0.4)] {
            let mut solver = ChannelStokes::new(grid, 3.0).unwrap();
            solver.set_walls(walls.clone()).unwrap();
            solver.set_drive(drive).unwrap();
            let force = random_force(grid, 5);
            let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
            let report = solver.solve(&force, &mut velocity).unwrap();
            solver.pressure(&force, &velocity, &mut pressure).unwrap();
            let [m, d] = residuals(3.0, &walls, &force, &velocity, &pressure, &report);
            println!(
                "{nx} {ny} {drive:?} {m:e} {d:e} max u {} g {:?}",
                largest(velocity.x()),
                report.mean_pressure_gradient
            );
        }
    }
}
