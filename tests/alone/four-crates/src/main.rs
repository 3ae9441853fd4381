//! A droplet swims above an elastic strip in a channel.

use active_interface::{ActiveDroplet, ContractileTension, Curve, InitialConcentration};
use elastic_solids::{NeoHookean, Solid, mesh::fitted_strip};
use ib_core::{BSpline, ImmersedBoundary, Scene, Vec2};
use stokes_grid::{ChannelStokes, Grid};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let solver = ChannelStokes::new(Grid::channel(60, 40, 0.1)?, 100.0)?;
    let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));

    let markers = Curve::circle(1.0)?.translated(Vec2::new(0.0, 0.4)).markers(120)?;
    let numbers = InitialConcentration::polarised(100.0, 0.0)?.particle_numbers(&markers)?;
    let law = ContractileTension::thesis(10.0, -2.0, 2.0, 100.0)?;
    let droplet = scene.add(ActiveDroplet::new(&markers, numbers, law, 0.1)?);

    let strip = fitted_strip(Vec2::new(-3.0, -2.0), [6.0, 0.8], 0.1)?;
    let material = NeoHookean::new(300.0, 600.0)?;
    let strip = scene.add(Solid::hyperelastic(strip, material).pinned(|point| point.y < -1.99)?);

    scene.run(2.0).go()?;
    let (speed, moved) = (scene.observe(droplet)?.speed(), scene.observe(strip)?.largest_displacement);
    println!("the droplet swims at {speed:.4}, the strip is displaced by up to {moved:.4}");
    assert!((speed - 0.1545).abs() < 0.001 && (moved - 0.0912).abs() < 0.001);
    Ok(())
}
