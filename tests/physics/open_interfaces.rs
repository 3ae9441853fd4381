//! Interfaces that are periodic along x: linear theory, conservation, neighbours.

use motile::active_interface::theory::{Stratum, StratumEnd};
use motile::active_interface::{ActiveInterface, Motion, wave};
use motile::base::{FlowSample, ImposedFlow};
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::prelude::*;
use motile::scene::{Body, Hydrodynamics, Markers};
use motile::setup::{
    DropletShape, ElasticitySetup, Hold, InterfaceSetup, InterfaceShape, Material, RigidBodySetup, Side, SolidOutline,
    SolidSetup, Start,
};
use motile_tests::validation::flat::{Flat, PERIOD, difference, half_space, wall};

/// Within 0.1 per cent at 64 cells a wave, and of second order in them: chords of the concentration.
fn assert_growth(flat: &Flat<'_>, exact: [[f64; 2]; 2], per_wave: usize, what: &str) {
    let cells = [1, 2, 4].map(|times| times * per_wave * flat.waves);
    let errors = cells.map(|cells| difference(flat.growth(64, cells).expect("rates"), exact));
    assert!(errors[0] < 1e-3, "{what}: {errors:?}");
    let order = (errors[1] / errors[2]).log2();
    assert!((1.9..2.1).contains(&order), "{what}: {errors:?}");
    // The shape alone has the accuracy of the integrals.
    let shape = flat.growth(64, cells[0]).expect("rates")[1][1];
    assert!((shape / exact[1][1] - 1.0).abs() < 1e-9, "{what}: {shape} {}", exact[1][1]);
}

#[test]
fn waves_grow_as_between_half_spaces() {
    let tall = Region::Channel { length: PERIOD, width: 36.0, drive: Drive::ZeroGradient };
    let high = Region::Box { lengths: [PERIOD, 30.0] };
    for (region, inside) in [(tall, 1.0), (tall, 10.0), (tall, 0.05), (high, 1.0)] {
        for advance in [PERIOD, -PERIOD] {
            let interfaces = &[(0.3, advance, inside)];
            let flat = Flat { region, exterior: 1.0, interfaces, signs: &[[1.0, 1.0]], waves: 1 };
            let exact = flat.theory(half_space(1.0), half_space(inside)).unwrap();
            assert_growth(&flat, exact, 64, &format!("{region:?} {inside} {advance}"));
        }
    }
}

#[test]
fn waves_grow_as_in_a_channel() {
    let region = Region::Channel { length: PERIOD, width: 2.0, drive: Drive::ZeroGradient };
    for (height, inside, waves) in [(0.0, 1.0, 1), (0.3, 5.0, 1), (-0.6, 0.1, 2)] {
        let interfaces = &[(height, PERIOD, inside)];
        let flat = Flat { region, exterior: 1.0, interfaces, signs: &[[1.0, 1.0]], waves };
        let exact = flat.theory(wall(1.0, 1.0 + height), wall(inside, 1.0 - height)).unwrap();
        assert_growth(&flat, exact, 64, &format!("{height} {inside} {waves}"));
    }
}

/// Next to a wall, the images of an interface are summed over as many nodes as the gap needs: a wave relaxes as it
/// should with any nodes that carry it, although they are farther apart than the gap: to 1e-10 at a tolerance of 1e-12.
#[test]
fn few_nodes_next_to_a_wall_are_exact() {
    let region = Region::Channel { length: PERIOD, width: 2.0, drive: Drive::ZeroGradient };
    // Where the gap is narrower, the amplitude of the wave, of which the theory is the limit, shows at any nodes alike.
    for (height, bound) in [(0.85, 1e-10), (0.97, 1e-9)] {
        let interfaces = &[(height, PERIOD, 20.0)];
        let flat = Flat { region, exterior: 1.0, interfaces, signs: &[[1.0, 1.0]], waves: 3 };
        let exact = flat.theory(wall(1.0, 1.0 + height), wall(20.0, 1.0 - height)).unwrap();
        let errors = [16, 24, 32, 48].map(|nodes| (flat.growth(nodes, 192).unwrap()[1][1] / exact[1][1] - 1.0).abs());
        println!("{height}: {errors:?}");
        assert!(errors.iter().all(|error| *error < bound && (error - errors[3]).abs() < 1e-11), "{height}: {errors:?}");
    }
}

#[test]
fn waves_grow_as_on_pairs() {
    let channel = Region::Channel { length: PERIOD, width: 4.0, drive: Drive::ZeroGradient };
    let high = Region::Box { lengths: [PERIOD, 30.0] };
    let (half, beyond) = (0.8, 3.0);
    for (region, outer) in [(channel, wall(beyond, 2.0 - half)), (high, half_space(beyond))] {
        for (end, signs) in [
            (StratumEnd::Same { thickness: 2.0 * half }, [[1.0, -1.0], [1.0, 1.0]]),
            (StratumEnd::Opposite { thickness: 2.0 * half }, [[-1.0, 1.0], [1.0, 1.0]]),
        ] {
            let interfaces = &[(-half, -PERIOD, beyond), (half, PERIOD, beyond)];
            let flat = Flat { region, exterior: 1.0, interfaces, signs: &signs, waves: 1 };
            let exact = flat.theory(Stratum { viscosity: 1.0, end }, outer).unwrap();
            assert_growth(&flat, exact, 64, &format!("{region:?} {end:?}"));
        }
    }
}

/// Two active interfaces, the fluid between them exterior, with a droplet there if wanted.
fn walls(method: Method, region: Region, droplets: Vec<DropletSetup>) -> Setup {
    let wall = |height: f64, inside: Side, seed: u64| InterfaceSetup {
        height,
        inside,
        viscosity: Some(50.0),
        particles: Some(Particles {
            activity: -1.0,
            start: Start::Perturbed { amplitude: 0.2, seed },
            ..Particles::default()
        }),
        ..InterfaceSetup::default()
    };
    let interfaces = vec![wall(-1.3, Side::Below, 1), wall(1.4, Side::Above, 2)];
    Setup { method, region, droplets, interfaces, ..Setup::default() }
}

const INTEGRAL: Method = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
const BOX: Region = Region::Box { lengths: [PERIOD, PERIOD] };

#[test]
fn particles_and_areas_are_conserved() {
    let channel = Region::Channel { length: PERIOD, width: 5.0, drive: Drive::Gradient(-0.5) };
    for region in [BOX, channel] {
        let Built { mut scene, interfaces, .. } = walls(INTEGRAL, region, Vec::new()).build().unwrap();
        let before = [0, 1].map(|k| scene.observe(interfaces[k]).unwrap());
        scene.run(20.0).go().unwrap();
        for (handle, before) in interfaces.iter().zip(&before) {
            let after = scene.observe(*handle).unwrap();
            assert!((after.particle_number / before.particle_number - 1.0).abs() < 1e-12, "{region:?}");
            assert!((after.height - before.height).abs() < 1e-10, "{region:?} {} {}", after.height, before.height);
            // The pattern has grown.
            let grown = after.concentration_modes.amplitude(1) / before.concentration_modes.amplitude(1);
            assert!(grown > 2.0, "{region:?}: {grown}");
        }
    }
}

#[test]
fn checkpoints_go_on_bit_for_bit() {
    let setup = walls(
        INTEGRAL,
        BOX,
        vec![DropletSetup { shape: DropletShape::Round { radius: 0.8 }, ..DropletSetup::active(-2.0) }],
    );
    let mut first = setup.build().unwrap().scene;
    for _ in 0..6 {
        first.step(0.01).unwrap();
    }
    let saved = first.checkpoint("walls");
    let mut second = setup.build().unwrap().scene;
    second.resume(&saved).unwrap();
    for scene in [&mut first, &mut second] {
        (0..6).for_each(|_| scene.step(0.01).unwrap());
    }
    assert_eq!(first.checkpoint(""), second.checkpoint(""));
}

/// Layers without solids are the integrals, to another tolerance; with a solid far away they are nearly that.
#[test]
fn layers_move_as_integrals_do() {
    let layers = Method::Layers(LayersMethod { nodes: 32, elements: 64, spacing: 0.125, ..LayersMethod::default() });
    let after = |method: Method, solids: Vec<SolidSetup>| {
        let region = Region::Box { lengths: [PERIOD, 9.0] };
        let Built { mut scene, interfaces, .. } =
            Setup { solids, ..walls(method, region, Vec::new()) }.build().unwrap();
        (0..4).for_each(|_| scene.step(0.05).unwrap());
        let seen = scene.observe(interfaces[1]).unwrap();
        [seen.height_modes.amplitude(1), seen.concentration_modes.amplitude(1)]
    };
    let exact = after(INTEGRAL, Vec::new());
    let alone = after(layers, Vec::new());
    for (found, exact) in alone.iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 1e-6, "{alone:?} {exact:?}");
    }
    let material = Material::NeoHookean { shear: 10.0, bulk: 20.0 };
    let disc = SolidSetup::new(SolidOutline::Disc { centre: [0.0, -4.2], radius: 0.6 }, material);
    let beside = after(layers, vec![SolidSetup { hold: Hold::Free, ..disc }]);
    for (found, exact) in beside.iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 0.002, "{beside:?} {exact:?}");
    }
}

/// The fluid beside an interface has its viscosity wherever it is looked at: the shear stress is continuous.
#[test]
fn samples_on_both_sides_have_one_stress() {
    for region in [BOX, Region::Channel { length: PERIOD, width: 5.0, drive: Drive::ZeroGradient }] {
        let Built { mut scene, .. } = walls(INTEGRAL, region, Vec::new()).build().unwrap();
        let system = scene.system_mut();
        system.evaluate().unwrap();
        let mut seen = [FlowSample::default(); 4];
        let (x, apart) = (0.7, 1e-6);
        let places = [1.4 - apart, 1.4 + apart, -1.3 + apart, -1.3 - apart].map(|y| Vec2::new(x, y));
        system.sample(&places, &mut seen).unwrap();
        for pair in seen.chunks(2) {
            // The interface is flat: velocity is continuous and with it dv/dy = -du/dx; the normal force is nothing.
            let [inner, outer] = [&pair[0], &pair[1]];
            assert!((inner.velocity - outer.velocity).length() < 1e-6, "{region:?}");
            let normal = |seen: &FlowSample, viscosity: f64| 2.0 * viscosity * seen.gradient[1][1] - seen.pressure;
            let scale = 1e-3 * (inner.pressure.abs() + 100.0 * inner.gradient[1][1].abs());
            assert!((normal(inner, 100.0) - normal(outer, 50.0)).abs() < scale, "{region:?} {inner:?} {outer:?}");
        }
    }
}

#[test]
fn impossible_interfaces_end_in_a_sentence() {
    let said = |change: &dyn Fn(&mut Setup)| {
        let mut setup = walls(INTEGRAL, BOX, Vec::new());
        change(&mut setup);
        setup.build().unwrap_err().to_string()
    };
    let has = |text: &str, part: &str| assert!(text.contains(part), "{text}");
    has(&said(&|setup| setup.region = Region::Plane), "Use a box or a channel");
    has(&said(&|setup| setup.method = Method::Grid(GridMethod::of_spacing(0.25))), "Use integral or layers");
    has(&said(&|setup| setup.interfaces[0].height = f64::NAN), "interfaces[0].height = NaN: use a finite number");
    has(&said(&|setup| setup.interfaces[0].viscosity = Some(20.0)), "would have the viscosities");
    has(&said(&|setup| setup.interfaces[0].inside = Side::Above), "would have the viscosities");
    has(&said(&|setup| setup.interfaces.truncate(1)), "would have the viscosities");
    let flux = Region::Channel { length: PERIOD, width: 5.0, drive: Drive::Flux(1.0) };
    has(
        &said(&|setup| setup.region = flux),
        "region.channel.drive.flux = 1: a flux cannot be prescribed along layers of different viscosity",
    );
    has(
        &said(&|setup| {
            setup.interfaces[1].height = -1.2;
            setup.interfaces[1].shape = InterfaceShape::Waves { cosines: vec![0.5], sines: Vec::new() };
        }),
        "overlaps",
    );
    let points = (0..16).map(|k| [0.3 * f64::from(k), 0.0]).collect::<Vec<_>>();
    has(
        &said(&|setup| setup.interfaces[1].shape = InterfaceShape::Points(points.clone())),
        "does not close across the period",
    );
    let droplet = DropletSetup { centre: [0.0, 1.4], ..DropletSetup::active(-1.0) };
    has(&said(&|setup| setup.droplets = vec![droplet.clone()]), "overlaps");
    has(
        &said(&|setup| {
            setup.region = Region::Channel { length: PERIOD, width: 2.7, drive: Drive::ZeroGradient };
        }),
        "does not fit into the region",
    );
}

/// A droplet between two walls is in exterior fluid, one beyond them in the fluid there, across the period too.
#[test]
fn droplets_know_the_fluid_around_them() {
    let small = |y: f64| DropletSetup {
        centre: [0.0, y],
        shape: DropletShape::Round { radius: 0.3 },
        ..DropletSetup::passive(10.0)
    };
    let region = Region::Box { lengths: [PERIOD, 12.0] };
    let setup = walls(INTEGRAL, region, [0.0, 1.9, 5.9, -1.9, -4.5].map(small).to_vec());
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    scene.step(0.001).unwrap();
    let seen: Vec<f64> =
        droplets.iter().map(|handle| scene.system().fluid_around(*handle).unwrap().viscosity).collect();
    assert_eq!(seen, [100.0, 50.0, 50.0, 50.0, 50.0]);
}

/// Waves on a flat elastic membrane between half-spaces decay at E_s k/(2 (eta_1 + eta_2)) along it and
/// (gamma k + B k^3)/(2 (eta_1 + eta_2)) across.
#[test]
fn waves_on_an_elastic_wall_decay() {
    let (stretching, bending, gamma, inside) = (7.0, 0.6, 2.0, 4.0);
    for nodes in [16, 48] {
        let settings = Settings { nodes, tolerance: 1e-13, ..Settings::default() };
        let region = Region::Channel { length: PERIOD, width: 36.0, drive: Drive::ZeroGradient };
        let mut flow = BoundaryIntegral::new(region, 1.0, settings).unwrap();
        let k = 2.0 * std::f64::consts::TAU / PERIOD;
        let flat = wave(0.0, PERIOD, &[], &[], nodes).unwrap();
        let made = ActiveInterface::periodic_passive(&flat, PERIOD, gamma).unwrap();
        let mut body = made.with_viscosity_inside(inside).unwrap().with_elasticity(stretching, bending).unwrap();
        let amplitude = 1e-6;
        let moved: Vec<f64> =
            flat.iter().flat_map(|x| [x.x + amplitude * (k * x.x).sin(), x.y + amplitude * (k * x.x).cos()]).collect();
        body.read_state(&moved).unwrap();
        let mut markers = Markers::new();
        markers.push_group(nodes, body.kind());
        body.write_markers(markers.positions_mut());
        body.write_forces(&flow.fluid_view(), markers.forces_mut()).unwrap();
        flow.velocities(&mut markers).unwrap();
        let seen = markers.velocities().iter().zip(&flat);
        let [along, across] = seen
            .fold([0.0; 2], |[along, across], (u, x)| [along + u.x * (k * x.x).sin(), across + u.y * (k * x.x).cos()]);
        let rates = [along, across].map(|sum| -2.0 * sum / (nodes as f64 * amplitude));
        let exact = [stretching * k, gamma * k + bending * k.powi(3)].map(|rate| rate / (2.0 * (1.0 + inside)));
        for (found, exact) in rates.into_iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 1e-7, "{nodes}: {rates:?} {exact:?}");
        }
    }
}

/// An elastic wall at rest on particles that do not pull keeps its particles on its points.
#[test]
fn elastic_walls_carry_their_particles() {
    let mut setup = walls(INTEGRAL, BOX, Vec::new());
    for wall in &mut setup.interfaces {
        wall.motion = Motion::WithFluid;
        wall.elasticity = Some(ElasticitySetup { stretching: 20.0, bending: 0.1 });
    }
    let Built { mut scene, interfaces, .. } = setup.build().unwrap();
    let before = scene.observe(interfaces[0]).unwrap();
    scene.run(10.0).go().unwrap();
    let after = scene.observe(interfaces[0]).unwrap();
    assert!((after.particle_number / before.particle_number - 1.0).abs() < 1e-12);
    assert!((after.height - before.height).abs() < 1e-10);
    assert!(scene.body(interfaces[0]).unwrap().elastic_energy() > 0.0);
    let saved = scene.checkpoint("");
    let mut again = setup.build().unwrap().scene;
    again.resume(&saved).unwrap();
    assert_eq!(again.checkpoint(""), saved);
    setup.interfaces[0].motion = Motion::default();
    let said = setup.build().unwrap_err().to_string();
    assert!(said.contains("Use \"with-fluid\""), "{said}");
}

/// Layers of two fluids between sliding walls: the shear stress is the same in all, (U_2 - U_1)/(h_1/eta_1 +
/// h_2/eta_2), and small waves on them decay. In a sheared box the images of interfaces slide past each other, which is
/// refused, and so is the stresslet of an interface.
#[test]
fn layers_in_a_shear() {
    let (walls, width, half, inside) = ([-1.0, 2.0], 4.0, 0.7, 5.0);
    let wall = |height: f64, side: Side| InterfaceSetup {
        height,
        inside: side,
        viscosity: Some(inside),
        particles: None,
        shape: InterfaceShape::Waves { cosines: vec![0.01], sines: Vec::new() },
        ..InterfaceSetup::default()
    };
    let setup = Setup {
        region: Region::Channel { length: PERIOD, width, drive: Drive::ZeroGradient },
        viscosity: 1.0,
        flow: FlowSetup { wall_velocity: Some(walls), ..FlowSetup::default() },
        method: INTEGRAL,
        droplets: Vec::new(),
        interfaces: vec![wall(-half, Side::Below), wall(half, Side::Above)],
        ..Setup::default()
    };
    let Built { mut scene, interfaces, .. } = setup.build().unwrap();
    let before = scene.observe(interfaces[1]).unwrap().height_modes.amplitude(1);
    scene.run(8.0).go().unwrap();
    let after = scene.observe(interfaces[1]).unwrap();
    assert!(after.height_modes.amplitude(1) < 0.2 * before && (after.height - half).abs() < 1e-9, "{after:?}");
    let stress = (walls[1] - walls[0]) / (2.0 * half + (width - 2.0 * half) / inside);
    let mut samples = [FlowSample::default(); 3];
    let places = [Vec2::new(0.3, 0.0), Vec2::new(-1.0, 1.9), Vec2::new(2.0, -1.9)];
    scene.system_mut().sample(&places, &mut samples).unwrap();
    for (sample, viscosity) in samples.iter().zip([1.0, inside, inside]) {
        let found = viscosity * (sample.gradient[0][1] + sample.gradient[1][0]);
        assert!((found / stress - 1.0).abs() < 0.01, "{found} {stress}");
    }
    // One interface, with different fluids at the walls.
    let height = 0.5;
    let interfaces = vec![InterfaceSetup { shape: InterfaceShape::Flat, ..wall(height, Side::Above) }];
    let Built { scene: mut single, .. } = Setup { interfaces, ..setup.clone() }.build().unwrap();
    single.step(0.001).unwrap();
    let stress = (walls[1] - walls[0]) / (0.5 * width + height + (0.5 * width - height) / inside);
    single
        .system_mut()
        .sample(&[Vec2::new(0.3, -1.0), Vec2::new(1.0, 1.5), Vec2::new(2.0, 2.0)], &mut samples)
        .unwrap();
    for (sample, viscosity) in samples.iter().zip([1.0, inside, inside]) {
        assert!((viscosity * sample.gradient[0][1] / stress - 1.0).abs() < 1e-8, "{sample:?} {stress}");
    }
    assert!((samples[2].velocity - Vec2::new(walls[1], 0.0)).length() < 1e-8, "{samples:?}");
    let refused = scene.system_mut().stresslets().unwrap_err().to_string();
    assert!(refused.contains("periodic along x") && refused.contains("Average the stress"), "{refused}");
    let region = Region::Box { lengths: [PERIOD, width] };
    let boxed = Setup { region, flow: FlowSetup { shear: 0.8, ..FlowSetup::default() }, ..setup };
    let refused = boxed.check().unwrap_err().to_string();
    assert!(refused.contains("slide past each other") && refused.contains("wall-velocity"), "{refused}");
    let still = Setup { flow: FlowSetup::default(), ..boxed };
    let mut scene = still.build().unwrap().scene;
    scene.impose(ImposedFlow::shear(1.0)).unwrap();
    let refused = scene.run(1.0).go().unwrap_err().to_string();
    assert!(refused.contains("slide past each other"), "{refused}");
}

/// A rigid disc between two active walls: three resolutions of the integrals, and layers, give it one motion.
#[test]
fn interfaces_beside_rigid_bodies() {
    let disc = RigidBodySetup {
        centre: [0.4, 0.3],
        shape: DropletShape::Round { radius: 0.6 },
        force: [3.0, -1.0],
        ..RigidBodySetup::default()
    };
    for region in [BOX, Region::Channel { length: PERIOD, width: 5.0, drive: Drive::Gradient(-2.0) }] {
        let motion = |method: Method| {
            let setup = Setup { rigid_bodies: vec![disc.clone()], ..walls(method, region, Vec::new()) };
            let Built { mut scene, rigid_bodies, interfaces, .. } = setup.build().unwrap();
            (0..4).for_each(|_| scene.step(0.05).unwrap());
            let body = scene.observe(rigid_bodies[0]).unwrap();
            let wave = scene.observe(interfaces[1]).unwrap().height_modes.amplitude(1);
            [body.velocity.x, body.velocity.y, body.spin, wave]
        };
        let nodes = |nodes: usize| motion(Method::Integral(IntegralMethod { nodes, elements: 96 }));
        let [coarse, fine] = [24, 48].map(nodes);
        let layers =
            motion(Method::Layers(LayersMethod { nodes: 48, elements: 96, spacing: 0.125, ..LayersMethod::default() }));
        for k in 0..4 {
            let scale = 1e-5 * fine[0].abs().max(fine[1].abs());
            assert!((coarse[k] - fine[k]).abs() < scale, "{region:?} {coarse:?} {fine:?}");
            assert!((layers[k] - fine[k]).abs() < scale, "{region:?} {layers:?} {fine:?}");
        }
    }
}
