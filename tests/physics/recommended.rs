//! Recommended settings hold what they promise where they were not measured.

use motile::ib_core::StepSize;
use motile::{DropletSetup, MethodKind, Region, Setup};
use motile::{Recommendation, SceneKind, SetupError, recommend};
use motile_tests::validation::scene::{open_channel, without_grid};
use motile_tests::validation::swimmers::speeds;

const STEADY: f64 = 40.0;
const KINDS: [MethodKind; 2] = [MethodKind::Integral, MethodKind::Grid];

/// The default scene with the recommended method and step.
fn recommended(kind: SceneKind, method: MethodKind, target: f64) -> Result<Setup, SetupError> {
    let Recommendation { method, step } = recommend(kind, method, target)?;
    Ok(Setup { method, step, ..Setup::default() })
}

/// Errors of the recommended settings for targets by boundary integrals and on a grid; `scene` is not in the data.
fn check(kind: SceneKind, targets: [&[f64]; 2], scene: &Setup) {
    let speed = |settings: &Setup| {
        let setup = Setup { method: settings.method, step: settings.step, ..scene.clone() };
        speeds(&setup, &[STEADY]).expect("a good swimmer")[0]
    };
    // Far finer than anything that is recommended.
    let exact = speed(&Setup { step: StepSize::OfLimit(0.5), ..without_grid(96, 512) });
    for (method, targets) in KINDS.into_iter().zip(targets) {
        for &target in targets {
            let found = speed(&recommended(kind, method, target).expect("a measured target"));
            let error = found / exact - 1.0;
            println!("{kind:?} {method:?} target {target}: error {error:.2e}");
            assert!(error.abs() < target, "{kind:?} {method:?} target {target}: error {error:.2e}");
        }
    }
}

#[test]
fn in_a_box() {
    // Another activity, box, excluded volume and heading.
    let droplets = vec![DropletSetup { angle: 0.4, ..DropletSetup::contractile(-3.0, 7.0) }];
    let scene = Setup { region: Region::Box { lengths: [6.6; 2] }, droplets, ..Setup::default() };
    check(SceneKind::Box, [&[0.01, 0.003, 0.001], &[0.01, 0.001]], &scene);
}

#[test]
fn with_a_contrast() {
    let droplets = vec![DropletSetup { viscosity: Some(100.0), ..DropletSetup::contractile(-1.5, 3.0) }];
    let scene = Setup { viscosity: 6.0, droplets, ..Setup::default() };
    check(SceneKind::ViscosityContrast, [&[0.01, 0.003], &[0.01]], &scene);
}

#[test]
fn in_a_channel() {
    let region = open_channel(11.2, 2.8);
    let scene = Setup { region, droplets: vec![DropletSetup::active(-2.4)], ..Setup::default() };
    check(SceneKind::Channel, [&[0.01, 0.003], &[0.01]], &scene);
}

#[test]
fn targets_out_of_range_are_refused() {
    for target in [1e-5, 0.2, 0.0, -1.0, f64::NAN] {
        let refused = recommended(SceneKind::Channel, MethodKind::Grid, target);
        assert!(matches!(refused, Err(SetupError::TargetError { .. })), "{target}");
    }
}
