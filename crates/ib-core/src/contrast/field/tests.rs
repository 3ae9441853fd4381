use std::f64::consts::TAU;

use stokes_layers::Geometry;

use super::*;
use crate::{MarkerKind, Markers};

/// Above a straight interface on the x axis, half way between two nodes at a distance of 0.1.
fn above(distance: f64) -> Nearby {
    Nearby {
        foot: Vec2::ZERO,
        nodes: [0, 1],
        fraction: 0.5,
        along: Vec2::new(0.1, 0.0),
        away: Vec2::Y,
        distance,
        contrast: 1.0,
    }
}

/// A parabola across the interface and a straight line along it: u = 1 + 2 x + 3 y + 4 y^2, v = 5 - 2 y + y^2.
fn parabola(at: Vec2) -> (Vec2, [[f64; 2]; 2]) {
    let Vec2 { x, y } = at;
    let velocity = Vec2::new(1.0 + 2.0 * x + 3.0 * y + 4.0 * y * y, 5.0 - 2.0 * y + y * y);
    (velocity, [[2.0, 3.0 + 8.0 * y], [0.0, -2.0 + 2.0 * y]])
}

#[test]
fn parabolas_across_an_interface_are_found_exactly() {
    let on_nodes = [-0.05, 0.05].map(|x| parabola(Vec2::new(x, 0.0)).0);
    for y in [0.0, 0.03, 0.1, 0.19, 0.2, 0.39, 0.4, 0.7] {
        let point = Vec2::new(0.0, y);
        // What is nearer than the reach is not to be asked for.
        let asked = |at: Vec2| {
            assert!(at.y >= 0.2, "{at}");
            parabola(at)
        };
        let (velocity, gradient) = above(y).flow(point, [0.2, 0.1], &on_nodes, asked);
        let (expected, slopes) = parabola(point);
        assert!((velocity - expected).length() < 1e-13, "{y}: {velocity} {expected}");
        for (found, expected) in gradient.as_flattened().iter().zip(slopes.as_flattened()) {
            assert!((found - expected).abs() < 1e-12, "{y}: {gradient:?} {slopes:?}");
        }
    }
}

/// A circle of radius 1 that grows, v = r: tau . dv/ds = 1, so that the pressure inside makes up for
/// -2 (eta_in - eta); and forces along the normal are balanced by it.
#[test]
fn the_pressure_inside_balances_viscous_stresses_and_forces() {
    let count = 256;
    let circle: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(TAU * f64::from(k) / f64::from(count))).collect();
    let mut markers = Markers::new();
    markers.push_group(circle.len(), MarkerKind::Interface { viscosity_inside: Some(5.0) });
    markers.positions.copy_from_slice(&circle);
    let mut contrast = Contrast::new(Geometry::Box { lengths: [8.0; 2] }, 0.0, 2.0, 0.01).unwrap();
    contrast.load(&markers).unwrap();
    let (none, rest) = (vec![0.0; circle.len()], vec![Vec2::ZERO; circle.len()]);
    // A force per length of 1.
    let weight = contrast.curves()[0].perimeter() / f64::from(count);
    let pressed: Vec<Vec2> = circle.iter().map(|normal| weight * normal).collect();
    let one = vec![1.0; circle.len()];
    for (pressures, equivalent, forces, velocities, expected) in [
        (&none, &rest, &rest, &circle, -6.0),
        (&none, &rest, &pressed, &rest, -1.0),
        // 1/2 + 5/2 / 2: half of the jump on both sides, inside in units of the ratio.
        (&none, &pressed, &rest, &rest, 1.75),
        (&one, &rest, &rest, &rest, -1.5),
    ] {
        let [offset] = contrast.pressure_offsets(pressures, equivalent, forces, velocities)[..] else { panic!() };
        assert!((offset - expected).abs() < 1e-3, "{offset} {expected}");
    }
}
