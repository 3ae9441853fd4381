//! Recommended settings hold what they promise where they were not measured.

use motile::active_interface::ActiveDroplet;
use motile::ib_core::{Handle, Scene, StepSize};
use motile::stokes_grid::Drive;
use motile::{AnyFlow, Method, SceneKind, SetupError, Swimmer, recommend};

const STEADY: f64 = 40.0;

fn speed((mut scene, droplet): (Scene<AnyFlow>, Handle<ActiveDroplet>)) -> f64 {
    scene.run(STEADY).go().expect("a good swimmer");
    scene.observe(droplet).expect("a good swimmer").speed()
}

/// Far finer than anything that is recommended.
fn fine(settings: &Swimmer) -> Swimmer {
    Swimmer {
        method: Method::BoundaryIntegral,
        nodes: 96,
        concentration_cells: 512,
        step: StepSize::OfLimit(0.5),
        ..settings.clone()
    }
}

/// Errors of the recommended settings for three targets; `scene` turns settings into a scene that is not in the data.
fn check(kind: SceneKind, method: Method, targets: &[f64], scene: impl Fn(Swimmer) -> Swimmer) {
    let run = |swimmer: Swimmer| {
        let built = match kind {
            SceneKind::Channel => swimmer.build_in_channel(Drive::ZeroGradient),
            _ => swimmer.build(),
        };
        speed(built.expect("a good swimmer"))
    };
    let exact = run(fine(&scene(Swimmer::default())));
    for &target in targets {
        let found = run(scene(recommend(kind, method, target).expect("a measured target")));
        let error = found / exact - 1.0;
        println!("{kind:?} {method:?} target {target}: error {error:.2e}");
        assert!(error.abs() < target, "{kind:?} {method:?} target {target}: error {error:.2e}");
    }
}

#[test]
fn in_a_box() {
    // Another activity, box, excluded volume and heading.
    let scene =
        |settings| Swimmer { activity: -3.0, excluded_volume: 7.0, lengths: [6.6, 6.6], angle: 0.4, ..settings };
    check(SceneKind::Box, Method::BoundaryIntegral, &[0.01, 0.003, 0.001], scene);
    check(SceneKind::Box, Method::ImmersedBoundary, &[0.01, 0.001], scene);
}

#[test]
fn with_a_contrast() {
    let scene = |settings| Swimmer {
        activity: -1.5,
        excluded_volume: 3.0,
        viscosity: 6.0,
        viscosity_inside: Some(100.0),
        lengths: [6.0, 6.0],
        ..settings
    };
    check(SceneKind::ViscosityContrast, Method::BoundaryIntegral, &[0.01, 0.003], scene);
    check(SceneKind::ViscosityContrast, Method::ImmersedBoundary, &[0.01], scene);
}

#[test]
fn in_a_channel() {
    let scene = |settings| Swimmer { activity: -2.4, lengths: [11.2, 2.8], ..settings };
    check(SceneKind::Channel, Method::BoundaryIntegral, &[0.01, 0.003], scene);
    check(SceneKind::Channel, Method::ImmersedBoundary, &[0.01], scene);
}

#[test]
fn targets_out_of_range_are_refused() {
    for target in [1e-5, 0.2, 0.0, -1.0, f64::NAN] {
        let refused = recommend(SceneKind::Channel, Method::ImmersedBoundary, target);
        assert!(matches!(refused, Err(SetupError::TargetError { .. })), "{target}");
    }
}
