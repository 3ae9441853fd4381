use motile_base::Vec2;

use super::*;
use crate::{ActiveDroplet, Curve};
use motile_scene::{Body, Domain};

/// A fluid of viscosity 3 without walls, on a grid of spacing 0.1.
fn view() -> FluidView {
    FluidView {
        domain: Domain { origin: [0.0; 2], periods: [None; 2].into(), walls: None },
        viscosity: 3.0,
        spacing: Some(0.1),
        shape_modes: None,
        nodes: None,
        second_order: true,
        interface_stiffness: 0.5,
    }
}

fn limits_of(droplet: &ActiveDroplet) -> Vec<(&'static str, f64)> {
    let view = view();
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

/// An elastic interface decays fastest in its shortest wave q, at the rate `q (E + B q^2)/(2 (eta_in + eta_ext))`.
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
            nodes: None,
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

/// A law with values `4 + f(c)`, and a slope of its own.
#[derive(Debug)]
struct Law {
    value: fn(f64) -> f64,
    slope: fn(f64) -> f64,
}

impl Tension for Law {
    fn value(&self, c: f64) -> f64 {
        4.0 + (self.value)(c)
    }
    fn slope(&self, c: f64) -> f64 {
        (self.slope)(c)
    }
}

/// Returns a droplet with 10 particles per length and that law.
fn with_law(value: fn(f64) -> f64, slope: fn(f64) -> f64) -> ActiveDroplet {
    let markers = Curve::circle(1.0).unwrap().markers(64).unwrap();
    ActiveDroplet::new(&markers, vec![TAU * 10.0 / 64.0; 64], Law { value, slope }, 0.1).unwrap()
}

/// A slope is told from the slope of the values by 5 %, unless it lies between the slopes on both sides of a kink.
#[test]
fn a_wrong_slope_of_the_tension_is_told() {
    let level = |c: f64| 3.0 * c / (c + 10.0);
    let exact = |c: f64| 30.0 / (c + 10.0).powi(2);
    let told =
        |value, slope| with_law(value, slope).interface.wrong_slope().map(|(_, excess, message)| (excess, message));
    assert_eq!(told(level, exact), None);
    assert_eq!(told(level, |c| 1.04 * 30.0 / (c + 10.0).powi(2)), None);
    assert_eq!(told(|c| c.min(10.0), |c| if c < 10.0 { 1.0 } else { 0.0 }), None);
    assert_eq!(told(|_| 1e9, |_| 0.0), None);
    let wrong: [fn(f64) -> f64; 5] = [
        |c| -30.0 / (c + 10.0).powi(2),
        |c| 1.07 * 30.0 / (c + 10.0).powi(2),
        |_| 0.0,
        |_| f64::INFINITY,
        |_| f64::NAN,
    ];
    for slope in wrong {
        assert!(told(level, slope).is_some_and(|(excess, _)| excess > 1.0), "{:?}", told(level, slope));
    }
    let (_, message) = told(level, |_| 0.0).unwrap();
    assert!(message.contains("`slope` of the tension law returns 0 at c = 5, but"), "{message}");
}

#[test]
fn a_law_that_is_not_finite_is_named() {
    let view = view();
    let mut forces = vec![Vec2::ZERO; 64];
    let mut droplet = with_law(|c| (9.0 - c).sqrt(), |_| 0.0);
    let error = droplet.write_forces(&view, &mut forces).unwrap_err().to_string();
    assert!(error.starts_with("the tension law returns NaN at c = 9.99598"), "{error}");
    assert!(with_law(|c| (11.0 - c).sqrt(), |_| 0.0).write_forces(&view, &mut forces).is_ok());
}
