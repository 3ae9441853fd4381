//! Gaps beside rigid surfaces: what the nodes do not resolve is warned of, and what is not warned of is right to a per
//! cent.

use motile::base::{Drive, Region, Vec2};
use motile::setup::{
    Built, DropletSetup, DropletShape, IntegralMethod, Method, RigidBodySetup, Setup, SolidOutline, WallSetup,
};

/// Rigid bodies with outlines by eight markers per node, so that its size hardly depends on the number.
fn method(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements: (8 * nodes).min(4096) })
}

fn disc(radius: f64, centre: [f64; 2], force: [f64; 2]) -> RigidBodySetup {
    RigidBodySetup { shape: DropletShape::Round { radius }, centre, force, ..RigidBodySetup::default() }
}

/// The velocities of the rigid bodies, and how many gaps are warned of.
fn solved(setup: &Setup) -> (Vec<Vec2>, usize) {
    let Built { mut scene, rigid_bodies, .. } = setup.build().expect("a scene");
    let warnings = scene.system_mut().warnings();
    let films = warnings.iter().filter(|warning| warning.cause == "thin film").count();
    let velocities = rigid_bodies.iter().map(|&body| scene.observe(body).expect("a body").velocity).collect();
    (velocities, films)
}

/// Two discs that are pulled together or past one another.
fn pair([small, large, gap]: [f64; 3], force: [f64; 2], nodes: usize) -> Setup {
    let other = disc(large, [small + large + gap, 0.0], force.map(|f| -f));
    Setup {
        region: Region::Plane,
        method: method(nodes),
        droplets: Vec::new(),
        rigid_bodies: vec![disc(small, [0.0, 0.0], force), other],
        ..Setup::default()
    }
}

/// Two discs come closer within 1 % of their speed, wherever there is no warning. With the default nodes a disc of
/// radius 0.1 at 0.03 from a disc of radius 1 is 6 % off, which is warned of. The speeds (length per time) were
/// computed with three to five times the nodes that resolve a gap, and one is computed again.
#[test]
fn pairs_of_discs_that_nodes_do_not_resolve_are_told() {
    let approach = |velocities: &[Vec2]| velocities[0].x - velocities[1].x;
    let mut told = 0;
    for (sizes, speed, nodes, warned) in [
        ([0.1, 1.0, 0.03], 1.070_368_389_6e-3, 72, true),
        ([0.1, 1.0, 0.03], 1.070_368_389_6e-3, 150, false),
        ([0.1, 3.0, 0.03], 9.797_693_05e-4, 192, true),
        ([0.1, 0.1, 0.003], 1.048_373_677_6e-4, 48, true),
        ([0.1, 0.1, 0.003], 1.048_373_677_6e-4, 72, false),
        ([0.1, 0.3, 0.003], 5.791_340_36e-5, 96, true),
        ([0.1, 0.3, 0.003], 5.791_340_36e-5, 168, false),
        ([0.1, 1.0, 0.1], 4.092_498_03e-3, 80, false),
    ] {
        let (found, films) = solved(&pair(sizes, [10.0, 0.0], nodes));
        let error = (approach(&found) / speed - 1.0).abs();
        println!("{sizes:?} {nodes} nodes: {error:.4}, {films} warnings");
        assert_eq!(films > 0, warned, "{sizes:?} {nodes}");
        assert!(warned || error < 0.01, "{sizes:?} {nodes}: {error}");
        told += usize::from(warned && error > 0.01);
    }
    assert!(told >= 3, "{told}");
    let (resolved, _) = solved(&pair([0.1, 0.1, 0.003], [10.0, 0.0], 216));
    let error = (approach(&resolved) / 1.048_373_677_6e-4 - 1.0).abs();
    assert!(error < 1e-6, "{error:e}");
}

/// A disc of radius 0.4 above an obstacle of radius 1.5.
fn above_obstacle(gap: f64, spacing: f64, force: [f64; 2]) -> Setup {
    let obstacle = SolidOutline::Disc { centre: [0.0, 0.0], radius: 1.5 };
    Setup {
        region: Region::Channel { length: 12.0, width: 8.0, drive: Drive::ZeroGradient },
        method: method(128),
        droplets: Vec::new(),
        walls: vec![WallSetup::new(obstacle, spacing)],
        rigid_bodies: vec![disc(0.4, [0.0, 1.9 + gap], force)],
        ..Setup::default()
    }
}

/// Beside an obstacle the nodes of the wall count. If they are too far apart for any solution, the scene is refused.
#[test]
fn walls_whose_nodes_do_not_resolve_a_gap_are_told() {
    for (gap, spacing, warned) in [(0.05, 0.2, true), (0.05, 0.09, false), (0.1, 0.2, true), (0.1, 0.13, false)] {
        let of = |spacing: f64| solved(&above_obstacle(gap, spacing, [10.0, -10.0]));
        let ((found, films), (reference, _)) = (of(spacing), of(0.025));
        let error = (found[0].distance(reference[0])) / reference[0].length();
        let across = (found[0].y / reference[0].y - 1.0).abs();
        println!("{gap} {spacing}: {error:.4} {across:.4}, {films} warnings");
        assert_eq!(films > 0, warned, "{gap} {spacing}");
        assert!(warned || across < 0.01, "{gap} {spacing}: {across}");
    }
    for (gap, spacing) in [(0.05, 0.4), (0.02, 0.2)] {
        let Built { mut scene, .. } = above_obstacle(gap, spacing, [10.0, 10.0]).build().unwrap();
        let error = scene.system_mut().evaluate().unwrap_err().to_string();
        println!("{error}");
        assert!(error.contains("rigid body and a rigid wall is") && error.contains("Give the wall a spacing of 0."));
    }
}

/// A stiff droplet beside an obstacle, as in a flow through a channel.
#[test]
fn droplets_beside_coarse_walls_are_told() {
    let speed = |gap: f64, spacing: f64| {
        let region = Region::Channel { length: 12.0, width: 8.0, drive: Drive::Gradient(-10.0) };
        let droplet = DropletSetup { viscosity: Some(1e4), centre: [0.0, 1.9 + gap], ..DropletSetup::passive(10.0) };
        let walls = above_obstacle(gap, spacing, [0.0; 2]).walls;
        let droplets = vec![droplet.with_radius(0.4)];
        let setup =
            Setup { region, method: Method::Integral(IntegralMethod { nodes: 96, elements: 384 }), ..Setup::default() };
        let Built { mut scene, droplets, .. } = Setup { walls, droplets, ..setup }.build().unwrap();
        let warnings = scene.system_mut().warnings();
        let films = warnings.iter().filter(|warning| warning.cause == "thin film").count();
        (scene.observe(droplets[0]).unwrap().velocity, films)
    };
    let (reference, _) = speed(0.03, 0.02);
    for (spacing, warned) in [(0.2, true), (0.075, false)] {
        let (velocity, films) = speed(0.03, spacing);
        let error = velocity.distance(reference) / reference.length();
        println!("{spacing}: {error:.4}, {films} warnings");
        assert_eq!(films > 0, warned, "{spacing}");
        assert_eq!(error > 0.01, warned, "{spacing}: {error}");
    }
}
