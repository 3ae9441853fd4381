use motile::prelude::*;
use motile::setup::{DropletShape, Start};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bean = |k: usize| {
        let t = std::f64::consts::TAU * k as f64 / 40.0;
        [1.5 + t.cos() + 0.2 * (2.0 * t).cos(), t.sin()]
    };
    let start = Start::Perturbed { amplitude: 0.1, seed: 7 };
    let setup = Setup {
        region: Region::Box { lengths: [8.0, 6.0] },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![
            DropletSetup { centre: [-1.5, 0.0], viscosity: Some(1000.0), ..DropletSetup::active(-3.0) },
            DropletSetup {
                shape: DropletShape::Points((0..40).map(bean).collect()),
                particles: Some(Particles { start, ..Particles::default() }),
                ..DropletSetup::default()
            },
        ],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(1.0).go()?;
    for droplet in droplets {
        println!("speed {:.4}", scene.observe(droplet)?.speed());
    }
    Ok(())
}
