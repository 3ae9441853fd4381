//! Sensitivities of branch points, Hopf points and folds: how far they move if a parameter of the scene changes.

use motile::prelude::*;
use motile_steady_states::{Continuation, Critical, Parameter as P, Sensitivities, SpecialKind, SteadyState, Symmetry};

fn setup(region: Region, activity: f64, nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    Setup { method, region, droplets: vec![DropletSetup::contractile(activity, 10.0)], ..Setup::default() }
}

/// Returns a critical value and its frequency, corrected for the growth rate that is left, which is not quite zero.
fn corrected(critical: &Critical, along: P) -> [f64; 2] {
    let mode = &critical.mode;
    let found = critical.state.sensitivities_by(&[along], std::slice::from_ref(mode)).expect("as described");
    let [of_growth, of_frequency] = ["growth_rate", "frequency"].map(|name| found.derivative(name, along));
    let change = -mode.value.re / of_growth.expect("as described");
    let value = along.get(critical.state.setup()).expect("as described");
    [value + change, mode.value.im + of_frequency.unwrap_or(0.0) * change]
}

/// Derivative of a critical value and its frequency by a parameter: central differences of critical points, of fourth
/// order.
fn difference(critical: &Critical, along: P, parameter: P) -> [f64; 2] {
    let value = parameter.get(critical.state.setup()).expect("as described");
    let at = |by: f64| {
        let found = critical.curve([along, parameter], [value + by], |_| {}).expect("as described");
        corrected(&found[0], along)
    };
    let slope = |step: f64| {
        let (above, below) = (at(step), at(-step));
        [0, 1].map(|k| (above[k] - below[k]) / (2.0 * step))
    };
    let step = 2e-3 * value.abs();
    let (fine, coarse) = (slope(step), slope(2.0 * step));
    [0, 1].map(|k| (4.0 * fine[k] - coarse[k]) / 3.0)
}

/// Checks how a critical value, and its frequency if it has one, moves with some parameters.
fn agrees(critical: &Critical, along: P, parameters: &[P], tolerance: f64) -> Sensitivities {
    let found = critical.sensitivities(along).expect("as described");
    for &parameter in parameters {
        let expected = difference(critical, along, parameter);
        let value = parameter.get(critical.state.setup()).expect("as described");
        for ((name, size), expected) in found.observables.iter().zip(expected) {
            let ours = found.derivative(name, parameter).expect("as described");
            // Changes in percent per percent.
            let error = (ours - expected) * value / size;
            println!("{name} by {}: {:.6} {error:.1e}", parameter.name(), ours * value / size);
            assert!(error.abs() < tolerance, "{name} by {}: {ours} {expected}", parameter.name());
        }
    }
    found
}

#[test]
fn thresholds_in_a_channel_and_a_box() {
    let channel = Region::Channel { length: 6.0, width: 4.0, drive: Drive::ZeroGradient };
    let regions = [(channel, [P::Width, P::Length]), (Region::Box { lengths: [5.0, 7.0] }, [P::BoxX, P::BoxY])];
    for (region, of_region) in regions {
        let mut scene = setup(region, -0.45, 24);
        scene.droplets[0].viscosity = Some(60.0);
        let rest = SteadyState::uniform(&scene).unwrap();
        let spectrum = rest.spectrum().unwrap();
        let mode = spectrum.modes.iter().find(|mode| mode.symmetry == Symmetry::Symmetric).unwrap();
        let critical = rest.critical(mode, P::Activity).unwrap();
        let parameters = [&[P::Diffusion, P::ViscosityInside, P::ViscosityOutside], &of_region[..]].concat();
        agrees(&critical, P::Activity, &parameters, 3e-7);
    }
}

/// Swimmers in a channel begin to swing: the activity and the frequency there.
#[test]
fn a_hopf_point() {
    let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient };
    let state = SteadyState::find(&setup(region, -2.55, 64)).unwrap();
    let spectrum = state.spectrum().unwrap();
    let swing = spectrum.modes.iter().find(|mode| mode.value.im > 0.0 && mode.symmetry == Symmetry::Antisymmetric);
    let hopf = state.critical(swing.unwrap(), P::Activity).unwrap();
    // The Jacobian is made of differences, with an error of about 1e-7 of the rates; the growth rate changes by a
    // hundredth of these per percent of the activity.
    let found = agrees(&hopf, P::Activity, &[P::ViscosityInside, P::Diffusion, P::Width], 5e-5);
    assert_eq!(found.observables[1].0, "frequency");
    // In other units of force, the critical activity changes in proportion, and the frequency does not.
    let sum = |observable: &str, parameters: &[P]| -> f64 {
        parameters.iter().map(|one| found.logarithmic(observable, *one).unwrap()).sum()
    };
    let stresses = [P::ExcludedVolume, P::Tension, P::ViscosityInside, P::ViscosityOutside];
    let ours = [sum("activity", &stresses), sum("frequency", &stresses)];
    println!("{ours:?}");
    assert!((ours[0] - 1.0).abs() < 5e-6 && ours[1].abs() < 5e-6, "{ours:?}");
}

/// A drop in extension is drawn out without end beyond a fold, at a rate E that is a function of the ratio of the
/// viscosities times gamma/(eta R).
#[test]
fn a_fold() {
    let fold = |inside: f64| -> Critical {
        let flow = FlowSetup { extension: 0.15, ..FlowSetup::default() };
        let drop = DropletSetup { viscosity: Some(inside), ..DropletSetup::passive(1.0) };
        let scene = Setup { flow, viscosity: 1.0, droplets: vec![drop], ..setup(Region::Plane, 0.0, 64) };
        let start = SteadyState::find(&scene).unwrap();
        let along = Continuation { largest_step: 0.1, ..Continuation::new(P::ExtensionRate, 0.15, 0.4) };
        let is_fold = |kind: SpecialKind| kind == SpecialKind::Fold;
        let branch = along.follow(&start, |_, special| !special.iter().any(|one| is_fold(one.kind))).unwrap();
        branch.special.into_iter().find(|one| is_fold(one.kind)).expect("a fold").critical
    };
    let critical = fold(1.0);
    let rate = P::ExtensionRate.get(critical.state.setup()).unwrap();
    let found = critical.sensitivities(P::ExtensionRate).unwrap();
    let percent = |parameter: P| found.logarithmic("extension", parameter).unwrap();
    let viscosities = percent(P::ViscosityInside) + percent(P::ViscosityOutside);
    // The radius moves nodes against the tip of the drop, which 48 nodes know to 3e-5 and 32 not at all.
    for (ours, exact, tolerance) in
        [(percent(P::Tension), 1.0, 1e-9), (viscosities, -1.0, 1e-9), (percent(P::Radius), -1.0, 1e-6)]
    {
        assert!((ours - exact).abs() < tolerance, "{ours} {exact}");
    }
    let at = |inside: f64| P::ExtensionRate.get(fold(inside).state.setup()).unwrap();
    let expected = (at(1.01) - at(0.99)) / 0.02;
    let error = percent(P::ViscosityInside) - expected / rate;
    println!("fold at {rate}, by the viscosity {:.5}, error {error:.1e}", percent(P::ViscosityInside));
    assert!(error.abs() < 1e-4, "{error}");
}
