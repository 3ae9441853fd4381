//! Scenes that go on with other parameters, and bodies that are moved between steps.

use motile::base::{Drive, Region, Vec2};
use motile::elastic_solids::ChannelShape;
use motile::scene::{SceneError, StepSize};
use motile::setup::{
    Built, DropletSetup, FlowSetup, IntegralMethod, LayersMethod, Material, Method, RigidBodySetup, Setup,
    SolidOutline, SolidSetup,
};

fn small(activity: f64) -> Setup {
    Setup {
        method: Method::Integral(IntegralMethod { nodes: 32, elements: 64 }),
        droplets: vec![DropletSetup::active(activity)],
        ..Setup::default()
    }
}

fn run(built: &mut Built, until: f64) -> [f64; 3] {
    built.scene.run(until).go().expect("a run");
    let seen = built.scene.observe(built.droplets[0]).expect("observables");
    [seen.speed(), seen.centroid.x, seen.centroid.y]
}

#[test]
fn a_scene_of_the_same_parameters_goes_on_as_if_nothing_had_happened() {
    let setup = Setup { step: StepSize::Fixed(0.02), ..small(-2.0) };
    let mut whole = setup.build().expect("a scene");
    let expected = run(&mut whole, 2.0);
    let mut first = setup.build().expect("a scene");
    run(&mut first, 1.0);
    let mut second = setup.build().expect("a scene");
    second.scene.take_over(&first.scene.checkpoint("")).expect("the state");
    assert_eq!((second.scene.time(), second.scene.steps()), (first.scene.time(), first.scene.steps()));
    let found = run(&mut second, 2.0);
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

#[test]
fn steady_speeds_are_those_of_the_new_parameters() {
    let mut first = small(-2.0).build().expect("a scene");
    run(&mut first, 10.0);
    // Another activity, viscosity and box.
    let changed = Setup { region: Region::Box { lengths: [7.0, 7.0] }, viscosity: 80.0, ..small(-3.0) };
    let mut second = changed.build().expect("a scene");
    second.scene.take_over(&first.scene.checkpoint("")).expect("the state");
    let [found, ..] = run(&mut second, 40.0);
    let [expected, ..] = run(&mut changed.build().expect("a scene"), 40.0);
    assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
}

#[test]
fn the_strain_of_a_sheared_box_is_taken_over() {
    let flow = FlowSetup { shear: 0.3, ..FlowSetup::default() };
    let setup = Setup { flow, step: StepSize::Fixed(0.02), ..small(-2.0) };
    let mut whole = setup.build().expect("a scene");
    let expected = run(&mut whole, 1.6);
    let mut first = setup.build().expect("a scene");
    run(&mut first, 0.8);
    let mut second = setup.build().expect("a scene");
    second.scene.take_over(&first.scene.checkpoint("")).expect("the state");
    let found = run(&mut second, 1.6);
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

#[test]
fn other_bodies_are_refused_and_nothing_is_changed() {
    let mut two = small(-2.0);
    two.droplets = vec![DropletSetup { centre: [-1.4, 0.0], ..DropletSetup::active(-2.0) }, DropletSetup::active(-2.0)];
    two.droplets[1].centre = [1.4, 0.0];
    let other = two.build().expect("a scene");
    let mut scene = small(-2.0).build().expect("a scene").scene;
    let before = scene.checkpoint("");
    let refused = scene.take_over(&other.scene.checkpoint("")).expect_err("two droplets").to_string();
    assert!(refused.contains("it has 2 bodies, this scene 1"), "{refused}");
    scene.take_over(&before).expect("the state before");
    assert_eq!((scene.time(), scene.steps()), (0.0, 0));
}

/// A finer or coarser description would be of no effect, and not that of the state that follows.
#[test]
fn another_number_of_markers_is_refused() {
    let of = |nodes, elements| {
        let method = Method::Integral(IntegralMethod { nodes, elements });
        let mut built = Setup { method, ..small(-2.0) }.build().expect("a scene");
        built.scene.run(0.1).go().expect("a run");
        built.scene
    };
    let saved = of(32, 64).checkpoint("");
    for elements in [96, 48] {
        let mut scene = of(32, elements);
        let before = scene.checkpoint("");
        let refused = scene.take_over(&saved).expect_err("another number of markers").to_string();
        let words = format!("the number of markers at the start is 64 in it and {elements} here");
        assert!(refused.contains(&words) && refused.contains("Build the scene with as many"), "{refused}");
        assert_eq!(scene.checkpoint("").to_bytes().expect("bytes"), before.to_bytes().expect("bytes"));
    }
    // With other nodes for the same markers it goes on, and what it saves is of its own description.
    let mut scene = of(48, 64);
    scene.take_over(&saved).expect("the same markers");
    scene.run(0.2).go().expect("a run");
    let after = scene.checkpoint("");
    let mut resumed = of(48, 64);
    resumed.resume(&after).expect("the same description");
    assert_eq!(resumed.checkpoint(""), after);
}

#[test]
fn a_box_that_is_too_small_for_the_state_is_refused() {
    let mut long = small(-2.0);
    long.droplets =
        vec![DropletSetup { centre: [-2.4, 0.0], ..DropletSetup::active(-2.0) }, DropletSetup::active(-2.0)];
    long.region = Region::Box { lengths: [8.0, 6.0] };
    long.droplets[1].centre = [2.4, 0.0];
    let spread = long.build().expect("a scene").scene.checkpoint("");
    let mut short = long.clone();
    short.region = Region::Box { lengths: [5.0, 6.0] };
    (short.droplets[0].centre, short.droplets[1].centre) = ([-1.2, 0.0], [1.2, 0.0]);
    let mut scene = short.build().expect("a scene").scene;
    let before = scene.checkpoint("");
    // 4.8 apart in a box of 5: each lies on the image of the other.
    let refused = scene.take_over(&spread);
    assert!(matches!(refused, Err(SceneError::Overlap { .. })), "{refused:?}");
    assert_eq!(scene.checkpoint("").to_bytes().expect("bytes"), before.to_bytes().expect("bytes"));
}

#[test]
fn a_run_in_a_box_does_not_depend_on_where_it_is() {
    let by = Vec2::new(1.3, -0.8);
    let setup = Setup { step: StepSize::Fixed(0.02), ..small(-3.0) };
    let [speed, x, y] = run(&mut setup.build().expect("a scene"), 1.0);
    let mut moved = setup.build().expect("a scene");
    moved.scene.run(0.5).go().expect("a run");
    moved.scene.translate(&[moved.droplets[0].into()], by).expect("room");
    let found = run(&mut moved, 1.0);
    for (found, expected) in found.into_iter().zip([speed, x + by.x, y + by.y]) {
        assert!((found - expected).abs() < 1e-7, "{found} {expected}");
    }
}

#[test]
fn a_move_onto_another_body_is_refused_and_the_scene_is_as_it_was() {
    let mut setup = small(-2.0);
    setup.region = Region::Box { lengths: [8.0, 6.0] };
    setup.droplets[0].centre = [-1.5, 0.0];
    setup.droplets.push(DropletSetup { centre: [1.5, 0.0], ..DropletSetup::active(-2.0) });
    setup.rigid_bodies = vec![RigidBodySetup { centre: [-1.5, 0.1], ..RigidBodySetup::default() }];
    let mut built = setup.build().expect("a scene");
    built.scene.run(0.2).go().expect("a run");
    let places = |built: &Built| built.scene.system().markers().positions().to_vec();
    let before = places(&built);
    let (droplet, nucleus) = (built.droplets[0].into(), built.rigid_bodies[0].into());
    assert!(built.scene.translate(&[droplet, nucleus], Vec2::new(1.5, 0.0)).is_err());
    assert!(built.scene.translate(&[droplet, nucleus], Vec2::new(f64::NAN, 0.0)).is_err());
    built.scene.system_mut().evaluate().expect("a flow");
    assert_eq!(places(&built), before);
    // Without its nucleus it would be left behind, with it all is well.
    built.scene.translate(&[droplet, nucleus], Vec2::new(-0.5, 0.3)).expect("room");
    let moved = places(&built);
    let shifts: Vec<f64> = moved.iter().zip(&before).map(|(after, before)| (*after - *before).length()).collect();
    assert_eq!(shifts.iter().filter(|shift| **shift < 1e-12).count(), 64);
    built.scene.run(0.4).go().expect("a run");
}

#[test]
fn a_pinned_wall_cannot_be_moved() {
    let outline = SolidOutline::WallBelow(ChannelShape::Straight { width: 4.5 });
    let wall = SolidSetup::new(outline, Material::Springs { shear: 100.0 });
    let setup = Setup {
        region: Region::Channel { length: 8.0, width: 6.0, drive: Drive::default() },
        method: Method::Layers(LayersMethod { nodes: 32, elements: 64, spacing: 0.2, ..LayersMethod::default() }),
        solids: vec![wall],
        ..small(-2.0)
    };
    let mut built = setup.build().expect("a scene");
    let refused = built.scene.translate(&[built.solids[0].into()], Vec2::X).expect_err("it is pinned").to_string();
    assert!(refused.starts_with("solid cannot be moved as a whole"), "{refused}");
}
