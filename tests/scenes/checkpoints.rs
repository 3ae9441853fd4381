//! Scenes on disk: resumed runs are bitwise those that were never stopped, and files that are not whole are
//! refused.

use std::path::PathBuf;

use motile::base::Drive;
use motile::base::{ImposedFlow, Region, TubeShape};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::ib_core::AnyKernel;
use motile::interior::{Anchoring, DirectorStart};
use motile::scene::{
    Body, Hydrodynamics, Imposed, Scene, SceneError, StepSize,
    checkpoint::{Checkpoint, CheckpointError},
    integrator::{Dynamics as _, RungeKuttaChebyshev},
};
use motile::setup::{
    ActiveSpringsSetup, AnyFlow, Built, DropletSetup, ExchangeSetup, ExcludedVolume, GelSetup, GridMethod, Hold,
    IntegralMethod, LayersMethod, Material, MaxwellSetup, Method, Particles, Setup, SolidSetup, SurfaceElasticitySetup,
    WallSetup,
};
use proptest::prelude::*;

/// Everything there is to know of a state, bit by bit.
fn bits<H: Hydrodynamics>(scene: &Scene<H>) -> Vec<u8> {
    scene.checkpoint("").to_bytes().expect("bytes")
}

/// A run to `until` that is interrupted after each of the given numbers of steps, saved and resumed in a scene made
/// anew, against one that is not; on the thread of the test, and with the feature `rayon` also in pools of one and two
/// threads.
fn compare<H: Hydrodynamics>(make: impl Fn() -> Scene<H> + Sync, until: f64, step: StepSize, stops: &[usize]) {
    let alone = whole_and_in_parts(&make, until, step, stops);
    #[cfg(feature = "rayon")]
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let pooled = pool.install(|| whole_and_in_parts(&make, until, step, stops));
        assert!(pooled == alone, "a pool of {threads} threads comes to something else");
    }
    assert!(!alone.is_empty());
}

/// The last state.
fn whole_and_in_parts<H: Hydrodynamics>(
    make: &(impl Fn() -> Scene<H> + Sync),
    until: f64,
    step: StepSize,
    stops: &[usize],
) -> Vec<u8> {
    let mut whole = make();
    whole.run(until).step_size(step).go().expect("a whole run");
    let mut parts = make();
    for &stop in stops {
        let outcome = parts.run(until).step_size(step).most_steps(stop).go();
        assert!(matches!(outcome, Err(SceneError::TooManySteps { .. })), "{outcome:?}");
        // Looking at the state changes nothing.
        parts.system_mut().evaluate().expect("a flow");
        let saved = parts.checkpoint("part of a run");
        parts = make();
        parts
            .resume(&Checkpoint::from_bytes(&saved.to_bytes().expect("bytes")).expect("a checkpoint"))
            .expect("the same scene");
        assert_eq!(parts.checkpoint("part of a run"), saved);
    }
    parts.run(until).step_size(step).go().expect("the rest of the run");
    assert!(parts.steps() > stops.iter().sum());
    assert_eq!(parts.time().to_bits(), whole.time().to_bits());
    let bits = bits(&whole);
    assert!(self::bits(&parts) == bits, "a resumed run differs after {} steps", whole.steps());
    bits
}

/// Numbers of steps that look random, from a seed.
fn stops(seed: u64, most: u64) -> [usize; 2] {
    let mut state = seed;
    [(); 2].map(|()| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (1 + (state >> 33) % most) as usize
    })
}

fn coarse() -> Setup {
    let method = Method::Grid(GridMethod::of_spacing(0.2));
    Setup { method, droplets: vec![DropletSetup::active(-3.0)], ..Setup::default() }
}

fn thesis(activity: f64) -> Setup {
    let method = Method::Grid(GridMethod { spacing: 0.2, ..GridMethod::thesis() });
    let mut droplet = DropletSetup::thesis();
    droplet.particles.iter_mut().for_each(|particles| particles.activity = activity);
    Setup { method, droplets: vec![droplet], ..Setup::thesis() }
}

/// The coarse scene by layers.
fn layers() -> Setup {
    Setup { method: Method::Layers(LayersMethod::of_spacing(0.2)), ..coarse() }
}

fn channel(width: f64, drive: Drive) -> Region {
    Region::Channel { length: 6.0, width, drive }
}

/// Setup with droplets of this viscosity, on a grid a smeared one.
fn filled(viscosity: f64, setup: &Setup) -> Setup {
    let method = match setup.method {
        Method::Grid(grid) => Method::Grid(GridMethod { corrected: false, ..grid }),
        method => method,
    };
    let droplets = setup.droplets.iter().cloned();
    let droplets = droplets.map(|droplet| DropletSetup { viscosity: Some(viscosity), ..droplet }).collect();
    Setup { droplets, method, ..setup.clone() }
}

fn scene(setup: &Setup) -> Scene<AnyFlow> {
    setup.build().expect("a scene").scene
}

const AUTO: StepSize = StepSize::OfLimit(0.5);
const ADAPTIVE: StepSize = StepSize::Adaptive { tolerance: 1e-5 };

#[test]
fn a_swimmer() {
    compare(|| scene(&coarse()), 6.0, AUTO, &stops(1, 15));
    compare(|| scene(&coarse()), 6.0, ADAPTIVE, &stops(2, 15));
    compare(|| scene(&coarse()), 1.0, StepSize::Fixed(0.01), &stops(3, 40));
}

#[test]
fn a_swimmer_by_the_chebyshev_method() {
    let make = || scene(&coarse()).advanced_by(RungeKuttaChebyshev::new());
    compare(make, 20.0, ADAPTIVE, &stops(4, 25));
    compare(make, 2.0, StepSize::Fixed(0.025), &stops(5, 30));
}

#[test]
fn a_swimmer_by_the_method_of_the_thesis() {
    // Markers are inserted and removed.
    let setup = thesis(-4.0);
    compare(|| scene(&setup), 2.0, StepSize::Fixed(0.01), &stops(6, 80));
    let contrast = filled(1000.0, &setup);
    compare(|| scene(&contrast), 0.4, StepSize::Fixed(0.02), &stops(7, 8));
    // Walls that lag remember the solution before.
    let between_walls = Setup { region: channel(2.8, Drive::ZeroGradient), ..setup };
    compare(|| scene(&between_walls), 1.0, StepSize::Fixed(0.01), &stops(17, 80));
    compare(|| scene(&between_walls), 1.0, ADAPTIVE, &stops(18, 5));
}

#[test]
fn a_channel() {
    let setup = Setup { region: channel(3.0, Drive::ZeroGradient), ..coarse() };
    compare(|| scene(&setup), 6.0, AUTO, &stops(8, 20));
}

#[test]
fn a_viscosity_ratio_of_a_hundred() {
    let setup = filled(1000.0, &Setup { viscosity: 10.0, ..layers() });
    compare(|| scene(&setup), 12.0, AUTO, &stops(9, 10));
    let channel = Setup { region: channel(3.0, Drive::ZeroFlux), ..setup };
    compare(|| scene(&channel), 8.0, AUTO, &stops(10, 8));
}

#[test]
fn without_a_grid() {
    let setup = Setup { method: Method::Integral(IntegralMethod { nodes: 48, elements: 96 }), ..coarse() };
    compare(|| scene(&setup), 6.0, AUTO, &stops(11, 5));
    let contrast = filled(1000.0, &setup);
    compare(|| scene(&contrast), 3.0, AUTO, &stops(12, 4));
}

#[test]
fn a_gel() {
    let mut setup = coarse();
    let start = DirectorStart::Random { seed: 2 };
    setup.droplets[0].gel = Some(GelSetup { anchoring: Anchoring::Planar, start, ..GelSetup::default() });
    let among_layers = Method::Layers(LayersMethod { nodes: 32, elements: 96, ..LayersMethod::of_spacing(0.2) });
    for (method, viscosity) in [(coarse().method, None), (among_layers, Some(20.0))] {
        (setup.method, setup.droplets[0].viscosity) = (method, viscosity);
        compare(|| scene(&setup), 4.0, AUTO, &[1, 7, 13]);
        compare(|| scene(&setup), 4.0, StepSize::Adaptive { tolerance: 1e-3 }, &[2, 5]);
    }
}

/// Between walls, the flow of another viscosity starts from the solution before, which a checkpoint has to hold.
#[test]
fn droplets_without_symmetry_between_walls() {
    for (region, step, stops) in [
        ("region.slit = { lower = -2.0, upper = 2.0 }", StepSize::Fixed(0.02), &[5, 8][..]),
        ("region.tube = { radius = 2.5 }", ADAPTIVE, &[2]),
    ] {
        let text = format!(
            "{region}\nviscosity = 10.0\nmethod.harmonics.degree = 4\nintegrator = \"runge-kutta-chebyshev\"\n\
             [[droplets]]\nviscosity = 50.0\nposition = [0.0, 0.4, 0.1]\nheading = [1.0, 0.5, 0.2]\n\
             particles = {{ activity = -1.0, excluded-volume.step = 2.0 }}\n"
        );
        let setup = Setup::from_toml(&text).expect("a scene");
        compare(|| scene(&setup), 0.4, step, stops);
    }
}

#[test]
fn particles_inside() {
    let mut setup = coarse();
    let exchange = ExchangeSetup { diffusion_inside: Some(0.2), ..ExchangeSetup::new(0.3, 0.4) };
    if let Some(particles) = &mut setup.droplets[0].particles {
        particles.exchange = Some(exchange);
    }
    compare(|| scene(&setup), 2.0, StepSize::OfLimit(0.5), &[1, 3, 5]);
    compare(|| scene(&setup), 4.0, StepSize::Adaptive { tolerance: 1e-3 }, &[1, 2]);
}

#[test]
fn an_elastic_channel() {
    let shear = Moduli::from_thesis_spring_constant(1e4).expect("moduli").shear();
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 5.4, drive: Drive::ZeroGradient },
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear })
            .into_iter()
            .map(|wall| SolidSetup { finer_surface: Some(true), ..wall })
            .collect(),
        ..layers()
    };
    let make = || scene(&setup);
    compare(make, 3.0, AUTO, &stops(13, 10));
    compare(|| make().advanced_by(RungeKuttaChebyshev::new()), 3.0, ADAPTIVE, &stops(14, 15));
}

/// Walls that relax, resist and twitch, of springs with uneven triangles and of a neo-Hookean material.
#[test]
fn a_channel_of_living_walls() {
    for material in [Material::Springs { shear: 90.0 }, Material::NeoHookean { shear: 90.0, bulk: 180.0 }] {
        let mut solids = SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &material);
        for wall in &mut solids {
            wall.finer_surface = Some(true);
            wall.relaxation =
                vec![MaxwellSetup { modulus: 60.0, time: 0.2 }, MaxwellSetup { modulus: 30.0, time: 5.0 }];
            let (on_sensitivity, off_sensitivity) = (-1.0, 2.0);
            let (tension, on, off, seed) = (2.0, 1.0, 2.0, 7);
            wall.active_springs = Some(ActiveSpringsSetup { tension, on, off, seed, on_sensitivity, off_sensitivity });
        }
        // One wall resists, which several evaluations of the flow are solved for.
        solids[0].viscosity = Some(150.0);
        let region = Region::Channel { length: 4.0, width: 5.4, drive: Drive::ZeroGradient };
        let setup = Setup { region, solids, ..layers() };
        let make = || scene(&setup);
        compare(make, 0.5, AUTO, &stops(16, 5));
        compare(|| make().advanced_by(RungeKuttaChebyshev::new()), 0.5, ADAPTIVE, &stops(17, 3));
    }
}

/// As large as it has to be for more than one thread to take part.
#[test]
fn a_large_box() {
    let method = Method::Grid(GridMethod::of_spacing(0.05));
    let setup = Setup { region: Region::Box { lengths: [46.0, 46.0] }, method, ..coarse() };
    compare(|| scene(&setup), 0.2, StepSize::Fixed(0.02), &stops(15, 4));
}

/// A run that goes on in its own scene takes the steps that it would have taken: the first of them looks at the step
/// before as any other.
#[test]
fn a_run_in_parts_is_one_run() {
    let fast = || scene(&Setup { droplets: vec![DropletSetup::active(-8.0)], ..coarse() });
    for (step, until) in [(AUTO, 0.4), (ADAPTIVE, 0.4)] {
        let (mut whole, mut parts) = (fast(), fast());
        whole.run(until).step_size(step).go().unwrap();
        for most in [1, 2, 4] {
            let outcome = parts.run(until).step_size(step).most_steps(most).go();
            assert!(matches!(outcome, Err(SceneError::TooManySteps { .. })), "{outcome:?}");
        }
        parts.run(until).step_size(step).go().unwrap();
        assert!(bits(&parts) == bits(&whole), "{step:?}: {} and {} steps", parts.steps(), whole.steps());
    }
}

/// Threads that run scenes of their own do not disturb each other, and there are no others.
#[test]
fn two_at_a_time_are_as_one() {
    let run = || {
        let mut scene = scene(&filled(1000.0, &layers()));
        scene.run(0.5).go().expect("a run");
        bits(&scene)
    };
    let alone = run();
    let both =
        std::thread::scope(|scope| [scope.spawn(run), scope.spawn(run)].map(|thread| thread.join().expect("a run")));
    assert!(both.iter().all(|bits| *bits == alone));
}

fn saved() -> Vec<u8> {
    let mut scene = scene(&coarse());
    scene.step(0.01).expect("a step");
    bits(&scene)
}

const NO_CHECKPOINT: &str = "this file is not a checkpoint";
const INCOMPLETE: &str = "the checkpoint is incomplete or has been added to: it has ";

/// Whether an error is a refusal whose text contains these words.
fn refused(error: &CheckpointError, words: &str) -> bool {
    matches!(error, CheckpointError::Refused { .. }) && error.to_string().contains(words)
}

#[test]
fn a_file_that_is_not_whole_is_refused() {
    let bytes = saved();
    for cut in [0, 3, 8, 12, 23, 24, 100, bytes.len() / 2, bytes.len() - 1] {
        let error = Checkpoint::from_bytes(&bytes[..cut]).expect_err("a part is no checkpoint");
        let foreign = refused(&error, NO_CHECKPOINT);
        assert_eq!(foreign, cut < 8, "{cut}: {error}");
        assert!(foreign || refused(&error, INCOMPLETE), "{cut}: {error}");
    }
    let longer = [bytes.as_slice(), &[0]].concat();
    assert!(refused(&Checkpoint::from_bytes(&longer).expect_err("too long"), INCOMPLETE));
    let mut later = bytes.clone();
    for version in [1, 7, 9] {
        later[8] = version;
        let error = Checkpoint::from_bytes(&later).expect_err("another version");
        let expected = u32::from(version);
        assert!(matches!(error, CheckpointError::Version { found, supported: 8 } if found == expected), "{error}");
    }
    assert!(refused(&Checkpoint::from_bytes(b"some other file").expect_err("another file"), NO_CHECKPOINT));
}

#[test]
fn a_checkpoint_of_another_scene_is_refused_and_changes_nothing() {
    let mut resumed = scene(&coarse());
    resumed.step(0.01).expect("a step");
    let before = bits(&resumed);
    let others = [
        Setup { region: Region::Box { lengths: [8.0, 6.0] }, ..coarse() },
        filled(10.0, &layers()),
        Setup { region: channel(6.0, Drive::ZeroFlux), ..coarse() },
        Setup { droplets: Vec::new(), ..coarse() },
        Setup { droplets: vec![DropletSetup::passive(1.0)], ..coarse() },
    ];
    for other in others {
        let error = resumed.resume(&scene(&other).checkpoint("")).expect_err("another scene");
        let text = error.to_string();
        let words = ["the checkpoint is of another scene: ", "the checkpoint is of other physics: "];
        let refused = matches!(error, SceneError::Refused { .. });
        assert!(refused && words.iter().any(|words| text.starts_with(words)), "{text}");
        assert!(bits(&resumed) == before);
    }
}

/// A change of the grid's settings.
type Change = fn(&mut GridMethod);

#[test]
fn what_is_seen_after_resuming_by_another_method_is_what_that_finds() {
    let method = |spacing: f64, change: Change| {
        let mut grid = GridMethod { marker_spacing: Some(0.1), ..GridMethod::of_spacing(spacing) };
        change(&mut grid);
        Setup { method: Method::Grid(grid), ..coarse() }
    };
    let build = |setup: &Setup| setup.build().expect("a scene");
    let mut first = build(&method(0.2, |_| {}));
    first.scene.run(0.5).go().expect("a run");
    let speed = first.scene.observe(first.droplets[0]).expect("a droplet").speed();
    let saved = first.scene.checkpoint("");
    let others: [(f64, Change); 4] = [
        (0.3, |_| {}),
        (0.2, |grid| grid.corrected = false),
        (0.2, |grid| grid.kernel = AnyKernel::Peskin4),
        (0.2, |_| {}),
    ];
    for (number, (spacing, change)) in others.into_iter().enumerate() {
        let Built { mut scene, droplets, .. } = build(&method(spacing, change));
        scene.resume(&saved).expect("the same physics");
        let seen = scene.observe(droplets[0]).expect("a droplet").speed();
        // The same state, handed over by its numbers alone.
        let mut rebuilt = build(&method(spacing, change));
        let mut state = Vec::new();
        scene.system().write_state(&mut state);
        rebuilt.scene.system_mut().read_state(&state).expect("a state");
        let exact = rebuilt.scene.observe(rebuilt.droplets[0]).expect("a droplet").speed();
        assert!((seen / exact - 1.0).abs() < 2e-3, "{number}: {seen} {exact}");
        assert_eq!(seen == speed, number == 3, "{number}: {seen} {speed}");
    }
}

/// Differences are named with both values, whatever they are.
#[test]
fn a_checkpoint_of_other_physics_is_refused_by_name() {
    let good = filled(20.0, &coarse());
    let saved = scene(&good).checkpoint("");
    let droplet = |change: fn(&mut DropletSetup)| {
        let mut setup = good.clone();
        change(&mut setup.droplets[0]);
        setup
    };
    let particles = |change: fn(&mut Particles)| {
        let mut setup = good.clone();
        setup.droplets[0].particles.as_mut().map(change);
        setup
    };
    let Method::Grid(grid) = good.method else { panic!("a grid") };
    let finer = Method::Grid(GridMethod { marker_spacing: Some(0.15), ..grid });
    let others = [
        ("times the mean concentration at the start", particles(|particles| particles.activity = -2.0)),
        (
            "times the mean concentration at the start",
            particles(|particles| particles.excluded_volume = ExcludedVolume::Step(20.0)),
        ),
        ("times the mean concentration at the start", droplet(|droplet| droplet.tension = 7.0)),
        ("the diffusion constant is 0.1 in it and 0.2 here", particles(|particles| particles.diffusion = 0.2)),
        ("the exterior viscosity is 100 in it and 50 here", Setup { viscosity: 50.0, ..good.clone() }),
        ("the viscosity inside is 20 in it and 30 here", droplet(|droplet| droplet.viscosity = Some(30.0))),
        ("the viscosity inside is 20 in it and not given here", droplet(|droplet| droplet.viscosity = None)),
        ("the number of markers at the start is", Setup { method: finer, ..good.clone() }),
    ];
    for (expected, other) in others {
        let error = scene(&other).resume(&saved).expect_err(expected);
        assert!(matches!(error, SceneError::Refused { .. }), "{error}");
        assert!(error.to_string().starts_with("the checkpoint is of other physics: for "), "{error}");
        assert!(error.to_string().contains(expected), "{error}");
    }
    for method in [good.method, Method::Integral(IntegralMethod { nodes: 32, elements: 64 })] {
        let driven = |drive| scene(&Setup { region: channel(4.0, drive), method, ..coarse() });
        let saved = driven(Drive::Gradient(-1.0)).checkpoint("");
        for (drive, expected) in [
            (Drive::Gradient(-2.0), "the imposed pressure gradient is -1 in it and -2 here"),
            (Drive::ZeroFlux, "the imposed flux is not given in it and 0 here"),
        ] {
            let error = driven(drive).resume(&saved).expect_err(expected);
            assert!(matches!(error, SceneError::Refused { .. }), "{error}");
            assert!(error.to_string().starts_with("the checkpoint is of other physics: for "), "{error}");
            assert!(error.to_string().contains(expected), "{error}");
        }
        driven(Drive::Gradient(0.0)).resume(&driven(Drive::ZeroGradient).checkpoint("")).expect("the same drive");
    }
    let with_nodes =
        |nodes| scene(&Setup { method: Method::Integral(IntegralMethod { nodes, elements: 64 }), ..Setup::default() });
    let error = with_nodes(48).resume(&with_nodes(32).checkpoint("")).expect_err("more nodes");
    assert!(error.to_string().contains("the number of nodes of an interface is 32 in it and 48 here"), "{error}");
    // Markers that follow the fluid come and go over a run, but those at the start tell.
    let follow = |marker_spacing: f64| {
        let mut setup = thesis(-3.0);
        setup.method = Method::Grid(GridMethod { marker_spacing: Some(marker_spacing), ..GridMethod::thesis() });
        scene(&setup)
    };
    let error = follow(0.05).resume(&follow(0.1).checkpoint("")).expect_err("other markers");
    assert!(error.to_string().contains("the number of markers at the start is 64 in it and 128 here"), "{error}");
    let elastic = |shear: f64| {
        let mut walls = SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear });
        walls.iter_mut().for_each(|wall| wall.finer_surface = Some(true));
        let region = Region::Channel { length: 4.0, width: 5.4, drive: Drive::ZeroGradient };
        scene(&Setup { region, solids: walls, ..layers() })
    };
    let saved = elastic(187.5).checkpoint("");
    let error = elastic(375.0).resume(&saved).expect_err("softer walls");
    assert!(error.to_string().contains("the mean energy of shears"), "{error}");
    // Another grid for the same bodies is no obstacle.
    let on = |spacing: f64| {
        let grid = GridMethod { marker_spacing: Some(0.1), ..GridMethod::of_spacing(spacing) };
        scene(&Setup { method: Method::Grid(grid), ..coarse() })
    };
    let saved = on(0.2).checkpoint("");
    on(0.15).resume(&saved).expect("the same bodies");
}

/// The scene of a description, without the description: told from others by its bodies and its fluid alone.
fn by_hand(setup: &Setup) -> Scene<AnyFlow> {
    scene(setup).described_by(Default::default())
}

/// Physics that no property of a droplet tells: refused with the key and both values, and without a description by
/// what the fluid and the bodies say of themselves.
#[test]
fn tubes_walls_and_surfaces_are_told_apart() {
    let method = Method::Integral(IntegralMethod { nodes: 24, elements: 48 });
    let tube = |flux: f64, throat: f64, ramp: f64| {
        let shape = TubeShape::Constriction { throat, throat_length: 1.0, ramp };
        let region = Region::Tube { radius: 2.0, shape, drive: Drive::Flux(flux), length: Some(12.0) };
        let centre = [-3.5, 0.0];
        let droplets = vec![DropletSetup { centre, ..DropletSetup::active(-2.0) }];
        Setup { region, method, droplets, ..Setup::default() }
    };
    let wall = |amplitude: f64, phase: f64, spacing: f64| {
        let sides = ChannelShape::Sinusoidal { width: 3.2, amplitude, waves: 1, phase };
        Setup {
            region: channel(5.0, Drive::ZeroGradient),
            method,
            walls: WallSetup::channel(&sides, spacing),
            ..coarse()
        }
    };
    let elastic = |bending: f64, hold: Hold| {
        let mut solids = SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear: 90.0 });
        solids.iter_mut().for_each(|solid| solid.finer_surface = Some(true));
        solids[0].surface_elasticity = Some(SurfaceElasticitySetup { stretching: 1.0, bending });
        solids[1].hold = hold;
        Setup { region: Region::Channel { length: 4.0, width: 5.4, drive: Drive::ZeroGradient }, solids, ..layers() }
    };
    let tethered = |stiffness: f64| elastic(1.0, Hold::Tethered { stiffness });
    let cases = [
        (
            tube(0.1, 1.4, 1.0),
            tube(0.2, 1.4, 1.0),
            "region.tube.drive.flux is 0.1 in it and 0.2 here",
            "the imposed flux",
        ),
        (tube(0.1, 1.4, 1.0), tube(0.1, 1.5, 1.0), "throat is 1.4 in it and 1.5 here", "of the walls"),
        (tube(0.1, 1.4, 1.0), tube(0.1, 1.4, 1.2), "ramp is 1.0 in it and 1.2 here", "of the walls"),
        (wall(0.2, 0.0, 0.2), wall(0.3, 0.0, 0.2), "amplitude is 0.2 in it and 0.3 here", "of the walls"),
        (wall(0.2, 0.0, 0.2), wall(0.2, 0.5, 0.2), "phase is 0.0 in it and 0.5 here", "of the walls"),
        (wall(0.2, 0.0, 0.2), wall(0.2, 0.0, 0.25), "walls[0].spacing is 0.2 in it and 0.25 here", "of the walls"),
        (
            elastic(1.0, Hold::Pinned),
            elastic(2.0, Hold::Pinned),
            "solids[0].surface-elasticity.bending is 1.0 in it and 2.0 here",
            "the bending modulus of its surface is 1 in it and 2 here",
        ),
        // The stiffness of tethers is part of their state, which a program may change.
        (tethered(20.0), tethered(30.0), "solids[1].hold.tethered.stiffness is 20.0 in it and 30.0 here", ""),
    ];
    for (saved, here, key, property) in cases {
        let checkpoint = scene(&saved).checkpoint("");
        scene(&saved).resume(&checkpoint).expect("the same scene");
        let mut other = scene(&here);
        let before = bits(&other);
        let error = other.resume(&checkpoint).expect_err(key);
        // Without the feature `toml` a description is one number.
        let told = if saved.entries().len() > 1 { key } else { "the number of the description is " };
        assert!(matches!(error, SceneError::Refused { .. }) && error.to_string().contains(told), "{key}: {error}");
        assert!(bits(&other) == before, "{key}");
        if !property.is_empty() {
            let error = by_hand(&here).resume(&by_hand(&saved).checkpoint("")).expect_err(property);
            assert!(error.to_string().contains(property) && !error.to_string().contains(key), "{property}: {error}");
        }
    }
}

/// Every kind of scene in every other: refused, or taken, and what is refused changes nothing.
#[test]
fn every_scene_in_every_other() {
    let integrals = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
    let plain = [coarse(), Setup { method: integrals, ..coarse() }, thesis(-3.0)];
    let contrasts = plain.each_ref().map(|setup| filled(1000.0, setup));
    let regions = [Region::Box { lengths: [6.0, 4.0] }, channel(4.0, Drive::ZeroGradient)];
    let setups = regions
        .iter()
        .flat_map(|&region| contrasts.iter().chain(&plain).map(move |setup| Setup { region, ..setup.clone() }));
    let mut scenes: Vec<_> = setups.map(|setup| scene(&setup)).collect();
    for scene in &mut scenes {
        (0..2).for_each(|_| scene.step(0.002).expect("a step"));
    }
    let saved: Vec<Checkpoint> = scenes.iter().map(|scene| scene.checkpoint("")).collect();
    let mut taken = 0;
    for (k, scene) in scenes.iter_mut().enumerate() {
        for (other, checkpoint) in saved.iter().enumerate() {
            match scene.resume(checkpoint) {
                Ok(()) => {
                    taken += 1;
                    scene.step(1e-4).expect("a step");
                    scene.resume(&saved[k]).expect("the same scene");
                }
                Err(error) => assert!(k != other, "{k}: {error}"),
            }
            assert_eq!(scene.checkpoint(""), saved[k], "{k} after {other}");
        }
    }
    assert!((scenes.len()..=3 * scenes.len()).contains(&taken), "{taken}");
}

#[test]
fn another_integrator_goes_on_from_the_state() {
    let mut first = scene(&coarse());
    first.run(1.0).go().expect("a run");
    let saved = first.checkpoint("");
    let mut other = scene(&coarse()).advanced_by(RungeKuttaChebyshev::new());
    other.resume(&saved).expect("the same bodies");
    assert_eq!((other.time(), other.steps()), (1.0, first.steps()));
    other.run(1.5).go().expect("a run");
}

/// A directory of this test's own, removed in the end.
struct Directory(PathBuf);

impl Directory {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("motile-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a directory");
        Self(path)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_run_saves_checkpoints_and_stops_when_told() {
    let directory = Directory::new("checkpoints");
    let path = directory.0.join("swimmer.checkpoint");
    let mut scene = scene(&coarse());
    scene.run(0.5).step_size(StepSize::Fixed(0.0125)).save(7, &path, "a swimmer").go().expect("a run");
    let read = Checkpoint::read(&path).expect("a checkpoint");
    assert_eq!((read.steps(), read.description()), (35, "a swimmer"));
    assert!((read.time() - 0.4375).abs() < 1e-12);
    // Nothing else is left.
    assert_eq!(std::fs::read_dir(&directory.0).expect("a directory").count(), 1);

    let stop = std::sync::atomic::AtomicBool::new(true);
    let error = scene.run(4.0).stop_on(&stop).go().expect_err("told to stop");
    assert!(matches!(error, SceneError::Stopped { .. }) && scene.steps() == 41, "{error}");
    let nowhere = directory.0.join("missing").join("file");
    let error = scene.run(4.0).save(1, &nowhere, "").go().expect_err("no such directory");
    assert!(matches!(error, SceneError::Checkpoint { .. }), "{error}");
    assert!(error.explanation().contains("missing"), "{}", error.explanation());
    let error = Checkpoint::read(&nowhere).expect_err("no file");
    assert!(matches!(error, CheckpointError::Missing { .. }), "{error}");
    assert_eq!(error.to_string(), format!("there is no checkpoint at {}. Check the path", nowhere.display()));
    let error = Checkpoint::read(&directory.0).expect_err("no file");
    assert!(refused(&error, "is a directory. Use the path of a checkpoint in it"), "{error}");
    if cfg!(unix) {
        // A device that never ends is not read.
        let error = Checkpoint::read(std::path::Path::new("/dev/zero")).expect_err("no file");
        assert!(matches!(error, CheckpointError::File { .. }), "{error}");
    }
    // What is not a file stays what it is.
    assert!(matches!(scene.checkpoint("").write(&directory.0), Err(CheckpointError::File { .. })));
    assert!(directory.0.is_dir());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn a_changed_byte_is_noticed(at in any::<prop::sample::Index>(), change in 1_u8..=255) {
        thread_local!(static SAVED: Vec<u8> = saved());
        let mut bytes = SAVED.with(Clone::clone);
        let index = at.index(bytes.len());
        bytes[index] ^= change;
        prop_assert!(Checkpoint::from_bytes(&bytes).is_err());
    }

    /// Contents whose checksum is right but that were never written: an error, or a checkpoint that a scene refuses or
    /// takes, never a panic.
    #[test]
    fn contents_of_any_kind_do_no_harm(
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        thread_local!(static SAVED: Vec<u8> = saved());
        let mut contents = SAVED.with(|bytes| bytes[24..].to_vec());
        for (at, value) in edits {
            let index = at.index(contents.len());
            contents[index] = value;
        }
        if let Ok(checkpoint) = Checkpoint::from_contents(&contents) {
            let mut scene = scene(&coarse());
            let before = bits(&scene);
            match scene.resume(&checkpoint) {
                Ok(()) => { let _ = scene.step(0.01); }
                Err(_) => prop_assert!(bits(&scene) == before),
            }
        }
    }
}

/// Handles find their bodies after a resumption.
#[test]
fn handles_stay_valid() {
    let Built { mut scene, droplets, .. } = coarse().build().expect("a scene");
    let droplet = droplets[0];
    scene.run(0.5).go().expect("a run");
    let saved = scene.checkpoint("");
    let markers = scene.body(droplet).unwrap().markers().to_vec();
    scene.run(1.0).go().expect("a run");
    scene.resume(&saved).expect("the same scene");
    assert_eq!(scene.body(droplet).unwrap().markers(), markers);
    assert_eq!(scene.body(droplet).unwrap().marker_count(), markers.len());
}

/// Functions of time cannot be compared, but their values can, from the time of the state on.
#[test]
fn imposed_flows_of_time_are_compared() {
    let of = |flow: Option<Imposed>| {
        let droplets = vec![DropletSetup { centre: [0.0, 0.3], ..DropletSetup::passive(1000.0) }];
        let method = Method::Integral(IntegralMethod { nodes: 16, elements: 32 });
        let mut scene = scene(&Setup { region: Region::Plane, method, droplets, ..Setup::default() });
        flow.into_iter().for_each(|flow| scene.impose(flow).expect("a flow"));
        scene
    };
    let shear = |rate: f64| Some(Imposed::from(ImposedFlow::shear(rate)));
    let wave = |rate: f64| Some(Imposed::of_time(move |time| ImposedFlow::shear(0.1 * (rate * time).cos())));
    let late = |time: f64| {
        Some(Imposed::of_time(move |now| ImposedFlow::shear(if now < time { 0.1 * (2.0 * now).cos() } else { 0.0 })))
    };
    let saved = |flow: Option<Imposed>| {
        let mut scene = of(flow);
        scene.run(0.5).go().expect("a run");
        scene.checkpoint("")
    };
    let (still, steady, moving) = (saved(None), saved(shear(0.1)), saved(wave(2.0)));
    for (checkpoint, flow) in [(&still, None), (&steady, shear(0.1)), (&moving, wave(2.0))] {
        of(flow).resume(checkpoint).expect("the same flow");
    }
    let at = "the gradient du/dy of the imposed flow";
    let cases = [
        (&moving, None, "is 0.05403023058681398 in it and not given here"),
        (&moving, shear(0.1), "is 0.05403023058681398 in it and 0.1 here"),
        (&moving, wave(3.0), "is 0.05403023058681398 in it and 0.0070737201667"),
        (&moving, late(0.6), "in it and not given here"),
        (&steady, None, "is 0.1 in it and not given here"),
        (&steady, shear(0.2), "is 0.1 in it and 0.2 here"),
        (&steady, wave(2.0), "in it and"),
        (&still, shear(0.1), "is not given in it and 0.1 here"),
        (&still, wave(2.0), "is not given in it and"),
    ];
    for (checkpoint, flow, expected) in cases {
        let error = of(flow).resume(checkpoint).expect_err(expected).to_string();
        assert!(error.contains(at) && error.contains(expected), "{expected}: {error}");
        assert!(error.contains("`Scene::take_over`"), "{error}");
    }
}
