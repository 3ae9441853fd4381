use active_interface::{ConstantTension, ContractileTension};
use motile_scene::integrator::{Midpoint, RungeKuttaChebyshev};

use super::*;
use crate::EdgeFollowing;
use crate::surface::dot;

fn shear(rate: f64) -> [[f64; 3]; 3] {
    [[0.0, rate, 0.0], [0.0; 3], [0.0; 3]]
}

/// Taylor's deformation (19 r + 16)/(16 r + 16) Ca of a drop in shear, the terms in Ca^3 extrapolated away.
#[test]
fn drops_in_shear_deform_as_taylor_says() {
    for ratio in [1.0, 5.0] {
        let deformation = |capillary: f64| {
            let law = ConstantTension::new(1.0).unwrap();
            let drop = SpaceDroplet::sphere(6, 1.0, [ratio, 1.0], law).unwrap();
            let mut drop = drop.with_imposed_flow(shear(capillary)).unwrap();
            let steps = StepSize::Adaptive { tolerance: 1e-6 };
            drop.advance(20.0 * (1.0 + ratio), steps, &mut RungeKuttaChebyshev::new(), |_| {}).unwrap();
            let axes = drop.semi_axes();
            (axes[0] - axes[2]) / (axes[0] + axes[2]) / capillary
        };
        let found = (4.0 * deformation(0.01) - deformation(0.02)) / 3.0;
        let exact = (19.0 * ratio + 16.0) / (16.0 * ratio + 16.0);
        assert!((found - exact).abs() < 3e-4 * exact, "{ratio}: {found} {exact}");
    }
}

/// A swimmer that starts along an oblique axis keeps it, and reaches the speed of the steady state.
fn swimmer(degree: usize) -> (SpaceDroplet, [f64; 3]) {
    let length = (1.0_f64 + 4.0 + 0.25).sqrt();
    let axis = [1.0 / length, 2.0 / length, -0.5 / length];
    let law = ContractileTension::thesis(10.0, -1.0, 2.0, 100.0).unwrap();
    let droplet = SpaceDroplet::sphere(degree, 1.0, [100.0, 100.0], law).unwrap();
    (droplet.with_particles(0.1, |s| 100.0 * (1.0 + 0.9 * dot(s, axis))).unwrap(), axis)
}

#[test]
fn swimmers_keep_their_heading_number_of_particles_and_volume() {
    let (mut droplet, axis) = swimmer(8);
    let start = droplet.observe().unwrap();
    let steps = StepSize::Adaptive { tolerance: 3e-3 };
    let mut times = Vec::new();
    let report =
        droplet.advance(25.0, steps, &mut RungeKuttaChebyshev::new(), |droplet| times.push(droplet.time())).unwrap();
    let end = droplet.observe().unwrap();
    assert_eq!((times.len(), end.time), (report.steps, 25.0));
    assert!(report.volume_error < 1e-5 && (end.volume / start.volume - 1.0).abs() < 1e-10, "{report:?}");
    assert!((end.particles / start.particles - 1.0).abs() < 1e-14);
    // Contractile particles gather at the rear.
    assert!((dot(end.heading, axis) + 1.0).abs() < 1e-5, "{:?}", end.heading);
    // 0.1261 from an axisymmetric program; degree 8 has two digits.
    assert!((end.speed / 0.126082 - 1.0).abs() < 1e-2, "{}", end.speed);
    let along = dot(end.position, axis).abs();
    assert!(along > 2.0 && dot(end.position, end.position) - along * along < 1e-4);
}

#[test]
fn midpoint_steps_are_of_second_order() {
    let end = |steps: f64| {
        let (mut droplet, _) = swimmer(6);
        droplet.advance(1.0, StepSize::Fixed(1.0 / steps), &mut Midpoint::default(), |_| {}).unwrap();
        droplet.state.clone()
    };
    let states = [16.0, 32.0, 64.0].map(end);
    let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let order = (difference(&states[0], &states[1]) / difference(&states[1], &states[2])).log2();
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn resumed_runs_continue_to_the_last_bit() {
    let step = |droplet: &mut SpaceDroplet, until: f64| {
        droplet.advance(until, StepSize::Fixed(0.125), &mut Midpoint::default(), |_| {}).unwrap();
    };
    let mut whole = swimmer(6).0;
    step(&mut whole, 0.5);
    let saved = whole.state().to_vec();
    step(&mut whole, 1.0);
    let mut resumed = swimmer(6).0;
    resumed.resume(0.5, &saved).unwrap();
    step(&mut resumed, 1.0);
    assert!(whole.state().iter().zip(resumed.state()).all(|(a, b)| a.to_bits() == b.to_bits()));
    assert!(resumed.resume(0.5, &saved[1..]).unwrap_err().to_string().contains("the state"));
    assert!(resumed.resume(0.5, &vec![0.0; saved.len()]).unwrap_err().to_string().contains("encloses no volume"));
    assert_eq!(whole.state(), resumed.state());
}

/// While the parameters follow the edge, the spread of the monitor falls, and the area of a swimmer comes closer to
/// the one of an axisymmetric program.
#[test]
fn parameters_follow_the_edge() {
    let end = |edge: Option<EdgeFollowing>| {
        let (mut droplet, _) = swimmer(10);
        droplet.edge = edge;
        droplet.advance(25.0, StepSize::Adaptive { tolerance: 3e-3 }, &mut RungeKuttaChebyshev::new(), |_| {}).unwrap();
        let seen = droplet.observe().unwrap();
        (seen.area / 12.5753637438 - 1.0).abs()
    };
    let (fixed, following) = (end(None), end(Some(EdgeFollowing { strength: 4.0, time: 1.0 })));
    assert!(following < 0.1 * fixed, "{fixed:e} {following:e}");
}

#[test]
fn runs_that_cannot_end_well_are_refused() {
    let (mut droplet, _) = swimmer(4);
    let mut run = |until: f64, steps: StepSize| {
        droplet.advance(until, steps, &mut Midpoint::default(), |_| {}).unwrap_err().to_string()
    };
    assert!(run(-1.0, StepSize::Fixed(0.1)).starts_with("the length of the run is -1"));
    assert!(run(1.0, StepSize::Fixed(f64::NAN)).starts_with("the time step is NaN"));
    assert!(run(1e13, StepSize::default()).contains("more than 1e8 steps"));
    // Steps far above the stability limit end in an error, and the droplet keeps its last good state.
    let error = run(1e4, StepSize::Fixed(50.0));
    assert!(error.contains("Use a higher degree"), "{error}");
    assert!(droplet.observe().unwrap().speed.is_finite());
}
