use super::*;
use crate::{ActiveDroplet, Curve};
use motile_scene::{Body, Domain};

fn limits_of(droplet: &ActiveDroplet) -> Vec<(&'static str, f64)> {
    let view = FluidView {
        domain: Domain { origin: [0.0; 2], periods: [None; 2].into(), walls: None },
        viscosity: 3.0,
        spacing: Some(0.1),
        shape_modes: None,
        second_order: true,
        interface_stiffness: 0.5,
    };
    let mut found = Vec::new();
    droplet.step_limits(&view, &mut |limit| {
        assert_eq!(limit.cause, StepCause::Decay);
        found.push((limit.reason, limit.dt));
    });
    found
}

/// Modes that decay at the rate a are stable under the midpoint rule up to 2/a: a = s gamma / eta, eta the mean
/// viscosity of both sides, for the interface and the given rate for its markers.
#[test]
fn the_bounds_of_a_passive_droplet_by_hand() {
    let markers = Curve::circle(1.0).unwrap().markers(32).unwrap();
    let moving = |motion| ActiveDroplet::passive(&markers, 6.0).unwrap().with_motion(motion);
    let tension = "the surface tension";
    assert_eq!(limits_of(&moving(Motion::WithFluid)), [(tension, 2.0)]);
    let thick = moving(Motion::WithFluid).with_viscosity_inside(9.0).unwrap();
    assert_eq!(limits_of(&thick), [(tension, 4.0)]);
    // 50 times a fifth of 6 over 3 and the radius of a circle of the same perimeter, before any step.
    let mut droplet = moving(Motion::default());
    let spacing = |droplet: &ActiveDroplet| limits_of(droplet)[1];
    assert_eq!(spacing(&droplet).0, "the relaxation of the marker spacing");
    assert!((spacing(&droplet).1 - 0.1 * droplet.interface.geometry().perimeter / TAU).abs() < 1e-12);
    droplet.interface.derived.relaxation = 40.0;
    assert_eq!(spacing(&droplet).1, 0.05);
}
