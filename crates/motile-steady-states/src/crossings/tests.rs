use motile::prelude::*;
use num_complex::Complex64;

use super::*;

/// Special points are one if they are of one kind, at one value, of one state, and of modes that swing alike.
#[test]
fn points_that_differ_in_anything_are_two() {
    let method = Method::Integral(IntegralMethod { nodes: 16, elements: 128 });
    let droplets = vec![DropletSetup::contractile(-0.2, 10.0)];
    let setup = Setup { method, region: Region::Plane, droplets, ..Setup::default() };
    let state = SteadyState::uniform(&setup).unwrap();
    let rate = state.diffusion_rate();
    let point = |kind: SpecialKind, value: f64, frequency: f64, symmetry: Symmetry| {
        let mode = Eigenmode { value: Complex64::new(0.0, frequency * rate), symmetry };
        SpecialPoint { kind, value, critical: Critical { state: state.clone(), mode } }
    };
    let hopf = |value: f64, frequency: f64| point(SpecialKind::Hopf, value, frequency, Symmetry::Antisymmetric);
    let one = hopf(-2.0, 3.0);
    assert!(is_same(&one, &hopf(-2.0, 3.0)) && is_same(&one, &hopf(-2.000_1, 3.000_05)));
    assert!(!is_same(&one, &hopf(-2.0, 3.001)) && !is_same(&one, &hopf(-2.0, 2.9)));
    assert!(!is_same(&one, &hopf(-2.01, 3.0)));
    assert!(!is_same(&one, &point(SpecialKind::Hopf, -2.0, 3.0, Symmetry::Symmetric)));
    assert!(!is_same(&one, &point(SpecialKind::BranchPoint, -2.0, 3.0, Symmetry::Antisymmetric)));
}
