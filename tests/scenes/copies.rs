//! Copies of scenes go on by themselves.

use motile::Recommendation;
use motile::active_interface::{ActiveDroplet, Curve};
use motile::analysis::trajectory::TrajectoryRecorder;
use motile::base::Vec2;
use motile::boundary_integrals::ImmersedLayers;
use motile::boundary_integrals::{BoundaryIntegral, PeriodicCalculus};
use motile::elastic_solids::mesh::TriangleMesh;
use motile::elastic_solids::{Channel, Mesher, Outline, Solid};
use motile::ib_core::{AnyKernel, ImmersedBoundary, SmearedContrast, Transfer};
use motile::scene::{
    Hydrodynamics, MarkerKind, Markers,
    checkpoint::Checkpoint,
    gap::{Boundary, SolidGap},
    integrator::{Midpoint, RungeKuttaChebyshev},
};
use motile::setup::{DropletSetup, Setup, SolidSetup};
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes, RealFft2, TwoPhaseStokes};

fn is_clone<T: Clone>() {}

#[test]
fn all_but_scenes_can_be_copied() {
    is_clone::<(PeriodicStokes, ChannelStokes, TwoPhaseStokes<PeriodicStokes>, RealFft2)>();
    is_clone::<ImmersedBoundary<ChannelStokes, AnyKernel>>();
    is_clone::<SmearedContrast<PeriodicStokes, AnyKernel>>();
    is_clone::<(BoundaryIntegral, PeriodicCalculus, Transfer<AnyKernel>, Markers)>();
    is_clone::<(ActiveDroplet, Curve, Solid, TriangleMesh, Outline, Channel, Mesher)>();
    is_clone::<(Midpoint, RungeKuttaChebyshev, TrajectoryRecorder, SolidGap, Boundary, Checkpoint)>();
    is_clone::<(Setup, DropletSetup, SolidSetup, Recommendation)>();
}

/// Markers of an ellipse that is ten times as viscous as what is around it, drawn out along x, and of a point beside
/// it.
fn markers(axis: f64) -> Markers {
    let mut markers = Markers::new();
    markers.push_group(64, MarkerKind::Interface { viscosity_inside: Some(10.0) });
    markers.push_group(1, MarkerKind::Points);
    let ellipse = Curve::ellipse(axis, 1.0 / axis).expect("an ellipse").markers(64).expect("markers");
    for (k, place) in ellipse.into_iter().chain([Vec2::new(2.0, 0.3)]).enumerate() {
        markers.positions_mut()[k] = place;
        markers.forces_mut()[k] = Vec2::new(place.x, 0.0);
    }
    markers
}

#[test]
fn a_copy_of_a_flow_goes_on_by_itself() {
    let solver = PeriodicStokes::new(Grid::periodic(48, 48, 0.125).expect("a grid"), 1.0).expect("a viscosity");
    let mut flow = ImmersedLayers::new(solver, AnyKernel::BSpline4, 64, 1e-6).expect("layers");
    flow.velocities(&mut markers(1.1)).expect("a flow");
    // The iterations start from the last solution, which the copy has too.
    let mut copy = flow.clone();
    let (mut ahead, mut beside) = (markers(1.12), markers(1.12));
    flow.velocities(&mut ahead).expect("a flow");
    flow.velocities(&mut markers(1.3)).expect("a flow");
    copy.velocities(&mut beside).expect("a flow");
    assert_eq!(ahead.velocities(), beside.velocities());
    assert_eq!((flow.work().evaluations, copy.work().evaluations), (3, 2));
}
