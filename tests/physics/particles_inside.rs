//! Particles that diffuse inside a droplet and are exchanged with its interface, against linear theory.

use std::f64::consts::{PI, TAU};

use motile::active_interface::Exchange;
use motile::interior::{InteriorObservables, ParticlesInDroplet};
use motile::prelude::*;
use motile::scene::integrator::Dynamics as _;
use motile::scene::{Body as _, Hydrodynamics as _};
use motile::setup::{AnyFlow, ExchangeSetup, ExcludedVolume};
use motile_tests::validation::exchange::{BINDING, DIFFUSION, MEAN, Mode, UNBINDING, bare_rate, rate};
use motile_tests::validation::scene::{on_grid, without_grid};

fn assert_second_order(mode: Mode, activity: f64) {
    let errors = [(32, 0.24), (64, 0.12), (128, 0.06)]
        .map(|(markers, spacing)| (rate(mode, activity, markers, spacing).expect("a rate") - mode.rate()).abs());
    let bound = 0.003 * (1.0 + mode.rate().abs());
    assert!(errors[2] < bound, "{mode:?}: {errors:?} of {}", mode.rate());
    assert!((errors[0] / errors[2]).log2() > 3.5, "{mode:?}: {errors:?} of {}", mode.rate());
}

#[test]
fn diffusing_modes_decay_at_the_exact_rates() {
    for (k, bulk) in [(0.0, 0.3), (1.0, 0.3), (2.0, 1.0), (3.0, 0.1), (4.0, 0.5)] {
        let mode = Mode::find(k, bulk, bare_rate(k, 0.0));
        assert!(!mode.modified);
        assert_second_order(mode, 0.0);
    }
}

#[test]
fn active_modes_grow_at_the_exact_rates() {
    for (k, bulk) in [(1.0, 0.3), (2.0, 1.0), (3.0, 0.1), (4.0, 20.0)] {
        let activity = -8.0;
        let mode = Mode::find(k, bulk, bare_rate(k, activity));
        assert!(mode.modified, "{mode:?}");
        assert_second_order(mode, activity);
    }
}

/// The activities at which modes neither grow nor decay, their densities inside being r^k cos k theta: rates are linear
/// in the activity.
#[test]
fn what_diffuses_inside_sets_the_thresholds() {
    for (k, bulk) in [(1.0, 0.3), (2.0, 1.0), (3.0, 0.1)] {
        // Almost at rest: I_k(q r) differs from r^k by q^2/(4 k + 4).
        let mode = Mode { k, q: 0.05, modified: true, bulk };
        let exact = -4.0 / k * (DIFFUSION * k * k + UNBINDING / (1.0 + BINDING / (k * bulk)));
        let errors = [(32, 0.24), (64, 0.12), (128, 0.06)].map(|(markers, spacing)| {
            let at = [0.5 * exact, 1.5 * exact];
            let [low, high] = at.map(|activity| rate(mode, activity, markers, spacing).unwrap());
            let found = at[0] - low * (at[1] - at[0]) / (high - low);
            (found / exact - 1.0).abs()
        });
        assert!(errors[2] < 5e-3 && (errors[1] / errors[2]).log2() > 1.8, "mode {k}: {errors:?} of {exact}");
    }
}

/// A swimmer with particles inside.
fn swimmer(method: Setup, region: Region, exchange: ExchangeSetup) -> Built {
    let particles = Particles {
        activity: -3.0,
        excluded_volume: ExcludedVolume::Step(10.0),
        exchange: Some(exchange),
        ..Particles::default()
    };
    let droplet = DropletSetup { particles: Some(particles), ..DropletSetup::default() };
    Setup { region, droplets: vec![droplet], ..method }.build().expect("a scene that works")
}

fn seen(scene: &mut Scene<AnyFlow>) -> InteriorObservables {
    let (inside, _) = scene.system().bodies::<ParticlesInDroplet>().next().expect("a field");
    scene.observe(inside).expect("a good state")
}

#[test]
fn no_particle_is_lost_however_the_droplet_moves() {
    let with = |bulk: f64| ExchangeSetup { diffusion_inside: Some(bulk), ..ExchangeSetup::new(BINDING, UNBINDING) };
    let square = Region::Box { lengths: [5.0; 2] };
    let channel = Region::Channel { length: 5.0, width: 2.6, drive: Drive::ZeroGradient };
    for (method, region, bulk) in
        [(on_grid(0.1), square, 0.05), (on_grid(0.1), channel, 1e-4), (without_grid(48, 96), Region::Plane, 0.5)]
    {
        let Built { mut scene, .. } = swimmer(method, region, with(bulk));
        let start = seen(&mut scene);
        scene.run(2.0).go().unwrap();
        let end = seen(&mut scene);
        let total = |seen: InteriorObservables| seen.number + seen.number_on;
        assert!((total(end) / total(start) - 1.0).abs() < 1e-12, "{bulk}: {start:?} {end:?}");
        assert!(end.range[0] >= 0.0 && (end.number / start.number - 1.0).abs() > 1e-4, "{bulk}: {start:?} {end:?}");
    }
}

/// A front that diffusion does not resolve.
#[test]
fn sharp_fields_stay_between_their_bounds() {
    let mut built = swimmer(on_grid(0.1), Region::Box { lengths: [5.0; 2] }, ExchangeSetup::new(0.0, 0.0));
    let (scene, host) = (&mut built.scene, built.droplets[0]);
    let droplet = scene.body(host).unwrap().clone();
    let exchange = Exchange::new(0.0, 0.0).unwrap();
    let step = |at: Vec2| if at.x > 0.2 { 1.0 } else { 0.0 };
    let field = ParticlesInDroplet::new(&droplet, host, exchange, 1e-9, step, 0.1).unwrap();
    let field = scene.add(field);
    let before = scene.observe(field).unwrap().number;
    scene.run(3.0).go().unwrap();
    let InteriorObservables { number, range, .. } = scene.observe(field).unwrap();
    assert!(range[0] > -1e-12 && range[1] < 1.02, "{range:?}");
    assert!((number / before - 1.0).abs() < 1e-12);
}

/// Without exchange nothing happens to a uniform field, but for the error of the steps.
#[test]
fn a_uniform_field_stays_uniform_however_the_droplet_moves() {
    for (method, ratio) in [(without_grid(48, 96), 0.35), (on_grid(0.1), 0.5)] {
        let spread = [0.04, 0.02].map(|dt| {
            let exchange =
                ExchangeSetup { number_inside: Some(PI), diffusion_inside: Some(0.01), ..ExchangeSetup::new(0.0, 0.0) };
            let mut built = swimmer(method.clone(), Region::Box { lengths: [5.0; 2] }, exchange);
            while built.scene.time() < 2.0 - 0.5 * dt {
                built.scene.step(dt).unwrap();
            }
            let [least, largest] = seen(&mut built.scene).range;
            largest - least
        });
        assert!(spread[1] < 1e-3 && spread[1] < ratio * spread[0], "{spread:?}");
    }
}

#[test]
fn fast_diffusion_is_a_pool() {
    let number = |bulk: Option<f64>| {
        let exchange = ExchangeSetup { diffusion_inside: bulk, ..ExchangeSetup::new(BINDING, UNBINDING) };
        let Built { mut scene, droplets, .. } = swimmer(on_grid(0.1), Region::Box { lengths: [5.0; 2] }, exchange);
        for _ in 0..20 {
            scene.step(0.02).unwrap();
        }
        scene.observe(droplets[0]).unwrap().particle_number
    };
    let start = TAU * MEAN;
    let pool = number(None);
    let errors = [10.0, 100.0, 1000.0].map(|bulk| (number(Some(bulk)) - pool).abs() / (pool - start).abs());
    assert!(errors[2] < 6e-6 && errors[2] < errors[0], "{errors:?}, {pool} of {start}");
}

/// Steps as long as the exchange allows against steps a twentieth as long.
#[test]
fn fast_exchange_is_stable_up_to_its_limit() {
    for (binding, bulk) in [(1.0, 1.0), (10.0, 1.0), (10.0, 0.05), (100.0, 10.0)] {
        let exchange = ExchangeSetup { diffusion_inside: Some(bulk), ..ExchangeSetup::new(binding, 1.0) };
        let on = [0.95, 0.05].map(|part| {
            let Built { mut scene, .. } = swimmer(without_grid(24, 48), Region::Plane, exchange);
            scene.run(0.5).step_size(StepSize::OfLimit(part)).go().unwrap();
            let InteriorObservables { number_on, range, .. } = seen(&mut scene);
            assert!(range[0] >= 0.0);
            number_on
        });
        assert!((on[0] / on[1] - 1.0).abs() < 3e-4, "{binding} {bulk}: {on:?}");
    }
}

/// Where diffusion outweighs it, transport inside is stable beyond the step in which a cell is emptied.
#[test]
fn transport_inside_is_stable_up_to_its_limit() {
    for bulk in [0.02, 0.05] {
        let exchange = ExchangeSetup { diffusion_inside: Some(bulk), ..ExchangeSetup::new(0.1, 0.1) };
        let inside = [0.95, 0.05].map(|part| {
            let Built { mut scene, .. } = swimmer(without_grid(32, 128), Region::Plane, exchange);
            scene.run(3.0).step_size(StepSize::OfLimit(part)).go().unwrap();
            let reason = &scene.step_report().most_limiting().expect("a reason").reason;
            assert_eq!(reason, "the transport of particles inside", "{bulk}");
            let InteriorObservables { number, range, .. } = seen(&mut scene);
            [number, range[0], range[1]]
        });
        for (long, short) in inside[0].iter().zip(inside[1]) {
            assert!((long / short - 1.0).abs() < 2e-3, "{bulk}: {inside:?}");
        }
    }
}

/// A cell of area A beside segments of length l loses particles to them at the rate k_on l/A, the fastest of which
/// bounds the step.
#[test]
fn the_smallest_cell_at_the_interface_bounds_the_step() {
    let exchange =
        ExchangeSetup { number_inside: Some(1.0), diffusion_inside: Some(1e-6), ..ExchangeSetup::new(50.0, 0.0) };
    let Built { mut scene, .. } = swimmer(without_grid(48, 96), Region::Plane, exchange);
    let (field, _) = scene.system().bodies::<ParticlesInDroplet>().next().expect("a field");
    let mut rate = vec![0.0; scene.system().state_len()];
    scene.system_mut().present_rate(&mut rate).expect("a flow");
    let body = scene.body(field).expect("a field");
    let rates = rate[rate.len() - body.numbers().len()..].iter().zip(body.numbers());
    let fastest = rates.map(|(rate, number)| -rate / number).fold(0.0, f64::max);
    let mut bound = f64::NAN;
    body.step_limits(&scene.system().hydrodynamics().fluid_view(), &mut |limit| {
        if limit.reason == "the exchange of particles" {
            bound = 2.0 / limit.dt;
        }
    });
    assert!((bound / fastest - 1.0).abs() < 1e-9, "{bound} {fastest}");
}
