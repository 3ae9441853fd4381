//! Swimmers in three dimensions.

use std::f64::consts::TAU;

use motile::prelude::*;
use motile::setup::{ExcludedVolume, Setup};
use motile_steady_states::{
    BranchPoint, Continuation, Critical, Parameter, SpecialKind, SpecialPoint, SteadyState, Symmetry,
};

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

/// Concentration that varies as the cosine of the polar angle, over the mean, of a droplet that is nearly a sphere.
fn amplitude(point: &BranchPoint) -> f64 {
    let (profile, centre) = (point.state.profile(), point.state.measured().expect("a measured state").centroid);
    let count = profile.positions.len();
    // The integral from pole to pole of what is odd in the parameter, by its sines.
    let over_rings = |value: &dyn Fn(f64) -> f64| {
        let wave = |m: usize| {
            let nodes = profile.positions.iter().zip(&profile.density).enumerate();
            let at = |k: usize| (TAU * (k * m) as f64 / count as f64).sin();
            nodes.map(|(k, (x, number))| value(x.x - centre.x) * number * x.y * at(k)).sum::<f64>() / m as f64
        };
        (1..count / 2).step_by(2).map(wave).sum::<f64>()
    };
    3.0 * over_rings(&|x| x) / over_rings(&|_| 1.0)
}

/// The coefficient b of swimmers that branch off a droplet at rest, activity = threshold (1 - b (c1/c0)^2), from the
/// first two points of the branch.
fn onset_coefficient(viscosities: [f64; 2], tension: f64) -> f64 {
    let mut setup = swimmer(Region::Space, -1e-3 * (3.0 * viscosities[0] + 2.0 * viscosities[1]), viscosities, 0.0, 40);
    setup.droplets[0].tension = tension;
    let rest = SteadyState::uniform(&setup).expect("a state of rest");
    let spectrum = rest.spectrum().expect("a spectrum");
    let mode = spectrum.modes.iter().find(|mode| mode.symmetry == Symmetry::Symmetric).expect("a symmetric mode");
    let critical: Critical = rest.critical(mode, Parameter::Activity).expect("a threshold");
    let threshold = Parameter::Activity.get(critical.state.setup()).expect("an activity");
    let range = Continuation::new(Parameter::Activity, 0.5 * threshold, 1.5 * threshold);
    let swimmers = Continuation { largest_step: 0.02, most_points: 3, ..range };
    let point = SpecialPoint::new(SpecialKind::BranchPoint, critical, Parameter::Activity);
    let branch = swimmers.switch(&point, true, |_, _| true).expect("a branch");
    let [(u, p), (v, q)] =
        [0, 1].map(|k| (amplitude(&branch.points[k]).powi(2), 1.0 - branch.points[k].value / threshold));
    (p / u * v - q / v * u) / (v - u)
}

/// On a sphere, without an excluded volume, the second harmonic c2 = c1^2/(3 c0 (1 - rho)) of the concentration follows
/// from the first, where rho = (2 eta_e + 3 eta_i)/(5 Sigma) is the mobility of the second harmonic over that of the
/// first. Its flow adds (3 rho - 1)/5 c2/c0 to the growth of the first, so the activity of swimmers is the threshold
/// times 1 - (3 rho - 1)/(15 (1 - rho)) (c1/c0)^2. Deformation changes this as one over the tension.
#[test]
fn the_onset_on_a_sphere_is_subcritical_as_the_closed_form_says() {
    for viscosities in [[10.0, 100.0], [100.0, 100.0], [100.0, 10.0]] {
        let [inside, outside] = viscosities;
        let rho = (2.0 * outside + 3.0 * inside) / (5.0 * (inside + outside));
        let exact = (3.0 * rho - 1.0) / (15.0 * (1.0 - rho));
        let errors = [1e3, 1e4].map(|tension| onset_coefficient(viscosities, tension) / exact - 1.0);
        // What is left without the part that falls as one over the tension.
        let left: f64 = (10.0 * errors[1] - errors[0]) / 9.0;
        assert!(left.abs() < 5e-4 && errors[1].abs() < 0.015, "{viscosities:?}: {errors:?}, {left}");
    }
}
