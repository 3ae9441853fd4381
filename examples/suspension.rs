//! Many droplets in a box.
//!
//! `cargo run --release --example suspension` puts four aligned droplets on a square lattice in a box of 12 x 12. That
//! is one droplet in a box of 6 x 6, seen over two periods, so all of them swim at its speed, 0.1302 at t = 3. Sixteen
//! droplets with random places and headings then swim through their collisions, and a repulsion keeps the fluid films
//! between them open. Tables of what they do together (`suspension.csv`, `members.csv`) and a picture that is coloured
//! by headings go to `out/suspension/`.

use std::path::Path;

use motile::prelude::*;
use motile::scene::gap::Repulsion;
use motile::setup::{Arrangement, Distribution, Headings, SuspensionSetup};
use motile_output::suspension::{SuspensionColour, SuspensionCsv, SuspensionPicture};

/// Returns the box of that side with droplets by boundary integrals.
fn in_box(side: f64) -> Setup {
    Setup {
        region: Region::Box { lengths: [side; 2] },
        method: Method::Integral(IntegralMethod { nodes: 32, elements: 128 }),
        droplets: Vec::new(),
        ..Setup::default()
    }
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let alone = Setup { droplets: vec![DropletSetup::default()], ..in_box(6.0) };
    let (headings, arrangement) = (Headings::Aligned(0.0), Arrangement::Lattice);
    let lattice = SuspensionSetup { count: Some(4), headings, arrangement, ..SuspensionSetup::default() };
    let mut speeds = Vec::new();
    for setup in [alone, Setup { suspension: vec![lattice], ..in_box(12.0) }] {
        let Built { mut scene, droplets, .. } = setup.build()?;
        scene.run(3.0).go()?;
        for droplet in droplets {
            speeds.push(scene.observe(droplet)?.velocity.x);
        }
    }
    println!("alone {:.6}, on a lattice {:.6?}", speeds[0], &speeds[1..]);
    assert!(speeds.len() == 5 && speeds.iter().all(|speed| (speed / speeds[0] - 1.0).abs() < 1e-6));

    let activity = Some(Distribution::Between([-3.0, -2.0]));
    let crowd = SuspensionSetup { count: Some(16), activity, ..SuspensionSetup::default() };
    // A film of 0.2 radii bears the capillary pressure of a droplet.
    let repulsion = Some(Repulsion::holding(0.2, 310.0)?);
    let Built { mut scene, droplets, .. } = Setup { suspension: vec![crowd], repulsion, ..in_box(13.0) }.build()?;
    let directory = Path::new("out/suspension");
    std::fs::create_dir_all(directory)?;
    let mut tables = SuspensionCsv::create(directory, scene.system_mut(), 0.2)?;
    scene.run(2.0).observe(Every::Time(0.1), &mut tables).go()?;
    let picture = SuspensionPicture::take(scene.system_mut())?;
    picture.write_picture(SuspensionColour::Heading, 1200.0, directory.join("final.png"))?;
    let (gap, order) = (scene.system().minimum_gap().ok_or("a scene without gaps")?, tables.last("polar_order"));
    println!("{} droplets, smallest gap {gap:.3}, polar order {order:.3?}", droplets.len());
    assert!(droplets.len() == 16 && gap > 0.0);
    Ok(())
}
