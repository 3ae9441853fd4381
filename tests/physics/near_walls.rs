//! Droplets that meet walls: nothing tunnels, nothing is lost.

use motile::active_interface::{ActiveDroplet, polygon_area, polygon_moments};
use motile::base::Drive;
use motile::base::Region;
use motile::scene::{StepSize, gap::wall_gap};
use motile::setup::{Built, DropletSetup, DropletShape, Setup};
use motile_tests::validation::scene::{on_grid, open_channel};

/// Gap between a droplet and the walls at y = -height and height.
fn gap(droplet: &ActiveDroplet, height: f64) -> f64 {
    wall_gap(droplet.markers(), [-height, height])
}

fn area_change(droplet: &ActiveDroplet) -> f64 {
    polygon_area(droplet.markers()).expect("a droplet of a scene") / droplet.initial_area() - 1.0
}

/// A passive droplet off the centre line of a Poiseuille flow drifts along, is deformed, and in Stokes flow without a
/// viscosity contrast moves away from the wall.
#[test]
fn passive_droplet_in_poiseuille_flow() {
    let (l, w) = (6.0, 3.0);
    let shape = DropletShape::Round { radius: 0.6 };
    let setup = Setup {
        region: Region::Channel { length: l, width: w, drive: Drive::Gradient(-1.0) },
        viscosity: 1.0,
        droplets: vec![DropletSetup { centre: [0.0, 0.7], shape, ..DropletSetup::passive(5.0) }],
        ..on_grid(0.1)
    };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let droplet = droplets[0];
    let start = gap(scene.body(droplet).unwrap(), 0.5 * w);
    scene.run(20.0).step_size(StepSize::OfLimit(0.25)).go().unwrap();
    let body = scene.body(droplet).unwrap();
    assert!(area_change(body).abs() < 1e-5, "{:e}", area_change(body));
    assert!(gap(body, 0.5 * w) > start, "it moves away from the wall");
    // Undisturbed flow at the centre of the channel: w^2/8 per unit gradient and viscosity; the droplet is slower.
    let travelled = polygon_moments(body.markers()).unwrap().centroid.x;
    assert!(travelled > l && travelled < 20.0 * w * w / 8.0, "{travelled}");
}

/// A swimmer driven into a wall drains the film between them to a fraction of the grid spacing and turns away.
#[test]
fn swimmer_driven_into_a_wall() {
    for (h, degrees) in [(0.1, 45.0_f64), (0.05, 80.0)] {
        let droplet = DropletSetup { angle: degrees.to_radians(), centre: [0.0, 0.3], ..DropletSetup::active(-4.0) };
        let setup = Setup { region: open_channel(12.0, 3.0), droplets: vec![droplet], ..on_grid(h) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let droplet = droplets[0];
        let particles: f64 = scene.body(droplet).unwrap().particle_numbers().iter().sum();
        let mut closest = f64::INFINITY;
        for step in 1..=100 {
            scene.run(0.25 * f64::from(step)).step_size(StepSize::OfLimit(0.5)).go().unwrap();
            closest = closest.min(gap(scene.body(droplet).unwrap(), 1.5));
        }
        let body = scene.body(droplet).unwrap();
        assert!(closest < 0.15 && closest > -0.25 * h, "h = {h}: {closest}");
        assert!(area_change(body).abs() < 1e-5, "h = {h}: {:e}", area_change(body));
        let left: f64 = body.particle_numbers().iter().sum();
        assert!((left / particles - 1.0).abs() < 1e-12);
    }
}
