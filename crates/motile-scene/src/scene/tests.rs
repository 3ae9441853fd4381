use super::*;
use crate::error::refused;
use crate::hydrodynamics::tests::DragBox;
use crate::integrator::IntegratorKind;
use crate::{BodyError, BodyFlow, FluidView, MarkerBody};
use motile_base::Vec2;

fn scene() -> Scene<DragBox> {
    Scene::new(DragBox::new(3.2, 1.0, 0.1))
}

/// Two points that a force pulls along x, the more the closer they are, and y.
fn pulled(name: &str) -> MarkerBody {
    let places = vec![Vec2::ZERO, Vec2::new(0.5, 0.2)];
    MarkerBody::new(name, places, |positions, forces| {
        forces.copy_from_slice(&[Vec2::X / (1.0 + positions[0].distance(positions[1])), Vec2::Y]);
    })
}

/// The mean velocity of its markers.
impl Observe for MarkerBody {
    type Observables = Vec2;

    fn observables(&self, _: &FluidView, flow: &BodyFlow<'_>) -> Result<Vec2, BodyError> {
        Ok(flow.velocities.iter().sum::<Vec2>() / flow.velocities.len() as f64)
    }
}

#[test]
fn a_handle_knows_its_scene() {
    let (mut first, mut second) = (scene(), scene());
    let foreign = [first.add(pulled("a")), first.add(pulled("b"))];
    let own = second.add(pulled("c"));
    assert_eq!(second.body(own).unwrap().name(), "c");
    // The first has an index that the second scene has too, the other one has not.
    for handle in foreign {
        assert!(second.body(handle).is_err_and(|error| refused(&error, "the handle is of a body of another scene")));
        assert!(
            second.body_mut(handle).is_err_and(|error| refused(&error, "the handle is of a body of another scene"))
        );
        assert!(second.observe(handle).is_err_and(|error| refused(&error, "the handle is of a body of another scene")));
        assert!(
            second
                .system()
                .any_body(handle)
                .is_err_and(|error| refused(&error, "the handle is of a body of another scene"))
        );
        assert!(
            second
                .system()
                .flow_at(handle)
                .is_err_and(|error| refused(&error, "the handle is of a body of another scene"))
        );
        assert_ne!(handle, own);
    }
    // With another integrator, and after a checkpoint, it is the same scene.
    let mut second = second.advanced_by(IntegratorKind::Midpoint);
    let checkpoint = second.checkpoint("");
    second.resume(&checkpoint).unwrap();
    assert_eq!(second.body(own).unwrap().name(), "c");
}

#[test]
fn bodies_are_found_by_their_type() {
    let mut scene = scene();
    let handles = [scene.add(pulled("a")), scene.add(pulled("b"))];
    let found: Vec<_> = scene.system().bodies::<MarkerBody>().map(|(handle, body)| (handle, body.name())).collect();
    assert_eq!(found, [(handles[0], "a"), (handles[1], "b")]);
    let names: Vec<_> = scene.system().all_bodies().map(|(_, body)| body.name()).collect();
    assert_eq!(names, ["a", "b"]);
}

#[test]
fn a_body_is_observed_in_its_present_state() {
    let mut scene = scene();
    let handle = scene.add(pulled("a"));
    let error = scene.system().flow_at(handle).unwrap_err();
    assert!(refused(&error, "is not known in the present state. Call `evaluate` first"), "{error}");
    let seen = scene.observe(handle).unwrap();
    assert!(seen.x > 0.01 && seen.y > 0.01, "{seen}");
    // What was known is of no use after the body has been changed.
    scene.body_mut(handle).unwrap().markers_mut()[1] = Vec2::new(0.1, 0.0);
    assert!(scene.system().flow_at(handle).is_err());
    assert!(scene.observe(handle).unwrap().x > seen.x + 0.005);
}

/// A polygon of tension gamma and spacing ds relaxes at most at the rate 4 gamma/(zeta ds).
#[test]
fn a_substrate_says_what_is_stable() {
    let view = crate::Substrate::new(3.0).unwrap().fluid_view();
    assert!((view.interface_stiffness / view.viscosity - 4.0 / (3.0 * 0.05)).abs() < 1e-12);
}
