//! Elastic fibres in flows, against closed forms and between methods.

use std::f64::consts::{PI, TAU};

use motile::elastic_solids::{BendingMeasure, Fibre, FibreEnd, FibreWave, Target};
use motile::prelude::*;
use motile::scene::Scene;
use motile::setup::{
    AnyFlow, CurvatureWaveSetup, DropletShape, FibreHold, FibreSetup, FibreShape, LoadSetup, ShellSetup, TargetSetup,
    TargetWaveSetup,
};

/// Side of the boxes (length).
const SIDE: f64 = 2.0;

/// A scene without bodies in a box of viscosity 1, on a grid of this spacing.
fn empty(spacing: f64) -> Scene<AnyFlow> {
    let region = Region::Box { lengths: [SIDE; 2] };
    let method = Method::Grid(GridMethod::of_spacing(spacing));
    let setup = Setup { region, viscosity: 1.0, method, droplets: Vec::new(), ..Setup::default() };
    setup.build().expect("a scene").scene
}

/// Nodes of a line over the period.
fn flat(count: usize) -> Vec<Vec2> {
    (0..count).map(|k| Vec2::new(SIDE * (k as f64 / count as f64 - 0.5), 0.0)).collect()
}

/// Amplitude of a wave of the heights of nodes.
fn amplitude(fibre: &Fibre, wave: f64) -> f64 {
    let count = fibre.nodes().len() as f64;
    let at = fibre.nodes().iter().map(|place| place.y * (wave * place.x).cos());
    2.0 / count * at.sum::<f64>()
}

/// Rate at which a small wave decays along a fibre across the box, that bends or is tethered.
fn decay(spacing: f64, bending: f64, tether: f64) -> f64 {
    let wave = TAU / SIDE;
    let count = (SIDE / spacing) as usize;
    let nodes = flat(count);
    let bent: Vec<Vec2> = nodes.iter().map(|x| *x + Vec2::new(0.0, 1e-4 * (wave * x.x).cos())).collect();
    let targets = nodes.iter().enumerate().map(|(k, place)| Target::fixed(k, *place, tether * spacing));
    let fibre = Fibre::periodic(&nodes, Vec2::new(SIDE, 0.0), 1.0, bending).expect("a fibre");
    let fibre = fibre.with_targets(targets).expect("a fibre").deformed(&bent).expect("a fibre");
    let mut scene = empty(spacing);
    let fibre = scene.add(fibre);
    let before = amplitude(scene.body(fibre).expect("the fibre"), wave);
    scene.run(0.02).step_size(StepSize::Fixed(0.005)).go().expect("a run");
    let after = amplitude(scene.body(fibre).expect("the fibre"), wave);
    (before / after).ln() / 0.02
}

/// Rate over the viscosity at which a wave of the forces per length k decays, on a line in a box: the sum over its
/// images of `k/(4 eta q) (1 + q |y|) exp(-q |y|)`.
fn of_images(wave: f64) -> f64 {
    let image = |n: i32| {
        let y = wave * SIDE * f64::from(n.abs());
        (1.0 + y) * (-y).exp()
    };
    (-5..=5).map(image).sum::<f64>() / (4.0 * wave)
}

#[test]
fn a_bent_line_relaxes_at_the_rate_of_an_infinite_sheet() {
    let wave = TAU / SIDE;
    let exact = 0.02 * wave.powi(4) * of_images(wave);
    assert!((exact / (0.02 * wave.powi(3) / 4.0) - 1.0).abs() < 0.03, "nearly B q^3/(4 eta)");
    let errors = [0.125, 0.0625].map(|spacing| (decay(spacing, 0.02, 0.0) / exact - 1.0).abs());
    let order = (errors[0] / errors[1]).log2();
    assert!(errors[1] < 0.025 && order > 1.85, "{errors:?} {order}");
}

#[test]
fn targets_pull_a_line_back_at_the_rate_of_its_mobility() {
    let exact = 3.0 * of_images(TAU / SIDE);
    let errors = [0.125, 0.0625].map(|spacing| (decay(spacing, 0.0, 3.0) / exact - 1.0).abs());
    let order = (errors[0] / errors[1]).log2();
    assert!(errors[1] < 0.025 && order > 1.85, "{errors:?} {order}");
}

/// Speed at which a sheet in a box swims against a wave of the amplitude b and the frequency w along it, Taylor's
/// `w q b^2/2` times a factor of its images: the flow between two sheets at the distance H has the stream function
/// `A cosh(q y) + C y sinh(q y)` about the middle, and the speed is `<h du/dy>` on the sheet.
fn of_taylor(wave: f64, frequency: f64, height: f64) -> f64 {
    let half = 0.5 * wave * SIDE;
    let images = 2.0 * half.cosh() / (half.cosh() + half / half.sinh()) - 1.0;
    0.5 * frequency * wave * height * height * images
}

/// A sheet driven by a wave of curvature kappa sin(q s - w t) follows it with the amplitude `(kappa/q^2)
/// r/sqrt(r^2 + w^2)` for the rate r of relaxation, and swims at the speed of Taylor's sheet.
#[test]
fn a_beating_sheet_swims_at_the_speed_of_taylor() {
    let (wave, bending, frequency, height) = (TAU / SIDE, 0.5, 4.0, 0.02);
    let rate = bending * wave.powi(4) * of_images(wave);
    let follows = rate / rate.hypot(frequency);
    let exact = of_taylor(wave, frequency, height * follows);
    let mut told = Vec::new();
    let mut speed = |count: usize| {
        let spacing = SIDE / count as f64;
        let beat = FibreWave { amplitude: height * wave * wave, wave_number: wave, frequency, phase: 0.0 };
        let fibre = Fibre::periodic(&flat(count), Vec2::new(SIDE, 0.0), 100.0, bending).unwrap();
        // As long as the wave is.
        let fibre = fibre.with_rest_length(SIDE * (1.0 + (0.5 * wave * height * follows).powi(2))).unwrap();
        let mut scene = empty(spacing);
        let fibre = scene.add(fibre.with_curvature_wave(beat).unwrap());
        told.push(thickness(&mut scene));
        let mean = |scene: &Scene<AnyFlow>| {
            let nodes = scene.body(fibre).unwrap().nodes();
            nodes.iter().map(|place| place.x).sum::<f64>() / nodes.len() as f64
        };
        let period = TAU / frequency;
        scene.run(period).go().unwrap();
        let before = mean(&scene);
        scene.run(2.0 * period).go().unwrap();
        (before - mean(&scene)) / period
    };
    // The velocity on a line of points is of first order in the grid spacing.
    let speeds = [16, 32].map(&mut speed);
    let errors = speeds.map(|speed| 1.0 - speed / exact);
    // The warning tells each of these errors.
    for (told, error) in told.iter().zip(errors) {
        assert!(told.is_some_and(|told| (told / error - 1.0).abs() < 0.15), "{told:?} {error}");
    }
    let order = (errors[0] / errors[1]).log2();
    let limit = (2.0 * speeds[1] - speeds[0]) / exact;
    assert!(
        errors[1] < 0.17 && (order - 1.0).abs() < 0.15 && (limit - 1.0).abs() < 0.025,
        "{errors:?} {order} {limit}"
    );
}

/// Error that a scene warns of because a fibre is as thick as the grid's spacings; `None` without such a warning.
fn thickness(scene: &mut Scene<AnyFlow>) -> Option<f64> {
    let warnings = scene.system_mut().warnings();
    let found = warnings.iter().find(|warning| warning.cause == "grid too coarse for a fibre")?;
    // The text tells the same as the excess above one per cent.
    let text = format!("off by about {:.0} %; halve the spacing", found.excess);
    assert!(found.message.contains(&text), "{} {text}", found.message);
    Some(0.01 * found.excess)
}

/// A hair on the wall of a channel, on a grid of this spacing.
fn hair(spacing: f64) -> (Scene<AnyFlow>, Handle<Fibre>) {
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 2.0, drive: Drive::Gradient(-1.0) },
        viscosity: 1.0,
        method: Method::Grid(GridMethod::of_spacing(spacing)),
        droplets: Vec::new(),
        fibres: vec![FibreSetup {
            shape: FibreShape::Line { from: [0.0, -1.0], to: [0.0, -0.25] },
            ends: [FibreHold::Clamped, FibreHold::Free],
            ..FibreSetup::default()
        }],
        ..Setup::default()
    };
    let Built { scene, fibres, .. } = setup.build().expect("a scene");
    (scene, fibres[0])
}

/// The error of the force on the clamp of a hair, against the limit of fine grids, is the error that the warning tells.
/// A grid as fine as the warning asks for is silent.
#[test]
fn a_hair_on_a_coarse_grid_is_told_with_its_error() {
    let (forces, told): (Vec<f64>, Vec<f64>) = [0.125, 0.0625]
        .into_iter()
        .map(|spacing| {
            let (mut scene, fibre) = hair(spacing);
            let told = thickness(&mut scene).expect("a warning");
            scene.run(1.0).go().expect("a run");
            (scene.observe(fibre).expect("the hair").end_forces[0].x.abs(), told)
        })
        .unzip();
    // The error is of first order.
    let limit = 2.0 * forces[1] - forces[0];
    for (force, told) in forces.iter().zip(&told) {
        let error = force / limit - 1.0;
        assert!((told / error - 1.0).abs() < 0.25, "{told} {error}");
    }
    assert!(thickness(&mut hair(0.0125).0).is_some() && thickness(&mut hair(0.01).0).is_none());
}

/// A free fibre in a channel that the walls shear, on the grid and next to the grid of layers.
fn in_flow(method: Method) -> Vec<Vec2> {
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 2.0, drive: Drive::Gradient(-2.0) },
        viscosity: 1.0,
        method,
        droplets: vec![DropletSetup {
            centre: [-0.9, 0.0],
            shape: DropletShape::Round { radius: 0.5 },
            ..DropletSetup::passive(2.0)
        }],
        fibres: vec![FibreSetup {
            shape: FibreShape::Line { from: [0.2, -0.6], to: [0.2, 0.5] },
            spacing: Some(0.05),
            stretching: Some(50.0),
            bending: Some(0.02),
            ..FibreSetup::default()
        }],
        ..Setup::default()
    };
    let Built { mut scene, fibres, .. } = setup.build().expect("a scene");
    scene.run(0.3).go().expect("a run");
    let seen = scene.observe(fibres[0]).expect("the fibre");
    assert!((seen.stretches[0] - 1.0).abs() < 0.02 && (seen.length / 1.1 - 1.0).abs() < 0.005, "{seen:?}");
    fibre_nodes(&scene, fibres[0])
}

fn fibre_nodes(scene: &Scene<AnyFlow>, handle: Handle<Fibre>) -> Vec<Vec2> {
    scene.body(handle).expect("the fibre").nodes().to_vec()
}

#[test]
fn grid_and_layers_bend_a_fibre_next_to_a_drop_alike() {
    let grid = in_flow(Method::Grid(GridMethod::of_spacing(0.05)));
    let layers = LayersMethod { nodes: 32, elements: 64, ..LayersMethod::of_spacing(0.05) };
    let layers = in_flow(Method::Layers(layers));
    let start = Vec2::new(0.2, -0.6);
    let moved = grid.iter().map(|place| (place.x - start.x).abs()).fold(0.0, f64::max);
    let apart = grid.iter().zip(&layers).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(moved > 0.2 && apart < 0.01 * moved, "{apart} {moved}");
}

/// A swimmer bends a hair on the wall: the clamp takes up what the fluid and a load put on the hair.
#[test]
fn a_clamp_takes_up_the_load_of_a_swimmer_and_a_weight() {
    let weight = [0.0, -0.05];
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 2.4, drive: Drive::ZeroGradient },
        viscosity: 10.0,
        method: Method::Grid(GridMethod { marker_spacing: Some(0.06), ..GridMethod::of_spacing(0.1) }),
        droplets: vec![DropletSetup {
            centre: [-0.8, 0.5],
            shape: DropletShape::Round { radius: 0.5 },
            ..DropletSetup::active(-5.0)
        }],
        fibres: vec![FibreSetup {
            shape: FibreShape::Line { from: [0.0, -1.2], to: [0.0, -0.2] },
            spacing: Some(0.1),
            stretching: Some(500.0),
            bending: Some(2.0),
            ends: [FibreHold::Clamped, FibreHold::Free],
            loads: vec![LoadSetup { node: None, force: weight }],
            ..FibreSetup::default()
        }],
        ..Setup::default()
    };
    let Built { mut scene, fibres, .. } = setup.build().unwrap();
    scene.run(0.6).go().unwrap();
    let seen = scene.observe(fibres[0]).unwrap();
    let on_fluid: Vec2 = scene.system_mut().flow_at(fibres[0]).unwrap().forces.iter().sum();
    let [clamp, tip] = seen.end_forces;
    let load = Vec2::from(weight) - on_fluid;
    assert!((clamp - load).length() < 1e-12 && tip == Vec2::ZERO, "{clamp} {load}");
    let nodes = fibre_nodes(&scene, fibres[0]);
    assert!(nodes[0] == Vec2::new(0.0, -1.2) && nodes.last().unwrap().x.abs() > 0.01, "{nodes:?}");
}

/// A run that is resumed from a checkpoint takes the same steps to the last bit, with targets that move and a wave.
#[test]
fn a_resumed_fibre_goes_on_to_the_last_bit() {
    let build = || {
        let fibre = FibreSetup {
            shape: FibreShape::Line { from: [-0.5, 0.0], to: [0.5, 0.1] },
            ends: [FibreHold::Pinned, FibreHold::Free],
            wave: Some(CurvatureWaveSetup { amplitude: 2.0, wave_number: 5.0, frequency: 9.0, phase: 0.0 }),
            targets: vec![TargetSetup {
                nodes: Some([5, 6]),
                stiffness: 4.0,
                offset: [0.0; 2],
                velocity: [0.1, 0.0],
                wave: Some(TargetWaveSetup { displacement: [0.0, 0.1], wave_number: 0.0, frequency: 7.0, phase: 0.2 }),
            }],
            ..FibreSetup::default()
        };
        let region = Region::Box { lengths: [SIDE; 2] };
        let method = Method::Grid(GridMethod::of_spacing(0.125));
        Setup { region, viscosity: 1.0, method, droplets: Vec::new(), fibres: vec![fibre], ..Setup::default() }
            .build()
            .unwrap()
    };
    let Built { mut scene, fibres, .. } = build();
    scene.run(0.1).go().unwrap();
    let saved = scene.checkpoint("a fibre");
    scene.run(0.2).go().unwrap();
    let Built { scene: mut other, fibres: others, .. } = build();
    other.resume(&saved).unwrap();
    other.run(0.2).go().unwrap();
    assert_eq!(fibre_nodes(&scene, fibres[0]), fibre_nodes(&other, others[0]));
    assert_eq!(fibre_nodes(&scene, fibres[0])[0], Vec2::new(-0.5, 0.0));
}

/// Steps of the limit are stable for free and for held fibres, and the energy falls at the power that a fibre puts into
/// the fluid.
#[test]
fn energy_goes_into_the_fluid_in_steps_of_the_limit() {
    for (spacing, hold) in [(0.06, 0), (0.12, 0), (0.06, 1), (0.12, 1), (0.12, 2)] {
        let place = |k: usize| {
            let s = spacing * k as f64;
            Vec2::new(s - 0.5, 0.1 * (4.0 * s).sin())
        };
        let nodes: Vec<Vec2> = (0..(1.0 / spacing) as usize).map(place).collect();
        // The shortest wave of its nodes.
        let zigzag = |(k, node): (usize, &Vec2)| *node + Vec2::new(0.0, if k % 2 == 0 { 1e-3 } else { -1e-3 });
        let moved: Vec<Vec2> = nodes.iter().enumerate().map(zigzag).collect();
        let fibre = Fibre::new(&nodes, 30.0, 0.1).unwrap().with_reference_curvature(0.0).unwrap();
        let fibre = match hold {
            1 => fibre.with_ends([FibreEnd::Clamped, FibreEnd::Free]).unwrap(),
            2 => fibre.with_targets((0..4).map(|k| Target::fixed(k, nodes[0], 20.0))).unwrap(),
            _ => fibre,
        };
        let fibre = fibre.deformed(&moved).unwrap();
        let mut scene = empty(0.125);
        let fibre = scene.add(fibre);
        let energy = |scene: &Scene<AnyFlow>| scene.body(fibre).unwrap().energies().iter().sum::<f64>();
        let mut last = energy(&scene);
        let first = last;
        for _ in 0..200 {
            scene.run(100.0).step_size(StepSize::OfLimit(1.0)).most_steps(1).go().unwrap_err();
            let now = energy(&scene);
            assert!(now <= last, "{hold}: {now} {last}");
            last = now;
        }
        assert!(last < 0.75 * first, "{hold}: {last} {first}");
        let power = scene.observe(fibre).unwrap().power;
        let dt = 1e-6;
        scene.run(scene.time() + dt).step_size(StepSize::Fixed(dt)).go().unwrap();
        let lost = (last - energy(&scene)) / dt;
        assert!((lost / power - 1.0).abs() < 1e-3, "{hold}: {lost} {power}");
    }
}

#[test]
fn what_is_no_fibre_in_a_scene_is_refused() {
    let region = Region::Box { lengths: [SIDE; 2] };
    let method = Method::Grid(GridMethod::of_spacing(0.125));
    let says = |fibre: FibreSetup, words: &str| {
        let (region, method) = (region, method);
        let setup = Setup { region, method, droplets: Vec::new(), fibres: vec![fibre], ..Setup::default() };
        let text = setup.build().unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    };
    let of = |shape: FibreShape| FibreSetup { shape, ..FibreSetup::default() };
    says(of(FibreShape::Points(vec![[0.0, 0.0], [0.1, 0.0]])), "fibres[0].shape.points = 2 points");
    let twice = vec![[0.0, 0.0], [0.1, 0.0], [0.1, 0.0]];
    says(of(FibreShape::Points(twice)), "fibres[0].shape.points[1]");
    says(of(FibreShape::Line { from: [0.1, 0.0], to: [0.1, 0.0] }), "fibres[0].shape.line.to");
    says(of(FibreShape::Line { from: [-3.0, 0.0], to: [3.0, 0.0] }), "does not fit into the region");
    says(of(FibreShape::Files("no-folder/name".to_owned())), "no-folder/name.spring cannot be read");
    let arc = FibreShape::Arc { from: [0.0; 2], angle: 0.0, length: 1.0, curvature: 2.0 * PI };
    says(of(arc), "fibres[0].shape.arc.curvature");
    says(FibreSetup { stretching: Some(-1.0), ..FibreSetup::default() }, "fibres[0].stretching = -1");
    says(FibreSetup { bending: Some(f64::NAN), ..FibreSetup::default() }, "fibres[0].bending = NaN");
    let held = FibreSetup { ends: [FibreHold::Pinned; 2], ..of(FibreShape::Across { height: 0.0 }) };
    says(held, "no ends that can be held");
    let load = LoadSetup { node: Some(99), force: [0.0, 1.0] };
    says(FibreSetup { loads: vec![load], ..FibreSetup::default() }, "node 99");
    let refused = |region: Region, fibre: FibreSetup, words: &str| {
        let setup = Setup { region, droplets: Vec::new(), fibres: vec![fibre], ..Setup::default() };
        let text = setup.build().unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    };
    refused(region, FibreSetup::default(), "method = integral: it supports elastic fibres");
    let held = FibreSetup { ends: [FibreHold::Clamped, FibreHold::Free], ..FibreSetup::default() };
    refused(Region::Plane, held, "Stokes' paradox");
    let pushed = FibreSetup { loads: vec![LoadSetup { node: None, force: [0.0, 1.0] }], ..FibreSetup::default() };
    refused(Region::Plane, pushed, "fibres[0].loads = 1");
}

/// In the plane, a closed fibre of regularised Stokeslets moves as a shell with the same moduli by boundary integrals.
#[test]
fn a_closed_fibre_in_the_plane_moves_as_a_shell() {
    let at = |k: usize, count: usize| {
        let angle = TAU * k as f64 / count as f64;
        let radius = 1.0 + 0.1 * (2.0 * angle).cos();
        [radius * angle.cos(), radius * angle.sin()]
    };
    let setup = |count: usize, fibre: bool| {
        let points: Vec<[f64; 2]> = (0..count).map(|k| at(k, count)).collect();
        let flow = FlowSetup { extension: 0.5, ..FlowSetup::default() };
        let empty = Setup { region: Region::Plane, viscosity: 1.0, flow, droplets: Vec::new(), ..Setup::default() };
        if fibre {
            let fibre = FibreSetup {
                shape: FibreShape::ClosedPoints(points),
                stretching: Some(3.0),
                bending: Some(0.5),
                rest_length: Some(TAU),
                reference_curvature: Some(1.0),
                ..FibreSetup::default()
            };
            Setup { fibres: vec![fibre], ..empty }
        } else {
            let shell = ShellSetup {
                shape: DropletShape::Points(points),
                rest: Some(DropletShape::Round { radius: 1.0 }),
                stretching: 3.0,
                bending: 0.5,
                measure: BendingMeasure::TurningAngle,
                ..ShellSetup::default()
            };
            Setup { shells: vec![shell], ..empty }
        }
    };
    // The second mode of the velocity along the radius, by the angle.
    let mode = |places: &[Vec2], velocities: &[Vec2]| {
        let count = places.len();
        let at = |k: usize| {
            let wide = places[(k + count - 1) % count].angle_to(places[(k + 1) % count]);
            let away = places[k].normalize();
            0.5 * wide * velocities[k].dot(away) * (away.x * away.x - away.y * away.y)
        };
        (0..count).map(at).sum::<f64>() / PI
    };
    let Built { mut scene, shells, .. } = setup(128, false).build().unwrap();
    scene.system_mut().evaluate().unwrap();
    let flow = scene.system().flow_at(shells[0]).unwrap();
    let exact = mode(flow.positions, flow.velocities);
    let errors = [64, 128, 256].map(|count| {
        let Built { mut scene, fibres, .. } = setup(count, true).build().unwrap();
        scene.system_mut().evaluate().unwrap();
        let flow = scene.system().flow_at(fibres[0]).unwrap();
        mode(flow.positions, flow.velocities) / exact - 1.0
    });
    let order = (errors[1] / errors[2]).log2();
    assert!(errors[2].abs() < 1e-3 && order > 1.5, "{exact} {errors:?} {order}");
}

/// A scene is known by the contents of the files of its fibres, wherever they lie.
#[test]
fn fingerprints_follow_the_contents_of_files() {
    let folders =
        ["one", "two"].map(|name| std::env::temp_dir().join(format!("motile-fibres-{}-{name}", std::process::id())));
    let write = |folder: &std::path::Path, stiffness: f64| {
        std::fs::create_dir_all(folder).unwrap();
        std::fs::write(folder.join("beam.vertex"), "3\n0.5 0\n0.5 0.1\n0.5 0.2\n").unwrap();
        std::fs::write(folder.join("beam.spring"), format!("2\n0 1 {stiffness} 0.1\n1 2 500 0.1\n")).unwrap();
    };
    let setup = |folder: &std::path::Path| Setup {
        region: Region::Box { lengths: [4.0, 2.0] },
        method: Method::Grid(GridMethod::of_spacing(0.125)),
        droplets: Vec::new(),
        fibres: vec![FibreSetup {
            shape: FibreShape::Files(folder.join("beam").to_string_lossy().into_owned()),
            ..FibreSetup::default()
        }],
        ..Setup::default()
    };
    write(&folders[0], 500.0);
    write(&folders[1], 500.0);
    let [one, two] = [&folders[0], &folders[1]].map(|folder| setup(folder).fingerprint());
    assert_eq!(one, two);
    let embedded = setup(&folders[0]).with_files(std::path::Path::new("")).unwrap();
    assert_eq!(embedded.fingerprint(), one);
    write(&folders[1], 400.0);
    assert_ne!(setup(&folders[1]).fingerprint(), one);
    folders.iter().for_each(|folder| std::fs::remove_dir_all(folder).unwrap());
    // What is embedded no longer needs the files.
    let fibre = embedded.build().expect("a scene");
    assert_eq!(fibre.fibres.len(), 1);
    #[cfg(feature = "toml")]
    assert_eq!(Setup::from_toml(&embedded.to_toml().expect("text")).expect("a scene"), embedded);
}
