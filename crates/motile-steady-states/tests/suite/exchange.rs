//! Droplets that exchange particles with a well-mixed inside, against linear theory and runs.

use std::f64::consts::{PI, TAU};

use motile::active_interface::theory::{LinearTheory, RoundDroplet};
use motile::prelude::*;
use motile::setup::{ExchangeSetup, ExcludedVolume};
use motile_steady_states::{Parameter, SteadyState, Symmetry};

const BINDING: f64 = 0.2;
const UNBINDING: f64 = 0.02;

/// Droplet of viscosity 100 in a fluid of 100, with that activity and so many particles inside.
fn setup(nodes: usize, activity: f64, number_inside: Option<f64>) -> Setup {
    let exchange = Some(ExchangeSetup { number_inside, ..ExchangeSetup::new(BINDING, UNBINDING) });
    let particles = Particles { activity, exchange, ..Particles::default() };
    Setup {
        method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
        droplets: vec![DropletSetup { particles: Some(particles), ..DropletSetup::default() }],
        ..Setup::default()
    }
}

/// Each mode m of a circle grows slower by k_off, and the number on the interface goes to its value at rest at the rate
/// k_off + 2 k_on/R; the threshold of swimming is raised by k_off over D/R^2.
#[test]
fn rates_and_threshold_of_the_circle() {
    let mut circle = setup(48, -0.5, None);
    circle.region = Region::Plane;
    circle.droplets[0].particles.as_mut().unwrap().excluded_volume = ExcludedVolume::None;
    let theory = LinearTheory::new(RoundDroplet {
        radius: 1.0,
        viscosity_inside: 100.0,
        viscosity_outside: 100.0,
        tension: circle.droplets[0].tension + 50.0,
        activity: -0.5,
        concentration: 100.0,
        diffusivity: 0.1,
    })
    .unwrap();
    let state = SteadyState::uniform(&circle).unwrap();
    let rates: Vec<f64> = state.spectrum().unwrap().of(Symmetry::Symmetric).map(|rate| rate.re).collect();
    let exact = (1..5).map(|k| theory.concentration_growth_rate(k) - UNBINDING);
    for exact in exact.chain([-UNBINDING - 2.0 * BINDING]) {
        let error = rates.iter().map(|rate| (rate - exact).abs()).fold(f64::INFINITY, f64::min);
        assert!(error < 1e-8, "{exact}: {error:.1e} of {rates:?}");
    }
    let leading = state.spectrum().unwrap().leading().unwrap().clone();
    let critical = state.critical(&leading, Parameter::Activity).unwrap();
    let threshold = Parameter::Activity.get(critical.state.setup()).unwrap();
    assert!((threshold + 4.0 * (0.1 + UNBINDING)).abs() < 1e-6, "{threshold}");
    // At a fixed activity the rate of unbinding at which it starts to swim.
    let critical = state.critical(&leading, Parameter::Unbinding).unwrap();
    let unbinding = Parameter::Unbinding.get(critical.state.setup()).unwrap();
    assert!((unbinding - 0.025).abs() < 1e-6, "{unbinding}");
}

/// Speed and numbers of a run to t = 120 and of Newton's method; there are as many particles as at the start, wherever
/// they were.
#[test]
fn a_swimmer_is_that_of_a_run() {
    for number_inside in [None, Some(0.0)] {
        let errors = [48, 72].map(|nodes| {
            let swimmer = setup(nodes, -1.2, number_inside);
            let found = SteadyState::find(&swimmer).unwrap();
            let exact = found.measured().unwrap().speed;
            let Built { mut scene, droplets, .. } = swimmer.build().unwrap();
            scene.run(120.0).go().unwrap();
            let seen = scene.observe(droplets[0]).unwrap();
            let observed = found.observables().unwrap();
            let [(inside, flux), (number, _)] = [observed.inside, seen.inside].map(|inside| inside.expect("some"));
            assert!(flux.abs() < 1e-9 * UNBINDING * observed.particle_number, "{flux}");
            let total = TAU * 100.0 + number_inside.unwrap_or(UNBINDING * 100.0 / BINDING * PI);
            assert!(((inside + observed.particle_number) / total - 1.0).abs() < 1e-9);
            // Binding sees the length of the interface, unbinding the particles on it.
            let density = UNBINDING * observed.particle_number / (BINDING * observed.perimeter);
            assert!((inside / PI / density - 1.0).abs() < 1e-4, "{inside} {density}");
            [seen.speed() / exact - 1.0, number / inside - 1.0].map(f64::abs)
        });
        for (coarse, fine) in errors[0].into_iter().zip(errors[1]) {
            assert!(coarse < 1e-3 && fine < 0.6 * coarse, "{number_inside:?}: {errors:?}");
        }
    }
}

/// A field inside, on a mesh in runs and of polynomials here: speeds agree to second order of the mesh.
#[test]
fn a_swimmer_with_a_field_is_that_of_a_run() {
    let swimmer = |nodes: usize, spacing: f64| {
        let mut swimmer = setup(nodes, -1.2, None);
        let particles = swimmer.droplets[0].particles.as_mut().unwrap();
        let inside = (Some(0.3), Some(spacing));
        particles.exchange = particles.exchange.map(|exchange| ExchangeSetup {
            diffusion_inside: inside.0,
            spacing_inside: inside.1,
            ..exchange
        });
        swimmer
    };
    let found = SteadyState::find(&swimmer(48, 0.1)).unwrap();
    let exact = found.measured().unwrap().speed;
    let observed = found.observables().unwrap();
    let (inside, flux) = observed.inside.unwrap();
    assert!(flux.abs() < 1e-12 * UNBINDING * observed.particle_number, "{flux}");
    let total = TAU * 100.0 + UNBINDING * 100.0 / BINDING * PI;
    assert!(((inside + observed.particle_number) / total - 1.0).abs() < 1e-6);
    let errors = [(24, 0.24), (48, 0.12)].map(|(nodes, spacing)| {
        let Built { mut scene, droplets, .. } = swimmer(nodes, spacing).build().unwrap();
        scene.run(100.0).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        [seen.speed() / exact - 1.0, seen.particle_number / observed.particle_number - 1.0].map(f64::abs)
    });
    for (coarse, fine) in errors[0].into_iter().zip(errors[1]) {
        assert!(coarse < 3e-3 && fine < 0.3 * coarse, "{errors:?}");
    }
}

/// At -2 and faster exchange two caps come to rest, which a run nears at the rate of the spectrum.
#[test]
fn a_run_nears_the_state_at_the_rate_of_the_spectrum() {
    let mut caps = setup(72, -2.0, None);
    let particles = caps.droplets[0].particles.as_mut().unwrap();
    particles.exchange = Some(ExchangeSetup::new(0.2, 0.1));
    let found = SteadyState::find(&caps).unwrap();
    let slowest = found.spectrum().unwrap().of(Symmetry::Symmetric).next().unwrap();
    let Built { mut scene, droplets, .. } = caps.build().unwrap();
    let speed = |until: f64| {
        scene.run(until).go().unwrap();
        scene.observe(droplets[0]).unwrap().speed()
    };
    let [before, after] = [120.0, 140.0].map(speed);
    let rate = (after / before).ln() / 20.0;
    assert!(slowest.im == 0.0 && (rate / slowest.re - 1.0).abs() < 0.02, "{rate} {slowest}");
}

/// Nothing that unbinds comes back: a drop of fluid is left.
#[test]
fn without_binding_all_leave() {
    let mut lost = setup(48, -2.0, Some(0.0));
    lost.droplets[0].particles.as_mut().unwrap().exchange.as_mut().unwrap().binding = 0.0;
    let lost = SteadyState::uniform(&lost).unwrap();
    assert!(lost.measured().unwrap().speed < 1e-12);
    assert!((lost.observables().unwrap().inside.unwrap().0 / (TAU * 100.0) - 1.0).abs() < 1e-12);
}

#[test]
fn what_cannot_be_solved_for_is_refused() {
    let refused = |change: &dyn Fn(&mut DropletSetup), word: &str| {
        let mut setup = setup(48, -2.0, None);
        change(&mut setup.droplets[0]);
        let text = SteadyState::find(&setup).expect_err(word).to_string();
        assert!(text.contains(word), "{text}");
    };
    refused(&|droplet| droplet.bending = 0.1, "bending");
    let gradient = Some(GradientSetup { slope: [0.1, 0.0], origin: [0.0; 2] });
    let entry = FieldEntry { gradient, ..FieldEntry::default() };
    refused(&|droplet| droplet.fields.tension = vec![entry.clone()], "fields that are fixed in the laboratory");
    let noisy = |droplet: &mut DropletSetup| {
        droplet.particles.as_mut().unwrap().noise = Some(NoiseSetup::default());
    };
    refused(&noisy, "noise on the particles");
    let diffusing = |change: fn(&mut ExchangeSetup)| {
        move |droplet: &mut DropletSetup| {
            let exchange = droplet.particles.as_mut().and_then(|particles| particles.exchange.as_mut()).unwrap();
            exchange.diffusion_inside = Some(0.1);
            change(exchange);
        }
    };
    refused(&diffusing(|exchange| (exchange.binding, exchange.number_inside) = (0.0, Some(1.0))), "never bind");
    let mut around = setup(48, -1.2, None);
    diffusing(|_| ())(&mut around.droplets[0]);
    assert!(SteadyState::uniform(&around).unwrap().spectrum().unwrap_err().to_string().contains("diffuse"));
    around.rigid_bodies.push(motile::setup::RigidBodySetup::disc(0.3));
    assert!(SteadyState::find(&around).unwrap_err().to_string().contains("around a rigid body"));
}
