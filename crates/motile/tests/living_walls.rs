//! Walls that relax, twitch or differ from place to place.

use motile::active_interface::ActiveDroplet;
use motile::elastic_solids::{ChannelShape, Solid};
use motile::motile_base::{Drive, Region};
use motile::motile_scene::Scene;
use motile::motile_scene::checkpoint::Checkpoint;
use motile::motile_scene::integrator::IntegratorKind;
use motile::setup::{
    ActiveSpringsSetup, AnyFlow, Axis, Built, DropletSetup, DropletShape, Grading, GridMethod, Material, MaxwellSetup,
    Method, Setup, SolidSetup,
};

/// A channel of width 2.6 with walls of that material and a droplet, on a coarse grid.
fn channel(material: &Material) -> Setup {
    Setup {
        region: Region::Channel { length: 6.0, width: 4.0, drive: Drive::ZeroGradient },
        method: Method::Grid(GridMethod::uncorrected(0.1)),
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.6 }, material),
        ..Setup::default()
    }
}

/// Energies of interfaces and solids, Maxwell elements included.
fn energy(scene: &Scene<AnyFlow>) -> f64 {
    let droplets = scene.system().bodies::<ActiveDroplet>();
    let interfaces: f64 = droplets.map(|(_, droplet)| 10.0 * droplet.segment_lengths().iter().sum::<f64>()).sum();
    let solids = scene.system().bodies::<Solid>();
    interfaces
        + solids
            .map(|(_, solid)| {
                solid.elastic_energy().expect("upright triangles") + solid.relaxing_energy().expect("the same")
            })
            .sum::<f64>()
}

/// Ten random scenes without activity: drops stretched along or across, between walls of any material, relaxation time
/// and viscosity. No step adds more than 1e-6 of what the drop has in excess of a circle.
#[test]
fn the_energy_of_passive_scenes_never_rises() {
    let mut state = 20_u64;
    let mut random = |low: f64, high: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (state >> 33) as f64 / f64::from(1_u32 << 31)
    };
    for number in 0..10 {
        let shear = random(1.0, 3.0).exp2() * 30.0;
        let material = match number % 3 {
            0 => Material::Springs { shear },
            1 => Material::NeoHookean { shear, bulk: 2.0 * shear },
            _ => Material::FluidLike,
        };
        let mut setup = channel(&material);
        let stretch = random(0.85, 1.2);
        setup.droplets = vec![DropletSetup {
            particles: None,
            shape: DropletShape::Ellipse { half_axes: [stretch, 1.0 / stretch] },
            ..DropletSetup::default()
        }];
        for wall in &mut setup.solids {
            wall.relaxation = vec![MaxwellSetup { modulus: random(20.0, 200.0), time: 10_f64.powf(random(-3.0, 1.0)) }];
            wall.viscosity = (number % 4 == 1).then(|| random(100.0, 400.0));
        }
        let Built { mut scene, .. } = setup.build().unwrap();
        let mut before = energy(&scene);
        let excess = before - 10.0 * std::f64::consts::TAU;
        let start = before;
        for step in 0..30 {
            let dt = 0.4 * scene.step_limit().unwrap().0.min(0.05);
            scene.step(dt).unwrap();
            let after = energy(&scene);
            assert!(after < before + 1e-6 * excess, "{number}, step {step}: {before} {after} {excess}");
            before = after;
        }
        assert!(before < start - 1e-3 * excess, "{number}: {before} {start} {excess}");
    }
}

/// Adaptive steps at any relaxation time: too short ones leave the walls elastic, and too long ones stiffer.
#[test]
fn adaptive_steps_take_any_relaxation_time() {
    let far = |shear: f64, time: Option<f64>| {
        let mut setup = channel(&Material::NeoHookean { shear, bulk: 2.0 * shear });
        for wall in &mut setup.solids {
            wall.relaxation = time.map(|time| MaxwellSetup { modulus: 60.0, time }).into_iter().collect();
        }
        let Built { mut scene, solids, .. } = setup.build().unwrap();
        scene.run(0.2).go().unwrap();
        (scene.observe(solids[0]).unwrap().largest_displacement, scene.steps())
    };
    let (elastic, steps) = far(60.0, None);
    for time in [1e-6, 1e-14, 1e-300] {
        let (found, taken) = far(60.0, Some(time));
        assert!((found / elastic - 1.0).abs() < 1e-3 && taken <= 3 * steps, "{time:e}: {found} {elastic} {taken}");
    }
    let (found, _) = far(60.0, Some(1e300));
    // Ten times as far from it as the bound on the others.
    assert!(found < 0.99 * elastic, "{found} {elastic}");
}

/// The image in y = 0: unequal walls exchanged, a gradient across turned over.
#[test]
fn mirrored_walls_give_mirrored_runs() {
    for material in [Material::Springs { shear: 60.0 }, Material::NeoHookean { shear: 60.0, bulk: 120.0 }] {
        let run = |sign: f64| {
            let mut setup = channel(&material);
            let factors = vec![[-2.0, 2.0 - sign], [2.0, 2.0 + sign]];
            for wall in &mut setup.solids {
                let across = Grading::Along { axis: Axis::Y, factors: factors.clone() };
                let along = Grading::Stripes { axis: Axis::X, width: 1.5, from: 0.0, factors: vec![1.0, 2.0] };
                wall.grading = across.times(along);
                wall.relaxation = vec![MaxwellSetup { modulus: 50.0, time: 0.3 }];
            }
            setup.droplets = vec![DropletSetup { centre: [0.0, 0.1 * sign], ..DropletSetup::active(-4.0) }];
            let Built { mut scene, droplets, solids, .. } = setup.build().unwrap();
            (0..25).for_each(|_| scene.step(5e-3).unwrap());
            let centroid = scene.observe(droplets[0]).unwrap().centroid;
            let mut energies = [0, 1].map(|k| scene.body(solids[k]).unwrap().elastic_energy().unwrap());
            if sign < 0.0 {
                energies.reverse();
            }
            (centroid, energies)
        };
        let ((up, [a, b]), (down, [c, d])) = (run(1.0), run(-1.0));
        assert!((up.x - down.x).abs() < 1e-11 && (up.y + down.y).abs() < 1e-11, "{up} {down}");
        assert!((a / c - 1.0).abs() < 1e-8 && (b / d - 1.0).abs() < 1e-8, "{a} {c} {b} {d}");
        // There is something to mirror.
        assert!((up.y - 0.1).abs() > 1e-6 && (a / b - 1.0).abs() > 0.1, "{up} {a} {b}");
    }
}

/// Seeds decide, and nothing else.
#[test]
fn twitching_walls_repeat_themselves() {
    let run = |seed: u64| {
        let mut setup = channel(&Material::Springs { shear: 60.0 });
        let active =
            ActiveSpringsSetup { tension: 2.0, on: 5.0, off: 10.0, seed, on_sensitivity: 0.0, off_sensitivity: 2.0 };
        setup.solids.iter_mut().for_each(|wall| wall.active_springs = Some(active));
        let Built { mut scene, solids, .. } = setup.build().unwrap();
        scene.run(0.1).go().unwrap();
        let wall = scene.body(solids[0]).unwrap();
        (
            wall.active_bonds().unwrap().to_vec(),
            wall.positions().to_vec(),
            scene.observe(solids[0]).unwrap().active_part,
        )
    };
    let (first, again, other) = (run(1), run(1), run(2));
    assert!(first == again && first.0 != other.0);
    assert!((first.2 - 1.0 / 3.0).abs() < 0.05, "{}", first.2);
}

/// A run that is resumed from a checkpoint has the bits of one that is not, with Maxwell elements, active springs and a
/// viscosity of the walls.
#[test]
fn resumed_runs_have_the_same_bits() {
    for integrator in [IntegratorKind::Midpoint, IntegratorKind::RungeKuttaChebyshev] {
        for material in [Material::Springs { shear: 60.0 }, Material::NeoHookean { shear: 60.0, bulk: 120.0 }] {
            let mut setup = Setup { integrator, ..channel(&material) };
            for (number, wall) in setup.solids.iter_mut().enumerate() {
                wall.relaxation =
                    vec![MaxwellSetup { modulus: 60.0, time: 0.02 }, MaxwellSetup { modulus: 30.0, time: 5.0 }];
                wall.viscosity = (number == 0).then_some(150.0);
                let (on_sensitivity, off_sensitivity) = (-1.0, 2.0);
                let (tension, on, off, seed) = (2.0, 20.0, 40.0, 7);
                wall.active_springs =
                    Some(ActiveSpringsSetup { tension, on, off, seed, on_sensitivity, off_sensitivity });
            }
            let make = || setup.build().unwrap().scene;
            let mut whole = make();
            (0..8).for_each(|_| whole.step(4e-3).unwrap());
            let mut part = make();
            (0..3).for_each(|_| part.step(4e-3).unwrap());
            let saved = part.checkpoint("").to_bytes().unwrap();
            let mut part = make();
            part.resume(&Checkpoint::from_bytes(&saved).unwrap()).unwrap();
            (0..5).for_each(|_| part.step(4e-3).unwrap());
            assert!(
                part.checkpoint("").to_bytes().unwrap() == whole.checkpoint("").to_bytes().unwrap(),
                "{integrator:?}"
            );
        }
    }
}

/// A change to a scene, and parts of the message that refuses it.
type Case<'a> = (&'a dyn Fn(&mut Setup), &'a [&'a str]);

/// Keys and remedies are named.
#[test]
fn descriptions_that_make_no_sense_are_refused() {
    let refused = |change: &dyn Fn(&mut Setup)| {
        let mut setup = channel(&Material::Springs { shear: 60.0 });
        change(&mut setup);
        setup.check().unwrap_err().to_string()
    };
    let relaxing = |modulus: f64, time: f64| vec![MaxwellSetup { modulus, time }];
    let active =
        ActiveSpringsSetup { tension: 2.0, on: 5.0, off: 10.0, seed: 1, on_sensitivity: 0.0, off_sensitivity: 2.0 };
    let cases: [Case<'_>; 9] = [
        (&|s| s.solids[0].relaxation = relaxing(-1.0, 1.0), &["solids[0].relaxation[0].modulus = -1"]),
        (&|s| s.solids[1].relaxation = relaxing(1.0, 0.0), &["solids[1].relaxation[0].time = 0"]),
        (&|s| s.solids[0].material = Material::FluidLike, &["solids[0].material = fluid-like", "relaxation = ["]),
        (&|s| s.solids[0].viscosity = Some(50.0), &["solids[0].viscosity = 50", "has 100"]),
        (&|s| s.solids[0].active_springs = Some(ActiveSpringsSetup { on: 0.0, ..active }), &["active-springs.on = 0"]),
        (
            &|s| {
                s.integrator = IntegratorKind::RungeKutta;
                s.droplets.clear();
                s.solids[0].relaxation = relaxing(1.0, 1.0);
            },
            &["solids[0].relaxation", "another integrator"],
        ),
        (
            &|s| {
                let factors = vec![1.0, 2.0];
                s.solids[0].grading = Grading::Stripes { axis: Axis::X, width: 1.3, from: 0.0, factors };
            },
            &["grading.stripes.width = 1.3", "give 1.5"],
        ),
        (
            &|s| s.solids[0].grading = Grading::Step { axis: Axis::Y, at: 0.0, factors: [1.0, -1.0] },
            &["grading.step.factors = -1"],
        ),
        (
            &|s| {
                s.solids[0].grading =
                    Grading::Product(vec![Grading::Uniform, Grading::Along { axis: Axis::X, factors: Vec::new() }]);
            },
            &["grading.product[1].along.factors"],
        ),
    ];
    for (change, parts) in cases {
        let said = refused(change);
        assert!(parts.iter().all(|part| said.contains(part)), "{said}");
    }
}
