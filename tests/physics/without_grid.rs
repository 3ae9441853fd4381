//! Swimmers without a grid against independent values and against the grid.

use motile::Swimmer;
use motile::ib_core::Hydrodynamics;
use motile_tests::validation::swimmers::{look, reference_swimmer, steady_without_grid};

#[test]
fn steady_swimmers() {
    for activity in [-2.0, -4.0] {
        let errors = steady_without_grid(&reference_swimmer(&Swimmer::default(), activity, 0.05), 60.0).unwrap();
        assert!(errors.speed.abs() < 1e-3, "{errors:?}");
        assert!(errors.stresslet.abs() < 5e-3 && errors.beta.abs() < 5e-3, "{errors:?}");
        assert!(errors.aspect_ratio.abs() < 1e-3 && errors.concentration_max.abs() < 2e-3, "{errors:?}");
    }
}

#[test]
fn steady_swimmer_with_viscosity_contrast() {
    let thick = Swimmer { viscosity_inside: Some(100.0), ..reference_swimmer(&Swimmer::default(), -1.0, 0.05) };
    let errors = steady_without_grid(&Swimmer { viscosity: 10.0, ..thick }, 60.0).unwrap();
    assert!(errors.speed.abs() < 1e-3 && errors.beta.abs() < 5e-3, "{errors:?}");
}

/// The same droplet on a grid and without one: the difference shrinks at the grid's order.
#[test]
fn both_methods_agree() {
    let swimmer = Swimmer { activity: -4.0, ..Swimmer::default() };
    let (mut scene, droplet) = swimmer.build_without_grid().unwrap();
    scene.run(10.0).go().unwrap();
    let exact = look(&mut scene, droplet).unwrap().aspect_ratio_moments;
    assert_eq!(scene.system().hydrodynamics().work().stokes_solves, 0);
    let differences = [0.2, 0.1].map(|spacing| {
        let (mut scene, droplet) =
            Swimmer { spacing, marker_spacing: Some(0.025), ..swimmer.clone() }.build_on_grid().unwrap();
        scene.run(10.0).go().unwrap();
        (look(&mut scene, droplet).unwrap().aspect_ratio_moments - exact).abs()
    });
    let order = (differences[0] / differences[1]).log2();
    assert!(order > 1.6 && differences[1] < 4e-3, "{differences:?}");
}
