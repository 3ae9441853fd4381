//! Swimmers in three dimensions.

use motile::prelude::*;
use motile::setup::{ExcludedVolume, Setup};
use motile_steady_states::SteadyState;

fn swimmer(region: Region, activity: f64, viscosities: [f64; 2], strength: f64, nodes: usize) -> Setup {
    let mut setup = Setup {
        region,
        viscosity: viscosities[1],
        method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
        droplets: vec![DropletSetup::active(activity)],
        ..Setup::default()
    };
    setup.droplets[0].viscosity = Some(viscosities[0]);
    if let Some(particles) = &mut setup.droplets[0].particles {
        particles.excluded_volume = ExcludedVolume::Step(strength);
    }
    setup
}

/// Activity -1 in viscosities of 100 (`axisymmetric.csv`): speed, aspect ratio of the moments, largest concentration
/// and stresslet.
#[test]
fn swimmers_in_space_are_those_of_the_reference() {
    let state = SteadyState::find(&swimmer(Region::Space, -1.0, [100.0, 100.0], 2.0, 96)).unwrap();
    let seen = state.measured().unwrap();
    let values = [seen.speed, seen.aspect_ratio, seen.concentration[0], seen.stresslet];
    let exact = [0.126_082_125_506, 0.957_859_972_447, 2.753_941_530_35, 30.097_758_073_9];
    for ((value, exact), limit) in values.into_iter().zip(exact).zip([3e-6, 1.5e-5, 3e-6, 3e-5]) {
        assert!((value / exact - 1.0_f64).abs() < limit, "{values:?}");
    }
    assert!(state.residual() < 1e-7);
    // Those of a run; concentrations are the means of 1536 segments.
    let run = state.observables().unwrap();
    let [largest, _] = run.concentration_range.unwrap();
    let values =
        [run.speed(), run.aspect_ratio_moments, largest / 100.0, run.moments.stresslet()[0][0], run.particle_number];
    let number = 400.0 * std::f64::consts::PI;
    let [speed, ratio, concentration, stresslet] = exact;
    for (value, exact) in values.into_iter().zip([speed, ratio, concentration, stresslet, number]) {
        assert!((value / exact - 1.0_f64).abs() < 1e-4, "{values:?}");
    }
}

/// In tubes as wide as the droplet and tighter, where steps in time are stiff and the start swims the other way first:
/// the swimmer, not the droplet at rest, which is unstable.
#[test]
fn swimmers_in_tight_tubes_are_found() {
    let state = SteadyState::find(&swimmer(Region::tube(1.1), -2.0, [100.0; 2], 4.0, 72)).unwrap();
    let speed = state.measured().unwrap().speed;
    assert!((0.0115..0.0125).contains(&speed), "{speed}");
}

#[test]
fn droplets_off_the_axis_are_refused() {
    let mut setup = swimmer(Region::Space, -1.0, [100.0, 100.0], 2.0, 64);
    setup.droplets[0].angle = 0.5;
    let error = SteadyState::find(&setup).unwrap_err().to_string();
    assert!(error.contains("along the x axis"), "{error}");
}
