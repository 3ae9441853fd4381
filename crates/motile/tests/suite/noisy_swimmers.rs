//! Swimmers whose particles fluctuate, against linear theory.

use std::f64::consts::TAU;

use motile::prelude::*;
use motile::scene::StepSize;
use motile::setup::NoiseSetup;

/// Directions of a swimmer at the times 0, 1, 2, ... (radians, unwrapped), after it has become steady.
fn directions(seed: u64, strength: f64, until: usize) -> Vec<f64> {
    let particles = Particles { noise: Some(NoiseSetup { seed, strength }), ..Particles::default() };
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 16, elements: 48 }),
        step: StepSize::Fixed(0.1),
        droplets: vec![DropletSetup { particles: Some(particles), ..DropletSetup::default() }],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().expect("a good scene");
    scene.run(20.0).go().expect("a run");
    let mut found: Vec<f64> = Vec::new();
    for k in 0..until {
        scene.run(20.0 + k as f64).go().expect("a run");
        let heading = scene.observe(droplets[0]).expect("a good state").heading().expect("a swimmer");
        let last = found.last().copied().unwrap_or(heading);
        found.push(last + (heading - last + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU);
    }
    found
}

/// The direction diffuses with `D_r = D INT c (dy/ds)^2 ds/<y, dc/dtheta>^2`, y the left null vector of the swimmer's
/// Jacobian, times the square of the strength. At activity -2 it is 2.081379e-4 (Fourier-Newton on the circle). This is
/// one of the longer tests, as a mean square turn needs many turns.
#[test]
fn the_direction_of_a_noisy_swimmer_diffuses_as_linear_theory_says() {
    let (strength, exact, lags, runs) = (0.2, 2.081379e-4, [4, 20], 8);
    let found: Vec<f64> = (1..=runs)
        .map(|seed| {
            let series = directions(seed, strength, 300);
            let square = |lag: usize| {
                let turns = series.windows(lag + 1).map(|window| (window[lag] - window[0]).powi(2));
                turns.sum::<f64>() / (series.len() - lag) as f64
            };
            // The difference of two lags is free of the jitter of the direction.
            (square(lags[1]) - square(lags[0])) / (2.0 * (lags[1] - lags[0]) as f64) / (strength * strength)
        })
        .collect();
    let count = runs as f64;
    let mean = found.iter().sum::<f64>() / count;
    let error = (found.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / (count * (count - 1.0))).sqrt();
    println!("{mean:e} +- {error:e} against {exact:e}");
    assert!((mean - exact).abs() < 2.5 * error && error < 0.25 * exact, "{mean:e} +- {error:e}: {found:?}");
}
