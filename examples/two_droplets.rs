//! Two droplets swim past each other.
//!
//! `cargo run --release --example two_droplets` starts them head-on, 1.25 radii above and below the axis. A turn by
//! half a circle exchanges them, so they stay opposite to each other: the sum of their centres remains zero. They turn
//! each other, and the gap between them never falls below 0.27 radii.

use motile::prelude::*;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let droplet = |x: f64, y: f64, angle: f64| DropletSetup { centre: [x, y], angle, ..DropletSetup::active(-3.0) };
    let setup = Setup {
        region: Region::Box { lengths: [12.0, 8.0] },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![droplet(-2.0, -1.25, 0.0), droplet(2.0, 1.25, std::f64::consts::PI)],
        // To end a run whose droplets touch, give the least gap between them.
        least_gap: Some(0.01),
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(20.0).go()?;
    // The smallest gap of all steps.
    let gap = scene.system().minimum_gap().ok_or("no gap")?;
    let [first, second] = [scene.observe(droplets[0])?, scene.observe(droplets[1])?];
    println!("first at {:.3}, second at {:.3}, smallest gap {gap:.3}", first.centroid, second.centroid);
    assert!((first.centroid + second.centroid).length() < 1e-6, "the symmetry is lost");
    assert!(first.centroid.x > second.centroid.x && (gap - 0.27).abs() < 0.01, "they have not passed each other");
    Ok(())
}
