//! Droplets that meet walls: nothing tunnels, nothing is lost.

use motile::active_interface::curve::polygon_area;
use motile::prelude::*;

/// Smallest distance of a droplet's markers from the walls at y = +-height.
fn gap(droplet: &ActiveDroplet, height: f64) -> f64 {
    droplet.markers().iter().map(|marker| height - marker.y.abs()).fold(f64::INFINITY, f64::min)
}

fn area_change(droplet: &ActiveDroplet) -> f64 {
    polygon_area(droplet.markers()).expect("a droplet of a scene") / droplet.initial_area() - 1.0
}

/// A passive droplet off the centre line of a Poiseuille flow drifts along, is deformed, and in Stokes flow without a
/// viscosity contrast moves away from the wall.
#[test]
fn passive_droplet_in_poiseuille_flow() {
    let (l, w, h) = (6.0, 3.0, 0.1);
    let mut solver = ChannelStokes::new(Grid::channel(60, 30, h).unwrap(), 1.0).unwrap();
    solver.set_drive(Drive::Gradient(-1.0)).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4));
    let curve = Curve::circle(0.6).unwrap().translated(Vec2::new(0.0, 0.7));
    let droplet = scene.add(ActiveDroplet::passive(&curve.markers(80).unwrap(), 5.0).unwrap());
    let start = gap(scene.body(droplet).unwrap(), 0.5 * w);
    scene.run(20.0).step_size(StepSize::OfLimit(0.25)).go().unwrap();
    let body = scene.body(droplet).unwrap();
    assert!(area_change(body).abs() < 1e-5, "{:e}", area_change(body));
    assert!(gap(body, 0.5 * w) > start, "it moves away from the wall");
    // Undisturbed flow at the centre of the channel: w^2/8 per unit gradient and viscosity; the droplet is slower.
    let travelled = body.markers().iter().map(|marker| marker.x).sum::<f64>() / 80.0;
    assert!(travelled > l && travelled < 20.0 * w * w / 8.0, "{travelled}");
}

/// A swimmer driven into a wall drains the film between them to a fraction of the grid spacing and turns away.
#[test]
fn swimmer_driven_into_a_wall() {
    for (h, degrees) in [(0.1, 45.0_f64), (0.05, 80.0)] {
        let swimmer = Swimmer {
            activity: -4.0,
            lengths: [12.0, 3.0],
            spacing: h,
            angle: degrees.to_radians(),
            offset: [0.0, 0.3],
            ..Swimmer::default()
        };
        let (mut scene, droplet) = swimmer.build_on_grid_in_channel(Drive::ZeroGradient).unwrap();
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
