//! Exchange of particles with a well-mixed inside against linear theory.

use std::f64::consts::{PI, TAU};

use motile::active_interface::ActiveDroplet;
use motile::active_interface::theory::{LinearTheory, RoundDroplet};
use motile::prelude::*;
use motile::setup::{ExchangeSetup, ExcludedVolume, Start};
use motile_tests::validation::scene::{on_grid, without_grid};

const BINDING: f64 = 0.4;
const UNBINDING: f64 = 0.25;

fn setup(start: Start, number_inside: Option<f64>, activity: f64) -> Setup {
    let exchange = Some(ExchangeSetup { number_inside, ..ExchangeSetup::new(BINDING, UNBINDING) });
    let particles =
        Particles { activity, excluded_volume: ExcludedVolume::None, start, exchange, ..Particles::default() };
    let droplet = DropletSetup { particles: Some(particles), ..DropletSetup::default() };
    Setup { region: Region::Plane, droplets: vec![droplet], ..without_grid(48, 192) }
}

/// Amplitudes of the modes 1 to 4 of the concentration over the mean, and the number inside, at the start and then.
fn amplitudes(setup: &Setup, dt: f64, time: f64) -> [([f64; 4], f64); 2] {
    let Built { mut scene, droplets, .. } = setup.build().expect("a scene");
    let mut seen = Vec::new();
    for until in [0.0, time] {
        while scene.time() < until - 0.5 * dt {
            scene.step(dt).expect("a step");
        }
        let observed = scene.observe(droplets[0]).expect("observables");
        let modes = &observed.concentration_modes;
        // Of the concentration itself, the mean of which may change.
        let of = |k: usize| modes.amplitude(k);
        seen.push(([of(1), of(2), of(3), of(4)], observed.inside.expect("an exchange").0));
    }
    [seen[0], seen[1]]
}

#[test]
fn modes_of_the_circle_grow_slower_by_the_rate_of_unbinding() {
    let activity = -0.9;
    let theory = LinearTheory::new(RoundDroplet {
        radius: 1.0,
        viscosity_inside: 100.0,
        viscosity_outside: 100.0,
        tension: 10.0 - activity * 100.0,
        activity,
        concentration: 100.0,
        diffusivity: 0.1,
    })
    .unwrap();
    let perturbed = setup(Start::Perturbed { amplitude: 1e-5, seed: 3 }, None, activity);
    let rates = |cells: usize, dt: f64| {
        let method = without_grid(cells / 4, cells).method;
        let [(before, _), (after, _)] = amplitudes(&Setup { method, ..perturbed.clone() }, dt, 1.0);
        [0, 1, 2].map(|k: usize| (after[k] / before[k]).ln())
    };
    let in_time = [0.1, 0.05, 0.025].map(|dt| rates(192, dt));
    let in_space = [192, 384].map(|cells| rates(cells, 0.00625));
    for k in 0..3 {
        let exact = theory.concentration_growth_rate(k as u32 + 1) - UNBINDING;
        let [coarse, middle, fine] = in_time.map(|rates| rates[k]);
        let ratio = (coarse - middle) / (middle - fine);
        assert!((3.0..5.0).contains(&ratio), "mode {}: second order in time, not {ratio}", k + 1);
        let [coarse, fine] = in_space.map(|rates| (rates[k] - exact).abs());
        assert!(fine < 0.3 * coarse && fine < 2e-4, "mode {}: {coarse:.1e} {fine:.1e}", k + 1);
    }
}

/// The activities at which the rates of modes 1 to 3 are zero: rates are linear in the activity.
#[test]
fn the_exchange_raises_the_threshold_by_the_rate_of_unbinding() {
    let at = [-1.0, -2.0];
    let errors = [96, 192].map(|cells| {
        let rates = at.map(|activity| {
            let method = without_grid(cells / 4, cells).method;
            let start = Start::Perturbed { amplitude: 1e-5, seed: 3 };
            let perturbed = Setup { method, ..setup(start, None, activity) };
            let [(before, _), (after, _)] = amplitudes(&perturbed, 0.00625, 0.1);
            [0, 1, 2].map(|k: usize| (after[k] / before[k]).ln() / 0.1)
        });
        [0, 1, 2].map(|k: usize| {
            let slope = (rates[1][k] - rates[0][k]) / (at[1] - at[0]);
            let found = at[0] - rates[0][k] / slope;
            let wave = k as f64 + 1.0;
            // -(2 Sigma R/(k c0)) (D k^2/R^2 + k_off)
            let exact = -4.0 / wave * (0.1 * wave * wave + UNBINDING);
            (found / exact - 1.0).abs()
        })
    });
    for (mode, (coarse, fine)) in errors[0].into_iter().zip(errors[1]).enumerate() {
        assert!(fine < 1e-3 && fine < 0.3 * coarse, "mode {}: {coarse:.1e} {fine:.1e}", mode + 1);
    }
}

#[test]
fn numbers_on_and_inside_come_to_rest_at_the_exact_rate() {
    let (on, area) = (TAU * 100.0, PI);
    let at_rest = UNBINDING * 100.0 / BINDING * area;
    let errors = [0.2, 0.1].map(|dt| {
        let Built { mut scene, droplets, .. } = setup(Start::Uniform, Some(0.0), -0.1).build().unwrap();
        while scene.time() < 2.0 - 0.5 * dt {
            scene.step(dt).unwrap();
        }
        let inside = scene.body(droplets[0]).unwrap().number_inside().unwrap();
        // dP/dt = k_off n - k_on (2/R) P with n + P = N.
        let rate = UNBINDING + BINDING * TAU / area;
        let exact = UNBINDING * on / rate * (1.0 - (-rate * 2.0).exp());
        (inside / exact - 1.0).abs()
    });
    assert!(errors[1] < 1e-3 && errors[1] < 0.3 * errors[0], "{errors:?}");
    // A droplet at rest with its inside has as many.
    let Built { scene, droplets, .. } = setup(Start::Uniform, None, -0.1).build().unwrap();
    let droplet = scene.body(droplets[0]).unwrap();
    assert!((droplet.number_inside().unwrap() / at_rest - 1.0).abs() < 1e-12);
    assert!(droplet.exchange_flux().unwrap().abs() < 1e-12 * on * UNBINDING);
}

#[test]
fn no_particle_is_lost_by_a_swimmer() {
    // Much faster than a step, too: the exchange sets none.
    for (method, factor) in [(without_grid(48, 192), 1.0), (without_grid(48, 192), 5e3), (on_grid(0.1), 1.0)] {
        let mut droplet = setup(Start::Polarised, None, -3.0).droplets.remove(0);
        if let Some(particles) = &mut droplet.particles {
            particles.excluded_volume = ExcludedVolume::Step(10.0);
            let (binding, unbinding) = (factor * BINDING, factor * UNBINDING);
            particles.exchange =
                Some(ExchangeSetup { number_inside: Some(10.0), ..ExchangeSetup::new(binding, unbinding) });
        }
        let setup = Setup { region: Region::Box { lengths: [5.0; 2] }, droplets: vec![droplet], ..method };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let total = |body: &ActiveDroplet| body.particle_numbers().iter().sum::<f64>() + body.number_inside().unwrap();
        let before = total(scene.body(droplets[0]).unwrap());
        scene.run(2.0).go().unwrap();
        let body = scene.body(droplets[0]).unwrap();
        assert!((total(body) / before - 1.0).abs() < 1e-12, "{factor}: {before} {}", total(body));
        assert!(body.particle_numbers().iter().chain(&body.number_inside()).all(|&number| number >= 0.0));
    }
}
