use motile_base::Vec2;

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

/// An elastic interface decays fastest in its shortest wave q, at the rate `q (E + B q^2)/(2 (eta_in + eta_out))`.
#[test]
fn the_bound_of_an_elastic_interface_by_hand() {
    let markers: Vec<Vec2> = (0..32).map(|k| Vec2::new(0.125 * f64::from(k), 0.0)).collect();
    let elastic = |inside: f64| {
        let interface = ActiveInterface::periodic_passive(&markers, 4.0, 0.0).unwrap();
        let interface = interface.with_elasticity(5.0, 0.02).unwrap().with_viscosity_inside(inside).unwrap();
        let view = FluidView {
            domain: Domain { origin: [0.0; 2], periods: [Some(4.0), None].into(), walls: None },
            viscosity: 3.0,
            spacing: Some(0.1),
            shape_modes: None,
            second_order: true,
            interface_stiffness: 0.5,
        };
        let mut found = None;
        interface.step_limits(&view, &mut |limit| {
            if limit.reason == "the elasticity of the interface" {
                found = Some(limit.dt);
            }
        });
        found.unwrap()
    };
    let wave = PI / 0.125;
    for inside in [3.0, 9.0] {
        let rate = wave * (5.0 + 0.02 * wave * wave) / (2.0 * (inside + 3.0));
        assert!((elastic(inside) * rate / 2.0 - 1.0).abs() < 1e-9, "{inside}: {} {rate}", elastic(inside));
    }
}
