use motile_scene::{PrescribedFlow, Scene, StepSize};

use super::*;
use crate::{ActiveDroplet, ContractileTension, Curve, Exchange, ExcludedVolume, InitialConcentration, Motion, Vec2};

/// Markers at rest, so that no step is too long.
const AT_REST: Motion = Motion::Equidistributed { relaxation: 0.0, filter: false };

#[test]
fn increments_of_a_path_add_up_and_have_the_variance_of_the_time() {
    let path = BrownianPath::new(7, 3, 0.5);
    for (k, [a, b, c]) in [[0.0, 0.1, 0.3], [0.2, 0.9, 2.6], [0.5, 0.5001, 1.0]].into_iter().enumerate() {
        let whole = path.increment(k as u64, a, c - a);
        let parts = path.increment(k as u64, a, b - a) + path.increment(k as u64, b, c - b);
        // Times are rounded, and paths are steep over the shortest pieces.
        assert!((whole - parts).abs() < 1e-10, "{whole} {parts}");
    }
    for dt in [1e-4, 0.03, 0.7] {
        let count = 20_000_u32;
        let squares = (0..count).map(|k| path.increment(u64::from(k), 0.37, dt).powi(2)).sum::<f64>();
        let ratio = squares / f64::from(count) / dt;
        assert!((ratio - 1.0).abs() < 4.0 * (2.0 / f64::from(count)).sqrt(), "{dt}: {ratio}");
    }
    // Steps that follow one another are independent.
    let products = (0..20_000_u64).map(|k| path.increment(k, 0.1, 0.2) * path.increment(k, 0.3, 0.2)).sum::<f64>();
    assert!((products / 20_000.0 / 0.2).abs() < 4.0 / 20_000.0_f64.sqrt());
}

/// Returns a droplet of radius R with c0 particles per length, without activity, in a scene at rest.
fn scene(
    radius: f64,
    c0: f64,
    diffusion: f64,
    seed: u64,
) -> (Scene<PrescribedFlow>, motile_scene::Handle<ActiveDroplet>) {
    let markers = Curve::circle(radius).unwrap().markers(16).unwrap();
    let numbers = InitialConcentration::uniform(c0).unwrap().particle_numbers(&markers).unwrap();
    let law = ContractileTension::new(1.0, 0.0, ExcludedVolume::None, c0).unwrap();
    let droplet = ActiveDroplet::new(&markers, numbers, law, diffusion).unwrap();
    let droplet = droplet.with_motion(AT_REST).with_noise(Noise::new(seed)).unwrap();
    let mut scene = Scene::new(PrescribedFlow::new(|_| Vec2::ZERO));
    let droplet = scene.add(droplet);
    (scene, droplet)
}

/// Returns the mean of the variances of the amplitudes of two modes over those of an ideal gas, at steps of `dt` in
/// units of R^2/D.
fn excess(radius: f64, c0: f64, diffusion: f64, dt: f64, steps: usize) -> f64 {
    let (mut scene, droplet) = scene(radius, c0, diffusion, 5);
    let total = scene.body(droplet).unwrap().particle_numbers().iter().sum::<f64>();
    let (mut sum, mut count) = (0.0, 0.0);
    for step in 0..steps {
        scene.step(dt * radius * radius / diffusion).unwrap();
        let body = scene.body(droplet).unwrap();
        let numbers = body.particle_numbers();
        assert!((numbers.iter().sum::<f64>() / total - 1.0).abs() < 1e-11);
        if step > steps / 20 {
            for mode in [1.0, 2.0, 5.0, 8.0] {
                let angle = |k: usize| mode * std::f64::consts::PI * (2.0 * k as f64 + 1.0) / 16.0;
                let amplitude = numbers.iter().enumerate().map(|(k, n)| n * angle(k).sin()).sum::<f64>();
                // Of the highest wave, all sines are one.
                let expected = total * if mode == 8.0 { 1.0 } else { 0.5 };
                sum += amplitude * amplitude / expected;
                count += 1.0;
            }
        }
    }
    sum / count
}

#[test]
fn an_ideal_gas_fluctuates_as_poisson_says_at_any_step_and_in_any_units() {
    // Correlation times of the first mode are 1/dt steps; the standard errors are below 0.03.
    for (radius, c0, diffusion, dt) in [(1.0, 1e4, 0.1, 1.0), (1e-6, 1e10, 1e-13, 3.0), (2.0, 1e4, 0.1, 0.3)] {
        let found = excess(radius, c0, diffusion, dt, 8000);
        assert!((found - 1.0).abs() < 0.04, "radius {radius}, step {dt}: {found}");
    }
}

#[test]
fn noise_is_the_same_whatever_the_steps_are() {
    let at_the_end = |dt: f64| {
        let (mut scene, droplet) = scene(1.0, 1e6, 0.1, 3);
        scene.run(0.8).step_size(StepSize::Fixed(dt)).go().unwrap();
        scene.body(droplet).unwrap().particle_numbers().to_vec()
    };
    let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let exact = at_the_end(0.8 / 256.0);
    let [coarse, fine] = [0.2, 0.05].map(|dt| distance(&at_the_end(dt), &exact));
    let spread = exact.iter().map(|n| (n - exact.iter().sum::<f64>() / 16.0).powi(2)).sum::<f64>().sqrt();
    // Of first order in the strong sense: a quarter of the step has a quarter of the error.
    assert!(coarse < 0.2 * spread && fine < 0.4 * coarse, "{coarse} {fine} {spread}");
}

#[test]
fn exchange_with_noise_keeps_particles_and_has_poisson_numbers() {
    let markers = Curve::circle(1.0).unwrap().markers(16).unwrap();
    let numbers = InitialConcentration::uniform(1e4).unwrap().particle_numbers(&markers).unwrap();
    let law = ContractileTension::new(1.0, 0.0, ExcludedVolume::None, 1e4).unwrap();
    let droplet = ActiveDroplet::new(&markers, numbers, law, 0.1).unwrap().with_motion(AT_REST);
    let exchange = Exchange::new(0.3, 0.2).unwrap();
    let inside = exchange.concentration_at_rest(1e4).unwrap() * droplet.initial_area();
    let droplet = droplet.with_well_mixed_interior(exchange, inside).unwrap().with_noise(Noise::new(2)).unwrap();
    let mut scene = Scene::new(PrescribedFlow::new(|_| Vec2::ZERO));
    let droplet = scene.add(droplet);
    let total = |scene: &Scene<PrescribedFlow>| {
        let body = scene.body(droplet).unwrap();
        (body.particle_numbers().iter().sum::<f64>(), body.number_inside().unwrap())
    };
    let (on, within) = total(&scene);
    let (mut square, mut mode, steps) = (0.0, 0.0, 8000);
    for _ in 0..steps {
        scene.step(4.0).unwrap();
        let (now, then) = total(&scene);
        assert!(((now + then) / (on + within) - 1.0).abs() < 1e-10);
        square += (now - on).powi(2) / f64::from(steps);
        let numbers = scene.body(droplet).unwrap().particle_numbers();
        let angle = |k: usize| std::f64::consts::PI * (2.0 * k as f64 + 1.0) / 16.0;
        mode += numbers.iter().enumerate().map(|(k, n)| n * angle(k).sin()).sum::<f64>().powi(2) / f64::from(steps);
    }
    // Of all particles, each is on the interface with the same probability: a binomial number.
    let expected = on * within / (on + within);
    assert!((square / expected - 1.0).abs() < 0.06, "{}", square / expected);
    assert!((mode / (0.5 * on) - 1.0).abs() < 0.06, "{}", mode / (0.5 * on));
}

#[test]
fn noise_of_nothing_is_refused() {
    let markers = Curve::circle(1.0).unwrap().markers(16).unwrap();
    assert!(ActiveDroplet::passive(&markers, 1.0).unwrap().with_noise(Noise::new(1)).is_err());
    let law = ContractileTension::new(1.0, 0.0, ExcludedVolume::None, 1.0).unwrap();
    assert!(ActiveDroplet::new(&markers, vec![1.0; 16], law, 0.0).unwrap().with_noise(Noise::new(1)).is_err());
    for strength in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(Noise::new(1).with_strength(strength).is_err());
    }
}

#[test]
fn rings_of_a_sphere_fluctuate_as_poisson_says() {
    // The sum of P_l(cos theta) over the particles on half of a sphere has the variance c0 4 pi R^2/(2l + 1)/4.
    let (radius, c0, diffusion) = (2.0, 1e4, 0.1);
    let markers = Curve::circle(radius).unwrap().markers(32).unwrap();
    let numbers = InitialConcentration::uniform(c0).unwrap().particle_numbers(&markers).unwrap();
    let law = ContractileTension::new(1.0, 0.0, ExcludedVolume::None, c0).unwrap();
    let droplet = ActiveDroplet::new(&markers, numbers, law, diffusion).unwrap().with_motion(AT_REST);
    let droplet = droplet.axisymmetric().unwrap().with_noise(Noise::new(11)).unwrap();
    let mut scene = Scene::new(PrescribedFlow::new(|_| Vec2::ZERO));
    let droplet = scene.add(droplet);
    let (mut sums, mut start, steps) = ([0.0; 2], [0.0; 2], 6000);
    for step in 0..=steps {
        let numbers = scene.body(droplet).unwrap().particle_numbers();
        let pairs = numbers.iter().zip(numbers.iter().rev());
        assert!(pairs.clone().all(|(a, b)| (a - b).abs() < 1e-9 * c0), "{numbers:?}");
        let sum = |weight: fn(f64) -> f64| -> f64 {
            let angle = |k: usize| std::f64::consts::TAU * (k as f64 + 0.5) / 32.0;
            numbers.iter().enumerate().take(16).map(|(k, n)| n * weight(angle(k).cos())).sum()
        };
        let found = [sum(|x| x), sum(|x| 1.5 * x * x - 0.5)];
        if step == 0 {
            start = found;
        }
        sums.iter_mut().zip(found).zip(start).for_each(|((sum, found), start)| *sum += (found - start).powi(2));
        scene.step(30.0).unwrap();
    }
    for (l, sum) in [1.0, 2.0].into_iter().zip(sums) {
        let expected = c0 * 4.0 * std::f64::consts::PI * radius * radius / (2.0 * l + 1.0) / 4.0;
        assert!((sum / f64::from(steps) / expected - 1.0).abs() < 0.08, "{l}: {}", sum / f64::from(steps) / expected);
    }
}

#[test]
fn adaptive_steps_keep_the_variance() {
    let markers = Curve::circle(1.0).unwrap().markers(16).unwrap();
    let numbers = InitialConcentration::uniform(1e3).unwrap().particle_numbers(&markers).unwrap();
    let law = ContractileTension::new(1.0, 0.0, ExcludedVolume::None, 1e3).unwrap();
    let droplet = ActiveDroplet::new(&markers, numbers, law, 0.1).unwrap();
    let droplet = droplet.with_area_constraint(true).with_noise(Noise::new(8)).unwrap();
    // A rotation, which changes no statistics.
    let mut scene = Scene::new(PrescribedFlow::new(|x: Vec2| Vec2::new(-x.y, x.x)));
    let droplet = scene.add(droplet);
    let total = 1e3 * std::f64::consts::TAU;
    let (mut sum, reports) = (0.0, 400);
    for report in 1..=reports {
        scene.run(10.0 * f64::from(report)).step_size(StepSize::Adaptive { tolerance: 1e-3 }).go().unwrap();
        let body = scene.body(droplet).unwrap();
        let (markers, numbers) = (body.markers(), body.particle_numbers());
        let place = |k: usize| 0.5 * (markers[k] + markers[(k + 1) % 16]);
        let moment: Vec2 = numbers.iter().enumerate().map(|(k, n)| *n * place(k)).sum();
        sum += moment.length_squared() / total / f64::from(reports);
    }
    // The standard error is 1/sqrt(400).
    assert!((sum - 1.0).abs() < 0.12, "{sum}");
}
