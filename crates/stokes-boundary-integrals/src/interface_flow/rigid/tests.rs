use crate::error::refused;
use crate::{Interface, InterfaceFlow, LayerCurve, LayerError, PeriodicCalculus, Settings, TensionPlacement};
use motile_base::{Drive, FlowSample, Region, Vec2};
use std::f64::consts::TAU;

const LENGTH: f64 = 6.0;

fn angle(k: usize, count: usize) -> f64 {
    TAU * k as f64 / count as f64
}

/// A side of a channel: `height` of x, the fluid above it (1) or below it (-1).
fn side(height: impl Fn(f64) -> f64, fluid: f64, count: usize) -> (Vec<Vec2>, Vec2) {
    let x = |k: usize| fluid * LENGTH * (k as f64 / count as f64 - 0.5);
    ((0..count).map(|k| Vec2::new(x(k), height(x(k)))).collect(), Vec2::new(fluid * LENGTH, 0.0))
}

/// Flow between two sides and around posts in a wider channel.
fn walled(
    width: f64,
    drive: Drive,
    nodes: usize,
    half_width: impl Fn(f64) -> f64,
    posts: &[Vec<Vec2>],
    settings: Settings,
) -> Result<InterfaceFlow, LayerError> {
    let sides = [side(|x| -half_width(x), 1.0, nodes), side(&half_width, -1.0, nodes)];
    let open = sides.iter().map(|(positions, period)| LayerCurve { positions, period: *period, nodes });
    let closed = posts.iter().map(|positions| LayerCurve { positions, period: Vec2::ZERO, nodes: positions.len() });
    let region = Region::Channel { length: LENGTH, width, drive };
    InterfaceFlow::new(region, 1.0, settings)?.with_walls(open.chain(closed))
}

fn settings(nodes: usize) -> Settings {
    Settings { nodes, tolerance: 1e-13, warm_start: false, ..Settings::default() }
}

/// An ellipse with tension 1 + 0.5 cos(t - 0.7) and the viscosity inside; velocities at its points.
fn moved(flow: &mut InterfaceFlow, centre: Vec2, axes: [f64; 2], inside: f64) -> Result<Vec<Vec2>, LayerError> {
    let count = flow.settings().nodes;
    let at = |k: usize| angle(k, count);
    let positions: Vec<Vec2> =
        (0..count).map(|k| centre + Vec2::new(axes[0] * at(k).cos(), axes[1] * at(k).sin())).collect();
    let tension: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * (at(k) - 0.7).cos()).collect();
    let mut forces = vec![Vec2::ZERO; count];
    PeriodicCalculus::new(count)?.tension_forces(&positions, &tension, TensionPlacement::Points, &mut forces)?;
    flow.load([Interface::closed(&positions, &forces, [inside, 1.0])].into_iter())?;
    flow.solve()?;
    let mut velocities = vec![Vec2::ZERO; count];
    flow.velocities(0, &mut velocities)?;
    Ok(velocities)
}

fn largest(a: &[Vec2], b: &[Vec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max)
}

fn samples(flow: &mut InterfaceFlow, points: &[Vec2]) -> Vec<FlowSample> {
    let mut out = vec![FlowSample::default(); points.len()];
    flow.sample(points, &mut out).unwrap();
    out
}

/// Straight walls as layers in a higher channel against the Green's function of the straight channel.
#[test]
fn straight_walls_are_those_of_the_straight_channel() {
    for drive in [Drive::ZeroGradient, Drive::Gradient(-0.3), Drive::ZeroFlux, Drive::Flux(0.2)] {
        for inside in [1.0, 8.0, 0.2] {
            // The droplet nearly touches the upper wall: a film of 0.05.
            let (centre, axes) = (Vec2::new(2.8, 0.15), [1.1, 0.8]);
            let region = Region::Channel { length: LENGTH, width: 2.0, drive };
            let mut straight = InterfaceFlow::new(region, 1.0, settings(160)).unwrap();
            let expected = moved(&mut straight, centre, axes, inside).unwrap();
            let mut layered = walled(3.0, drive, 240, |_| 1.0, &[], settings(160)).unwrap();
            let found = moved(&mut layered, centre, axes, inside).unwrap();
            let error = largest(&expected, &found);
            let points = [Vec2::new(0.0, -0.99), Vec2::new(2.8, 0.97), Vec2::new(-2.0, 0.3), Vec2::new(2.5, 0.2)];
            let [a, b] = [&mut straight, &mut layered].map(|flow| samples(flow, &points));
            let between = a.iter().zip(&b).map(|(a, b)| (a.velocity - b.velocity).length()).fold(0.0, f64::max);
            let [a, b] = [&mut straight, &mut layered].map(|flow| flow.solve().unwrap().pressure_gradient);
            println!("{drive:?} {inside}: {error:.1e} {between:.1e} {:.1e}", a - b);
            assert!(error < 1e-10 && between < 1e-10 && (a - b).abs() < 1e-10, "{drive:?} {inside}");
        }
    }
}

fn wave(x: f64) -> f64 {
    1.0 + 0.2 * (TAU * x / LENGTH).cos()
}

/// Against finer nodes: a droplet in a wavy channel beside a post, films of 0.1 and 0.01.
#[test]
fn droplets_between_curved_walls_converge() {
    let post: Vec<Vec2> =
        (0..48).map(|k| Vec2::new(-1.6 + 0.3 * angle(k, 48).cos(), 0.2 + 0.3 * angle(k, 48).sin())).collect();
    for (film, inside, bounds) in [(0.1, 1.0, [1e-6, 1e-11]), (0.01, 0.1, [2e-4, 2e-6])] {
        // Close to the wall at its widest place, from below.
        let centre = Vec2::new(0.1, wave(0.0) - film - 0.6);
        let at = |nodes: usize, droplet: usize| {
            let posts = std::slice::from_ref(&post);
            let mut flow = walled(3.0, Drive::Gradient(-0.1), nodes, wave, posts, settings(droplet)).unwrap();
            let velocities = moved(&mut flow, centre, [0.7, 0.6], inside).unwrap();
            velocities.into_iter().step_by(droplet / 32).collect::<Vec<_>>()
        };
        let reference = at(256, 192);
        let errors = [(64, 32), (96, 64)].map(|(nodes, droplet)| largest(&at(nodes, droplet), &reference));
        println!("{film} {inside}: {errors:?}");
        assert!(errors[0] < bounds[0] && errors[1] < bounds[1], "{film} {inside}: {errors:?}");
    }
}

/// Between the nodes of walls nothing flows, the flux is the same everywhere, and a given one is what flows.
#[test]
fn nothing_flows_through_walls() {
    for (inside, flux) in [(1.0, 0.4), (5.0, -0.2)] {
        let mut flow = walled(3.0, Drive::Flux(flux), 96, wave, &[], settings(64)).unwrap();
        let velocities = moved(&mut flow, Vec2::new(0.3, 0.2), [0.8, 0.7], inside).unwrap();
        assert!(velocities.iter().any(|v| v.length() > 0.05));
        let on_wall: Vec<Vec2> = (0..97).map(|k| 0.063 * f64::from(k) - 3.0).map(|x| Vec2::new(x, wave(x))).collect();
        let leak = samples(&mut flow, &on_wall).iter().map(|s| s.velocity.length()).fold(0.0, f64::max);
        assert!(leak < 1e-10, "{leak:e}");
        for x in [-3.0, -1.2, 1.7] {
            let places = motile_base::internal::gauss_legendre(64)
                .into_iter()
                .map(|(at, weight)| (wave(x) * at, wave(x) * weight));
            let found: f64 =
                places.map(|(y, weight)| samples(&mut flow, &[Vec2::new(x, y)])[0].velocity.x * weight).sum();
            assert!((found - flux).abs() < 1e-9, "{x}: {found} {flux}");
        }
    }
}

/// Without tension and of the same viscosity as the rest, interfaces move as the fluid does without them.
#[test]
fn what_has_no_tension_moves_with_the_flow() {
    let mut flow = walled(3.0, Drive::Gradient(-1.0), 96, wave, &[], settings(48)).unwrap();
    let points: Vec<Vec2> =
        (0..48).map(|k| Vec2::new(0.4 + 0.5 * angle(k, 48).cos(), 0.3 + 0.4 * angle(k, 48).sin())).collect();
    flow.load(std::iter::empty()).unwrap();
    let alone = samples(&mut flow, &points);
    let forces = vec![Vec2::ZERO; 48];
    flow.load([Interface::closed(&points, &forces, [1.0; 2])].into_iter()).unwrap();
    flow.solve().unwrap();
    let mut velocities = vec![Vec2::ZERO; 48];
    flow.velocities(0, &mut velocities).unwrap();
    for (sample, velocity) in alone.iter().zip(&velocities) {
        assert!((sample.velocity - *velocity).length() < 1e-11 && velocity.x > 0.1, "{velocity}");
    }
}

/// A droplet whose last modes are large, as one is that is not resolved, beside a wall that it does not reach.
#[test]
fn a_rough_droplet_is_not_beyond_a_wall() {
    let mut flow =
        walled(3.0, Drive::default(), 192, |_| 1.0, &[], Settings { tolerance: 1e-8, ..settings(64) }).unwrap();
    // Numbers between -1 and 1 without a pattern.
    let mut state = 1_u64;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 23) - 1.0
    };
    for round in 0..200 {
        let modes: Vec<[f64; 2]> = (0..20).map(|_| [0.03 * noise(), 0.03 * noise()]).collect();
        let rough = |t: f64| {
            let waves =
                modes.iter().zip(10..).map(|([a, b], m)| a * (f64::from(m) * t).cos() + b * (f64::from(m) * t).sin());
            (0.6 + waves.sum::<f64>()) * Vec2::from_angle(t)
        };
        let mut positions: Vec<Vec2> = (0..64).map(|k| rough(angle(k, 64))).collect();
        let top = (0..2000).map(|k| rough(angle(k, 2000)).y).fold(0.0, f64::max);
        positions.iter_mut().for_each(|x| x.y += 0.94 - top);
        let forces = vec![Vec2::ZERO; 64];
        let loaded = flow.load([Interface::closed(&positions, &forces, [1.0, 1.0])].into_iter());
        let solved = loaded.and_then(|()| flow.solve());
        assert!(solved.is_ok(), "{round}: {solved:?}");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let build = |width: f64, half_width: fn(f64) -> f64, posts: &[Vec<Vec2>]| {
        walled(width, Drive::default(), 64, half_width, posts, settings(48)).map(drop).unwrap_err()
    };
    let circle = |centre: Vec2, radius: f64| -> Vec<Vec2> {
        (0..32).map(|k| centre + radius * Vec2::from_angle(angle(k, 32))).collect()
    };
    assert!(matches!(build(2.2, wave, &[]), LayerError::BeyondWall { .. }));
    assert!(refused(&build(3.0, |x| wave(x) - 1.1, &[]), "wall 0 crosses or touches wall 1 near ("));
    let post = circle(Vec2::new(2.9, -0.8), 0.3);
    assert!(refused(&build(3.0, wave, &[post]), "wall 0 crosses or touches wall 2 near ("));
    let posts = [circle(Vec2::new(2.9, 0.0), 0.3), circle(Vec2::new(-2.7, 0.1), 0.3)];
    assert!(refused(&build(3.0, wave, &posts), "wall 2 crosses or touches wall 3 near ("));
    let eight: Vec<Vec2> = (0..64).map(|k| angle(k, 64)).map(|t| Vec2::new(t.sin(), 0.4 * (2.0 * t).sin())).collect();
    let error = build(3.0, wave, &[eight]);
    let crosses = refused(&error, "wall 2 crosses itself near (");
    assert!(crosses || matches!(error, LayerError::Clockwise { .. }), "{error}");
    let mut plane = InterfaceFlow::new(Region::Plane, 1.0, settings(48)).unwrap();
    plane.load(std::iter::empty()).unwrap();
    let positions = circle(Vec2::ZERO, 1.0);
    let wall = LayerCurve { positions: &positions, period: Vec2::ZERO, nodes: 32 };
    let error = plane.with_walls([wall].into_iter()).unwrap_err();
    assert!(refused(&error, "rigid walls and obstacles need a channel around them"), "{error}");
    // Droplets beyond walls or in posts, close to them and far from them.
    let mut flow = walled(4.0, Drive::default(), 64, wave, &[circle(Vec2::new(-1.0, 0.0), 0.6)], settings(48)).unwrap();
    for (centre, radius) in [((0.0, 1.1), 0.2), ((0.0, 1.65), 0.2), ((-1.0, 0.0), 0.2), ((-1.5, 0.0), 0.3)] {
        let error = moved(&mut flow, centre.into(), [radius; 2], 1.0).unwrap_err();
        assert!(matches!(error, LayerError::CrossesWall { curve: 0, .. }), "{error}");
    }
    assert!(moved(&mut flow, Vec2::new(0.6, 0.0), [0.6; 2], 1.0).is_ok());
    // Once they are in place, when they come to cross.
    assert!(moved(&mut flow, Vec2::new(0.6, 0.62), [0.6; 2], 1.0).is_err());
}

#[test]
fn steady_state_allocates_nothing() {
    let mut flow = walled(3.0, Drive::Flux(0.1), 64, wave, &[], settings(48)).unwrap();
    let count = 48;
    let positions: Vec<Vec2> = (0..count).map(|k| 0.9 * Vec2::from_angle(angle(k, count))).collect();
    let forces: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(2.0 * angle(k, count))).collect();
    let mut velocities = vec![Vec2::ZERO; count];
    for inside in [1.0, 6.0] {
        let mut go = |flow: &mut InterfaceFlow| {
            flow.load([Interface::closed(&positions, &forces, [inside, 1.0])].into_iter()).unwrap();
            flow.solve().unwrap();
            flow.velocities(0, &mut velocities).unwrap();
        };
        go(&mut flow);
        go(&mut flow);
        assert_eq!(allocation_counter::measure(|| go(&mut flow)).count_total, 0);
    }
}
