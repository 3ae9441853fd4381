//! Particles bind to the interface of a droplet and unbind into its inside.
//!
//! `cargo run --release --example exchange` starts with a droplet that swims. No particle is lost: their number on the
//! interface and inside changes by less than 1e-9 of itself. With an activity weaker than the threshold, it comes to
//! rest with both in equilibrium, where there are 0.8 particles on the interface for each one inside.

use motile::prelude::*;
use motile::setup::ExchangeSetup;

/// Runs a droplet of that activity, and returns its numbers of particles on the interface and inside, before and after.
fn numbers(activity: f64, exchange: ExchangeSetup) -> Result<[[f64; 2]; 2], Box<dyn std::error::Error>> {
    let particles = Particles { activity, exchange: Some(exchange), ..Particles::default() };
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![DropletSetup { particles: Some(particles), ..DropletSetup::default() }],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut seen = [[0.0; 2]; 2];
    for (row, time) in seen.iter_mut().zip([0.0, 40.0]) {
        scene.run(time).go()?;
        let now = scene.observe(droplets[0])?;
        *row = [now.particle_number, now.inside.ok_or("no particles inside")?.0];
    }
    Ok(seen)
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [binding, unbinding] = [0.2, 0.5];
    // With `diffusion_inside`, particles inside would be a field that the flow carries along.
    let exchange = ExchangeSetup::new(binding, unbinding);
    let [before, after] = numbers(-3.0, exchange)?.map(|[on, inside]| on + inside);
    println!("{before:.6} particles at the start, {after:.6} in the end");
    assert!((after / before - 1.0).abs() < 1e-9);

    // Per length of the interface 2 pi and area pi of a round droplet: on/(2 pi) unbinding = inside/pi binding.
    let [_, [on, inside]] = numbers(-0.1, exchange)?;
    println!(
        "{:.6} particles on the interface for each one inside, exactly {:.6}",
        on / inside,
        2.0 * binding / unbinding
    );
    assert!((on / inside / (2.0 * binding / unbinding) - 1.0).abs() < 1e-3);
    Ok(())
}
