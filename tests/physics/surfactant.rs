//! Drops with insoluble surfactant in weak flows, against first-order theory.

use motile::setup::FlowSetup;
use motile_tests::validation::imposed::{EXTENSION, SHEAR};
use motile_tests::validation::order;
use motile_tests::validation::surfactant::{Drop, Response};

const CAPILLARY: [f64; 3] = [0.04, 0.02, 0.01];

/// The distance from first-order theory is of second order in the capillary number. Without that order, at no capillary
/// number, the theory is met.
fn assert_response(what: &str, drop: Drop, theory: Response, run: &dyn Fn(f64) -> Response, quantities: usize) {
    let found = CAPILLARY.map(run);
    for (k, name) in Response::NAMES.into_iter().enumerate().take(quantities) {
        let errors = found.map(|found| found.list()[k] / theory.list()[k] - 1.0);
        let order = order(&CAPILLARY, &errors);
        assert!((1.85..2.15).contains(&order), "{what} {drop:?} {name}: {errors:?}");
        let limit = (4.0 * errors[2] - errors[1]) / 3.0;
        assert!(limit.abs() < 4e-4, "{what} {drop:?} {name}: {limit:e} {errors:?}");
    }
}

#[test]
fn drops_in_the_plane() {
    for ratio in [0.1, 1.0, 10.0] {
        for elasticity in [0.2, 0.5] {
            let drop = Drop { ratio, elasticity, diffusion: 0.1 };
            let run = |flow: FlowSetup, ca: f64| drop.plane(flow, ca, 32).expect("a steady drop");
            let extend = |ca: f64| run(FlowSetup { extension: ca, ..EXTENSION }, ca);
            assert_response("extension", drop, drop.plane_theory(), &extend, 3);
            let shear = |ca: f64| run(FlowSetup { shear: ca, ..SHEAR }, ca);
            assert_response("shear", drop, drop.plane_theory().half(), &shear, 2);
        }
    }
}

#[test]
fn axisymmetric_drops() {
    for elasticity in [0.0, 0.5, 10.0] {
        let drop = Drop { ratio: 1.0, elasticity, diffusion: 0.1 };
        let run = |ca: f64| drop.space(ca, 32, 64).expect("a run");
        assert_response("space", drop, drop.space_theory(), &run, 2);
    }
}

/// Limits of the theory: Taylor's drop, and a surface that surfactant holds.
#[test]
fn limits_of_the_theory() {
    for ratio in [0.0, 0.3, 1.0, 20.0] {
        let clean = Drop { ratio, elasticity: 0.0, diffusion: 0.1 }.space_theory();
        assert!((clean.deformation - 1.5 * (16.0 + 19.0 * ratio) / (16.0 + 16.0 * ratio)).abs() < 1e-13);
        let held = Drop { ratio, elasticity: 1e9, diffusion: 0.1 }.space_theory();
        assert!((held.deformation - 15.0 / 8.0).abs() < 1e-6 && held.speed < 1e-8, "{held:?}");
    }
}
