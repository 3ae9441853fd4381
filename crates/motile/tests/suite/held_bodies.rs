//! Forces on held bodies and walls against an independent boundary-integral program and closed forms.

use std::f64::consts::PI;

use motile::elastic_solids::RigidBody;
use motile::prelude::*;
use motile::scene::ChannelForces;
use motile::setup::{DropletShape, Hold, InterfaceSetup, Material, RigidBodySetup, Side, SolidOutline, SolidSetup};

/// A channel of viscosity 1 with a rigid body.
fn channel(length: f64, width: f64, slip: f64, drive: Drive, body: RigidBodySetup) -> Setup {
    Setup {
        region: Region::Channel { length, width, drive }.with_slip([slip; 2]),
        viscosity: 1.0,
        droplets: Vec::new(),
        rigid_bodies: vec![body],
        method: Method::Integral(IntegralMethod { nodes: 96, elements: 96 }),
        ..Setup::default()
    }
}

fn ellipse(y: f64) -> RigidBodySetup {
    let shape = DropletShape::Ellipse { half_axes: [0.6, 0.3] };
    RigidBodySetup { centre: [0.0, y], angle: PI / 6.0, shape, ..RigidBodySetup::default() }
}

fn disc(radius: f64, y: f64) -> RigidBodySetup {
    RigidBodySetup { centre: [0.0, y], ..RigidBodySetup::disc(radius) }
}

/// Force and torque of the fluid on the first rigid body, and the forces along the channel.
fn seen(setup: &Setup) -> ([f64; 3], ChannelForces) {
    seen_in(&mut setup.build().expect("a scene").scene)
}

fn seen_in(scene: &mut Scene<AnyFlow>) -> ([f64; 3], ChannelForces) {
    let (body, _) = scene.system().bodies::<RigidBody>().next().expect("a body");
    let seen = scene.observe(body).expect("a body");
    let forces = scene.system_mut().channel_forces().expect("a flow").expect("straight walls");
    ([seen.force.x, seen.force.y, seen.torque], forces)
}

/// Forces, torque and extra pressure drop of a body that is held in a flux of 1, moves along x, along y, and turns
/// without a flux.
fn resistances(length: f64, width: f64, slip: f64, body: &RigidBodySetup) -> [[f64; 4]; 4] {
    let of = |flux: f64, velocity: [f64; 2], spin: f64| {
        let body = RigidBodySetup { velocity: Some(velocity), angular_velocity: Some(spin), ..body.clone() };
        let (load, forces) = seen(&channel(length, width, slip, Drive::Flux(flux), body));
        let drop = forces.extra_pressure_drop.expect("a flux");
        assert!((forces.on_bodies.x - load[0]).abs() < 1e-9 * load[0].abs().max(1.0));
        [load[0], load[1], load[2], drop]
    };
    [of(1.0, [0.0; 2], 0.0), of(0.0, [1.0, 0.0], 0.0), of(0.0, [0.0, 1.0], 0.0), of(0.0, [0.0; 2], 1.0)]
}

/// Length, width, slip length, body, and what each of the four motions takes.
type Case = (f64, f64, f64, RigidBodySetup, [[f64; 4]; 4]);

/// Force along x and y, torque, and extra pressure drop of each of the four motions, from an independent first-kind
/// boundary-integral program with 96 and 160 nodes (errors of 1e-11).
#[test]
fn resistances_are_those_of_an_independent_program() {
    let cases: [Case; 6] = [
        (
            6.0,
            3.0,
            0.0,
            disc(0.5, 0.0),
            [
                [16.7187598671, 0.0, 0.0, 7.936105974],
                [-35.3086873928, 0.0, 0.0, -16.7187598671],
                [0.0, -21.5257951042, 0.0, 0.0],
                [0.0, 0.0, -3.44090059295, 0.0],
            ],
        ),
        (
            6.0,
            3.0,
            0.2,
            disc(0.5, 0.5),
            [
                [10.229651639, 0.0, 0.78993995687, 4.11511648501],
                [-25.9483059866, 0.0, -1.34948857528, -10.229651639],
                [0.0, -24.8264781261, 0.0, 0.0],
                [-1.34948857528, 0.0, -3.60660097985, -0.78993995687],
            ],
        ),
        (
            12.0,
            2.0,
            0.2,
            disc(0.3, 0.4),
            [
                [11.5483189436, 0.0, 0.606347599229, 6.63250190009],
                [-20.577009068, 0.0, -0.697237908252, -11.5483189436],
                [0.0, -22.6915870402, 0.0, 0.0],
                [-0.697237908252, 0.0, -1.27542306409, -0.606347599229],
            ],
        ),
        (
            12.0,
            3.0,
            0.2,
            disc(1.0, 0.2),
            [
                [78.9954087296, 0.0, 6.5121252674, 30.2632413053],
                [-208.093485052, 0.0, -16.0921090012, -78.9954087296],
                [0.0, -91.9310711896, 0.0, 0.0],
                [-16.0921090012, 0.0, -19.9817842797, -6.5121252674],
            ],
        ),
        (
            6.0,
            3.0,
            0.0,
            ellipse(0.0),
            [
                [12.3569342509, -2.33445620151, 0.0, 5.97716058476],
                [-25.5818937035, 4.85483180482, 0.0, -12.3569342509],
                [4.85483180482, -21.0437693991, 0.0, 2.33445620151],
                [0.0, 0.0, -3.2668220732, 0.0],
            ],
        ),
        (
            6.0,
            3.0,
            0.2,
            ellipse(0.4),
            [
                [8.6261930034, -1.59415384843, 0.44458988301, 3.6133521305],
                [-20.7812144479, 3.93346282287, -0.760201638972, -8.6261930034],
                [3.93346282287, -21.35290791, -0.511666033564, 1.59415384843],
                [-0.760201638972, -0.511666033564, -3.33441976832, -0.44458988301],
            ],
        ),
    ];
    for (length, width, slip, body, expected) in cases {
        let found = resistances(length, width, slip, &body);
        let largest = expected.as_flattened().iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let worst = (found.as_flattened().iter().zip(expected.as_flattened()))
            .fold(0.0, |most: f64, (found, expected)| most.max((found - expected).abs() / largest));
        println!("{slip} {:?}: {worst:.1e}", body.shape);
        assert!(worst < 1e-8, "{body:?}: {worst:e}, {found:?}");
        // Reciprocity: the matrix is symmetric, up to the sign of the pressure drop.
        for i in 0..4 {
            for j in 0..i {
                let mirrored = if j == 0 { -found[j][i - 1] } else { found[j][i - 1] };
                let other = if j == 0 { found[i][3] } else { found[i][j - 1] };
                assert!((other - mirrored).abs() < 1e-8 * largest, "{i} {j}: {other} {mirrored}");
            }
        }
    }
}

/// The walls next to a post: force and shear stress, from the same program (errors of 1e-8).
#[test]
fn walls_next_to_a_post() {
    let body = RigidBodySetup { held: true, ..disc(0.5, 0.0) };
    let Built { mut scene, .. } = channel(6.0, 3.0, 0.0, Drive::Flux(1.0), body).build().expect("a scene");
    let system = scene.system_mut();
    let forces = system.channel_forces().expect("a flow").expect("walls");
    assert!((forces.pressure_drop - 10.602772640671).abs() < 1e-8, "{forces:?}");
    for force in forces.on_walls {
        assert!((force - 7.544779034).abs() < 2e-8, "{forces:?}");
    }
    let [lower, upper] = system.wall_shear(128).expect("a flow").expect("walls");
    for shear in [lower, upper] {
        assert!((shear[64] - 2.76673351).abs() < 2e-8 && (shear[0] - 0.66550053).abs() < 2e-8, "{shear:?}");
    }
    let traction = system.wall_traction().expect("a flow").expect("walls");
    assert!(forces.imbalance(traction).abs() < 1e-8 * forces.scale(), "{forces:?} {traction:?}");
}

/// Drag of a cylinder on the centre line of a long channel without a flux: values of the same program, which Faxen's
/// series meets for thin cylinders.
#[test]
fn a_cylinder_between_walls_is_that_of_faxen() {
    for (ratio, expected) in [(0.02, 4.19295071701), (0.1, 8.95060401431), (0.3, 29.1585403209)] {
        let body = RigidBodySetup { velocity: Some([1.0, 0.0]), ..disc(ratio, 0.0) };
        let ([drag, ..], _) = seen(&channel(12.0, 2.0, 0.0, Drive::ZeroFlux, body));
        assert!((-drag / expected - 1.0).abs() < 1e-8, "{ratio}: {drag}");
        let k2: f64 = ratio * ratio;
        let faxen = 4.0 * PI / (-ratio.ln() - 0.9157 + 1.7244 * k2 - 1.7302 * k2 * k2);
        assert!((-drag / faxen - 1.0).abs() < 2e-2 * ratio, "{ratio}: {drag} {faxen}");
    }
}

/// Unequal slip, sliding walls and a pressure gradient: forces by the reciprocal theorem are those of the shear stress
/// on the walls, and of no bodies those of the closed form.
#[test]
fn forces_on_unequal_walls() {
    let slips = [0.2, 1.0];
    let mut setup = channel(6.0, 3.0, 0.0, Drive::Gradient(-2.0), RigidBodySetup { held: true, ..ellipse(0.3) });
    setup.region = setup.region.with_slip(slips);
    setup.flow.wall_velocity = Some([-0.3, 0.5]);
    let Built { mut scene, .. } = setup.build().expect("a scene");
    let system = scene.system_mut();
    let forces = system.channel_forces().expect("a flow").expect("walls");
    assert!((forces.pressure_drop - 12.0).abs() < 1e-12 && forces.extra_pressure_drop.is_none(), "{forces:?}");
    let traction = system.wall_traction().expect("a flow").expect("walls");
    for (wall, force) in traction.iter().enumerate() {
        assert!((force - forces.on_walls[wall]).abs() < 1e-8 * forces.scale(), "{forces:?} {traction:?}");
    }
    setup.rigid_bodies.clear();
    let mut scene = setup.build().expect("a scene").scene;
    let forces = scene.system_mut().channel_forces().expect("a flow").expect("walls");
    // Poiseuille and Couette flow between these walls.
    let slope = 2.0 * (4.5 + 1.0 * 3.0) / 4.2;
    let couette = 0.8 / 4.2;
    let expected = [6.0 * (slope + couette), 6.0 * (2.0 * 3.0 - slope - couette)];
    for (found, expected) in forces.on_walls.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12 * expected, "{forces:?} {expected}");
    }
}

/// A swimmer of another viscosity beside a post and a body that turns: forces balance, and the swimmer bears none. The
/// force on the walls in excess of each other tells of its dipole.
#[test]
fn a_swimmer_next_to_a_post_balances() {
    for drive in [Drive::Flux(0.5), Drive::ZeroGradient, Drive::Gradient(-20.0)] {
        let swimmer = DropletSetup {
            centre: [-1.5, 0.2],
            shape: DropletShape::Round { radius: 0.8 },
            viscosity: Some(60.0),
            ..DropletSetup::active(-3.0)
        };
        let post = RigidBodySetup { held: true, ..ellipse(-0.5) };
        let wheel = RigidBodySetup { centre: [2.6, 0.6], angular_velocity: Some(0.4), ..RigidBodySetup::disc(0.4) };
        let setup = Setup {
            region: Region::Channel { length: 8.0, width: 4.0, drive },
            method: Method::Integral(IntegralMethod { nodes: 96, elements: 192 }),
            droplets: vec![swimmer],
            rigid_bodies: vec![RigidBodySetup { centre: [0.6, -0.5], ..post }, wheel],
            ..Setup::default()
        };
        let Built { mut scene, droplets, rigid_bodies, .. } = setup.build().expect("a scene");
        let system = scene.system_mut();
        let forces = system.channel_forces().expect("a flow").expect("walls");
        let traction = system.wall_traction().expect("a flow").expect("walls");
        println!("{drive:?}: {forces:?} {traction:?} {:?}", system.work());
        assert!(forces.imbalance(traction).abs() < 1e-8 * forces.scale(), "{forces:?} {traction:?}");
        for (wall, force) in traction.iter().enumerate() {
            assert!((force - forces.on_walls[wall]).abs() < 1e-7 * forces.scale(), "{forces:?} {traction:?}");
        }
        assert!(system.force_on(droplets[0]).expect("a droplet").length() < 1e-9 * forces.scale());
        let [post, wheel] = [0, 1].map(|k| system.observe(rigid_bodies[k]).expect("a body"));
        assert!((post.force + wheel.force - forces.on_bodies).length() < 1e-9 * forces.scale());
        assert!(post.velocity.length() < 1e-7 && post.spin.abs() < 1e-7, "{post:?}");
        assert!(wheel.velocity.length() < 1e-7 && (wheel.spin - 0.4).abs() < 1e-7, "{wheel:?}");
    }
}

/// A free body under the load that a moved one needs moves as that does, also in a box.
#[test]
fn a_load_for_a_motion_moves_the_body() {
    let (velocity, spin) = ([0.3, -0.2], 0.5);
    for region in [
        Region::Box { lengths: [4.0, 5.0] },
        Region::Channel { length: 5.0, width: 3.0, drive: Drive::ZeroFlux },
        Region::Channel { length: 5.0, width: 3.0, drive: Drive::Gradient(-0.5) }.with_slip([0.1, 0.4]),
    ] {
        let body = RigidBodySetup { velocity: Some(velocity), angular_velocity: Some(spin), ..ellipse(0.2) };
        let moved = Setup { region, ..channel(1.0, 1.0, 0.0, Drive::ZeroFlux, body) };
        let Built { mut scene, rigid_bodies, .. } = moved.build().expect("a scene");
        let seen = scene.observe(rigid_bodies[0]).expect("a body");
        let (force, torque) = ((-seen.force).to_array(), -seen.torque);
        let free = RigidBodySetup { force, torque, ..ellipse(0.2) };
        let Built { mut scene, rigid_bodies, .. } =
            Setup { rigid_bodies: vec![free], ..moved }.build().expect("a scene");
        let seen = scene.observe(rigid_bodies[0]).expect("a body");
        assert!((seen.velocity - Vec2::from(velocity)).length() < 1e-8, "{region:?}: {seen:?}");
        assert!((seen.spin - spin).abs() < 1e-8, "{region:?}: {seen:?}");
        assert!((seen.force + Vec2::from(force)).length() < 1e-12 * Vec2::from(force).length());
    }
}

/// A body that is moved is where it should be after a run, and a run that is resumed is the same to the last bit.
#[test]
fn a_body_moves_as_prescribed() {
    let body = RigidBodySetup { velocity: Some([0.5, -0.2]), angular_velocity: Some(2.0), ..ellipse(0.2) };
    let mut setup = channel(6.0, 3.0, 0.1, Drive::Flux(0.3), body);
    setup.method = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
    let Built { mut scene, rigid_bodies, .. } = setup.build().expect("a scene");
    scene.run(0.3).go().expect("a run");
    let saved = scene.checkpoint("a moving body");
    scene.run(0.5).go().expect("a run");
    let seen = scene.observe(rigid_bodies[0]).expect("a body");
    assert!((seen.centre - Vec2::new(0.25, 0.1)).length() < 1e-12 && (seen.angle - 1.0).abs() < 1e-12, "{seen:?}");
    let Built { scene: mut again, rigid_bodies: bodies, .. } = setup.build().expect("a scene");
    again.resume(&saved).expect("the same scene");
    again.run(0.5).go().expect("a run");
    let resumed = again.observe(bodies[0]).expect("a body");
    assert_eq!(format!("{seen:?}"), format!("{resumed:?}"));
    // A body that is not held is another one.
    let free = Setup { rigid_bodies: vec![ellipse(0.2)], ..setup };
    assert!(free.build().expect("a scene").scene.resume(&saved).is_err());
}

/// Micrometres and millipascal seconds in SI units: forces scale as viscosity times velocity.
#[test]
fn a_post_of_a_micrometre() {
    let post = RigidBodySetup { held: true, ..disc(1e-6, 1e-6) };
    let mut setup = channel(12e-6, 6e-6, 0.4e-6, Drive::Flux(4e-12), post);
    setup.viscosity = 1e-3;
    let ([x, y, torque], forces) = seen(&setup);
    // The case of radius 0.5 at 0.5 in units of 2 micrometres and seconds.
    let unit = 1e-3 * 2e-6;
    assert!((x / (10.229651639 * unit) - 1.0).abs() < 1e-8, "{x}");
    assert!((torque / (0.78993995687 * unit * 2e-6) - 1.0).abs() < 1e-8 && y.abs() < 1e-8 * x, "{torque} {y}");
    let extra = forces.extra_pressure_drop.expect("a flux");
    assert!((extra / (4.11511648501 * 1e-3) - 1.0).abs() < 1e-8, "{extra}");
}

#[test]
fn what_cannot_be_held_is_refused() {
    let post = RigidBodySetup { held: true, ..RigidBodySetup::disc(0.5) };
    let moved = RigidBodySetup { velocity: Some([1.0, 0.0]), ..RigidBodySetup::disc(0.5) };
    let turned = RigidBodySetup { angular_velocity: Some(1.0), ..RigidBodySetup::disc(0.5) };
    for (body, key) in [(post, "held"), (moved, "velocity"), (turned, "angular-velocity")] {
        let setup = Setup { region: Region::Plane, ..channel(1.0, 1.0, 0.0, Drive::ZeroFlux, body) };
        let text = setup.check().expect_err("a refusal").to_string();
        assert!(text.contains(key) && text.contains("Stokes' paradox") && text.contains("channel"), "{text}");
    }
    // A grid that does not resolve the body, or its ends.
    let thin = DropletShape::Ellipse { half_axes: [0.9, 0.05] };
    for body in [RigidBodySetup::disc(0.1), RigidBodySetup { shape: thin, ..RigidBodySetup::default() }] {
        let mut setup = channel(6.0, 3.0, 0.0, Drive::ZeroFlux, RigidBodySetup { held: true, ..body });
        setup.method = Method::Grid(GridMethod { spacing: 0.1, ..GridMethod::default() });
        let text = setup.build().expect_err("a refusal").to_string();
        assert!(text.contains("method.grid.spacing = 0.1") && text.contains("rigid body"), "{text}");
    }
    // The same of a scene that is put together by hand, and of a body in it.
    let markers = (0..64).map(|k| Vec2::from_angle(f64::from(k) * PI / 32.0)).collect::<Vec<_>>();
    let settings = motile::boundary_integrals::Settings::default();
    let flow = motile::boundary_integrals::BoundaryIntegral::new(Region::Plane, 1.0, settings).expect("a flow");
    let mut scene = Scene::new(flow);
    scene.add(RigidBody::new(&markers).expect("an outline").held());
    let text = scene.system_mut().evaluate().expect_err("a refusal").to_string();
    assert!(text.contains("Stokes' paradox") && text.contains("channel"), "{text}");
    let nowhere = RigidBody::new(&markers).expect("an outline").moving(Vec2::new(f64::NAN, 0.0), 0.0);
    assert!(nowhere.is_err_and(|error| error.to_string().contains("velocity")));
    for value in [f64::NAN, f64::INFINITY] {
        let wrong = RigidBodySetup { velocity: Some([0.0, value]), ..RigidBodySetup::disc(0.5) };
        let text = channel(6.0, 3.0, 0.0, Drive::ZeroFlux, wrong).check().expect_err("a refusal").to_string();
        assert!(text.contains("rigid-bodies[0].velocity"), "{text}");
        let wrong = RigidBodySetup { angular_velocity: Some(value), ..RigidBodySetup::disc(0.5) };
        let text = channel(6.0, 3.0, 0.0, Drive::ZeroFlux, wrong).check().expect_err("a refusal").to_string();
        assert!(text.contains("angular-velocity"), "{text}");
    }
}

/// On a grid, drag, lift, torque and pressure drop are of second order in the spacing, against the same program.
#[test]
fn a_post_on_a_grid() {
    for (slip, body, expected) in [
        (0.0, disc(0.5, 0.0), [16.7187598671, 0.0, 0.0, 7.936105974]),
        (0.2, ellipse(0.4), [8.6261930034, -1.59415384843, 0.44458988301, 3.6133521305]),
    ] {
        let errors = [0.1, 0.05, 0.025].map(|spacing| {
            let body = RigidBodySetup { held: true, ..body.clone() };
            let mut setup = channel(6.0, 3.0, slip, Drive::Flux(1.0), body);
            setup.method = Method::Grid(GridMethod { spacing, ..GridMethod::default() });
            let Built { mut scene, .. } = setup.build().expect("a scene");
            let (load, forces) = seen_in(&mut scene);
            let traction = scene.system_mut().wall_traction().expect("a flow").expect("walls");
            assert!(forces.imbalance(traction).abs() < 1e-6 * forces.scale(), "{forces:?} {traction:?}");
            let found = [load[0], load[1], load[2], forces.extra_pressure_drop.expect("a flux")];
            let errors = [0, 1, 2, 3].map(|k| ((found[k] - expected[k]) / expected[0]).abs());
            errors.into_iter().fold(0.0, f64::max)
        });
        println!("{slip}: {errors:?}");
        assert!(errors[1] < 0.012 && errors[2] < 0.003, "{errors:?}");
        let order = (errors[0] / errors[2]).log2() / 2.0;
        assert!(order > 1.8, "{order} {errors:?}");
    }
}

/// A swimmer next to a post and a moving body by two methods: the grid is near boundary integrals, in a channel and in
/// a box.
#[test]
fn posts_by_two_methods() {
    let swimmer =
        DropletSetup { centre: [-1.4, 0.2], shape: DropletShape::Round { radius: 0.8 }, ..DropletSetup::active(-3.0) };
    let post = RigidBodySetup { held: true, centre: [0.6, -0.5], ..ellipse(0.0) };
    let moved = RigidBodySetup {
        centre: [2.4, 0.6],
        velocity: Some([-0.5, 0.2]),
        angular_velocity: Some(0.4),
        ..RigidBodySetup::disc(0.4)
    };
    for region in [
        Region::Channel { length: 8.0, width: 4.0, drive: Drive::Gradient(-20.0) },
        Region::Box { lengths: [8.0, 4.0] },
    ] {
        let of = |method: Method| {
            let setup = Setup {
                region,
                method,
                droplets: vec![swimmer.clone()],
                rigid_bodies: vec![post.clone(), moved.clone()],
                ..Setup::default()
            };
            let Built { mut scene, droplets, rigid_bodies, .. } = setup.build().expect("a scene");
            let velocity = scene.observe(droplets[0]).expect("a droplet").velocity;
            let [post, moved] = [0, 1].map(|k| scene.observe(rigid_bodies[k]).expect("a body"));
            let power = moved.force.dot(moved.velocity) + moved.torque * moved.spin;
            [post.force.x, post.force.y, moved.force.x, power, 100.0 * velocity.x, 100.0 * velocity.y]
        };
        let expected = of(Method::Integral(IntegralMethod { nodes: 72, elements: 144 }));
        let scale = expected.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let errors = [0.1, 0.05].map(|spacing| {
            let found = of(Method::Grid(GridMethod { spacing, ..GridMethod::default() }));
            let apart = found.iter().zip(&expected).map(|(found, expected)| (found - expected).abs() / scale);
            apart.fold(0.0, f64::max)
        });
        println!("{region:?}: {expected:?} {errors:?}");
        assert!(errors[1] < 0.01 && errors[1] < 0.4 * errors[0], "{errors:?}");
    }
}

/// Next to an elastic solid, layers hold a body too: it is at rest, and the forces balance.
#[test]
fn a_post_next_to_an_elastic_solid() {
    let island = SolidSetup {
        hold: Hold::Free,
        ..SolidSetup::new(
            SolidOutline::Disc { centre: [-1.2, 0.2], radius: 0.6 },
            Material::NeoHookean { shear: 500.0, bulk: 900.0 },
        )
    };
    let post = RigidBodySetup { held: true, centre: [1.2, -0.3], ..RigidBodySetup::disc(0.5) };
    let setup = Setup {
        region: Region::Channel { length: 6.0, width: 3.0, drive: Drive::Flux(1.0) },
        method: Method::Layers(LayersMethod::of_spacing(0.1)),
        droplets: Vec::new(),
        solids: vec![island],
        rigid_bodies: vec![post],
        ..Setup::default()
    };
    let Built { mut scene, rigid_bodies, solids, .. } = setup.build().expect("a scene");
    let seen = scene.observe(rigid_bodies[0]).expect("a body");
    assert!(seen.velocity.length() < 1e-6 && seen.spin.abs() < 1e-6, "{seen:?}");
    let system = scene.system_mut();
    let forces = system.channel_forces().expect("a flow").expect("walls");
    let traction = system.wall_traction().expect("a flow").expect("walls");
    println!("{seen:?} {forces:?} {traction:?}");
    assert!(forces.imbalance(traction).abs() < 2e-2 * forces.scale(), "{forces:?} {traction:?}");
    assert!(system.force_on(solids[0]).expect("a solid").length() < 1e-9 * forces.scale());
}

/// Nothing acts on a post in fluid at rest. Eight posts in a row of a channel are eight times one post in an eighth of
/// its length.
#[test]
fn many_posts_and_none_that_bear_a_force() {
    let post = RigidBodySetup { held: true, ..disc(0.3, 0.2) };
    let small = |setup: Setup| Setup { method: Method::Integral(IntegralMethod { nodes: 48, elements: 48 }), ..setup };
    let (load, forces) = seen(&small(channel(3.0, 2.0, 0.0, Drive::ZeroGradient, post.clone())));
    assert_eq!((load, forces.on_walls), ([0.0; 3], [0.0; 2]));
    let (one, drop) = seen(&small(channel(3.0, 2.0, 0.0, Drive::Flux(1.0), post.clone())));
    let mut many = small(channel(24.0, 2.0, 0.0, Drive::Flux(1.0), post.clone()));
    many.rigid_bodies =
        (0..8).map(|k| RigidBodySetup { centre: [3.0 * f64::from(k) - 10.5, 0.2], ..post.clone() }).collect();
    let (first, total) = seen(&many);
    assert!((first[0] / one[0] - 1.0).abs() < 1e-6 && (first[2] / one[2] - 1.0).abs() < 1e-6, "{first:?} {one:?}");
    assert!((total.on_bodies.x / (8.0 * one[0]) - 1.0).abs() < 1e-6, "{total:?}");
    assert!((total.pressure_drop / (8.0 * drop.pressure_drop) - 1.0).abs() < 1e-6, "{total:?}");
}

/// A scene that is kept symmetric needs the mirror image of what is moved.
#[test]
fn symmetric_scenes_move_bodies_in_pairs() {
    let body = |y: f64, across: f64| RigidBodySetup { velocity: Some([0.1, across]), ..disc(0.3, y) };
    let of = |bodies: Vec<RigidBodySetup>| {
        let setup = channel(6.0, 3.0, 0.0, Drive::ZeroFlux, body(0.0, 0.0));
        Setup { mirror_symmetric: true, rigid_bodies: bodies, ..setup }
    };
    let text = of(vec![body(0.0, 0.2)]).check().expect_err("a refusal").to_string();
    assert!(text.contains("mirror image") && text.contains("rigid-bodies[0].velocity"), "{text}");
    let mut scene = of(vec![body(0.6, 0.2), body(-0.6, -0.2)]).build().expect("a pair").scene;
    scene.run(0.1).go().expect("a run");
    let places: Vec<Vec2> = scene.system().bodies::<RigidBody>().map(|(_, body)| body.centre()).collect();
    assert!((places[0] - Vec2::new(0.01, 0.62)).length() < 1e-12, "{places:?}");
}

/// A run with a held body on a grid can be resumed on a finer one.
#[test]
fn a_held_body_on_a_finer_grid() {
    let on = |spacing: f64| {
        let mut setup = channel(3.0, 2.0, 0.0, Drive::Flux(1.0), RigidBodySetup { held: true, ..disc(0.4, 0.1) });
        setup.method = Method::Grid(GridMethod { spacing, ..GridMethod::default() });
        setup.build().expect("a scene").scene
    };
    let mut scene = on(0.1);
    scene.run(0.1).go().expect("a run");
    let saved = scene.checkpoint("a post");
    let mut finer = on(0.05);
    finer.resume(&saved).expect("the same scene on another grid");
    let ([found, ..], _) = seen_in(&mut finer);
    let ([expected, ..], _) = seen_in(&mut on(0.05));
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
}

/// Fluids of several viscosities: an interface along the channel over less viscous fluid, and a droplet with a rigid
/// nucleus that is held, or that moves freely under a load. Forces by the reciprocal theorem are those of the shear
/// stress on the walls.
#[test]
fn walls_next_to_layers_and_nuclei() {
    for held in [true, false] {
        let nucleus = RigidBodySetup { held, centre: [0.5, 0.1], force: [20.0, 5.0], ..RigidBodySetup::disc(0.3) };
        let droplet = DropletSetup { centre: [0.4, 0.0], viscosity: Some(40.0), ..DropletSetup::active(-3.0) };
        let layer =
            InterfaceSetup { height: -1.5, inside: Side::Below, viscosity: Some(30.0), ..InterfaceSetup::default() };
        for interfaces in [Vec::new(), vec![layer]] {
            let setup = Setup {
                region: Region::Channel { length: 6.0, width: 5.0, drive: Drive::Gradient(-20.0) },
                method: Method::Integral(IntegralMethod { nodes: 72, elements: 144 }),
                droplets: vec![droplet.clone()],
                rigid_bodies: vec![nucleus.clone()],
                interfaces,
                ..Setup::default()
            };
            let mut scene = setup.build().expect("a scene").scene;
            let system = scene.system_mut();
            let forces = system.channel_forces().expect("a flow").expect("walls");
            let traction = system.wall_traction().expect("a flow").expect("walls");
            println!("{held} {}: {forces:?} {traction:?}", setup.interfaces.len());
            for (wall, force) in traction.iter().enumerate() {
                assert!((force - forces.on_walls[wall]).abs() < 1e-9 * forces.scale(), "{forces:?} {traction:?}");
            }
        }
    }
}
