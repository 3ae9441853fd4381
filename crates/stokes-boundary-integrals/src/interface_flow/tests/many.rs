//! Many droplets beside rigid bodies, between curved walls, and the flow between them: fast sums against sums over
//! pairs.

use std::f64::consts::TAU;

use motile_base::Drive;

use super::*;
use crate::{
    PeriodicCalculus, TensionPlacement,
    sample::{Sampler, pays},
};

const NODES: usize = 80;
const SIDE: f64 = 10.4;
/// Droplets along a side of the lattice.
const COUNT: usize = 4;

fn angle(k: usize, count: usize) -> f64 {
    TAU * k as f64 / count as f64
}

/// Width of the films between some droplets.
const FILM: f64 = 0.2;

/// Outlines on a lattice over a square about the middle, of different shapes, with their forces; some films between
/// them are so wide.
fn droplets(side: f64, film: f64) -> Vec<(Vec<Vec2>, Vec<Vec2>)> {
    let cell = side / COUNT as f64;
    let mut calculus = PeriodicCalculus::new(NODES).unwrap();
    let outline = |number: usize| -> (Vec<Vec2>, Vec<Vec2>) {
        let place = |k: usize| (k as f64 + 0.5) * cell - 0.5 * side;
        let centre = Vec2::new(place(number % COUNT), place(number / COUNT));
        let (along, across) = (0.5 * (cell - film), 0.4 * cell + 0.02 * (number % 4) as f64);
        let at = |k: usize| angle(k, NODES);
        let positions: Vec<Vec2> =
            (0..NODES).map(|k| centre + Vec2::new(along * at(k).cos(), across * at(k).sin())).collect();
        let tension: Vec<f64> = (0..NODES).map(|k| 1.0 + 0.5 * (at(k) - number as f64).cos()).collect();
        let mut forces = vec![Vec2::ZERO; NODES];
        calculus.tension_forces(&positions, &tension, TensionPlacement::Points, &mut forces).unwrap();
        (positions, forces)
    };
    (0..COUNT * COUNT).map(outline).collect()
}

/// A flow with the droplets, of which every fourth one is rigid where `rigid` says so, by fast sums or by others.
fn solved(flow: InterfaceFlow, inside: f64, rigid: bool, fast: bool) -> InterfaceFlow {
    solved_of(&droplets(SIDE, FILM), flow, inside, rigid, fast)
}

/// The like of some droplets.
fn solved_of(
    all: &[(Vec<Vec2>, Vec<Vec2>)],
    mut flow: InterfaceFlow,
    inside: f64,
    rigid: bool,
    fast: bool,
) -> InterfaceFlow {
    let given = all.iter().enumerate().map(|(number, (positions, forces))| {
        if rigid && number % 4 == 0 {
            Interface::rigid(positions, forces, 1.0)
        } else {
            Interface::closed(positions, forces, [inside, 1.0])
        }
    });
    flow.load(given).unwrap();
    if fast {
        flow.layers.sum_fast().unwrap();
    } else {
        flow.layers.fast = None;
    }
    flow.solve().unwrap();
    flow
}

/// Velocities at the points of all droplets.
fn velocities(flow: &mut InterfaceFlow) -> Vec<Vec2> {
    let mut all = vec![Vec2::ZERO; NODES * flow.len()];
    for (number, out) in all.chunks_exact_mut(NODES).enumerate() {
        flow.velocities(number, out).unwrap();
    }
    all
}

fn settings(tolerance: f64) -> Settings {
    Settings { nodes: NODES, tolerance, warm_start: false, ..Settings::default() }
}

/// Largest difference over the largest value.
fn error(found: &[Vec2], expected: &[Vec2]) -> f64 {
    let largest = expected.iter().map(|v| v.length()).fold(0.0, f64::max);
    found.iter().zip(expected).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / largest
}

const BOX: Region = Region::Box { lengths: [SIDE, SIDE] };
const CHANNEL: Region = Region::Channel { length: SIDE, width: SIDE + 0.4, drive: Drive::ZeroFlux };

#[test]
fn velocities_are_right_to_the_tolerance_at_any_ratio() {
    for region in [BOX, CHANNEL, Region::Plane] {
        for (inside, rigid) in [(0.1, false), (10.0, false), (10.0, true)] {
            let new = |tolerance| InterfaceFlow::new(region, 1.0, settings(tolerance)).unwrap();
            let expected = velocities(&mut solved(new(1e-13), inside, rigid, false));
            for tolerance in [1e-4, 1e-6, 1e-8] {
                let error = error(&velocities(&mut solved(new(tolerance), inside, rigid, true)), &expected);
                println!("{region:?} {inside} {rigid} {tolerance:e}: {:.2}", error / tolerance);
                assert!(error < tolerance, "{region:?} {inside} {rigid} {tolerance:e}: {error:e}");
            }
        }
    }
}

#[test]
fn sums_are_over_pairs_where_fast_ones_show_round_off() {
    let all = droplets(SIDE, FILM);
    let fast = |tolerance: f64| {
        let mut flow = InterfaceFlow::new(BOX, 1.0, settings(tolerance)).unwrap();
        flow.load(all.iter().map(|(outline, forces)| Interface::closed(outline, forces, [1.0, 1.0]))).unwrap();
        flow.layers.sums_fast()
    };
    assert!(fast(1e-12) && !fast(0.9e-12));
}

#[test]
fn velocities_around_films_that_nodes_do_not_resolve_are_right_to_the_tolerance() {
    let all = droplets(SIDE, 0.02);
    let new = |tolerance| InterfaceFlow::new(BOX, 1.0, settings(tolerance)).unwrap();
    let expected = velocities(&mut solved_of(&all, new(1e-13), 10.0, false, false));
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let error = error(&velocities(&mut solved_of(&all, new(tolerance), 10.0, false, true)), &expected);
        println!("films {tolerance:e}: {:.2}", error / tolerance);
        assert!(error < tolerance, "{tolerance:e}: {error:e}");
    }
}

/// A side of a channel, a sine about the height y of walls with the fluid between them.
fn side(y: f64, count: usize) -> (Vec<Vec2>, Vec2) {
    let fluid = -y.signum();
    let x = |k: usize| fluid * SIDE * (k as f64 / count as f64 - 0.5);
    let height = |x: f64| y + 0.3 * (TAU * x / SIDE).sin();
    ((0..count).map(|k| Vec2::new(x(k), height(x(k)))).collect(), Vec2::new(fluid * SIDE, 0.0))
}

#[test]
fn curved_walls_stand_beside_many_droplets() {
    let walls = [-0.5 * SIDE - 0.4, 0.5 * SIDE + 0.4].map(|y| side(y, 160));
    let region = Region::Channel { length: SIDE, width: SIDE + 2.0, drive: Drive::Flux(0.3) };
    let walled = |tolerance: f64| {
        let curves = walls.iter().map(|(positions, period)| LayerCurve { positions, period: *period, nodes: 160 });
        InterfaceFlow::new(region, 1.0, settings(tolerance)).unwrap().with_walls(curves).unwrap()
    };
    for inside in [1.0, 5.0] {
        let expected = velocities(&mut solved(walled(1e-13), inside, false, false));
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let mut flow = solved(walled(tolerance), inside, false, true);
            let error = error(&velocities(&mut flow), &expected);
            println!("walls, {inside} {tolerance:e}: {:.2}", error / tolerance);
            assert!(error < tolerance, "{inside} {tolerance:e}: {error:e}");
            // Between droplets, beside a wall, and behind one.
            let points = [[0.0, 0.0], [0.4, -0.5 * SIDE - 0.25], [0.4, 0.5 * SIDE + 0.2], [1.0, 0.5 * SIDE + 0.95]];
            let points = points.map(|[x, y]| Vec2::new(x, y));
            let mut exact = solved(walled(1e-2 * tolerance), inside, false, false);
            let [velocity, ..] = sample_errors(&mut flow, &mut exact, &points);
            println!("samples beside walls, {inside} {tolerance:e}: {:.2}", velocity / tolerance);
            assert!(velocity < tolerance, "{inside} {tolerance:e}: {velocity:e}");
        }
    }
}

/// Errors of velocity, pressure and gradient at points by fast sums, over the largest values: against the sums over
/// pairs, which few points get, of a flow whose walls are exact, with the same velocities and the same close points.
fn sample_errors(flow: &mut InterfaceFlow, exact: &mut InterfaceFlow, points: &[Vec2]) -> [f64; 3] {
    exact.velocities.clone_from(&flow.velocities);
    exact.sampler = Sampler::new(flow.settings.tolerance);
    let nodes = flow.layers.starts[flow.layers.curves.len()];
    let times = (300_000 / nodes).div_ceil(points.len());
    let many: Vec<Vec2> = points.iter().copied().cycle().take(times * points.len()).collect();
    assert!(pays(&flow.layers, &many));
    let mut found = vec![FlowSample::default(); many.len()];
    flow.sample(&many, &mut found).unwrap();
    let mut expected = vec![FlowSample::default(); points.len()];
    // By so few that sums over pairs cost less.
    let few = (100_000 / nodes).max(1);
    for (points, out) in points.chunks(few).zip(expected.chunks_mut(few)) {
        assert!(!pays(&exact.layers, points));
        exact.sample(points, out).unwrap();
    }
    let largest = |of: &dyn Fn(&FlowSample) -> f64| expected.iter().map(of).fold(0.0, f64::max);
    let speed = largest(&|sample| sample.velocity.length());
    let pressure = largest(&|sample| sample.pressure.abs());
    let slope = largest(&|sample| sample.gradient.as_flattened().iter().fold(0.0, |a, b| a.max(b.abs())));
    let mut errors = [0.0f64; 3];
    for (found, expected) in found.iter().zip(expected.iter().cycle()) {
        let slopes = found.gradient.as_flattened().iter().zip(expected.gradient.as_flattened());
        errors = [
            errors[0].max(found.velocity.distance(expected.velocity) / speed),
            errors[1].max((found.pressure - expected.pressure).abs() / pressure),
            errors[2].max(slopes.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / slope),
        ];
    }
    errors
}

#[test]
fn a_raster_around_one_droplet_is_that_of_sums_over_pairs() {
    const NODES: usize = 48;
    let at = |k: usize| angle(k, NODES);
    let outline: Vec<Vec2> = (0..NODES).map(|k| Vec2::new(0.4 + 1.2 * at(k).cos(), 0.9 * at(k).sin())).collect();
    let tension: Vec<f64> = (0..NODES).map(|k| 1.0 + 0.5 * at(k).cos() + 0.2 * (2.0 * at(k)).sin()).collect();
    let mut calculus = PeriodicCalculus::new(NODES).unwrap();
    let mut forces = vec![Vec2::ZERO; NODES];
    calculus.tension_forces(&outline, &tension, TensionPlacement::Points, &mut forces).unwrap();
    const WIDTH: usize = 80;
    let raster = |[lx, ly]: [f64; 2]| -> Vec<Vec2> {
        let at = |k: usize, length: f64| (k as f64 / WIDTH as f64 - 0.5) * length;
        (0..WIDTH * WIDTH).map(|k| Vec2::new(at(k % WIDTH, lx), at(k / WIDTH, ly))).collect()
    };
    let flux = Drive::Flux(0.2);
    for (region, lengths, strain) in [
        (Region::Box { lengths: [6.0, 6.0] }, [6.0, 6.0], 0.0),
        (Region::Box { lengths: [4.0, 9.0] }, [4.0, 9.0], 0.3),
        (Region::Channel { length: 8.0, width: 4.0, drive: flux }, [8.0, 3.999], 0.0),
        (Region::Channel { length: 16.0, width: 2.2, drive: flux }, [16.0, 2.199], 0.0),
    ] {
        for (inside, tolerance) in [(1.0, 1e-3), (1.0, 1e-6), (10.0, 1e-6), (10.0, 1e-8), (1.0, 1e-10)] {
            let [mut flow, mut exact] = [tolerance, 1e-2 * tolerance].map(|tolerance| {
                let settings = Settings { nodes: NODES, ..settings(tolerance) };
                let mut flow = InterfaceFlow::new(region, 1.0, settings).unwrap();
                flow.layers.set_strain(strain);
                flow.load([Interface::closed(&outline, &forces, [inside, 1.0])].into_iter()).unwrap();
                flow.solve().unwrap();
                flow
            });
            let errors = sample_errors(&mut flow, &mut exact, &raster(lengths));
            println!("raster, {region:?} {inside} {tolerance:e}: {:?}", errors.map(|e| e / tolerance));
            assert!(errors[0].max(errors[1]) < tolerance, "{region:?} {inside} {tolerance:e}: {errors:?}");
            // A derivative further.
            assert!(errors[2] < 3.0 * tolerance, "{region:?} {inside} {tolerance:e}: {errors:?}");
        }
    }
}

#[test]
fn samples_are_those_of_sums_over_pairs() {
    // In the fluid, in droplets, in a film, at and beside a node, beside a wall and outside of the first image.
    let cell = SIDE / COUNT as f64;
    let node = droplets(SIDE, FILM)[7].0[5];
    let points = [
        Vec2::new(0.3 - 0.5 * SIDE, 0.01 - 0.5 * SIDE),
        Vec2::new(0.0, 0.0),
        Vec2::new(0.5 * cell, 0.0),
        Vec2::new(0.5 * cell - 0.02, 0.1),
        node,
        node + Vec2::new(1e-7, 2e-7),
        node + Vec2::new(3e-3, -2e-3),
        Vec2::new(0.2, 0.5 * SIDE),
        Vec2::new(2.2, -0.5 * SIDE + 0.02),
        Vec2::new(SIDE, 1.0),
        Vec2::new(-1.37 * SIDE, 2.3),
    ];
    for region in [BOX, CHANNEL, Region::Plane] {
        for (inside, rigid) in [(1.0, false), (10.0, false), (10.0, true)] {
            for tolerance in [1e-4, 1e-6, 1e-9] {
                let new = InterfaceFlow::new(region, 1.0, settings(tolerance)).unwrap();
                let mut flow = solved(new, inside, rigid, true);
                let exact = InterfaceFlow::new(region, 1.0, settings(1e-2 * tolerance)).unwrap();
                let errors = sample_errors(&mut flow, &mut solved(exact, inside, rigid, false), &points);
                println!("samples, {region:?} {inside} {rigid} {tolerance:e}: {:?}", errors.map(|e| e / tolerance));
                assert!(errors.iter().all(|error| *error < tolerance), "{region:?} {inside} {rigid}: {errors:?}");
            }
        }
    }
}

#[test]
fn a_droplet_near_a_wall_refines_no_other() {
    // The first one, of fewer nodes than the film needs, has its fine nodes; the other's are as they were.
    let region = Region::Channel { length: 8.0, width: 6.0, drive: Drive::ZeroGradient };
    let moved = |nodes: usize| {
        let at = |k: usize| angle(k, nodes);
        let circle = |x: f64, y: f64| (0..nodes).map(|k| Vec2::new(x + at(k).cos(), y + at(k).sin())).collect();
        let outlines: [Vec<Vec2>; 2] = [circle(-1.5, -1.9), circle(1.5, 0.5)];
        let mut calculus = PeriodicCalculus::new(nodes).unwrap();
        let tension: Vec<f64> = (0..nodes).map(|k| 1.0 + 0.5 * at(k).sin()).collect();
        let mut forces = [(); 2].map(|()| vec![Vec2::ZERO; nodes]);
        for (outline, forces) in outlines.iter().zip(&mut forces) {
            calculus.tension_forces(outline, &tension, TensionPlacement::Points, forces).unwrap();
        }
        let settings = Settings { nodes, tolerance: 1e-10, ..Settings::default() };
        let mut flow = InterfaceFlow::new(region, 1.0, settings).unwrap();
        let given = outlines.iter().zip(&forces);
        flow.load(given.map(|(outline, forces)| Interface::closed(outline, forces, [3.0, 1.0]))).unwrap();
        flow.solve().unwrap();
        let walls = flow.layers.walls.as_ref().unwrap();
        let refined = [walls.refines(0), walls.refines(1)];
        let velocities = [0, 1].map(|number| {
            let mut out = vec![Vec2::ZERO; nodes];
            flow.velocities(number, &mut out).unwrap();
            out.into_iter().step_by(nodes / 64).collect::<Vec<_>>()
        });
        (refined, velocities.concat())
    };
    let ((refined, found), (_, expected)) = (moved(64), moved(256));
    assert_eq!(refined, [true, false]);
    let error = error(&found, &expected);
    assert!(error < 1e-7, "{error:e}");
}
