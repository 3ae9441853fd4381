use super::*;
use crate::hydrodynamics::drag_box::DragBox;
use crate::{Scene, StepSize};

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
    let place = scene.body(handle).unwrap().positions()[0];
    assert!((place - Vec2::new(1.0_f64.cos(), 1.0_f64.sin())).length() < 1e-4, "{place}");
    scene.body_mut(handle).unwrap().positions_mut()[0].x = f64::NAN;
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
    assert_eq!(error, "at time 0 bead went wrong: entry 0 of the forces is NaN: give finite numbers");
}
