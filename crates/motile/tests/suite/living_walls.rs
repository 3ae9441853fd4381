//! Walls that relax, twitch or differ from place to place.

use motile::active_interface::ActiveDroplet;
use motile::base::{Drive, Region};
use motile::elastic_solids::{ChannelShape, Solid};
use motile::scene::checkpoint::Checkpoint;
use motile::scene::integrator::IntegratorKind;
use motile::scene::{Body as _, Scene};
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
    let interfaces: f64 = droplets.map(|(_, droplet)| 10.0 * droplet.element_lengths().iter().sum::<f64>()).sum();
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
    for time in [1e-6, 1e-14, 1e-50] {
        let (found, taken) = far(60.0, Some(time));
        assert!((found / elastic - 1.0).abs() < 1e-6 && taken <= 3 * steps, "{time:e}: {found} {elastic} {taken}");
    }
    let (found, _) = far(60.0, Some(1e50));
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

/// The image in x = 0: gradients along turned over, a droplet that swims the other way, on lattices, which are their
/// own images.
#[test]
fn gradients_along_that_are_mirrored_give_mirrored_runs() {
    for material in [Material::Springs { shear: 60.0 }, Material::NeoHookean { shear: 60.0, bulk: 120.0 }] {
        let run = |sign: f64| {
            let mut setup = channel(&material);
            for wall in &mut setup.solids {
                // Continuous over the seam.
                let factors = vec![[-3.0, 2.0], [-1.5, 2.0 - sign], [1.5, 2.0 + sign], [3.0, 2.0]];
                let along = Grading::Along { axis: Axis::X, factors };
                let across = Grading::Step { axis: Axis::Y, at: 0.0, factors: [1.0, 3.0] };
                wall.grading = along.times(across);
                wall.relaxation = vec![MaxwellSetup { modulus: 50.0, time: 0.3 }];
            }
            let angle = if sign > 0.0 { 0.0 } else { std::f64::consts::PI };
            setup.droplets = vec![DropletSetup { centre: [0.1 * sign, 0.0], angle, ..DropletSetup::active(-4.0) }];
            let Built { mut scene, droplets, solids, .. } = setup.build().unwrap();
            (0..25).for_each(|_| scene.step(5e-3).unwrap());
            let centroid = scene.observe(droplets[0]).unwrap().centroid;
            let energies = [0, 1].map(|k| scene.body(solids[k]).unwrap().elastic_energy().unwrap());
            (centroid, energies)
        };
        let ((right, [a, b]), (left, [c, d])) = (run(1.0), run(-1.0));
        assert!((right.x + left.x).abs() < 1e-11 && (right.y - left.y).abs() < 1e-11, "{right} {left}");
        assert!((a / c - 1.0).abs() < 1e-8 && (b / d - 1.0).abs() < 1e-8, "{a} {c} {b} {d}");
        assert!((right.x - 0.1).abs() > 1e-3 && (a / b - 1.0).abs() > 0.1, "{right} {a} {b}");
    }
}

/// Walls without an equilibrium creep beside a droplet that swims until a triangle is as good as inverted; not those
/// that keep a part of their modulus.
#[test]
fn walls_that_flow_end_in_the_error_that_says_when() {
    let run = |material: &Material| {
        let mut setup = channel(material);
        setup.method = Method::Grid(GridMethod::uncorrected(0.2));
        setup.droplets = vec![DropletSetup::active(-8.0)];
        setup.solids = SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, material);
        for wall in &mut setup.solids {
            wall.relaxation = vec![MaxwellSetup { modulus: 20.0, time: 0.2 }];
        }
        let Built { mut scene, .. } = setup.build().unwrap();
        scene.run(2.0).go().map(|_| ()).map_err(|error| (scene.time(), error.to_string()))
    };
    let (time, said) = run(&Material::FluidLike).unwrap_err();
    assert!(
        said.contains("at time 1.")
            && said.contains("wall went wrong: triangle")
            && said.contains("is nearly inverted"),
        "{said}"
    );
    assert!(time > 1.0, "{time}: {said}");
    run(&Material::NeoHookean { shear: 200.0, bulk: 400.0 }).unwrap();
}

/// Factors on relaxation times and on the tension of bonds are those of the place.
#[test]
fn relaxation_times_and_tensions_are_graded() {
    let mut setup = channel(&Material::Springs { shear: 60.0 });
    let step = Grading::Step { axis: Axis::X, at: 0.0, factors: [1.0, 5.0] };
    for wall in &mut setup.solids {
        wall.relaxation = vec![MaxwellSetup { modulus: 50.0, time: 0.3 }];
        let (on_sensitivity, off_sensitivity) = (0.0, 0.0);
        // Never off.
        wall.active_springs =
            Some(ActiveSpringsSetup { tension: 2.0, on: 1.0, off: 0.0, seed: 1, on_sensitivity, off_sensitivity });
    }
    let viscosity = |setup: &Setup| {
        let Built { scene, solids, .. } = setup.build().unwrap();
        let properties = scene.body(solids[0]).unwrap().properties();
        properties.into_iter().find(|(name, _)| name == "that of their viscosities").unwrap().1
    };
    let even = viscosity(&setup);
    for wall in &mut setup.solids {
        (wall.relaxation_time_grading, wall.tension_grading) = (step.clone(), step.clone());
    }
    assert!((viscosity(&setup) / even - 3.0).abs() < 1e-12);
    let Built { scene, solids, .. } = setup.build().unwrap();
    let wall = scene.body(solids[0]).unwrap();
    let stresses = wall.internal_stresses().unwrap().unwrap();
    let spacing = wall.mesh().quality().mean_edge;
    for (triangle, stress) in stresses.iter().enumerate() {
        let corners = wall.mesh().triangles()[triangle].map(|point| wall.mesh().points()[point]);
        if (corners[0].x - corners[1].x).abs().max((corners[0].x - corners[2].x).abs()) > 1.0 {
            continue;
        }
        let place = (corners[0] + corners[1] + corners[2]) / 3.0;
        // Away from the surface, the step and the seam.
        let away = place.x.abs().min(3.0 - place.x.abs());
        if away > 0.2 && (place.y + 1.65).abs() < 0.1 {
            let factor = if place.x < 0.0 { 1.0 } else { 5.0 };
            let expected = 3.0_f64.sqrt() * 2.0 * factor / spacing;
            assert!((stress.x_axis.x / expected - 1.0).abs() < 0.03, "{place}: {} {expected}", stress.x_axis.x);
        }
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
    let cases: [Case<'_>; 12] = [
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
            &["grading.stripes.width = 1.3", "Use 1.5"],
        ),
        (
            &|s| {
                s.mirror_symmetric = true;
                s.solids[0].relaxation = relaxing(1.0, 1.0);
            },
            &["solids[0].relaxation", "no mirror image"],
        ),
        (
            &|s| {
                s.solids[0].active_springs = Some(active);
                s.solids[0].tension_grading = Grading::Step { axis: Axis::X, at: 0.0, factors: [1.0, -1.0] };
            },
            &["solids[0].tension-grading.step.factors = -1"],
        ),
        (
            &|s| s.solids[0].relaxation_time_grading = Grading::uniform(2.0),
            &["relaxation-time-grading", "Add relaxation"],
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
