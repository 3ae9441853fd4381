//! Films that drain, and what holds them open: against exact resistances, their integral in time, and an energy.

use std::f64::consts::{PI, TAU};

use motile::base::Region;
use motile::base::Vec2;
use motile::scene::{MarkerBody, MarkerKind, Scene, StepSize, gap::Repulsion};
use motile::setup::{AnyFlow, Built, DropletSetup, IntegralMethod, Method, Setup};
use motile_tests::validation::scene::{flow, open_channel};

const FORCE: f64 = 2.0;

/// Velocity (length per time) at which a rigid cylinder of radius one sinks under a force per length onto a wall at the
/// gap d in fluid of viscosity one (Jeffrey and Onishi, Q. J. Mech. Appl. Math. 34, 1981).
fn sinking(gap: f64) -> f64 {
    let alpha = (1.0 + gap).acosh();
    FORCE * (alpha - alpha.tanh()) / (4.0 * PI)
}

/// The gap after a time, by that velocity.
fn drained(mut gap: f64, time: f64) -> f64 {
    let (count, rate) = (20_000, |gap: f64| -sinking(gap));
    let dt = time / f64::from(count);
    for _ in 0..count {
        let a = rate(gap);
        let b = rate(gap + 0.5 * dt * a);
        let c = rate(gap + 0.5 * dt * b);
        gap += dt / 6.0 * (a + 2.0 * b + 2.0 * c + rate(gap + dt * c));
    }
    gap
}

/// A droplet of radius one, so viscous that it is nearly rigid, above the lower wall of a wide channel, pulled to it.
fn stiff(nodes: usize, gap: f64, ratio: f64) -> Scene<AnyFlow> {
    let method = Method::Integral(IntegralMethod { nodes, elements: nodes });
    let flow = flow(open_channel(30.0, 20.0), method, 1.0, 1e-9).expect("a flow");
    let place = |k: usize| {
        let (s, c) = (TAU * k as f64 / nodes as f64).sin_cos();
        Vec2::new(c, s + gap - 9.0)
    };
    let pull = move |_: &[Vec2], forces: &mut [Vec2]| forces.fill(-FORCE / nodes as f64 * Vec2::Y);
    let droplet = MarkerBody::new("droplet", (0..nodes).map(place).collect(), pull)
        .with_kind(MarkerKind::Interface { viscosity_inside: Some(ratio) });
    let mut scene = Scene::new(flow);
    scene.add(droplet);
    scene
}

/// Its velocity: what the inside gives way is in proportion to the ratio and taken off.
#[test]
fn the_resistance_of_a_film_is_exact() {
    for (gap, nodes, bound) in [(0.2, 64, 2e-4), (0.1, 96, 2e-4), (0.05, 128, 2e-3)] {
        let [soft, hard] = [5e3, 1e4].map(|ratio| {
            let mut scene = stiff(nodes, gap, ratio);
            let markers = scene.system_mut().evaluate().expect("a flow");
            -markers.velocities().iter().sum::<Vec2>().y / nodes as f64
        });
        let error = (2.0 * hard - soft) / sinking(gap) - 1.0;
        assert!(error.abs() < bound, "{gap}: {error:e}");
    }
}

/// The thickness of the film over time, by steps that see it close.
#[test]
fn a_film_drains_as_it_should() {
    let (start, time) = (0.3, 30.0);
    let exact = drained(start, time);
    let tolerances = [1e-3, 1e-4, 1e-5];
    let runs = tolerances.map(|tolerance| {
        let mut scene = stiff(96, start, 3e4);
        scene.run(time).step_size(StepSize::Adaptive { tolerance }).go().expect("a run");
        let gap = scene.system_mut().wall_gap().expect("a wall");
        (gap / exact - 1.0, scene.steps())
    });
    assert!(exact < 0.08 && runs[2].0.abs() < 5e-3 && runs.iter().all(|run| run.1 < 60), "{exact} {runs:?}");
    // What is left in the end is what the inside gives way.
    assert!(runs.windows(2).all(|pair| pair[1].0.abs() < 0.7 * pair[0].0.abs()), "{runs:?}");
}

/// At rest the repulsion carries the force: `-dE/dd = FORCE` with the energy `E(d)` of a circle at the gap d.
#[test]
fn a_repulsion_carries_what_presses() {
    let repulsion = Repulsion::new(200.0, 0.2).expect("a repulsion");
    let carried = |gap: f64| {
        let count = 20_000;
        let pressure = |k: u32| repulsion.pressure(gap + 1.0 - (TAU * f64::from(k) / f64::from(count)).cos());
        (0..count).map(pressure).sum::<f64>() * TAU / f64::from(count)
    };
    let (mut low, mut high) = (0.0, 0.2);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if carried(middle) > FORCE { low = middle } else { high = middle }
    }
    let at_rest = |scene: Scene<AnyFlow>| {
        let mut scene = scene.with_repulsion(repulsion);
        scene.run(15.0).step_size(StepSize::Adaptive { tolerance: 1e-4 }).go().expect("a run");
        scene.system_mut().wall_gap().expect("a wall") / low - 1.0
    };
    let errors = [64, 96].map(|nodes| at_rest(stiff(nodes, low + 0.01, 1e5)));
    assert!(errors.iter().all(|error| error.abs() < 2e-3), "{errors:?}");
}

/// Swimmers that collide head-on, held apart by a film as thick as the distance of their nodes, or one alone.
fn collided(both: bool, repulsion: Repulsion) -> Built {
    let places = [(-1.4, 0.0), (1.4, PI)].into_iter().take(if both { 2 } else { 1 });
    let droplet = |(x, angle): (f64, f64)| DropletSetup { centre: [x, 0.0], angle, ..DropletSetup::active(-2.0) };
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 128 });
    let droplets = places.map(droplet).collect();
    let setup = Setup { region: Region::Plane, method, droplets, repulsion: Some(repulsion), ..Setup::default() };
    let mut built = setup.build().expect("a scene");
    built.scene.run(12.0).go().expect("a run through the collision");
    built
}

#[test]
fn a_film_that_nodes_resolve_holds_without_more_steps() {
    let film = TAU / 32.0;
    let repulsion = Repulsion::holding(film, 210.0).expect("a repulsion");
    let alone = collided(false, repulsion).scene.steps();
    let Built { mut scene, droplets, .. } = collided(true, repulsion);
    // They have come as close as they are held, and no closer at any time.
    let gap = scene.system().gap(droplets[0], droplets[1]).expect("handles").expect("a gap");
    let least = scene.system().minimum_gap().expect("a gap");
    assert!(gap < 2.0 * film && least > 0.3 * film, "{gap} {least}");
    assert!(scene.steps() < 2 * alone, "{} {alone}", scene.steps());
    assert_eq!(scene.step_report().rejections + scene.step_report().failures, 0);
    // What it transmits is what pushes them together, along their line.
    let load = scene.system_mut().repulsion_load().expect("a flow").expect("a repulsion");
    let [[along, aside], [_, across]] = load.virial;
    assert!(along > 0.0 && aside.abs() < 1e-6 * along && across.abs() < along, "{load:?}");
    for droplet in droplets {
        let state = scene.observe(droplet).expect("a state");
        let change = state.area / scene.body(droplet).expect("a handle").initial_area() - 1.0;
        assert!(change.abs() < 1e-4, "{change:e}");
    }
}
