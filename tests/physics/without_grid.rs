//! Swimmers without a grid against independent values and against the grid.

use motile::scene::Hydrodynamics;
use motile::setup::{Built, DropletSetup, GridMethod, Method, Setup};
use motile_tests::validation::scene::reference;
use motile_tests::validation::swimmers::steady;

#[test]
fn steady_swimmers() {
    for activity in [-2.0, -4.0] {
        let errors = steady(&reference(Setup::default(), activity), 60.0).unwrap();
        assert!(errors.speed.abs() < 2e-4, "{errors:?}");
        assert!(errors.stresslet.abs() < 5e-3 && errors.beta.abs() < 5e-3, "{errors:?}");
        assert!(errors.aspect_ratio.abs() < 2e-4 && errors.concentration_max.abs() < 2e-3, "{errors:?}");
    }
}

#[test]
fn steady_swimmer_with_viscosity_contrast() {
    let thick = DropletSetup { viscosity: Some(100.0), ..DropletSetup::default() };
    let setup = Setup { viscosity: 10.0, droplets: vec![thick], ..Setup::default() };
    let errors = steady(&reference(setup, -1.0), 60.0).unwrap();
    assert!(errors.speed.abs() < 3e-4 && errors.beta.abs() < 0.002, "{errors:?}");
}

/// A droplet on a grid and without one: the difference shrinks at the grid's order.
#[test]
fn both_methods_agree() {
    let aspect_ratio = |method: Method| {
        let setup = Setup { method, droplets: vec![DropletSetup::active(-4.0)], ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(10.0).go().unwrap();
        (scene.observe(droplets[0]).unwrap().aspect_ratio_moments, scene.system().hydrodynamics().work().stokes_solves)
    };
    let (exact, solves) = aspect_ratio(Method::default());
    assert_eq!(solves, 0);
    let differences = [0.2, 0.1].map(|spacing| {
        let grid = GridMethod { marker_spacing: Some(0.025), ..GridMethod::of_spacing(spacing) };
        (aspect_ratio(Method::Grid(grid)).0 - exact).abs()
    });
    let order = (differences[0] / differences[1]).log2();
    assert!(order > 1.6 && differences[1] < 4e-3, "{differences:?}");
}
