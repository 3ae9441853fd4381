//! Recommended settings hold what they promise where they were not measured.

use motile::base::Region;
use motile::scene::StepSize;
use motile::setup::{DropletSetup, Method, MethodKind, Setup};
use motile::{Recommendation, SceneKind, SetupError, recommend};
use motile_tests::validation::scene::{open_channel, without_grid};
use motile_tests::validation::swimmers::speeds;

/// Times at which a swimmer is steady and crosses two cells or so: on a grid its speed oscillates.
const STEADY: [f64; 6] = [40.0, 40.35, 40.7, 41.1, 41.55, 42.0];
const KINDS: [MethodKind; 2] = [MethodKind::Integral, MethodKind::Grid];

/// Errors of the recommended settings for targets by boundary integrals and on a grid; `scene` is not in the data.
fn check(kind: SceneKind, targets: [&[f64]; 2], scene: &Setup) {
    let speed = |method: Method, step: StepSize| {
        speeds(&Setup { method, step, ..scene.clone() }, &STEADY).expect("a good swimmer")
    };
    // Far finer than anything that is recommended.
    let exact = speed(without_grid(96, 512).method, StepSize::Adaptive { tolerance: 1e-5 });
    for (method, targets) in KINDS.into_iter().zip(targets) {
        for &target in targets {
            let Recommendation { method, step, .. } = recommend(kind, method, target).expect("a measured target");
            let found = speed(method, step);
            let errors = found.iter().zip(&exact).map(|(found, exact)| (found / exact - 1.0).abs());
            let error = errors.fold(0.0, f64::max);
            println!("{kind:?} {method:?} target {target}: error {error:.2e}");
            assert!(error < target, "{kind:?} {method:?} target {target}: error {error:.2e}");
        }
    }
}

#[test]
fn in_a_box() {
    // Another activity, box, excluded volume and heading.
    let droplets = vec![DropletSetup { angle: 0.4, ..DropletSetup::contractile(-3.0, 7.0) }];
    let scene = Setup { region: Region::Box { lengths: [6.6; 2] }, droplets, ..Setup::default() };
    check(SceneKind::Box, [&[0.01, 0.003, 0.001], &[0.03, 0.01, 0.003]], &scene);
}

#[test]
fn along_a_line_of_the_grid() {
    // Where the error of a grid is nearly the same at all times, and the mean no better than the worst.
    let scene = Setup { droplets: vec![DropletSetup::contractile(-4.0, 8.0)], ..Setup::default() };
    check(SceneKind::Box, [&[], &[0.008]], &scene);
}

#[test]
fn with_a_contrast() {
    let droplets = vec![DropletSetup { viscosity: Some(100.0), ..DropletSetup::contractile(-1.5, 3.0) }];
    let scene = Setup { viscosity: 6.0, droplets, ..Setup::default() };
    check(SceneKind::ViscosityContrast, [&[0.01, 0.003], &[]], &scene);
    let refused = recommend(SceneKind::ViscosityContrast, MethodKind::Grid, 0.01).unwrap_err().to_string();
    assert!(refused.contains("Use integral or layers"), "{refused}");
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
        let refused = recommend(SceneKind::Channel, MethodKind::Grid, target);
        assert!(matches!(refused, Err(SetupError::TargetError { .. })), "{target}");
        // The smallest that is known is one that may be asked for.
        let Err(SetupError::TargetError { smallest, .. }) = refused else { return };
        assert!(recommend(SceneKind::Channel, MethodKind::Grid, smallest).is_ok());
    }
}
