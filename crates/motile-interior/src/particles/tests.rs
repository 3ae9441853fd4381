use active_interface::{ConstantTension, Curve};
use ib_core::{AnyKernel, ImmersedBoundary};
use motile_scene::{Hydrodynamics as _, Scene};
use stokes_grid::{Grid, PeriodicStokes};

use super::*;

/// The place where a mesh is folded is told: between the arms of a star, far from the origin.
#[test]
fn stars_are_too_bent() {
    let solver = PeriodicStokes::new(Grid::periodic(40, 40, 0.1).unwrap(), 1.0).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4));
    let centre = Vec2::new(10.0, -20.0);
    let mut refused = |arm: f64| {
        let star = Curve::fourier(1.0, &[0.0, 0.0, arm], &[]).unwrap().translated(centre);
        let markers = star.markers(96).unwrap();
        let tension = ConstantTension::new(1.0).unwrap();
        let droplet = ActiveDroplet::new(&markers, vec![1.0; 96], tension, 1.0).unwrap().with_open_number();
        let host = scene.add(droplet.clone());
        ParticlesInDroplet::new(&droplet, host, Exchange::new(1.0, 1.0).unwrap(), 0.5, |_| 1.0, 0.1).err()
    };
    assert!(refused(0.05).is_none());
    let Some(InteriorError::Folded { x, y }) = refused(0.4) else { panic!("it is not folded") };
    assert!((0.1..1.7).contains(&centre.distance(Vec2::new(x, y))), "{x} {y}");
}

/// Particles in a circle of radius 1 with so many markers, at a density inside.
fn filled(markers: usize, diffusion: f64, density: impl Fn(Vec2) -> f64) -> (ActiveDroplet, ParticlesInDroplet) {
    let solver = PeriodicStokes::new(Grid::periodic(40, 40, 0.1).unwrap(), 1.0).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4));
    let positions = Curve::circle(1.0).unwrap().markers(markers).unwrap();
    let on = (0..markers).map(|k| 1.0 + 0.1 * (k % 3) as f64).collect();
    let tension = ConstantTension::new(1.0).unwrap();
    let droplet = ActiveDroplet::new(&positions, on, tension, 1.0).unwrap().with_open_number();
    let host = scene.add(droplet.clone());
    let exchange = Exchange::new(0.3, 0.2).unwrap();
    let spacing = TAU / markers as f64;
    let body = ParticlesInDroplet::new(&droplet, host, exchange, diffusion, density, spacing).unwrap();
    (droplet, body)
}

fn view() -> FluidView {
    let solver = PeriodicStokes::new(Grid::periodic(40, 40, 0.1).unwrap(), 1.0).unwrap();
    Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4)).system().hydrodynamics().fluid_view()
}

/// J_1 by its integral, to round-off.
fn bessel_1(x: f64) -> f64 {
    let angles = (0..64).map(|k| std::f64::consts::PI * (f64::from(k) + 0.5) / 64.0);
    angles.map(|angle| (angle - x * angle.sin()).cos()).sum::<f64>() / 64.0
}

/// The mode `J_1(z r) cos` with the first zero z of J_1' decays at the rate D z^2 within a wall.
#[test]
fn diffusion_inside_takes_modes_down_at_their_rates() {
    let zero = 1.841_183_781_340_659_3;
    let mode = |place: Vec2| bessel_1(zero * place.length()) * place.x / place.length().max(1e-300);
    let errors = [48, 96].map(|markers| {
        let (_, mut body) = filled(markers, 0.7, |place| 1.0 + mode(place));
        body.begin_step(&view(), StepInfo { dt: 0.1, stabilised: false }).unwrap();
        let numbers = body.numbers().to_vec();
        let mut rate = vec![0.0; numbers.len()];
        body.add_implicit(&numbers, 1.0, &mut rate);
        let (mut sum, mut norm) = (0.0, 0.0);
        for ((rate, place), area) in rate.iter().zip(body.nodes()).zip(&body.cells.areas) {
            let mode = mode(*place);
            sum += mode * rate;
            norm += mode * mode * area;
        }
        (sum / norm / (-0.7 * zero * zero) - 1.0).abs()
    });
    assert!(errors[1] < 2e-3 && (errors[0] / errors[1]).log2() > 1.8, "{errors:?}");
}

/// After the implicit part of a step, numbers less the change by diffusion are those before it.
#[test]
fn implicit_diffusion_solves_its_equation() {
    let (_, mut body) = filled(48, 0.7, |place| 1.0 + 0.5 * place.x);
    body.begin_step(&view(), StepInfo { dt: 0.1, stabilised: false }).unwrap();
    let before = body.numbers().to_vec();
    let mut after = before.clone();
    body.solve_implicit(0.05, &mut after);
    let mut back = after.clone();
    body.add_implicit(&after, -0.05, &mut back);
    let largest = before.iter().copied().fold(0.0, f64::max);
    let error = back.iter().zip(&before).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(error < 1e-8 * largest, "{error}");
    let moved = after.iter().zip(&before).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(moved > 0.01 * largest, "{moved}");
    assert!((after.iter().sum::<f64>() / before.iter().sum::<f64>() - 1.0).abs() < 1e-13);
}

/// At a uniform density C a segment of length l with n particles gains `k_on C l - k_off n`, and the inside loses it.
#[test]
fn each_segment_gains_what_binds_to_it_less_what_unbinds() {
    let (droplet, mut body) = filled(48, 0.7, |_| 1.5);
    body.begin_step(&view(), StepInfo { dt: 0.1, stabilised: false }).unwrap();
    let still = vec![Vec2::ZERO; body.marker_count()];
    let mut rate = vec![0.0; body.state_len()];
    body.rate(&still, &mut rate);
    let mut of_host = vec![7.0; droplet.state_len()];
    body.add_host_rate(&mut of_host);
    let (positions, numbers) = of_host.split_at(2 * 48);
    assert!(positions.iter().all(|rate| *rate == 7.0), "{positions:?}");
    assert_eq!(numbers.len(), 48);
    let mut gained = 0.0;
    for ((found, length), on) in numbers.iter().zip(droplet.element_lengths()).zip(droplet.particle_numbers()) {
        let expected = 0.3 * 1.5 * length - 0.2 * on;
        assert!((found - 7.0 - expected).abs() < 1e-14, "{found} {expected}");
        gained += expected;
    }
    assert!((rate.iter().sum::<f64>() + gained).abs() < 1e-12, "{gained}");
}

/// Exchange decays at most at the rate `k_off + k_on (2/R + k_on/D)`; transport is bounded by what leaves a cell, or
/// where it is slower by diffusion: `max(2/turnover, D/u^2)`.
#[test]
fn limits_of_the_step_inside_are_those_of_exchange_and_transport() {
    let (droplet, mut body) = filled(48, 0.7, |_| 1.5);
    let radius = droplet.element_lengths().iter().sum::<f64>() / TAU;
    let rate = 0.2 + 0.3 * (2.0 / radius + 0.3 / 0.7);
    for (turnover, speed, transport) in [(8.0, 0.5, 2.8), (8.0, 10.0, 0.25)] {
        body.transport.pace = Pace { turnover, speed };
        let mut limits = Vec::new();
        body.step_limits(&view(), &mut |limit| limits.push((limit.reason, limit.dt)));
        let [(exchange, first), (carried, second)] = limits[..] else { panic!("{limits:?}") };
        assert_eq!([exchange, carried], ["the exchange of particles", "the transport of particles inside"]);
        assert!((first * rate / 2.0 - 1.0).abs() < 1e-13, "{first}");
        assert!((second / transport - 1.0).abs() < 1e-13, "{second} {transport}");
    }
}

/// Sizes of the numbers of the cells: their mean, or one where there are none.
#[test]
fn scales_are_the_mean_of_the_numbers() {
    for density in [0.0, 1.0, 1e3] {
        let (_, body) = filled(48, 0.7, |place| density * (1.0 + 0.5 * place.x));
        let mut scales = vec![0.0; body.state_len()];
        body.write_scales(&mut scales);
        let total: f64 = body.numbers().iter().sum();
        let mean = if density > 0.0 { total / body.numbers().len() as f64 } else { 1.0 };
        assert!(scales.iter().all(|scale| (scale / mean - 1.0).abs() < 1e-12), "{density}");
    }
}

/// Particles that are lost are an error, as are those that come from nowhere.
#[test]
fn lost_and_new_particles_are_errors() {
    for (factor, kept) in [(1.0, true), (1.01, false), (0.99, false)] {
        let (_, mut body) = filled(48, 0.7, |_| 1.0);
        let state: Vec<f64> = body.numbers().iter().map(|number| factor * number).collect();
        body.read_state(&state).unwrap();
        let outcome = body.write_forces(&view(), &mut vec![Vec2::ZERO; body.marker_count()]);
        match outcome {
            Ok(()) => assert!(kept, "{factor}"),
            Err(error) => assert!(!kept && matches!(error, BodyError::NotConserved { .. }), "{factor}: {error}"),
        }
    }
}

/// Noise on the particles of the interface is refused, whether it comes before or after the particles inside.
#[test]
fn noise_is_refused() {
    let (droplet, mut body) = filled(32, 0.5, |_| 1.0);
    let noisy = droplet.with_noise(active_interface::Noise::new(1)).unwrap();
    let host = body.filling.host;
    let error = ParticlesInDroplet::new(&noisy, host, Exchange::new(1.0, 1.0).unwrap(), 0.5, |_| 1.0, 0.2);
    assert!(error.unwrap_err().to_string().contains("no noise"));
    body.update_host(&noisy);
    let mut forces = vec![Vec2::ZERO; body.marker_count()];
    assert!(body.write_forces(&view(), &mut forces).unwrap_err().to_string().contains("no noise"));
}
