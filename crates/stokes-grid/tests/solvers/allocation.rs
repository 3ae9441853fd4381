//! A solver in steady state allocates nothing.

use allocation_counter::measure;
use motile_base::Drive;
use stokes_grid::{
    CentreField, ChannelStokes, Grid, PeriodicStokes, ProjectionStokes, StaggeredField, StokesSolver, TwoPhaseStokes,
    WallMotion, WallTreatment,
};

fn allocations(solver: &mut dyn StokesSolver) -> u64 {
    let grid = *solver.grid();
    let mut force = StaggeredField::zeros(grid);
    force.components_mut().0.iter_mut().enumerate().for_each(|(k, f)| *f = (k * k % 101) as f64);
    let (mut velocity, mut pressure) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
    let mut both = || {
        solver.solve(&force, &mut velocity).expect("a good force");
        solver.pressure(&force, &velocity, &mut pressure).expect("a good force");
    };
    both();
    measure(|| (0..3).for_each(|_| both())).count_total
}

#[test]
fn solving_allocates_nothing() {
    // The counter counts.
    assert_eq!(measure(|| drop(std::hint::black_box(vec![1.0; 10]))).count_total, 1);
    for (nx, ny) in [(48, 40), (31, 29), (47, 60)] {
        let periodic = Grid::periodic(nx, ny, 0.1).unwrap();
        let channel = Grid::channel(nx, ny, 0.1).unwrap();
        let walls = WallMotion::uniform(&channel, 1.0, 0.0).unwrap();
        let mut streamfunction = ChannelStokes::new(channel, 2.0).unwrap();
        streamfunction.set_walls(walls).unwrap();
        streamfunction.set_drive(Drive::ZeroFlux).unwrap();
        assert_eq!(allocations(&mut PeriodicStokes::new(periodic, 2.0).unwrap()), 0);
        assert_eq!(allocations(&mut streamfunction), 0);
        assert_eq!(allocations(&mut ProjectionStokes::new(periodic, 2.0).unwrap()), 0);
        let mut projection = ProjectionStokes::new(channel, 2.0).unwrap();
        projection.set_drive(Drive::ZeroFlux).unwrap();
        assert_eq!(allocations(&mut projection), 0);
        projection.set_wall_treatment(WallTreatment::Lagged).unwrap();
        assert_eq!(allocations(&mut projection), 0);
        let mut varying = TwoPhaseStokes::new(streamfunction).unwrap();
        varying.set_viscosity(|x, y| 3.0 + x.sin() + y.cos()).unwrap();
        assert_eq!(allocations(&mut varying), 0);
    }
}
