//! Scenes compute only what they need.

use motile::active_interface::{ActiveDroplet, Curve};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{FlowWork, Hydrodynamics, Scene};
use motile::setup::{GridMethod, Method, Setup};
use motile::stokes_grid::{Grid, PeriodicStokes};
use motile_tests::validation::scene::on_grid;

#[test]
fn a_step_is_two_solves_of_two_transforms() {
    let mut scene = on_grid(0.1).build().unwrap().scene;
    for _ in 0..5 {
        scene.step(0.01).unwrap();
    }
    // The flow of the last state is known too: the next step starts from it.
    let expected = FlowWork {
        evaluations: 11,
        stokes_solves: 11,
        transforms: 22,
        markers_spread: 11 * 128,
        corrections: 11,
        ..FlowWork::default()
    };
    assert_eq!(scene.system().hydrodynamics().work(), expected);
    // Looking at the present state is reused by the next step.
    scene.system_mut().evaluate().unwrap();
    scene.system_mut().evaluate().unwrap();
    scene.step(0.01).unwrap();
    assert_eq!(scene.system().hydrodynamics().work().evaluations, 13);
}

#[test]
fn the_thesis_preset_is_not_corrected() {
    let method = Method::Grid(GridMethod { spacing: 0.1, ..GridMethod::thesis() });
    let mut scene = Setup { method, ..Setup::thesis() }.build().unwrap().scene;
    scene.step(0.001).unwrap();
    assert_eq!(scene.system().hydrodynamics().work().corrections, 0);
}

#[test]
fn a_passive_droplet_has_no_transport() {
    let solver = PeriodicStokes::new(Grid::periodic(40, 40, 0.1).unwrap(), 1.0).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));
    let curve = Curve::ellipse(1.2, 1.0 / 1.2).unwrap();
    let droplet = scene.add(ActiveDroplet::passive(&curve.markers(128).unwrap(), 1.0).unwrap());
    scene.step(0.01).unwrap();
    assert!(scene.body(droplet).unwrap().particle_numbers().is_empty());
    let mut reasons = Vec::new();
    scene.system().each_limit(&mut |limit, _| reasons.push(limit.reason));
    assert_eq!(reasons, ["the surface tension", "the relaxation of the marker spacing"]);
}
