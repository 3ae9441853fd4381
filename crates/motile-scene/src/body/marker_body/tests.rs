use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::hydrodynamics::tests::DragBox;
use crate::{Hydrodynamics, Scene, StepSize, Substrate};

fn scene() -> Scene<DragBox> {
    Scene::new(DragBox::new(3.2, 2.0, 0.1))
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
    .unwrap()
}

#[test]
fn moves_as_it_is_told() {
    let mut scene = scene();
    let driven =
        MarkerBody::new("driven", vec![Vec2::new(1.0, 0.0)], |_, _| {}).with_motion(|at, velocities, rates| {
            rates[0] = velocities[0] + Vec2::new(-at[0].y, at[0].x);
        });
    let handle = scene.add(driven);
    scene.run(1.0).step_size(StepSize::Fixed(0.01)).go().unwrap();
    let place = scene.body(handle).unwrap().markers()[0];
    assert!((place - Vec2::new(1.0_f64.cos(), 1.0_f64.sin())).length() < 1e-4, "{place}");
    scene.body_mut(handle).unwrap().markers_mut()[0].x = f64::NAN;
    assert!(scene.step(0.01).is_err());
}

#[test]
fn what_is_no_stiffness_and_no_force_is_refused_by_name() {
    for bad in [-3.0, f64::NAN, f64::INFINITY] {
        let refused = tethered(1, 0.0).with_stiffness(bad).unwrap_err().to_string();
        assert!(refused.starts_with("the stiffness is "), "{refused}");
    }
    let mut scene = scene();
    scene.add(tethered(3, 0.2));
    scene.add(MarkerBody::new("bead", vec![Vec2::ZERO], |_, forces| forces[0].y = f64::NAN));
    let error = scene.run(0.1).go().unwrap_err().explanation();
    assert_eq!(error, "at time 0 bead went wrong: entry 0 of the forces is NaN. Use finite numbers");
}

/// Circles of markers at rest that springs of `stiffness` hold together, neighbour to neighbour, and the calls of
/// their law.
fn ring(count: usize, stiffness: f64) -> (MarkerBody, Arc<AtomicUsize>) {
    let place = |k: usize| Vec2::from_angle(TAU * k as f64 / count as f64);
    let rest = place(0).distance(place(1));
    let calls = Arc::new(AtomicUsize::new(0));
    let counter = calls.clone();
    let law = move |positions: &[Vec2], forces: &mut [Vec2]| {
        counter.fetch_add(1, Ordering::Relaxed);
        for k in 0..positions.len() {
            let next = (k + 1) % positions.len();
            let spring = positions[next] - positions[k];
            let pull = stiffness * (spring.length() - rest) * spring.normalize();
            forces[k] += pull;
            forces[next] -= pull;
        }
    };
    (MarkerBody::new("ring", (0..count).map(place).collect(), law), calls)
}

/// The largest eigenvalue of a ring's Hessian is 2 k (1 + cos(2 pi/N)): that of the springs, which neighbours share.
#[test]
fn the_stiffness_of_a_ring_of_springs() {
    let view = scene().system().hydrodynamics().fluid_view();
    for count in [8, 30, 64, 200, 1500] {
        let (mut body, _) = ring(count, 5.0);
        let exact = 10.0 * (1.0 + (TAU / count as f64).cos());
        let mobility = Mobility::new(&view, &body.positions);
        let identity = |forces: &[Vec2], out: &mut [Vec2]| out.copy_from_slice(forces);
        let found = mobility.power_method(body.forces.get_mut(), identity);
        println!("{count}: {found} {exact}");
        assert!((found / exact - 1.0).abs() < 0.1, "{count}: {found} {exact}");
    }
}

/// The springs' shortest wave decays at a rate that hardly depends on the number of markers, and the step limit with
/// it: also where markers are so many that those far away are taken together.
#[test]
fn one_marker_more_does_not_change_the_step_limit() {
    let limit = |count: usize| {
        let mut scene = Scene::new(Substrate::new(3.0).unwrap());
        scene.add(ring(count, 5.0).0);
        scene.step_limit().unwrap().0
    };
    let limits = [999, 1000, 1001, 1002, 3000].map(limit);
    println!("{limits:?}");
    for few in &limits[..2] {
        for many in &limits[2..] {
            assert!((many / few - 1.0).abs() < 0.005, "{limits:?}");
        }
    }
}

/// Nothing but the springs' shortest waves decays fast: the ring is not held in its place. The law is asked when the
/// bound is asked for first, and a body that is loaded knows it.
#[test]
fn springs_between_markers_take_long_steps() {
    let flow = Substrate::new(3.0).unwrap();
    let mut scene = Scene::new(flow);
    let (body, calls) = ring(64, 5.0);
    let handle = scene.add(body);
    let (limit, reason, _) = scene.step_limit().unwrap();
    let asked = calls.load(Ordering::Relaxed);
    assert_eq!((scene.step_limit().unwrap().0, calls.load(Ordering::Relaxed), reason), (limit, asked, "the stiffness"));
    assert!((3..=30).contains(&asked), "{asked}");
    let stated = {
        let mut other = Scene::new(flow);
        other.add(ring(64, 5.0).0.with_stiffness(20.0).unwrap());
        other.step_limit().unwrap().0
    };
    println!("{limit} {stated}, {asked} calls");
    assert!(limit > 10.0 * stated, "{limit} {stated}");
    scene.body_mut(handle).unwrap().markers_mut()[3] *= 1.01;
    let shape = |scene: &Scene<_>| {
        let markers = scene.body(handle).unwrap().markers();
        markers.iter().map(|marker| (marker.length() - 1.0).abs()).fold(0.0, f64::max)
    };
    let before = shape(&scene);
    scene.run(200.0 * limit).step_size(StepSize::OfLimit(1.0)).go().unwrap();
    assert!(shape(&scene) < before && scene.steps() == 200, "{} {before}", shape(&scene));
    let settled = scene.checkpoint("");
    let mut again = Scene::new(flow);
    let (body, calls) = ring(64, 5.0);
    again.add(body);
    again.resume(&settled).unwrap();
    let after = calls.load(Ordering::Relaxed);
    assert_eq!(again.step_limit().map(|limit| limit.0), scene.step_limit().map(|limit| limit.0));
    assert_eq!(calls.load(Ordering::Relaxed), after);
}

/// Of tethers alone it is the estimate for a stated stiffness.
#[test]
fn tethers_are_found_as_if_stated() {
    let view = scene().system().hydrodynamics().fluid_view();
    for (count, radius) in [(1, 0.0), (1, 0.2), (7, 0.05), (60, 0.5), (200, 0.8)] {
        let stated = tethered(count, radius);
        let found = MarkerBody { stiffness: None, ..tethered(count, radius) };
        let [stated, found] = [stated.decay_rate(&view), found.decay_rate(&view)];
        println!("{count} {radius}: {found} {stated}");
        assert!((found / stated - 1.0).abs() < 0.05, "{count} {radius}: {found} {stated}");
    }
    let free = MarkerBody::new("free", vec![Vec2::X; 5], |_, forces| forces.fill(Vec2::Y));
    assert_eq!(free.decay_rate(&view), 0.0);
}
