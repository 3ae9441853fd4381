//! Films that drain, and what holds them open: against exact resistances, their integral in time, and an energy.

use std::f64::consts::{PI, TAU};

use motile::ib_core::{Handle, MarkerBody, MarkerKind, Repulsion, Scene, StepSize, Vec2};
use motile::{AnyFlow, GridMethod, IntegralMethod, Method};
use motile_tests::validation::scene::{flow, open_channel};

const REGION: [f64; 2] = [30.0, 20.0];
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

/// A circle of radius one above the lower wall of a channel, pulled towards it, of another viscosity and a tension.
fn pulled(
    flow: AnyFlow,
    [length, width]: [f64; 2],
    gap: f64,
    count: usize,
    viscosity: Option<f64>,
    tension: f64,
) -> (Scene<AnyFlow>, Handle<MarkerBody>) {
    assert!(length > 0.0);
    let place = |k: usize| {
        let (s, c) = (TAU * k as f64 / count as f64).sin_cos();
        Vec2::new(c, s + 1.0 + gap - 0.5 * width)
    };
    let forces = move |markers: &[Vec2], forces: &mut [Vec2]| {
        for (k, force) in forces.iter_mut().enumerate() {
            let [before, after] =
                [(k + count - 1) % count, (k + 1) % count].map(|i| (markers[i] - markers[k]).normalize());
            *force = tension * (before + after) - FORCE / count as f64 * Vec2::Y;
        }
    };
    let body = MarkerBody::new("cylinder", (0..count).map(place).collect(), forces)
        .with_kind(MarkerKind::Interface { viscosity_inside: viscosity });
    let mut scene = Scene::new(flow);
    let body = scene.add(body);
    (scene, body)
}

fn integral(nodes: usize) -> AnyFlow {
    let method = Method::Integral(IntegralMethod { nodes, cells: nodes });
    flow(open_channel(REGION[0], REGION[1]), method, 1.0, 1e-9).expect("a flow")
}

/// A droplet so viscous that it is rigid.
fn stiff(nodes: usize, gap: f64, ratio: f64) -> (Scene<AnyFlow>, Handle<MarkerBody>) {
    pulled(integral(nodes), REGION, gap, nodes, Some(ratio), 0.0)
}

/// Its velocity: what the inside gives way is in proportion to the ratio and taken off.
#[test]
fn the_resistance_of_a_film_is_exact() {
    for (gap, nodes, bound) in [(0.2, 64, 2e-4), (0.1, 96, 2e-4), (0.05, 128, 2e-3)] {
        let [soft, hard] = [5e3, 1e4].map(|ratio| {
            let (mut scene, _) = stiff(nodes, gap, ratio);
            let markers = scene.system_mut().evaluate().expect("a flow");
            -markers.velocities().iter().sum::<Vec2>().y / nodes as f64
        });
        let error = (2.0 * hard - soft) / sinking(gap) - 1.0;
        println!("{gap}: {error:e}");
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
        let (mut scene, _) = stiff(96, start, 3e4);
        scene.run(time).step_size(StepSize::Adaptive { tolerance }).go().expect("a run");
        let gap = scene.system_mut().wall_gap().expect("a wall");
        (gap / exact - 1.0, scene.steps(), scene.step_report().most_limiting().map(|limit| limit.reason.clone()))
    });
    println!("{exact} {runs:?}");
    assert!(exact < 0.07 && runs[2].0.abs() < 5e-3, "{exact} {runs:?}");
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
        scene.run(60.0).step_size(StepSize::Adaptive { tolerance: 1e-4 }).go().expect("a run");
        scene.system_mut().wall_gap().expect("a wall") / low - 1.0
    };
    let errors = [64, 96].map(|nodes| at_rest(stiff(nodes, low + 0.03, 1e4).0));
    println!("{low} {errors:?}");
    assert!(errors[1].abs() < 1e-2 && errors[0].abs() < 3e-2, "{errors:?}");
    // On a grid a droplet of the same viscosity that its tension keeps round.
    let region = [6.0, 5.0];
    let errors = [0.1, 0.05].map(|h| {
        let method = Method::Grid(GridMethod::of_spacing(h));
        let grid = flow(open_channel(region[0], region[1]), method, 1.0, 1e-6).expect("a flow");
        at_rest(pulled(grid, region, low + 0.03, (TAU / (0.5 * h)) as usize, None, 200.0).0)
    });
    println!("{low} {errors:?}");
    assert!(errors[1].abs() < 5e-2, "{errors:?}");
}
