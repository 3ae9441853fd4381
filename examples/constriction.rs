//! A droplet passes a constriction, or does not.
//!
//! `cargo run --release --example constriction` lets droplets of activity -4 swim into constrictions of a channel of
//! width 3. They pass a throat of width 1.6. In a throat of width 1.2 they stop.

use motile::elastic_solids::ChannelShape;
use motile::prelude::*;
use motile::setup::WallSetup;

/// Runs until the droplet has passed a throat of that width or the time is over; returns its last place.
fn place(throat: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let shape =
        ChannelShape::Constriction { width: 3.0, throat, throat_length: 2.0, ramp: 1.0, exit_ramp: None, centre: 0.0 };
    let mut walls = WallSetup::channel(&shape, 0.05);
    walls.iter_mut().for_each(|wall| wall.rounding = 0.2);
    let setup = Setup {
        region: Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Integral(IntegralMethod { nodes: 56, elements: 224 }),
        droplets: vec![DropletSetup { centre: [-3.5, 0.0], ..DropletSetup::active(-4.0) }],
        walls,
        mirror_symmetric: true,
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    for time in 1..=60 {
        scene.run(f64::from(time)).go()?;
        if scene.observe(droplets[0])?.centroid.x > 2.5 {
            break;
        }
    }
    println!("throat {throat}: t = {}, at {:.3}", scene.time(), scene.observe(droplets[0])?.centroid);
    Ok(scene.observe(droplets[0])?.centroid.x)
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    assert!(place(1.6)? > 2.0, "the droplet has not passed the wide throat");
    assert!(place(1.2)? < 1.0, "the droplet has passed the narrow throat");
    Ok(())
}
