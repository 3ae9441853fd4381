//! A droplet between elastic walls that are built in code.
//!
//! `cargo run --release --example elastic_channel` lets a droplet swim through a channel of width 3, whose walls are
//! strips of springs in front of rigid ones. The softer the walls, the more the droplet moves them, and the faster it
//! is: 0.197 between soft walls. Between stiff ones its speed is that between rigid walls, 0.186, which boundary
//! integrals compute without a grid.

use motile::elastic_solids::{Solid, mesh::fitted_strip};
use motile::prelude::*;

/// Returns the speed after a time of 2, and the largest displacement of the walls, whose springs have that shear
/// modulus.
fn between_elastic_walls(shear: f64) -> Result<[f64; 2], Box<dyn std::error::Error>> {
    let setup = Setup {
        region: Region::Channel { length: 10.0, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod { nodes: 48, elements: 192, ..LayersMethod::of_spacing(0.1) }),
        ..Setup::default()
    };
    let mut scene = Scene::new(setup.flow()?);
    let droplet = scene.add(setup.droplet(&DropletSetup::active(-4.0))?);
    let mut walls = Vec::new();
    for bottom in [-2.5, 1.5] {
        let mesh = fitted_strip(Vec2::new(-5.0, bottom), [10.0, 1.0], 0.2)?;
        // The rows that touch the rigid walls of the region are held.
        walls.push(scene.add(Solid::springs(mesh, shear)?.pinned(|point| point.y.abs() > 2.499)?));
    }
    scene.run(2.0).go()?;
    let moved = [scene.observe(walls[0])?, scene.observe(walls[1])?].map(|wall| wall.largest_displacement);
    Ok([scene.observe(droplet)?.speed(), moved[0].max(moved[1])])
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rigid = Setup {
        region: Region::Channel { length: 10.0, width: 3.0, drive: Drive::ZeroGradient },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![DropletSetup::active(-4.0)],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = rigid.build()?;
    scene.run(2.0).go()?;
    let rigid = scene.observe(droplets[0])?.speed();
    let [soft, stiff] = [between_elastic_walls(200.0)?, between_elastic_walls(5000.0)?];
    println!(
        "speed and displacement of soft walls {soft:.4?}, of stiff walls {stiff:.4?}, speed of rigid ones {rigid:.4}"
    );
    assert!(soft[1] > 5.0 * stiff[1], "soft walls give way");
    assert!((stiff[0] / rigid - 1.0).abs() < 0.02 && (soft[0] - rigid).abs() > 2.0 * (stiff[0] - rigid).abs());
    Ok(())
}
