use crate::{Grid, PeriodicStokes, StaggeredField, StokesSolver};

#[test]
fn several_threads_give_the_bits_of_one() {
    for (nx, ny) in [(900, 896), (901, 889), (1000, 805)] {
        let grid = Grid::periodic(nx, ny, 0.01).unwrap();
        let mut force = StaggeredField::zeros(grid);
        let (x, y) = force.components_mut();
        for (k, value) in x.iter_mut().chain(y).enumerate() {
            *value = ((k * k % 1009) as f64).sin();
        }
        let solve = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut velocity = StaggeredField::zeros(grid);
            let mut solver = PeriodicStokes::new(grid, 2.0).unwrap();
            solver.set_mean_velocity([0.25, -0.5]).unwrap();
            let report = pool.install(|| solver.solve(&force, &mut velocity)).unwrap();
            (velocity, report.mean_pressure_gradient)
        };
        let (expected, gradient) = solve(1);
        for threads in [2, 3] {
            let (found, found_gradient) = solve(threads);
            assert_eq!(found.x(), expected.x(), "{nx} x {ny}, {threads} threads");
            assert_eq!(found.y(), expected.y(), "{nx} x {ny}, {threads} threads");
            assert_eq!(found_gradient, gradient);
        }
    }
}
