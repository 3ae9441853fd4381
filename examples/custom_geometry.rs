//! Geometry in code, 1: walls that are functions of x.
//!
//! `cargo run --release --example custom_geometry` drives fluid through a channel of the half width 1 + 0.3 cos(k x)
//! with flux 1. Lubrication theory gives the mean pressure gradient, -3/2 eta Q times the mean of 1/(half width)^3, up
//! to the square of the slope of the walls. Over twice the period the difference falls to a quarter. Then a droplet
//! swims through elastic walls of the same shape, whose mesh fills the area between the function and the rigid wall.

use std::f64::consts::TAU;

use motile::boundary_integrals::{BoundaryIntegral, RigidWall, Settings};
use motile::elastic_solids::{Channel, Mesher, NeoHookean, Solid};
use motile::prelude::*;

/// Half width of the channel.
fn half_width(x: f64, period: f64) -> f64 {
    1.0 + 0.3 * (TAU * x / period).cos()
}

/// Returns the mean pressure gradient that drives a flux of 1 through rigid walls, over the gradient of lubrication
/// theory.
fn resistance(period: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let region = Region::Channel { length: period, width: 4.0, drive: Drive::Flux(1.0) };
    let nodes = 8 * period as usize;
    let walls = [
        RigidWall::below(period, nodes, |x| -half_width(x, period))?,
        RigidWall::above(period, nodes, |x| half_width(x, period))?,
    ];
    let viscosity = 100.0;
    let flow = BoundaryIntegral::new(region, viscosity, Settings::default())?.with_walls(&walls)?;
    let mut scene = Scene::new(flow);
    // A round droplet of constant tension and of the viscosity of the fluid changes nothing about the flow.
    scene.add(Setup::default().droplet(&DropletSetup::passive(10.0).with_radius(0.5))?);
    scene.system_mut().evaluate()?;
    let gradient = scene.system().report().mean_pressure_gradient[0];
    let mean = (0..256).map(|k| half_width(period * f64::from(k) / 256.0, period).powi(-3)).sum::<f64>() / 256.0;
    Ok(gradient / (-1.5 * viscosity * mean))
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [short, long] = [resistance(12.0)?, resistance(24.0)?];
    println!("pressure gradient over that of lubrication theory: {short:.5}, with twice the period {long:.5}");
    let fall = (short - 1.0) / (long - 1.0);
    assert!((fall - 4.0).abs() < 0.4, "the difference falls by {fall}");

    // Elastic walls of that shape: a mesh, a material, and points that are held.
    let period = 12.0;
    let setup = Setup {
        region: Region::Channel { length: period, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(0.2)),
        ..Setup::default()
    };
    let mut scene = Scene::new(setup.flow()?);
    let droplet = scene.add(setup.droplet(&DropletSetup::active(-4.0).with_radius(0.9))?);
    let shape = move |x: f64| half_width(x, period) + 0.2;
    let channel = Channel::between(-0.5 * period, period, move |x| -shape(x), shape)?;
    let mesher = Mesher::new(0.4)?;
    let material = NeoHookean::new(300.0, 600.0)?;
    for mesh in [channel.lower_wall(-2.5, &mesher)?, channel.upper_wall(2.5, &mesher)?] {
        // Between y = 1.2 + 0.3 cos(k x) and 2.5 lie 1.3 on average.
        assert!((mesh.area() / (1.3 * period) - 1.0).abs() < 1e-2, "area {}", mesh.area());
        scene.add(Solid::hyperelastic(mesh, material).pinned(|point| point.y.abs() > 2.499)?);
    }
    scene.run(1.0).go()?;
    println!("between elastic walls the droplet swims at {:.4}", scene.observe(droplet)?.speed());
    Ok(())
}
