//! Scenes that are their own mirror image in y = 0 stay so up to round-off.

use motile::SetupError;
use motile::active_interface::ActiveDroplet;
use motile::elastic_solids::ChannelShape;
use motile::prelude::*;
use motile::scene::{Handle, SceneError, integrator::Dynamics};
use motile::setup::{AnyFlow, DropletShape, Material, RigidBodySetup, SolidSetup, Start, WallSetup};

/// Largest distance (length) of a marker from the mirror image of its counterpart, and the largest difference of
/// concentrations there over the largest of all, of two droplets (or of one with itself) whose markers are numbered
/// from points that are mirror images.
fn asymmetry(scene: &Scene<AnyFlow>, droplets: &[Handle<ActiveDroplet>]) -> [f64; 2] {
    let [one, other] =
        [droplets[0], droplets[droplets.len() - 1]].map(|droplet| scene.body(droplet).expect("a droplet"));
    let count = one.markers().len();
    let distance = |k: usize| {
        let (marker, image) = (one.markers()[k], other.markers()[(count - k) % count]);
        (marker.x - image.x).hypot(marker.y + image.y)
    };
    let difference = |k: usize| (one.concentrations()[k] - other.concentrations()[count - 1 - k]).abs();
    let most = one.concentrations().iter().fold(0.0_f64, |a, &b| a.max(b));
    let largest = |of: &dyn Fn(usize) -> f64| (0..count).map(of).fold(0.0, f64::max);
    [largest(&distance), largest(&difference) / most]
}

/// Steps of half the stability limit; asymmetries of 1e-12 are some hundred times what round-off is found to make.
fn stays_symmetric(name: &str, setup: &Setup, steps: usize) {
    let Built { mut scene, droplets, .. } = setup.build().expect("a scene");
    for _ in 0..steps {
        scene.system_mut().evaluate().expect("a flow");
        let (limit, ..) = scene.step_limit().expect("a limit");
        scene.step(0.5 * limit).expect("a step");
    }
    let found = asymmetry(&scene, &droplets);
    println!("{name}: {found:?}");
    assert!(found[0] < 1e-12 && found[1] < 1e-12, "{name}: {found:?}");
}

fn channel(length: f64, width: f64) -> Region {
    Region::Channel { length, width, drive: Drive::ZeroGradient }
}

/// A droplet in the plane by integrals, with cells so few for its nodes that the shortest waves are there.
fn integrals() -> Setup {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 96 });
    Setup { region: Region::Plane, method, droplets: vec![DropletSetup::active(-4.0)], ..Setup::default() }
}

/// A narrow place, half a period of 12 away from a droplet.
const CONSTRICTION: ChannelShape =
    ChannelShape::Constriction { width: 2.4, throat: 1.2, throat_length: 4.0, ramp: 1.0, exit_ramp: None, centre: 6.0 };

#[test]
fn by_integrals() {
    let abreast = |y: f64| DropletSetup { centre: [0.0, y], angle: 0.1 * y, ..DropletSetup::active(-4.0) };
    let two = vec![abreast(-1.3), abreast(1.3)];
    stays_symmetric("plane", &integrals(), 40);
    let lengths = [6.0, 6.0];
    stays_symmetric("box", &Setup { region: Region::Box { lengths }, droplets: two, ..integrals() }, 20);
    stays_symmetric("channel", &Setup { region: channel(8.0, 2.4), ..integrals() }, 40);
}

#[test]
fn between_curved_rigid_walls() {
    let sinusoidal = ChannelShape::Sinusoidal { width: 2.6, amplitude: 0.2, waves: 1, phase: 0.0 };
    let branches = [1.3, 1.3];
    let branching =
        ChannelShape::Branching { width: 2.4, branches, island_length: 4.0, island_thickness: 1.2, ramp: 2.0 };
    for (shape, x) in [(CONSTRICTION, 0.0), (sinusoidal, 2.0), (branching, 6.0)] {
        let droplets = vec![DropletSetup { centre: [x, 0.0], ..DropletSetup::active(-4.0) }];
        let walls = WallSetup::channel(&shape, 0.2);
        let setup = Setup { region: channel(12.0, 5.0), droplets, walls, ..integrals() };
        stays_symmetric(shape.name(), &setup, 10);
    }
}

#[test]
fn on_a_grid() {
    let grid = Method::Grid(GridMethod::of_spacing(0.1));
    let setup = Setup { method: grid, region: Setup::default().region, ..integrals() };
    stays_symmetric("box", &setup, 20);
    stays_symmetric("channel", &Setup { region: channel(6.0, 3.0), ..setup }, 20);
}

#[test]
fn between_elastic_walls() {
    let method = Method::Layers(LayersMethod::of_spacing(0.1));
    let material = Material::NeoHookean { shear: 200.0, bulk: 400.0 };
    let walls = SolidSetup::walls(&CONSTRICTION, &material);
    let setup = Setup { region: channel(12.0, 5.0), method, solids: walls, ..integrals() };
    stays_symmetric("layers", &setup, 10);
    // A droplet that starts squeezed.
    let narrow = ChannelShape::Constriction {
        width: 2.0,
        throat: 1.0,
        throat_length: 4.0,
        ramp: 1.0,
        exit_ramp: None,
        centre: 6.0,
    };
    let squeezed = Setup { solids: SolidSetup::walls(&narrow, &material), mirror_symmetric: true, ..setup.clone() };
    stays_symmetric("squeezed", &squeezed, 10);
    let springs = SolidSetup::walls(&CONSTRICTION, &Material::Springs { shear: 200.0 });
    let solids = springs.into_iter().map(SolidSetup::thesis).collect();
    let method = Method::Grid(GridMethod::uncorrected(0.1));
    stays_symmetric("plain", &Setup { method, solids, ..setup }, 10);
}

/// An ellipse with particles everywhere, which gather on one side; it is off a mirror image by 1e-7.
fn undecided() -> Setup {
    let shape = DropletShape::Modes { radius: 1.0, cosines: vec![0.0, -0.1], sines: vec![0.0, 0.0, 1e-7] };
    let particles = Particles { activity: -4.0, start: Start::Uniform, ..Particles::default() };
    Setup {
        droplets: vec![DropletSetup { shape, particles: Some(particles), ..DropletSetup::default() }],
        ..integrals()
    }
}

/// The free droplet swims away from the axis, the one that is held does not; resumed half way it is the same to the
/// bit.
#[test]
fn held_symmetric_where_that_is_unstable() {
    let run = |held: bool, resumed: bool| {
        let setup = Setup { mirror_symmetric: held, ..undecided() };
        let mut built = setup.build().unwrap();
        built.scene.run(7.0).go().unwrap();
        if resumed {
            let saved = built.scene.checkpoint("");
            built = setup.build().unwrap();
            built.scene.resume(&saved).unwrap();
        }
        built.scene.run(20.0).go().unwrap();
        built
    };
    let [mut free, mut held] = [false, true].map(|held| run(held, false));
    let off = [&free, &held].map(|built| asymmetry(&built.scene, &built.droplets)[0]);
    let places = [&mut free, &mut held].map(|built| built.scene.observe(built.droplets[0]).unwrap().centroid);
    println!("{off:?} {places:?}");
    assert!(off[0] > 1e-4 && places[0].y.abs() > 1e-4, "{off:?} {places:?}");
    assert!(off[1] == 0.0 && places[1].y.abs() < 1e-15, "{off:?} {places:?}");
    let resumed = run(true, true);
    let [state, again] = [&held, &resumed].map(|built| {
        let mut state = Vec::new();
        built.scene.system().write_state(&mut state);
        state.into_iter().map(f64::to_bits).collect::<Vec<_>>()
    });
    assert!(state == again);
}

/// Pairs of bodies of each kind, and bodies that are their own images.
#[test]
fn bodies_of_each_kind_are_held() {
    let method = Method::Layers(LayersMethod::of_spacing(0.1));
    let abreast = |y: f64| {
        let centre = [-1.0, y];
        DropletSetup { centre, angle: 0.2 * y, viscosity: Some(1000.0), ..DropletSetup::active(-4.0) }
    };
    let walls = SolidSetup::walls(&CONSTRICTION, &Material::NeoHookean { shear: 200.0, bulk: 400.0 });
    let droplets = vec![abreast(-1e-8)];
    let setup = Setup { region: channel(12.0, 5.0), method, droplets, solids: walls, ..Setup::default() };
    let held = |setup: Setup| {
        let Built { mut scene, droplets, .. } = Setup { mirror_symmetric: true, ..setup }.build().unwrap();
        scene.run(0.1).go().unwrap();
        let found = asymmetry(&scene, &droplets);
        assert!(found[0] == 0.0 && found[1] < 1e-12, "{found:?}");
    };
    held(setup);
    let disc = |y: f64| RigidBodySetup { centre: [2.0, y], ..RigidBodySetup::disc(0.4) };
    let lengths = [8.0, 6.0];
    held(Setup {
        region: Region::Box { lengths },
        droplets: vec![abreast(-1.2), abreast(1.2)],
        rigid_bodies: vec![disc(0.0), disc(1.0), disc(-1.0)],
        ..Setup::default()
    });
}

#[test]
fn scenes_that_are_no_mirror_images_are_refused() {
    let refused = |setup: Setup, problem: &str| {
        let setup = Setup { mirror_symmetric: true, ..setup };
        match setup.build().map(|_| ()) {
            Err(SetupError::Scene(error @ SceneError::NotSymmetric { .. })) => {
                let text = error.to_string();
                assert!(text.contains(problem), "{text}");
            }
            other => panic!("{other:?}"),
        }
    };
    let named = |name: &str, droplet: DropletSetup| DropletSetup { name: name.to_owned(), ..droplet };
    let active = |y: f64| DropletSetup { centre: [0.0, y], ..DropletSetup::active(-4.0) };
    let aside = vec![named("first", active(-1.5)), named("second", active(1.4))];
    refused(Setup { droplets: aside, ..integrals() }, "first has no mirror image");
    let thick = DropletSetup { viscosity: Some(1000.0), ..active(1.5) };
    refused(
        Setup { droplets: vec![named("thin", active(-1.5)), thick], ..integrals() },
        "thin has another mirror image",
    );
    refused(Setup::thesis(), "no mirror images");
    // Walls that are none show in the first step.
    let shape = ChannelShape::Sinusoidal { width: 2.6, amplitude: 0.2, waves: 1, phase: 0.5 };
    let walls = WallSetup::channel(&shape, 0.2);
    let setup = Setup { region: channel(12.0, 5.0), walls, mirror_symmetric: true, ..integrals() };
    let mut scene = setup.build().unwrap().scene;
    let error = scene.step(0.01).unwrap_err();
    assert!(matches!(error, SceneError::NotSymmetric { .. }), "{error}");
}
