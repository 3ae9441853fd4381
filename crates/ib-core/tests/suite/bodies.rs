//! Expectations of scenes of their bodies and films, against the flow of the grid.

use std::f64::consts::TAU;

use ib_core::{BSpline, ImmersedBoundary};
use motile_base::Vec2;
use motile_scene::{MarkerBody, MarkerKind, Scene, StepSize, gap::Repulsion};
use stokes_grid::{Grid, PeriodicStokes};

/// A box of 3.2 by 3.2 with grid spacing 0.1.
fn solver(viscosity: f64) -> PeriodicStokes {
    let grid = Grid::periodic(32, 32, 0.1).expect("a grid");
    PeriodicStokes::new(grid, viscosity).expect("a solver")
}

/// Bodies with their markers on the grid.
fn scene(viscosity: f64) -> Scene<ImmersedBoundary<PeriodicStokes, BSpline<4>>> {
    let flow = ImmersedBoundary::new(solver(viscosity), BSpline::<4>);
    Scene::new(flow).with_step_size(StepSize::Fixed(0.05))
}

fn circle(centre: Vec2, radius: f64) -> Vec<Vec2> {
    let count = (TAU * radius / 0.08).ceil().max(16.0);
    (0..count as usize)
        .map(|k| centre + radius * Vec2::new((TAU * k as f64 / count).cos(), (TAU * k as f64 / count).sin()))
        .collect()
}

/// Markers on a circle, each tethered to the origin by a spring of 3.
fn tethered(count: usize, radius: f64) -> MarkerBody {
    let place = |k: usize| Vec2::new(0.3, 0.0) + radius * Vec2::new((k as f64).cos(), (k as f64).sin());
    MarkerBody::new("tethered", (0..count).map(place).collect(), |positions, forces| {
        for (force, position) in forces.iter_mut().zip(positions) {
            *force = -3.0 * position;
        }
    })
    .with_stiffness(3.0)
    .expect("a stiffness")
}

#[test]
fn the_fastest_decay_is_estimated_from_above() {
    for (count, radius) in [(1, 0.0), (1, 0.2), (7, 0.05), (60, 0.5)] {
        let mut scene = scene(2.0);
        let handle = scene.add(tethered(count, radius));
        // The midpoint rule is stable to 2 over the rate.
        let estimate = 2.0 / scene.step_limit().unwrap().0;
        let centre = |scene: &Scene<_>| scene.body(handle).unwrap().markers().iter().sum::<Vec2>().x;
        let before = centre(&scene);
        let dt = 1e-3 / estimate;
        scene.step(dt).unwrap();
        let measured = -(centre(&scene) / before).ln() / dt;
        assert!(measured < estimate && measured > 0.2 * estimate, "{count} {radius}: {measured} {estimate}");
    }
}

/// A ring of springs between neighbours, at rest, whose law alone says how stiff it is: the largest rate of change of
/// displacements in the flow of the grid, by the power method.
#[test]
fn the_fastest_decay_of_springs_is_estimated_from_above() {
    for (count, radius) in [(8, 0.5), (24, 0.8), (64, 1.0), (128, 1.0), (300, 1.0)] {
        let mut scene = scene(2.0);
        let place = |k: usize| radius * Vec2::from_angle(TAU * k as f64 / count as f64);
        let rest = place(0).distance(place(1));
        let law = move |positions: &[Vec2], forces: &mut [Vec2]| {
            for k in 0..count {
                let next = (k + 1) % count;
                let spring = positions[next] - positions[k];
                let pull = 3.0 * (spring.length() - rest) * spring.normalize();
                forces[k] += pull;
                forces[next] -= pull;
            }
        };
        let handle = scene.add(MarkerBody::new("ring", (0..count).map(place).collect(), law));
        let estimate = 2.0 / scene.step_limit().unwrap().0;
        let mut direction: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle((k * k) as f64)).collect();
        let mut measured = 0.0;
        for _ in 0..60 {
            let norm = direction.iter().map(|d| d.length_squared()).sum::<f64>().sqrt();
            for (k, marker) in scene.body_mut(handle).unwrap().markers_mut().iter_mut().enumerate() {
                *marker = place(k) + 1e-6 / norm * direction[k];
            }
            direction = scene.system_mut().evaluate().unwrap().velocities().to_vec();
            measured = direction.iter().map(|d| d.length_squared()).sum::<f64>().sqrt() / 1e-6;
        }
        println!("{count} {radius}: {measured} {estimate}");
        assert!(measured < estimate && measured > 0.5 * estimate, "{count} {radius}: {measured} {estimate}");
    }
}

/// The bound on the step is for flat interfaces that slip; the repulsion of circles, which face each other along a
/// fifth of their length and do not slip, decays at some part of that rate.
#[test]
fn the_bound_of_the_repulsion_is_that_of_its_decay() {
    let approach = |gap: f64| {
        let mut scene = scene(10.0).with_repulsion(Repulsion::new(50.0, 0.4).unwrap());
        let free = |x: f64| {
            MarkerBody::new("free", circle(Vec2::new(x, 0.0), 0.6), |_, _| {})
                .with_kind(MarkerKind::Interface { viscosity_inside: None })
        };
        let [left, right] = [-0.6 - 0.5 * gap, 0.6 + 0.5 * gap].map(|x| scene.add(free(x)));
        scene.system_mut().evaluate().unwrap();
        let (limit, ..) = scene.step_limit().unwrap();
        let [left, right] = [left, right].map(|handle| {
            let flow = scene.system().flow_at(handle).unwrap();
            flow.velocities
                .iter()
                .map(|velocity| velocity.x)
                .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a })
        });
        (right - left, limit)
    };
    for gap in [0.05, 0.1, 0.2] {
        let ((near, limit), (far, _)) = (approach(gap), approach(1.01 * gap));
        let rate = (near - far) / (0.01 * gap);
        assert!((0.02..0.8).contains(&(rate * limit / 2.0)), "{gap}: {rate} {limit}");
    }
}
