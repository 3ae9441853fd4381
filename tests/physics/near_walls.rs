//! Droplets that meet walls: nothing tunnels, nothing is lost.

use std::f64::consts::PI;

use motile::active_interface::{ActiveDroplet, polygon_area, polygon_moments};
use motile::base::Drive;
use motile::base::{Region, Vec2};
use motile::scene::{StepSize, gap::wall_gap};
use motile::setup::{
    Built, DropletSetup, DropletShape, IntegralMethod, LayersMethod, Method, RigidBodySetup, Setup, ShellSetup,
};
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

/// A disc in a film that its nodes resolve moves as in closed form (Jeffrey and Onishi, Q. J. Mech. Appl. Math. 34,
/// 129, 1981), without a warning, and the refusal of a thinner one asks for nodes that resolve it.
#[test]
fn films_beside_rigid_bodies_are_refused_or_right() {
    let settle = |gap: f64, nodes: usize| {
        let width = 40.0;
        let region = Region::Channel { length: 60.0, width, drive: Drive::ZeroGradient };
        let disc =
            RigidBodySetup { centre: [0.0, 1.0 + gap - 0.5 * width], force: [0.0, -1.0], ..RigidBodySetup::disc(1.0) };
        let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
        let rigid_bodies = vec![disc];
        let setup = Setup { region, method, viscosity: 1.0, droplets: vec![], rigid_bodies, ..Setup::default() };
        setup.build().expect("a valid setup")
    };
    for (gap, nodes) in [(0.03, 64), (0.02, 96), (0.01, 96), (0.008, 107)] {
        let Built { mut scene, rigid_bodies, .. } = settle(gap, nodes);
        let speed = -scene.observe(rigid_bodies[0]).expect("a motion").velocity.y;
        let distance = (1.0 + gap).acosh();
        let exact = (distance - distance.tanh()) / (4.0 * PI);
        println!("{gap} {nodes}: {:e}", speed / exact - 1.0);
        assert!((speed / exact - 1.0).abs() < 0.0065, "{gap} {nodes}: {speed} {exact}");
        let warnings = scene.system_mut().warnings();
        assert!(warnings.is_empty(), "{gap} {nodes}: {warnings:?}");
    }
    // As it sinks, the cause of the end and its remedy come first.
    let Built { mut scene, .. } = settle(0.012, 96);
    let error = scene.run(1e4).go().expect_err("a closing film").to_string();
    println!("{error}");
    let cause = error.find("the gap between rigid body").expect("the cause");
    assert!(cause < 80 && error.contains("nodes or more"), "{error}");
    assert!(!error.contains("larger tolerance"), "{error}");
}

/// Markers of rigid bodies and shells lie on their true curve, with an imposed flow and without one.
#[test]
fn rigid_outlines_are_as_large_as_asked() {
    let integral = Method::Integral(IntegralMethod { nodes: 32, elements: 48 });
    for method in [integral, Method::Layers(LayersMethod { nodes: 32, elements: 48, ..LayersMethod::of_spacing(0.2) })]
    {
        let region = Region::Channel { length: 8.0, width: 6.0, drive: Drive::ZeroGradient };
        let (rigid_bodies, shells) = (
            vec![RigidBodySetup { centre: [-1.5, 0.0], ..RigidBodySetup::disc(1.0) }],
            vec![ShellSetup { centre: [1.5, 0.0], ..ShellSetup::default() }],
        );
        let setup = Setup { region, method, droplets: vec![], rigid_bodies, shells, ..Setup::default() };
        let Built { scene, rigid_bodies, shells, .. } = setup.build().expect("a valid setup");
        let rigid: Vec<Vec2> = scene.body(rigid_bodies[0]).expect("a body").markers().collect();
        let shell = scene.body(shells[0]).expect("a shell").markers();
        for (markers, x, radius) in [(&rigid[..], -1.5, 1.0), (shell, 1.5, 0.5)] {
            let centre = Vec2::new(x, 0.0);
            let off = markers.iter().map(|place| (place.distance(centre) - radius).abs()).fold(0.0, f64::max);
            assert!(off < 1e-12, "{off:e}");
        }
    }
}
