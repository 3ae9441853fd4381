//! Your own tension law.
//!
//! `cargo run --release --example own_tension` gives a droplet a tension that saturates with the concentration. A small
//! perturbation of the uniform concentration then grows as linear theory predicts from the slope of the law at the mean
//! concentration: at 0.0875 per unit of time.

use motile::active_interface::Tension;
use motile::active_interface::theory::{LinearTheory, RoundDroplet};
use motile::prelude::*;
use motile::setup::Start;

/// The law gamma(c) = 10 + rise c/(c + half).
#[derive(Debug, Clone, Copy)]
struct Saturating {
    rise: f64,
    half: f64,
}

impl Tension for Saturating {
    fn value(&self, c: f64) -> f64 {
        10.0 + self.rise * c / (c + self.half)
    }
    fn slope(&self, c: f64) -> f64 {
        self.rise * self.half / (c + self.half).powi(2)
    }
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let law = Saturating { rise: 300.0, half: 100.0 };
    let theory = LinearTheory::new(RoundDroplet {
        radius: 1.0,
        viscosity_inside: 100.0,
        viscosity_outside: 100.0,
        tension: law.value(100.0),
        activity: -law.slope(100.0),
        concentration: 100.0,
        diffusivity: 0.1,
    })?;
    let start = Start::Perturbed { amplitude: 1e-4, seed: 1 };
    let particles = Particles { start, ..Particles::default() };
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![DropletSetup { particles: Some(particles), ..DropletSetup::default() }],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.body_mut(droplets[0])?.set_tension(law);
    // Speed is in proportion to the first mode of the concentration, so both grow alike.
    scene.run(4.0).go()?;
    let before = scene.observe(droplets[0])?.speed();
    scene.run(8.0).go()?;
    let growth = (scene.observe(droplets[0])?.speed() / before).ln() / 4.0;
    let exact = theory.concentration_growth_rate(1);
    println!("growth rate {growth:.5}, by linear theory {exact:.5}");
    assert!((growth / exact - 1.0).abs() < 2e-3);
    Ok(())
}
