//! An interface along a channel whose particles gather by themselves.
//!
//! `cargo run --release --example active_walls` perturbs the concentration on a flat interface in the middle of a
//! channel. The longest wave grows as linear theory predicts, at 0.138 per unit of time, to the error of the elements:
//! 0.1 %.

use std::f64::consts::TAU;

use motile::active_interface::theory::{FlatInterface, Stratum, StratumEnd};
use motile::prelude::*;
use motile::setup::{ExcludedVolume, InterfaceSetup, Side, Start};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (length, width, activity) = (6.0, 6.0, -1.0);
    let start = Start::Perturbed { amplitude: 1e-5, seed: 1 };
    let interface = InterfaceSetup {
        inside: Side::Below,
        particles: Some(Particles { activity, start, excluded_volume: ExcludedVolume::None, ..Particles::default() }),
        ..InterfaceSetup::default()
    };
    let setup = Setup {
        region: Region::Channel { length, width, drive: Drive::ZeroGradient },
        method: Method::Integral(IntegralMethod { nodes: 32, elements: 128 }),
        droplets: Vec::new(),
        interfaces: vec![interface],
        ..Setup::default()
    };
    let particles = Particles::default();
    let flat = FlatInterface {
        wave_number: TAU / length,
        tension: setup.interfaces[0].tension - activity * particles.concentration,
        activity,
        concentration: particles.concentration,
        diffusivity: particles.diffusion,
    };
    let fluid = Stratum { viscosity: setup.viscosity, end: StratumEnd::Wall { thickness: 0.5 * width } };
    let [[exact, _], _] = flat.growth_matrix(fluid, fluid)?;

    let Built { mut scene, interfaces, .. } = setup.build()?;
    let mut amplitudes = [0.0_f64; 2];
    for (amplitude, time) in amplitudes.iter_mut().zip([1.0, 5.0]) {
        scene.run(time).step_size(StepSize::Fixed(0.01)).go()?;
        let modes = scene.observe(interfaces[0])?.concentration_modes;
        *amplitude = modes.cosines[0].hypot(modes.sines[0]);
    }
    let growth = (amplitudes[1] / amplitudes[0]).ln() / 4.0;
    println!("growth rate {growth:.5}, by linear theory {exact:.5}");
    assert!((growth / exact - 1.0).abs() < 1e-3);
    Ok(())
}
