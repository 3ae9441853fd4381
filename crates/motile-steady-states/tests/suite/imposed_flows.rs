//! Clean drops in imposed flows: steady shapes, their growth rates, and the turning points of extension.

use std::f64::consts::PI;

use motile::base::Region;
use motile::prelude::*;
use motile::setup::{FibreSetup, ShellSetup};
use motile_steady_states::{Branch, BranchPoint, Continuation, Parameter, SpecialKind, SteadyState, Symmetry};

const SHEAR: FlowSetup = FlowSetup { shear: 1.0, extension: 0.0, rotation: 0.0, poiseuille: None, wall_velocity: None };
const EXTENSION: FlowSetup = FlowSetup { shear: 0.0, extension: 1.0, ..SHEAR };

/// A clean drop of radius 1 in fluid of unit viscosity.
fn drop_in(flow: FlowSetup, ratio: f64, capillary: f64, nodes: usize) -> Setup {
    Setup {
        region: Region::Plane,
        viscosity: 1.0,
        flow,
        method: Method::Integral(IntegralMethod { nodes, elements: nodes }),
        droplets: vec![DropletSetup { viscosity: Some(ratio), ..DropletSetup::passive(1.0 / capillary) }],
        ..Setup::default()
    }
}

/// Deformation, angle (degrees), largest and smallest radius, speed and curvature at the tip, period and stresslet: the
/// values of tests/reference/imposed_flows.csv, to ten digits.
#[test]
fn steady_drops_in_shear() {
    for (ratio, capillary, expected) in [
        (
            1.0,
            0.1,
            [
                0.0992714640356,
                39.3304935426,
                1.10467746384,
                0.905158085496,
                0.443828829743,
                1.34730658864,
                14.7259063223,
                0.922987761262,
                4.60332489112,
            ],
        ),
        (
            1.0,
            0.3,
            [
                0.283345263204,
                29.1597287666,
                1.33515197449,
                0.745554394823,
                0.322006879697,
                2.31629205782,
                16.4671133776,
                2.38935770611,
                3.89503207393,
            ],
        ),
        (
            10.0,
            0.1,
            [
                0.0707671099482,
                22.2305855699,
                1.07344641623,
                0.9315580439,
                0.423201215736,
                1.23675264884,
                13.8643199029,
                0.456435820429,
                5.56767296216,
            ],
        ),
    ] {
        let state = SteadyState::find(&drop_in(SHEAR, ratio, capillary, 96)).unwrap();
        let (seen, [[xx, xy], _]) = (state.deformation().unwrap(), state.particle_stress().unwrap());
        let found = [
            seen.by_moments,
            seen.angle_of_moments.unwrap().to_degrees(),
            seen.extents[0],
            seen.extents[1],
            seen.tip_speed,
            seen.tip_curvature,
            seen.period.unwrap(),
            xx,
            xy,
        ];
        for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
            let error = found / expected - 1.0;
            assert!(error.abs() < 1e-7, "{ratio} {capillary}, value {k}: {found} {error:e}");
        }
        assert!(state.velocity().length() < 1e-10 && !state.is_mirror_symmetric());
        let spectrum = state.spectrum().unwrap();
        assert!(spectrum.unstable() == 0 && spectrum.neutral < 1e-6, "{spectrum:?}");
        assert!(SteadyState::near(state.setup(), state.profile(), Vec2::ZERO, true).is_err());
    }
}

/// A disturbance of wave number k of a drop that is hardly deformed relaxes at the rate `gamma k/(2 (eta_in + eta_ext)
/// R)` and is carried around by half the shear rate, but for terms of the second order of the capillary number.
#[test]
fn growth_rates_of_a_round_drop() {
    let (ratio, capillary) = (3.0, 1e-3);
    let spectrum = SteadyState::find(&drop_in(SHEAR, ratio, capillary, 32)).unwrap().spectrum().unwrap();
    let exact = |k: f64| -0.5 * k / ((1.0 + ratio) * capillary);
    for (mode, k) in spectrum.modes.iter().zip(2..5) {
        assert!((mode.value.re / exact(f64::from(k)) - 1.0).abs() < 1e-4, "{k} {mode:?}");
        assert_eq!(mode.symmetry, Symmetry::None);
    }
}

/// Complete elliptic integral of the first kind of a modulus, by the arithmetic-geometric mean.
fn elliptic(modulus: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - modulus * modulus).sqrt());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * PI / a
}

/// A branch in extension from one rate to another, up to its first special point.
fn branch(ratio: f64, [from, to]: [f64; 2], nodes: usize) -> Branch {
    let start = drop_in(FlowSetup { extension: from, ..EXTENSION }, ratio, 1.0, nodes);
    let start = SteadyState::find(&start).expect("a steady drop");
    let continuation = Continuation { largest_step: 0.1, ..Continuation::new(Parameter::ExtensionRate, from, to) };
    continuation.follow(&start, |_, special| special.is_empty()).expect("a branch")
}

/// In extension steady bubbles are ellipses with `Ca = (D/pi) K(D) sqrt(1 - D^2)`.
#[test]
fn bubbles_in_extension() {
    for point in branch(1e-6, [0.1, 0.25], 96).points {
        let d = point.state.deformation().unwrap().by_moments;
        let capillary = d / PI * elliptic(d) * (1.0 - d * d).sqrt();
        assert!((capillary - point.value).abs() < 3e-6, "{} {d} {capillary}", point.value);
        assert_eq!(point.spectrum.unstable(), 0);
    }
}

/// The turning point of drops of the viscosity around them, beyond which they are unstable: 0.183 by independent
/// computations, and the same at two resolutions.
#[test]
fn turning_point_in_extension() {
    let fold = |nodes: usize| {
        let branch = branch(1.0, [0.15, 0.25], nodes);
        let [special] = branch.special.as_slice() else { panic!("{:?}", branch.end) };
        assert_eq!(special.kind, SpecialKind::Fold);
        let unstable = |point: Option<&BranchPoint>| point.map(|point| point.spectrum.unstable());
        assert_eq!((unstable(branch.points.first()), unstable(branch.points.last())), (Some(0), Some(1)));
        (special.value, special.critical.state.deformation().unwrap().by_moments)
    };
    let [coarse, fine] = [fold(64), fold(80)];
    assert!((fine.0 - 0.183).abs() < 5e-4 && (fine.0 - coarse.0).abs() < 1e-6, "{coarse:?} {fine:?}");
    assert!((fine.1 - coarse.1).abs() < 1e-3, "{coarse:?} {fine:?}");
}

#[test]
fn flows_that_no_state_is_steady_in() {
    let drop = drop_in(SHEAR, 1.0, 0.1, 32);
    let refused = SteadyState::uniform(&drop).unwrap_err().to_string();
    assert!(refused.contains("deformed by the imposed flow"), "{refused}");
    let boxed = Setup { region: Region::Box { lengths: [6.0; 2] }, ..drop.clone() };
    let refused = SteadyState::find(&boxed).unwrap_err().to_string();
    assert!(
        refused.contains("images of a sheared box never stop moving") && refused.contains("run the scene"),
        "{refused}"
    );
    let capsule = Setup { droplets: Vec::new(), shells: vec![ShellSetup::default()], ..drop };
    let refused = SteadyState::find(&capsule).unwrap_err().to_string();
    assert!(refused.contains("has a shell") && refused.contains("Run it until"), "{refused}");
    let hairy = Setup { region: Region::Plane, fibres: vec![FibreSetup::default()], ..Setup::default() };
    let refused = SteadyState::find(&hairy).unwrap_err().to_string();
    assert!(refused.contains("the scene has a fibre"), "{refused}");
    let refused = Parameter::ShearRate.with(&Setup::default(), 1.0).unwrap_err().to_string();
    assert!(refused.contains("no parameter shear"), "{refused}");
}

/// Beyond the turning point a drop is drawn out without an end.
#[test]
fn a_drop_beyond_the_turning_point_does_not_converge() {
    let error = SteadyState::find(&drop_in(EXTENSION, 1.0, 0.2, 32)).unwrap_err();
    assert!(matches!(error, motile_steady_states::SteadyError::NoConvergence { .. }), "{error}");
}

/// Deformations that would be round-off are refused.
#[test]
fn tiny_capillary_numbers_are_refused() {
    assert!(SteadyState::find(&drop_in(SHEAR, 1.0, 1e-6, 32)).is_ok());
    for flow in [SHEAR, EXTENSION] {
        let error = SteadyState::find(&drop_in(flow, 1.0, 1e-9, 32)).unwrap_err().to_string();
        assert!(error.starts_with("the capillary number is 1.0e-9: "), "{error}");
    }
}

/// Turning points are at a fixed capillary number, `E eta R/gamma`, and states next to them say so beside their
/// sensitivities.
#[test]
fn sensitivities_at_and_near_the_turning_point() {
    let branch = branch(1.0, [0.17, 0.25], 64);
    let [fold] = branch.special.as_slice() else { panic!("{:?}", branch.end) };
    let found = fold.critical.sensitivities(Parameter::ExtensionRate).unwrap();
    let relative = |parameter| found.logarithmic("extension", parameter).unwrap();
    let viscosities = relative(Parameter::ViscosityInside) + relative(Parameter::ViscosityOutside);
    println!("{found}");
    assert!((relative(Parameter::Tension) - 1.0).abs() < 1e-7, "{}", relative(Parameter::Tension));
    assert!((viscosities + 1.0).abs() < 1e-7, "{viscosities}");
    // Nodes stay where they are if the radius changes.
    assert!((relative(Parameter::Radius) + 1.0).abs() < 1e-3, "{}", relative(Parameter::Radius));
    assert!(found.parameters.iter().all(|entry| entry.parameter != Parameter::ExtensionRate));

    let before = branch.points.iter().rfind(|point| point.spectrum.unstable() == 0).unwrap();
    let near = before.state.at(Parameter::ExtensionRate, 0.9995 * fold.value).unwrap();
    let found = near.sensitivities().unwrap();
    assert!(found.warning.is_some() && found.slowest_relative.abs() < 0.05, "{found}");
    let of_extension = found.parameters.iter().find(|entry| entry.parameter == Parameter::ExtensionRate).unwrap();
    let distance = of_extension.distance.unwrap();
    println!("{found}\n{distance} {}", fold.value - of_extension.value);
    assert!((distance / (fold.value - of_extension.value) - 1.0).abs() < 0.2, "{distance}");
    let aspect = |by: f64| {
        let state = near.at(Parameter::ExtensionRate, of_extension.value + by).unwrap();
        state.measured().unwrap().aspect_ratio
    };
    let slope = |by: f64| (aspect(by) - aspect(-by)) / (2.0 * by);
    let slope = (4.0 * slope(2e-6) - slope(4e-6)) / 3.0;
    let derivative = found.derivative("aspect_ratio", Parameter::ExtensionRate).unwrap();
    assert!((derivative / slope - 1.0).abs() < 1e-4, "{derivative} {slope}");
    // Farther off there is no remark.
    assert!(branch.points[0].state.sensitivities().unwrap().warning.is_none());
}
