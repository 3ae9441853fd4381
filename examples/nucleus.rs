//! A droplet with a rigid nucleus.
//!
//! `cargo run --release --example nucleus` lets a droplet swim in unbounded fluid with a rigid disc inside, slightly
//! off the axis. The disc makes the droplet swim in circles. Newton's method starts from the last state of the run and
//! finds the steady state on such a circle: its speed, 0.0992, and turning rate, -0.036, agree with the run to 1 %.

use motile::prelude::*;
use motile::setup::RigidBodySetup;
use motile_steady_states::{Profile, SteadyState};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 64, elements: 256 }),
        droplets: vec![DropletSetup::active(-2.0)],
        rigid_bodies: vec![RigidBodySetup { centre: [0.05, 0.15], ..RigidBodySetup::disc(0.7) }],
        ..Setup::default()
    };
    let Built { mut scene, droplets, rigid_bodies, .. } = setup.build()?;
    scene.run(98.0).go()?;
    let before = scene.observe(droplets[0])?.velocity;
    scene.run(100.0).go()?;
    let (cell, core) = (scene.observe(droplets[0])?, scene.observe(rigid_bodies[0])?);
    let turning = before.angle_to(cell.velocity) / 2.0;

    // The last state, seen along its motion: the droplet's centre is the origin.
    let heading = cell.velocity.normalize();
    let turned = |x: Vec2| Vec2::new((x - cell.centroid).dot(heading), heading.perp_dot(x - cell.centroid));
    let body = scene.body(droplets[0])?;
    let markers: Vec<Vec2> = body.markers().iter().map(|x| turned(*x)).collect();
    let profile = Profile::from_markers(&markers, body.particle_numbers())?.with_nuclei(vec![turned(core.centre)]);
    let steady = SteadyState::near(&setup, &profile, Vec2::new(cell.speed(), 0.0), false)?;
    let (speed, rate) = (steady.measured()?.speed, steady.turning_rate());
    println!("speed {:.5}, by Newton's method {speed:.5}; turning rate {turning:.5}, {rate:.5}", cell.speed());
    assert!((cell.speed() / speed - 1.0).abs() < 0.01 && (turning / rate - 1.0).abs() < 0.01);
    Ok(())
}
