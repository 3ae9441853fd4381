//! Properties of the solution operator, on random grids and forces.

use motile_base::Drive;
use proptest::prelude::*;
use stokes_grid::{ChannelStokes, Grid, PeriodicStokes, ProjectionStokes, StaggeredField, StokesSolver};

use crate::common::{largest, random_force, relative_distance};

fn solve(solver: &mut dyn StokesSolver, force: &StaggeredField) -> StaggeredField {
    let mut velocity = StaggeredField::zeros(*solver.grid());
    solver.solve(force, &mut velocity).unwrap();
    velocity
}

/// All kinds of solver on grids of this size, with walls at rest.
fn solvers(nx: usize, ny: usize) -> Vec<Box<dyn StokesSolver>> {
    let (periodic, channel) = (Grid::periodic(nx, ny, 0.2).unwrap(), Grid::channel(nx, ny, 0.2).unwrap());
    let mut closed = ChannelStokes::new(channel, 1.5).unwrap();
    closed.set_drive(Drive::ZeroFlux).unwrap();
    let mut closed_projection = ProjectionStokes::new(channel, 1.5).unwrap();
    closed_projection.set_drive(Drive::ZeroFlux).unwrap();
    vec![
        Box::new(PeriodicStokes::new(periodic, 1.5).unwrap()),
        Box::new(ChannelStokes::new(channel, 1.5).unwrap()),
        Box::new(closed),
        Box::new(ProjectionStokes::new(periodic, 1.5).unwrap()),
        Box::new(ProjectionStokes::new(channel, 1.5).unwrap()),
        Box::new(closed_projection),
    ]
}

/// `a f + b g`.
fn combine(a: f64, f: &StaggeredField, b: f64, g: &StaggeredField) -> StaggeredField {
    let sum = |f: &[f64], g: &[f64]| f.iter().zip(g).map(|(f, g)| a * f + b * g).collect();
    StaggeredField::from_components(*f.grid(), sum(f.x(), g.x()), sum(f.y(), g.y())).unwrap()
}

fn dot(f: &StaggeredField, g: &StaggeredField) -> f64 {
    let sum = |f: &[f64], g: &[f64]| f.iter().zip(g).map(|(f, g)| f * g).sum::<f64>();
    sum(f.x(), g.x()) + sum(f.y(), g.y())
}

fn norm(f: &StaggeredField) -> f64 {
    dot(f, f).sqrt()
}

/// The field moved by whole cells.
fn moved(f: &StaggeredField, di: usize, dj: usize) -> StaggeredField {
    let (nx, ny) = (f.grid().nx(), f.grid().ny());
    let rows = f.grid().node_rows();
    let shift = |values: &[f64], rows: usize| -> Vec<f64> {
        (0..values.len()).map(|k| values[(k / nx + rows - dj) % rows * nx + (k % nx + nx - di) % nx]).collect()
    };
    StaggeredField::from_components(*f.grid(), shift(f.x(), ny), shift(f.y(), rows)).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn the_velocity_is_linear_in_the_force(
        nx in 2usize..40, ny in 2usize..40, seed in 0u64..1000, a in -3.0..3.0f64, b in 0.1..3.0f64,
    ) {
        for mut solver in solvers(nx, ny) {
            let (f, g) = (random_force(*solver.grid(), seed), random_force(*solver.grid(), seed + 5000));
            let together = solve(&mut *solver, &combine(a, &f, b, &g));
            let apart = combine(a, &solve(&mut *solver, &f), b, &solve(&mut *solver, &g));
            prop_assert!(relative_distance(&apart, &together) < 1e-11);
        }
    }

    #[test]
    fn the_operator_is_symmetric_and_dissipates(nx in 2usize..40, ny in 2usize..40, seed in 0u64..1000) {
        for mut solver in solvers(nx, ny) {
            let (f, g) = (random_force(*solver.grid(), seed), random_force(*solver.grid(), seed + 5000));
            let (vf, vg) = (solve(&mut *solver, &f), solve(&mut *solver, &g));
            let scale = norm(&f) * norm(&vg) + norm(&g) * norm(&vf);
            prop_assert!((dot(&f, &vg) - dot(&g, &vf)).abs() < 1e-13 * scale);
            prop_assert!(dot(&f, &vf) > 0.0);
        }
    }

    #[test]
    fn a_moved_force_moves_the_flow(
        nx in 2usize..40, ny in 2usize..40, seed in 0u64..1000, di in 0usize..40, dj in 0usize..40,
    ) {
        for mut solver in solvers(nx, ny) {
            let f = random_force(*solver.grid(), seed);
            let (di, dj) = (di % nx, if solver.grid().has_walls() { 0 } else { dj % ny });
            let expected = moved(&solve(&mut *solver, &f), di, dj);
            prop_assert!(relative_distance(&solve(&mut *solver, &moved(&f, di, dj)), &expected) < 1e-11);
        }
    }

    #[test]
    fn the_mean_velocity_of_a_box_is_zero(nx in 2usize..60, ny in 2usize..60, seed in 0u64..1000) {
        let grid = Grid::periodic(nx, ny, 0.2).unwrap();
        let velocity = solve(&mut PeriodicStokes::new(grid, 1.5).unwrap(), &random_force(grid, seed));
        for component in [velocity.x(), velocity.y()] {
            let mean = component.iter().sum::<f64>() / component.len() as f64;
            prop_assert!(mean.abs() < 1e-14 * largest(component));
        }
    }
}
