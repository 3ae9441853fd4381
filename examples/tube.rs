//! Three dimensions: a droplet swims along a tube.
//!
//! `cargo run --release --example tube` simulates an axisymmetric droplet in a tube of radius 1.6, and compares its
//! speed, 0.0784, with the speed of the steady state by Newton's method: they agree to 0.1 %.

use motile::prelude::*;
use motile_steady_states::SteadyState;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let setup = Setup {
        region: Region::tube(1.6),
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![DropletSetup::contractile(-1.0, 2.0)],
        ..Setup::default()
    };
    let steady = SteadyState::find(&setup)?.measured()?.speed;
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(30.0).go()?;
    let seen = scene.observe(droplets[0])?;
    println!("speed {:.5}, by Newton's method {steady:.5}, volume {:.5}", seen.speed(), seen.area);
    assert!((seen.speed() / steady - 1.0).abs() < 1e-3);
    Ok(())
}
