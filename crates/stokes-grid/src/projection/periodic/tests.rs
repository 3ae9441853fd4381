use crate::{CentreField, Grid, ProjectionStokes, StaggeredField, StokesSolver};

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
            let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
            let mut solver = ProjectionStokes::new(grid, 2.0).unwrap();
            solver.set_mean_velocity([0.25, -0.5]).unwrap();
            let report = pool.install(|| {
                let report = solver.solve(&force, &mut velocity).unwrap();
                solver.pressure(&force, &velocity, &mut pressure).unwrap();
                report
            });
            (velocity, pressure, report)
        };
        let expected = solve(1);
        for threads in [2, 3] {
            assert!(solve(threads) == expected, "{nx} x {ny}, {threads} threads");
        }
    }
}
