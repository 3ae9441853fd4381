//! Forces on obstacles, which are closed rigid walls, and on walls in a fluid with friction.

use motile::active_interface::observables::net_flux;
use motile::elastic_solids::{ChannelShape, RigidBody};
use motile::prelude::*;
use motile::scene::ChannelForces;
use motile::setup::{DropletShape, OutlineSetup, RigidBodySetup, SolidOutline, WallSetup};

fn in_channel(drive: Drive, walls: Vec<WallSetup>, rigid_bodies: Vec<RigidBodySetup>) -> Setup {
    Setup {
        region: Region::Channel { length: 6.0, width: 3.0, drive },
        viscosity: 1.0,
        method: Method::Integral(IntegralMethod { nodes: 96, elements: 96 }),
        walls,
        rigid_bodies,
        droplets: Vec::new(),
        ..Setup::default()
    }
}

fn channel_forces(scene: &mut Scene<AnyFlow>) -> ChannelForces {
    scene.system_mut().channel_forces().expect("a flow").expect("straight walls")
}

/// Error of the balance of forces with the shear stress on the walls, over the largest force.
fn imbalance(scene: &mut Scene<AnyFlow>) -> f64 {
    let forces = channel_forces(scene);
    let traction = scene.system_mut().wall_traction().expect("a flow").expect("straight walls");
    forces.imbalance(traction) / forces.scale()
}

/// A disc in a flux of 1: drag, pressure drop and forces on the walls of an independent program, by the first kind.
#[test]
fn a_disc_in_a_flux_bears_the_force_of_the_table() {
    let disc = WallSetup::new(SolidOutline::Disc { centre: [0.0; 2], radius: 0.5 }, 0.05);
    let mut scene = in_channel(Drive::Flux(1.0), vec![disc], Vec::new()).build().expect("a scene").scene;
    let loads = scene.system_mut().obstacle_loads().expect("a flow");
    let [Some(load)] = loads[..] else { panic!("one obstacle: {loads:?}") };
    assert!((load.force.x / 16.7187598671 - 1.0).abs() < 1e-7 && load.force.y.abs() < 1e-7, "{load:?}");
    assert!(load.torque.abs() < 1e-7 && load.centroid.length() < 1e-9, "{load:?}");
    let forces = channel_forces(&mut scene);
    assert!((forces.pressure_drop / 10.602772640671 - 1.0).abs() < 1e-7, "{forces:?}");
    assert!((forces.extra_pressure_drop.expect("a flux") / 7.936105974 - 1.0).abs() < 1e-7, "{forces:?}");
    for wall in forces.on_walls {
        assert!((wall / 7.544779034 - 1.0).abs() < 1e-7, "{forces:?}");
    }
    assert!(imbalance(&mut scene).abs() < 1e-7);
}

/// An inclined ellipse off the centre line, as an obstacle and as a held rigid body, which is another integral
/// equation.
#[test]
fn an_obstacle_bears_the_force_and_torque_of_a_held_body() {
    let (half_axes, angle, y) = ([0.6, 0.3], std::f64::consts::PI / 6.0, 0.4);
    let shape = DropletShape::Ellipse { half_axes };
    let body = RigidBodySetup { held: true, centre: [0.3, y], angle, shape, ..RigidBodySetup::default() };
    let droplet =
        DropletSetup { centre: [-1.6, -0.2], shape: DropletShape::Round { radius: 0.7 }, ..DropletSetup::active(-3.0) };
    let with = |setup: Setup| Setup { droplets: vec![droplet.clone()], ..setup };
    let mut held = with(in_channel(Drive::Flux(0.4), Vec::new(), vec![body])).build().expect("a scene").scene;
    let (handle, _) = held.system().bodies::<RigidBody>().next().expect("a body");
    let seen = held.observe(handle).expect("a flow");
    let points = (0..192).map(|k| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 192.0).sin_cos();
        let (x, y) = (half_axes[0] * cos, half_axes[1] * sin);
        [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()]
    });
    let outline = OutlineSetup { points: points.collect(), place: [0.3, y], ..OutlineSetup::default() };
    let wall = WallSetup::new(SolidOutline::Closed(outline), 0.03);
    let mut scene = with(in_channel(Drive::Flux(0.4), vec![wall], Vec::new())).build().expect("a scene").scene;
    let [Some(load)] = scene.system_mut().obstacle_loads().expect("a flow")[..] else { panic!("one obstacle") };
    println!("{load:?} {:?} {}", seen.force, seen.torque);
    assert!((load.force - seen.force).length() < 1e-5 * seen.force.length(), "{load:?} {:?}", seen.force);
    assert!((load.torque - seen.torque).abs() < 1e-5 * seen.force.length(), "{load:?} {}", seen.torque);
    let [own, other] = [channel_forces(&mut scene), channel_forces(&mut held)];
    for (a, b) in own.on_walls.into_iter().zip(other.on_walls) {
        assert!((a - b).abs() < 1e-5 * own.scale(), "{own:?} {other:?}");
    }
    assert!(imbalance(&mut scene).abs() < 1e-6);
}

/// Behind walls that are not closed there is fluid too: no force rather than a wrong one.
#[test]
fn walls_that_are_not_closed_have_no_load() {
    let shape = ChannelShape::Sinusoidal { width: 2.0, amplitude: 0.2, waves: 1, phase: 0.0 };
    let setup = in_channel(Drive::Gradient(-1.0), WallSetup::channel(&shape, 0.15), Vec::new());
    let mut scene = setup.build().expect("a scene").scene;
    assert!(scene.system_mut().obstacle_loads().expect("a flow").iter().all(Option::is_none));
    assert!(scene.system_mut().channel_forces().expect("a flow").is_none());
}

/// Between flat sides at the distance w: the shear stress G w/2 and the force G w l/2 on each, whatever lies behind.
#[test]
fn flat_sides_have_the_shear_stress_of_poiseuille() {
    let (gradient, width, period) = (-0.7, 2.0, 6.0);
    let shape = ChannelShape::Straight { width };
    let setup = in_channel(Drive::Gradient(gradient), WallSetup::channel(&shape, 0.1), Vec::new());
    let walls = setup.build().expect("a scene").scene.system_mut().wall_stresses().expect("a flow");
    assert_eq!(walls.len(), 2);
    for wall in walls {
        let exact = -0.5 * gradient * width;
        assert!(wall.shear.iter().all(|shear| (shear / exact - 1.0).abs() < 1e-7), "{:?}", &wall.shear[..9]);
        assert!((wall.force.x / (exact * period) - 1.0).abs() < 1e-7, "{:?}", wall.force);
        assert!(!wall.closed && (wall.reach - 0.5 * width).abs() < 1e-12, "{}", wall.reach);
    }
}

/// Stresses that are sampled at the walls balance the pressure drop, bear out the loads on obstacles, and settle: a
/// wavy channel with an island and a droplet that swims.
#[test]
fn the_shear_stress_on_curved_walls_balances_the_pressure_drop() {
    let (gradient, period) = (-0.9, 6.0);
    let shape = ChannelShape::Sinusoidal { width: 2.4, amplitude: 0.2, waves: 1, phase: 0.4 };
    let errors = [0.2, 0.1].map(|spacing| {
        let mut walls = WallSetup::channel(&shape, spacing);
        walls.push(WallSetup::new(SolidOutline::Disc { centre: [1.6, 0.3], radius: 0.35 }, 0.5 * spacing));
        let droplet = DropletSetup {
            centre: [-1.2, 0.1],
            shape: DropletShape::Round { radius: 0.6 },
            ..DropletSetup::active(-3.0)
        };
        let setup = in_channel(Drive::Gradient(gradient), walls, Vec::new());
        let mut scene = Setup { droplets: vec![droplet], ..setup }.build().expect("a scene").scene;
        let system = scene.system_mut();
        let found = system.wall_stresses().expect("a flow");
        let loads = system.obstacle_loads().expect("a flow");
        let load = loads[2].expect("an obstacle");
        let force: f64 = found.iter().map(|wall| wall.force.x).sum();
        let carried = -gradient * period * (found[0].reach + found[1].reach);
        let size = found.iter().map(|wall| wall.force.length()).fold(0.0, f64::max);
        [(force - carried).abs() / size, load.force.distance(found[2].force) / load.force.length()]
    });
    println!("{errors:?}");
    assert!(errors[1].into_iter().all(|error| error < 1e-5), "{errors:?}");
    assert!((0..2).all(|k| errors[1][k] < 0.2 * errors[0][k].max(1e-6)), "{errors:?}");
}

/// In a fluid with friction: u = -(G/alpha) (1 - cosh(q y)/cosh(q w/2)), and on each wall the force l G tanh(q w/2)/q.
#[test]
fn friction_of_the_fluid_takes_part_in_the_balance() {
    let (gradient, friction, viscosity, width, period) = (-3.0, 20.0, 2.0, 3.0, 6.0_f64);
    let of = |droplets: Vec<DropletSetup>, slip: [f64; 2], spacing: f64| {
        let region = Region::Channel { length: period, width, drive: Drive::Gradient(gradient) }.with_slip(slip);
        let method = Method::Grid(GridMethod { spacing, ..GridMethod::default() });
        let setup = Setup { region, friction, viscosity, method, droplets, ..Setup::default() };
        setup.build().expect("a scene").scene
    };
    let wave = (friction / viscosity).sqrt();
    let forces = channel_forces(&mut of(Vec::new(), [0.0; 2], 0.1));
    let exact = -gradient * period * (0.5 * wave * width).tanh() / wave;
    for wall in forces.on_walls {
        assert!((wall / exact - 1.0).abs() < 1e-9, "{forces:?} {exact}");
    }
    let plates = -gradient * period * width - 2.0 * exact;
    assert!((forces.on_plates / plates - 1.0).abs() < 1e-9, "{forces:?} {plates}");
    // With a droplet and slip, the plates bear alpha times the flux, and the balance closes to second order.
    let droplet = DropletSetup { centre: [0.2, 0.1], ..DropletSetup::active(-2.0) };
    let errors = [0.1, 0.05].map(|spacing| {
        let mut scene = of(vec![droplet.clone()], [0.3, 0.1], spacing);
        let forces = channel_forces(&mut scene);
        let flux = net_flux(scene.system_mut(), 2.4).expect("a channel");
        [imbalance(&mut scene).abs(), (forces.on_plates / (friction * period * flux) - 1.0).abs()]
    });
    println!("{errors:?}");
    assert!(errors[1].iter().all(|error| *error < 5e-3), "{errors:?}");
    assert!((0..2).all(|k| errors[1][k] < 0.4 * errors[0][k].max(1e-3)), "{errors:?}");
}

/// Forces on the only shaped side of a channel and on the straight wall opposite, and what the pressure drop carries,
/// all along x.
fn beside_one_side(setup: &Setup, gradient: f64) -> [f64; 3] {
    let mut scene = setup.build().expect("a scene").scene;
    let system = scene.system_mut();
    let (wall, straight) = system.opposite_wall_force().expect("a flow").expect("one open wall");
    let found = system.wall_stresses().expect("a flow");
    let shaped: Vec<_> = found.iter().filter(|wall| !wall.closed).collect();
    let [side] = shaped[..] else { panic!("one side") };
    let Region::Channel { length, width, .. } = setup.region else { panic!("a channel") };
    assert_eq!(wall, usize::from(matches!(setup.walls[0].outline, SolidOutline::WallBelow(_))));
    [side.force.x, straight, -gradient * length * (side.reach + 0.5 * width)]
}

/// A flat side below or above the other straight wall: half of what the pressure drop carries is on each.
#[test]
fn a_flat_side_and_a_straight_wall_bear_half_of_the_pressure_drop_each() {
    let gradient = -0.7;
    let shape = ChannelShape::Straight { width: 2.0 };
    for outline in [SolidOutline::WallBelow(shape), SolidOutline::WallAbove(shape)] {
        let setup = in_channel(Drive::Gradient(gradient), vec![WallSetup::new(outline, 0.1)], Vec::new());
        // From the side at 1 to the wall at 1.5 beyond the centre line.
        let exact = 0.5 * 0.7 * 2.5 * 6.0;
        let [side, straight, carried] = beside_one_side(&setup, gradient);
        assert!(
            (side / exact - 1.0).abs() < 1e-7 && (straight / exact - 1.0).abs() < 1e-7,
            "{side} {straight} {exact}"
        );
        assert!((carried / (2.0 * exact) - 1.0).abs() < 1e-12, "{carried}");
    }
    let both = in_channel(Drive::Gradient(gradient), WallSetup::channel(&shape, 0.1), Vec::new());
    let mut scene = both.build().expect("a scene").scene;
    assert!(scene.system_mut().opposite_wall_force().expect("a flow").is_none());
}

/// A swimmer between a wavy side and a straight wall: the forces on both add up to what the pressure drop carries.
#[test]
fn a_wavy_side_and_a_straight_wall_balance_the_pressure_drop() {
    let gradient = -0.9;
    let shape = ChannelShape::Sinusoidal { width: 2.4, amplitude: 0.2, waves: 1, phase: 0.4 };
    let errors = [0.2, 0.1].map(|spacing| {
        let walls = vec![WallSetup::new(SolidOutline::WallAbove(shape), spacing)];
        let shape = DropletShape::Round { radius: 0.6 };
        let droplet = DropletSetup { centre: [-1.2, -0.3], shape, ..DropletSetup::active(-3.0) };
        let setup = Setup { droplets: vec![droplet], ..in_channel(Drive::Gradient(gradient), walls, Vec::new()) };
        let [side, straight, carried] = beside_one_side(&setup, gradient);
        ((side + straight - carried) / side.abs().max(straight.abs())).abs()
    });
    println!("{errors:?}");
    assert!(errors[1] < 1e-5 && errors[1] < 0.2 * errors[0].max(1e-6), "{errors:?}");
}
