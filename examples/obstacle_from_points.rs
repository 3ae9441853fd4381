//! Geometry in code, 2: an obstacle from a list of points.
//!
//! `cargo run --release --example obstacle_from_points` puts a wedge into a channel, off the axis. Stokes flow is
//! reversible: although the wedge is blunt on one side and sharp on the other, it resists the flow equally in both
//! directions, to the accuracy of the solver. Then a droplet swims towards the wedge and around it.

use std::f64::consts::TAU;

use motile::prelude::*;
use motile::setup::{SolidOutline, WallSetup};

/// Returns the pressure gradient that drives a flux through the channel with the obstacle, with the droplet at rest at
/// its start.
fn gradient(setup: &Setup, flux: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let mut setup = setup.clone();
    setup.region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::Flux(flux) };
    setup.droplets = vec![DropletSetup { centre: [-4.0, 0.0], ..DropletSetup::passive(10.0) }];
    let mut scene = setup.build()?.scene;
    scene.system_mut().evaluate()?;
    Ok(scene.system().report().mean_pressure_gradient[0])
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A drop shape with its tip to the right: any closed list of points, in order.
    let corners = (0..60)
        .map(|k| TAU * f64::from(k) / 60.0)
        .map(|t| [1.5 + 0.7 * t.cos(), 1.5 + 0.45 * t.sin() * (0.5 - 0.5 * t.cos() + 0.15)])
        .collect();
    let outline = SolidOutline::Polygon { corners, rounding: 0.0 };
    let setup = Setup {
        region: Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        walls: vec![WallSetup { rounding: 0.08, ..WallSetup::new(outline, 0.06) }],
        droplets: vec![DropletSetup { centre: [-2.0, 0.2], ..DropletSetup::active(-4.0) }],
        ..Setup::default()
    };
    let [right, left] = [gradient(&setup, 1.0)?, gradient(&setup, -1.0)?];
    // Without an obstacle it is 12 eta Q/w^3.
    let free = -12.0 * setup.viscosity / 125.0;
    println!("pressure gradient {right:.4} to the right, {left:.4} to the left, in an empty channel {free}");
    assert!((right + left).abs() < 1e-6 * right.abs() && right / free > 1.02);

    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(20.0).go()?;
    let (seen, gap) = (scene.observe(droplets[0])?, scene.system().minimum_wall_gap().ok_or("no walls")?);
    println!("the droplet has come to {:.2}, smallest gap {gap:.3}", seen.centroid);
    assert!(seen.centroid.x > 1.5 && seen.centroid.y < 0.2 && gap > 0.0, "it goes below the wedge");
    Ok(())
}
