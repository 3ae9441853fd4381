//! Branches and their special points against exact values.

use motile::prelude::*;
use motile_steady_states::{
    Branch, BranchEnd, Continuation, Critical, Parameter, SpecialKind, SteadyError, SteadyState, Symmetry,
};

fn setup(region: Region, activity: f64, nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    Setup { method, region, droplets: vec![DropletSetup::contractile(activity, 10.0)], ..Setup::default() }
}

fn follow(start: &SteadyState, from: f64, to: f64) -> Branch {
    Continuation::new(Parameter::Activity, from, to).follow(start, |_, _| true).expect("a branch")
}

#[test]
fn a_droplet_in_the_plane_polarises_at_the_threshold_of_linear_theory() {
    let state = SteadyState::uniform(&setup(Region::Plane, -0.3, 32)).unwrap();
    let branch = follow(&state, -0.3, -0.6);
    // The slope of the tension at c0 has to be 2 D (eta_in + eta_ext)/(R0 c0) = 0.4, Cowley (2.20).
    let slope = |activity: f64| {
        let law = DropletSetup::contractile(activity, 10.0).particles.unwrap().law(10.0).unwrap();
        motile::active_interface::Tension::slope(&law, 100.0)
    };
    let symmetries: Vec<_> = branch.special.iter().map(|point| point.critical.mode.symmetry).collect();
    assert_eq!(symmetries, [Symmetry::Symmetric, Symmetry::Antisymmetric]);
    for point in &branch.special {
        let activity = Parameter::Activity.get(point.critical.state.setup()).unwrap();
        assert_eq!(point.kind, SpecialKind::BranchPoint);
        assert!((slope(activity) - 0.4).abs() < 1e-8, "{activity}");
    }
}

#[test]
fn ranges_that_are_empty_or_elsewhere_are_refused() {
    let state = SteadyState::uniform(&setup(Region::Plane, -0.3, 32)).unwrap();
    for (from, to) in [(-0.3, -0.3), (-0.4, -0.6), (-0.3, f64::NEG_INFINITY), (f64::NAN, -0.3)] {
        let outcome = Continuation::new(Parameter::Activity, from, to).follow(&state, |_, _| true);
        let error = outcome.map(drop).unwrap_err();
        let refused = matches!(error, SteadyError::Refused { .. });
        assert!(refused && error.to_string().starts_with("no branch starts at "), "{from} {to}: {error}");
    }
}

#[test]
fn the_branch_of_swimmers_leads_from_the_threshold_to_the_swimmer_that_a_run_finds() {
    let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient };
    let rest = follow(&SteadyState::uniform(&setup(region, -0.3, 64)).unwrap(), -0.3, -0.6);
    let threshold = rest.special.iter().find(|point| point.critical.mode.symmetry == Symmetry::Symmetric).unwrap();
    let swimmers = Continuation::new(Parameter::Activity, -0.3, -1.0);
    let branch = swimmers.switch(threshold, true, |_, _| true).unwrap();
    let last = branch.points.last().unwrap();
    let direct = SteadyState::find(&setup(region, last.value, 64)).unwrap();
    let speeds = [&last.state, &direct].map(|state| state.measured().unwrap().speed);
    assert!((speeds[0] / speeds[1] - 1.0).abs() < 1e-4, "{speeds:?}");
    assert!(matches!(branch.end, BranchEnd::Range) && (last.value + 1.0).abs() < 1e-12, "{}", last.value);
}

#[test]
fn swings_across_a_channel_begin_at_a_hopf_point() {
    let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient };
    let state = SteadyState::find(&setup(region, -2.45, 128)).unwrap();
    let branch = follow(&state, -2.45, -2.7);
    let [hopf] = branch.special.as_slice() else { panic!("{:?}", branch.special.len()) };
    assert_eq!(hopf.kind, SpecialKind::Hopf);
    // The straight line between the growth rates on both sides.
    let growth = |activity: f64| {
        let state = SteadyState::find(&setup(region, activity, 128)).unwrap();
        state.spectrum().unwrap().of(Symmetry::Antisymmetric).find(|z| z.im > 0.0).unwrap().re
    };
    let (a, b) = (growth(-2.55), growth(-2.58));
    let line = -2.55 - 0.03 * a / (a - b);
    let found = Parameter::Activity.get(hopf.critical.state.setup()).unwrap();
    assert!((found - line).abs() < 5e-4, "{found} {line}");
}

#[test]
#[ignore = "takes two minutes; .ci/release runs it"]
fn a_narrow_channel_has_a_fold_beyond_which_no_swimmer_is() {
    let region = Region::Channel { length: 12.0, width: 2.05, drive: Drive::ZeroGradient };
    let start = SteadyState::find(&setup(region, -7.1, 64)).unwrap();
    let settings = Continuation { largest_step: 0.2, ..Continuation::new(Parameter::Activity, -7.1, -7.6) };
    // Until it has turned back.
    let branch = settings.follow(&start, |_, special| special.iter().all(|point| point.kind != SpecialKind::Fold));
    let branch = branch.unwrap();
    assert!(matches!(branch.end, BranchEnd::Stopped), "{}", branch.end);
    let fold = branch.special.iter().find(|point| point.kind == SpecialKind::Fold).unwrap();
    let at = Parameter::Activity.get(fold.critical.state.setup()).unwrap();
    // 96 and 128 nodes have it at -7.306, and a mode of the symmetry of the state that does neither grow nor decay.
    assert!((at + 7.306).abs() < 5e-3, "{at}");
    let Critical { state, mode, .. } = &fold.critical;
    assert!(mode.symmetry == Symmetry::Symmetric && mode.value.norm() < 1e-3, "{}", mode.value);
    // Near a fold the distance of the two branches is the square root of that to the fold.
    let speed = |k: usize| branch.points[k].state.measured().unwrap().speed;
    let (last, values) = (branch.points.len() - 1, branch.points.iter().map(|point| point.value));
    assert!(values.fold(f64::INFINITY, f64::min) > at - 1e-6);
    assert!((speed(last) - state.measured().unwrap().speed) * (speed(0) - state.measured().unwrap().speed) < 0.0);
}

#[test]
#[ignore = "takes a minute; .ci/release runs it"]
fn a_long_step_does_not_pass_over_a_branch_point() {
    // In width 2 another antisymmetric mode is next to zero growth at both ends of the step; 128 nodes find 74.66.
    let region = Region::Channel { length: 71.6, width: 2.0, drive: Drive::ZeroGradient };
    let start = SteadyState::find(&setup(region, -2.0, 64)).unwrap();
    let settings =
        Continuation { largest_step: 5.0, most_points: 2, ..Continuation::new(Parameter::Length, 71.6, 80.2) };
    let branch = settings.follow(&start, |_, _| true).unwrap();
    let lengths: Vec<f64> = branch.points.iter().map(|point| point.value).collect();
    assert!(lengths.len() == 2 && lengths[1] > 75.5, "{lengths:?}");
    let [point] = branch.special.as_slice() else { panic!("{:?}", branch.special.len()) };
    let at = Parameter::Length.get(point.critical.state.setup()).unwrap();
    assert!(point.kind == SpecialKind::BranchPoint && (at - 74.66).abs() < 0.05, "{at}");
}

#[test]
fn a_branch_of_swimmers_ends_at_rest_at_the_threshold_and_not_in_a_fold() {
    let region = Region::Plane;
    let rest = follow(&SteadyState::uniform(&setup(region, -0.35, 48)).unwrap(), -0.35, -0.5);
    let swimmer = SteadyState::find(&setup(region, -0.45, 48)).unwrap();
    let branch = follow(&swimmer, -0.45, -0.3);
    assert!(matches!(branch.end, BranchEnd::Rest), "{}", branch.end);
    let [point] = branch.special.as_slice() else { panic!("{:?}", branch.special.len()) };
    let [found, exact] =
        [point, &rest.special[0]].map(|point| Parameter::Activity.get(point.critical.state.setup()).unwrap());
    assert!(point.kind == SpecialKind::BranchPoint && (found - exact).abs() < 1e-7, "{found} {exact}");
}

#[test]
fn swimmers_across_branch_off_where_those_along_do_and_are_as_fast() {
    let rest = follow(&SteadyState::uniform(&setup(Region::Plane, -0.35, 48)).unwrap(), -0.35, -0.5);
    let across = rest.special.iter().find(|point| point.critical.mode.symmetry == Symmetry::Antisymmetric).unwrap();
    let swimmers = Continuation { largest_step: 0.2, ..Continuation::new(Parameter::Activity, -0.35, -0.6) };
    let branch = swimmers.switch(across, true, |_, _| true).unwrap();
    let last = &branch.points.last().unwrap().state;
    let along = SteadyState::find(&setup(Region::Plane, -0.6, 48)).unwrap();
    assert!(!last.is_mirror_symmetric() && last.velocity().x.abs() < 1e-7, "{}", last.velocity());
    // Up or down, with the mode or against it.
    let first = |with: bool| swimmers.switch(across, with, |_, _| false).unwrap().points[0].state.velocity().y;
    assert!(first(true) * first(false) < 0.0, "{} {}", first(true), first(false));
    let speeds = [last, &along].map(|state| state.measured().unwrap().speed);
    // The error of 48 nodes, which stand elsewhere.
    assert!((speeds[0] / speeds[1] - 1.0).abs() < 5e-6, "{speeds:?}");
}

#[test]
fn the_threshold_over_the_excluded_volume_is_that_of_linear_theory() {
    let rest = follow(&SteadyState::uniform(&setup(Region::Plane, -0.35, 32)).unwrap(), -0.35, -0.5);
    let strengths = [12.0, 30.0, 100.0, 200.0];
    let parameters = [Parameter::Activity, Parameter::ExcludedVolume];
    let curve = rest.special[0].critical.curve(parameters, strengths, |_| {}).unwrap();
    assert_eq!(curve.len(), strengths.len());
    for (critical, strength) in curve.iter().zip(strengths) {
        let activity = Parameter::Activity.get(critical.state.setup()).unwrap();
        let law = DropletSetup::contractile(activity, strength).particles.unwrap().law(10.0).unwrap();
        let slope = motile::active_interface::Tension::slope(&law, 100.0);
        assert!((slope - 0.4).abs() < 1e-8, "{strength}: {activity}, {slope}");
    }
}

#[test]
fn both_branch_points_of_the_plane_are_found_at_any_number_of_nodes() {
    for nodes in [32, 48, 64, 96] {
        let state = SteadyState::uniform(&setup(Region::Plane, -0.35, nodes)).unwrap();
        let branch = follow(&state, -0.35, -0.5);
        let symmetries: Vec<_> = branch.special.iter().map(|point| point.critical.mode.symmetry).collect();
        assert_eq!(symmetries, [Symmetry::Symmetric, Symmetry::Antisymmetric], "{nodes} nodes");
    }
}

#[test]
fn a_droplet_at_rest_that_may_be_shifted_across_a_channel_has_no_branch_points_but_the_thresholds() {
    let region = Region::Channel { length: 12.0, width: 3.0, drive: Drive::ZeroGradient };
    let rest = SteadyState::uniform(&setup(region, -0.2, 32)).unwrap();
    let viscosity = Continuation::new(Parameter::ViscosityInside, 100.0, 10.0);
    let branch = viscosity.follow(&rest, |_, _| true).unwrap();
    assert!(branch.special.is_empty(), "{:?}", branch.special.len());
}

/// A droplet at rest may be shifted across a channel: that neutral mode takes no crossing of another for its own.
#[test]
fn every_special_point_of_a_droplet_at_rest_in_a_channel_is_a_crossing() {
    for (length, width) in [(12.0, 5.0), (6.0, 4.0)] {
        let region = Region::Channel { length, width, drive: Drive::ZeroGradient };
        let rest = SteadyState::uniform(&setup(region, -0.3, 32)).unwrap();
        let branch = Continuation { largest_step: 0.1, ..Continuation::new(Parameter::Activity, -0.3, -0.9) }
            .follow(&rest, |_, _| true)
            .unwrap();
        let of = |symmetry| branch.special.iter().filter(|point| point.critical.mode.symmetry == symmetry).count();
        assert!(of(Symmetry::Symmetric) >= 1 && of(Symmetry::Antisymmetric) >= 1, "{}", branch.special.len());
        for point in &branch.special {
            let growing = |activity: f64| {
                let spectrum = SteadyState::uniform(&setup(region, activity, 32)).unwrap().spectrum().unwrap();
                spectrum.of(point.critical.mode.symmetry).filter(|z| z.re > 1e-6).count()
            };
            let sides = [1.0 - 1e-3, 1.0 + 1e-3].map(|factor| growing(factor * point.value));
            println!("{length} {width}: {} {} {sides:?}", point.value, point.critical.mode.symmetry.name());
            assert!(sides[0] != sides[1], "{length} {width}: {} {sides:?}", point.value);
        }
    }
}

/// A ratio of viscosities is that of the inside to the outside; another one keeps their sum, on which speeds depend.
#[test]
fn a_ratio_of_viscosities_keeps_their_sum() {
    let ratio = Parameter::ViscosityRatio;
    let droplets = vec![DropletSetup { viscosity: Some(6.0), ..DropletSetup::default() }];
    let setup = Setup { viscosity: 2.0, droplets, ..Setup::default() };
    assert_eq!(ratio.get(&setup), Some(3.0));
    let other = ratio.with(&setup, 0.25).unwrap();
    assert_eq!((ratio.get(&other), other.viscosity, other.droplets[0].viscosity), (Some(0.25), 6.4, Some(1.6)));
    assert_eq!(ratio.get(&Setup { viscosity: 2.0, ..Setup::default() }), Some(1.0));
}
