//! Steady states in other units: SI numbers of a droplet of a micrometre.

use motile::prelude::*;
use motile::setup::{DropletShape, ExcludedVolume};
use motile_steady_states::{Continuation, Parameter, SteadyState, Symmetry};

/// Sizes of the units of length, time and force.
#[derive(Debug, Clone, Copy)]
struct Units {
    length: f64,
    time: f64,
    force: f64,
}

/// A droplet in a region, in units.
fn scene(activity: f64, region: Region, cortex: f64, nodes: usize, units: Units) -> Setup {
    let Units { length, time, force } = units;
    let space = matches!(region, Region::Space | Region::Tube { .. });
    // Tensions are forces in two dimensions, and forces per length in three.
    let tension = if space { force / length } else { force };
    let concentration = if space { length.powi(-2) } else { length.recip() };
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    let mut setup = Setup { method, region, ..Setup::default() };
    setup.viscosity *= tension * time / length;
    let droplet = &mut setup.droplets[0];
    droplet.tension *= tension;
    droplet.cortex.viscosity = cortex * tension * time;
    droplet.shape = DropletShape::Round { radius: length };
    let particles = droplet.particles.as_mut().expect("a good scene");
    particles.activity = activity * tension / concentration;
    particles.concentration *= concentration;
    particles.diffusion *= length * length / time;
    particles.excluded_volume = ExcludedVolume::Step(if space { 2.0 } else { 10.0 } * tension / concentration);
    setup
}

const ONE: Units = Units { length: 1.0, time: 1.0, force: 1.0 };
const SI: Units = Units { length: 1e-6, time: 37.0, force: 3.1e-13 };

/// Speed and growth rates at rest and swimming, in units of the scene.
fn values(activity: f64, region: Region, cortex: f64, units: Units) -> Vec<f64> {
    let setup = scene(activity, region, cortex, 64, units);
    let rest = SteadyState::uniform(&setup).expect("a good scene").spectrum().expect("a good scene");
    let mut values: Vec<f64> = rest.of(Symmetry::Symmetric).map(|z| z.re * units.time).take(4).collect();
    let found = SteadyState::find(&setup);
    let state = found.unwrap_or_else(|error| panic!("{region:?} in {units:?}: {error}"));
    // Once more from the state itself.
    let near = SteadyState::near(&setup, state.profile(), state.velocity(), true).expect("a good scene");
    values
        .extend([&state, &near].map(|state| state.measured().expect("a good scene").speed * units.time / units.length));
    let spectrum = near.spectrum().expect("a good scene");
    values.extend(spectrum.of(Symmetry::Symmetric).take(4).flat_map(|z| [z.re, z.im]).map(|part| part * units.time));
    let measured = near.measured().expect("a good scene");
    values.extend([measured.aspect_ratio, measured.concentration[0]]);
    values
}

#[test]
fn states_are_the_same_in_other_units() {
    for (region, si, activity, cortex) in [
        (Region::Plane, Region::Plane, -2.0, 50.0),
        (Region::Box { lengths: [6.0; 2] }, Region::Box { lengths: [6e-6; 2] }, -2.0, 0.0),
        (Region::Space, Region::Space, -1.5, 0.0),
        (Region::Space, Region::Space, -1.5, 50.0),
    ] {
        let (here, there) = (values(activity, region, cortex, ONE), values(activity, si, cortex, SI));
        let errors: Vec<f64> = here.iter().zip(&there).map(|(a, b)| (a - b).abs()).collect();
        let worst = errors.iter().copied().fold(0.0, f64::max);
        println!("{region:?} {cortex}: {worst:.1e}");
        assert!(worst < 1e-8, "{region:?}: {errors:?}");
    }
}

/// Thresholds of a branch at rest, growth rates there and the derivative of the threshold by the diffusion constant,
/// and speeds along the branch of swimmers, in units of the scene.
fn of_branches(region: Region, units: Units) -> Vec<f64> {
    let unit = units.force * units.length;
    let scene = |activity: f64| scene(activity, region, 0.0, 32, units);
    let rest = SteadyState::uniform(&scene(-0.35)).expect("a good scene");
    let along = |from: f64, to: f64| Continuation::new(Parameter::Activity, from * unit, to * unit);
    let branch = along(-0.35, -0.5).follow(&rest, |_, _| true).expect("a branch");
    let mut values: Vec<f64> = branch.special.iter().map(|point| point.value / unit).collect();
    let threshold = branch.special.first().expect("a threshold");
    let found = threshold.critical.sensitivities(Parameter::Activity).expect("a threshold");
    let by_diffusion = found.derivative("activity", Parameter::Diffusion).expect("diffusion");
    values.push(by_diffusion / unit * units.length * units.length / units.time);
    let swimmers = along(-0.35, -0.5).switch(threshold, true, |point, _| point.value > -0.47 * unit);
    let swimmers = swimmers.expect("a branch");
    let first = &swimmers.points.first().expect("a swimmer").state;
    // At a value of the parameter, since the steps are not the same.
    let swimmer = first.at(Parameter::Activity, -0.45 * unit).expect("a swimmer");
    values.push(swimmer.measured().expect("a swimmer").speed * units.time / units.length);
    values
}

#[test]
fn thresholds_and_branches_are_the_same_in_other_units() {
    let metres = Units { length: 1e-5, time: 10.0, force: 1e-9 };
    let here = of_branches(Region::Plane, ONE);
    assert_eq!(here.len(), 4);
    // -(2 D/(R c0)) (eta_in + eta_ext) less the excluded volume, and its derivative by D.
    assert!((here[0] + 0.4 + 4.539787e-4).abs() < 1e-7 && (here[2] + 4.0).abs() < 1e-6, "{here:?}");
    for units in [SI, metres] {
        let there = of_branches(Region::Plane, units);
        let errors: Vec<f64> = here.iter().zip(&there).map(|(a, b)| (a - b).abs()).collect();
        println!("{units:?}: {errors:?}");
        assert!(errors.iter().all(|error| *error < 1e-7), "{here:?} {there:?}");
    }
}

/// Differences by a parameter far below its natural size must not reach across zero. With the default values, a droplet
/// with a radius of 1e-6 is such a scene: particles diffuse along it at once, so it rests, and what has no value has
/// none in the table either.
#[test]
fn sensitivities_exist_if_values_are_far_below_their_natural_size() {
    let mut setup = Setup { region: Region::Box { lengths: [6.0, 6.0] }, ..Setup::default() };
    setup.droplets[0] = DropletSetup::contractile(-2.0, 10.0);
    setup.droplets[0].shape = DropletShape::Round { radius: 1e-6 };
    let rest = SteadyState::uniform(&setup).expect("a state");
    let leading = rest.spectrum().expect("a spectrum").modes[0].clone();
    let found = rest.sensitivities_with(&[leading]).expect("sensitivities");
    let of = |observable: &str, parameter| found.derivative(observable, parameter).expect("an entry");
    assert!((of("perimeter", Parameter::Radius) / std::f64::consts::TAU - 1.0).abs() < 1e-9);
    // All rates are those of tension over viscosity and radius.
    let by_radius = found.logarithmic("growth_rate", Parameter::Radius).expect("a rate");
    assert!((by_radius + 1.0).abs() < 1e-5, "{by_radius}");
    assert_eq!(found.logarithmic("speed", Parameter::Activity), None);
    assert_eq!(found.logarithmic("stresslet", Parameter::BoxX), None);
    let text = found.to_string();
    assert!(text.contains("1.000e-6"), "{text}");
}
