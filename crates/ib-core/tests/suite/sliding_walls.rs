//! Markers next to walls that slide.

use ib_core::{AnyKernel, Hydrodynamics, ImmersedBoundary, MarkerKind, Markers, Vec2};
use stokes_grid::{ChannelStokes, Grid, ProjectionStokes, StokesSolver, WallMotion};

/// Markers without forces move with Couette flow exactly, at any distance from the walls and with any kernel.
#[test]
fn markers_move_with_couette_flow() {
    let grid = Grid::channel(24, 16, 0.125).expect("a grid");
    let walls = WallMotion::uniform(&grid, -1.0, 2.0).expect("walls");
    let mut streamfunction = ChannelStokes::new(grid, 3.0).expect("a solver");
    streamfunction.set_walls(walls.clone()).expect("walls");
    let mut projection = ProjectionStokes::new(grid, 3.0).expect("a solver");
    projection.set_walls(walls).expect("walls");
    let solvers: [Box<dyn StokesSolver>; 2] = [Box::new(streamfunction), Box::new(projection)];
    for solver in solvers {
        let mut flow = ImmersedBoundary::new(solver, AnyKernel::BSpline4);
        let heights = [0.0, 0.03, 0.125, 0.2, 1.0, 1.7, 1.95, 2.0];
        let mut markers = Markers::new();
        markers.push_group(heights.len(), MarkerKind::Points);
        for (place, y) in markers.positions_mut().iter_mut().zip(heights) {
            *place = Vec2::new(0.31, y - 1.0);
        }
        flow.velocities(&mut markers).expect("velocities");
        for (velocity, y) in markers.velocities().iter().zip(heights) {
            let exact = -1.0 + 1.5 * y;
            assert!((velocity.x - exact).abs() < 1e-12 && velocity.y.abs() < 1e-12, "{y}: {velocity} {exact}");
        }
    }
}
