//! Every number of a scene: either its sensitivity agrees with differences of states, or nothing that is measured
//! depends on it.

use motile::active_interface::Cortex;
use motile::prelude::*;
use motile::setup::{ExchangeSetup, ExcludedVolume, FibreSetup, FieldEntry, FieldsSetup, RigidBodySetup};
use motile_steady_states::{Parameter, Sensitivities, SteadyState};
use toml::Value;

/// Terms that a zero leaves out: they have derivatives from above or none.
const LEFT_OUT: [&str; 5] = [
    "droplets.0.cortex.viscosity",
    "droplets.0.cortex.per-concentration",
    "droplets.0.cortex.shear-viscosity",
    "droplets.0.friction",
    "region.channel.slip.0",
];

/// Observables of all states.
const NAMES: [&str; 6] = ["speed", "stresslet", "aspect_ratio", "c_max", "c_min", "perimeter"];

fn scene(region: Region, activity: f64, nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    let drop = DropletSetup { viscosity: Some(60.0), ..DropletSetup::contractile(activity, 10.0) };
    Setup { method, region, droplets: vec![drop], ..Setup::default() }
}

/// Adds the keys of all numbers of a table, except for whole ones such as numbers of nodes.
fn numbers(value: &Value, at: &str, found: &mut Vec<(String, f64)>) {
    let below = |key: &str| if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") };
    match value {
        Value::Table(table) => table.iter().for_each(|(key, value)| numbers(value, &below(key), found)),
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(k, value)| numbers(value, &below(&k.to_string()), found));
        }
        Value::Float(number) => found.push((at.to_owned(), *number)),
        _ => {}
    }
}

/// Returns the scene with another number at a key; `None` if it is refused.
fn with(whole: &Value, key: &str, number: f64) -> Option<Setup> {
    let mut whole = whole.clone();
    let mut at = &mut whole;
    for part in key.split('.') {
        at = match at {
            Value::Array(list) => list.get_mut(part.parse::<usize>().ok()?)?,
            other => other.get_mut(part)?,
        };
    }
    *at = Value::Float(number);
    Setup::from_toml(&whole.as_table()?.to_string()).ok()
}

fn measured(state: &SteadyState) -> [f64; 6] {
    let seen = state.measured().expect("as described");
    let [most, least] = seen.concentration;
    [seen.speed, seen.stresslet, seen.aspect_ratio, most, least, seen.perimeter]
}

/// Checks all numbers of a scene, and returns how many have sensitivities and how many do not matter.
fn check(setup: &Setup) -> [usize; 2] {
    let whole = Value::Table(setup.to_toml().expect("a text").parse().expect("a table"));
    let mut all = Vec::new();
    numbers(&whole, "", &mut all);
    let state = SteadyState::find(setup).expect("as described");
    let found: Sensitivities = state.sensitivities().expect("as described");
    let here = measured(&state);
    let (mut known, mut idle) = (0, 0);
    for (key, value) in all {
        let Some(entry) = found.parameters.iter().find(|entry| entry.key == key) else {
            let left_out = value == 0.0 && LEFT_OUT.contains(&key.as_str());
            let step = if value == 0.0 { 1e-3 } else { 1e-3 * value.abs() };
            let moved = with(&whole, &key, value + step).filter(|_| !left_out);
            let Some(moved) = moved.and_then(|moved| state.follow(&moved).ok()) else { continue };
            idle += 1;
            for (name, (now, then)) in NAMES.iter().zip(here.iter().zip(measured(&moved))) {
                let change = (then - now).abs() / now.abs().max(1e-3);
                assert!(change < 1e-7, "{name} changes with {key}, which has no sensitivities, by {change:.1e}");
            }
            continue;
        };
        known += 1;
        // By symmetry, what is measured of a drop in extension does not depend on a small shear.
        if value == 0.0 && LEFT_OUT.contains(&key.as_str()) {
            // Derivatives from above have a test of their own.
            assert!(entry.derivatives.iter().all(|derivative| derivative.is_finite()), "{key}");
            continue;
        }
        if value == 0.0 {
            assert!(
                entry.derivatives.iter().all(|derivative| derivative.abs() < 1e-7),
                "{key}: {:?}",
                entry.derivatives
            );
            continue;
        }
        let slope = |step: f64| {
            let ends = [step, -step].map(|by| {
                // The key is that of the parameter.
                let moved = with(&whole, &key, value + by).expect("a number next to this one");
                assert_eq!(moved, entry.parameter.with(setup, value + by).expect("as described"), "{key}");
                measured(&state.at(entry.parameter, value + by).expect("a state next to this one"))
            });
            std::array::from_fn::<_, 6, _>(|k| (ends[0][k] - ends[1][k]) / (2.0 * step))
        };
        let step = 1e-3 * value.abs();
        let (fine, coarse) = (slope(step), slope(2.0 * step));
        for (k, name) in NAMES.iter().enumerate() {
            let place = found.observables.iter().position(|(known, _)| known == name).expect("as described");
            let ours = entry.derivatives[place];
            let error = (ours - (4.0 * fine[k] - coarse[k]) / 3.0) * value;
            let error = error / here[k].abs().max((ours * value).abs()).max(1e-4);
            assert!(error.abs() < 1e-7, "{name} by {key}: {error:.1e}");
        }
    }
    println!("{:?}: {known} with sensitivities, {idle} without effect", setup.region);
    [known, idle]
}

#[test]
fn in_two_dimensions() {
    let channel = |drive| Region::Channel { length: 8.0, width: 4.0, drive };
    let mut in_box = scene(Region::Box { lengths: [5.0, 7.0] }, -0.8, 32);
    in_box.droplets[0].cortex = Cortex { per_concentration: 0.3, ..Cortex::new(40.0) };
    in_box.droplets[0].friction = 3.0;
    let mut pushed = scene(channel(Drive::Gradient(-0.3)), -0.8, 48);
    pushed.droplets[0].particles.as_mut().unwrap().excluded_volume =
        ExcludedVolume::StepAt { strength: 10.0, threshold: 190.0, steepness: 20.0 };
    let mut carried = scene(channel(Drive::Flux(0.05)), -0.8, 32);
    carried.droplets[0].particles.as_mut().unwrap().excluded_volume = ExcludedVolume::Quadratic(0.01);
    for setup in [in_box, pushed, carried] {
        assert!(check(&setup)[0] >= 10);
    }
}

/// Slip lengths that are equal, different, and zero at one wall: each wall has a row.
#[test]
fn between_walls_with_slip() {
    for slip in [[0.2, 0.2], [0.15, 0.25], [0.0, 0.1]] {
        let region = Region::SlipChannel { length: 6.0, width: 3.2, drive: Drive::ZeroFlux, slip };
        let setup = scene(region, -0.8, 48);
        assert!(check(&setup)[0] >= 10);
        let found = SteadyState::find(&setup).unwrap().sensitivities().unwrap();
        let by_wall = [Parameter::LowerSlip, Parameter::UpperSlip].map(|wall| found.derivative("speed", wall).unwrap());
        assert!(by_wall.iter().all(|by| by.abs() > 1e-4), "{by_wall:?}");
        assert!(slip[0] != slip[1] || (by_wall[0] / by_wall[1] - 1.0).abs() < 1e-9, "{by_wall:?}");
        // Both walls together, and from walls without slip.
        let state = SteadyState::find(&setup).unwrap();
        let both = state.sensitivities_by(&[Parameter::Slip], &[]);
        match both {
            Ok(both) => {
                let sum = by_wall[0] + by_wall[1];
                assert!((both.parameters[0].derivatives[0] / sum - 1.0).abs() < 1e-7, "{by_wall:?}");
            }
            Err(error) => assert!(slip[0] != slip[1], "{error}"),
        }
    }
}

#[test]
fn with_exchange_nucleus_and_flows() {
    let mut exchanging = scene(Region::Plane, -1.0, 32);
    let exchange = ExchangeSetup { number_inside: Some(60.0), ..ExchangeSetup::new(0.2, 0.02) };
    exchanging.droplets[0].particles.as_mut().unwrap().exchange = Some(exchange);
    let mut nucleated = scene(Region::Plane, -2.0, 48);
    nucleated.rigid_bodies = vec![RigidBodySetup { centre: [0.0, 0.4], ..RigidBodySetup::disc(0.5) }];
    let mut strained = scene(Region::Plane, -0.8, 32);
    strained.flow.extension = 0.01;
    for setup in [exchanging, nucleated, strained] {
        assert!(check(&setup)[0] >= 9);
    }
}

#[test]
fn in_three_dimensions() {
    let mut in_space = scene(Region::Space, -0.7, 28);
    in_space.droplets[0].cortex = Cortex { shear_viscosity: 20.0, ..Cortex::new(40.0) };
    check(&in_space);
}

/// Scenes in which nothing is steady are refused before any work.
#[test]
fn fields_and_fibres_are_refused() {
    let plain = scene(Region::Plane, -0.8, 32);
    let mut felt = plain.clone();
    let entry = FieldEntry { uniform: Some(0.1), ..FieldEntry::default() };
    felt.droplets[0].fields = FieldsSetup { activity: vec![entry], ..FieldsSetup::default() };
    let mut hairy = plain;
    hairy.fibres = vec![FibreSetup::default()];
    for (setup, said) in [(felt, "the droplet feels fields that are fixed in the laboratory"), (hairy, "fibre")] {
        let error = SteadyState::find(&setup).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
}
