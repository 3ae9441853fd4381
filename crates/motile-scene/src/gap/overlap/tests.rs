use std::f64::consts::TAU;

use super::*;
use crate::{Domain, MarkerKind};

const INTERFACE: MarkerKind = MarkerKind::Interface { viscosity_inside: None };

/// A box of 6 x 6 with a grid spacing of 0.1 and fluid of viscosity 1.
fn fluid_view() -> FluidView {
    let domain = Domain { origin: [0.0; 2], periods: [Some(6.0); 2].into(), walls: None };
    let shape_modes = None;
    FluidView {
        domain,
        viscosity: 1.0,
        spacing: Some(0.1),
        second_order: true,
        shape_modes,
        nodes: shape_modes,
        interface_stiffness: 1.0,
    }
}

fn circle(x: f64, radius: f64) -> Boundary {
    let points = (0..96).map(|k| Vec2::new(x, 0.0) + radius * Vec2::from_angle(TAU * f64::from(k) / 96.0));
    let mut boundary = Boundary::default();
    boundary.push_loop(&points.collect::<Vec<_>>());
    boundary
}

/// A wall along the whole period, up to a height.
fn wall(height: f64) -> Boundary {
    let mut boundary = Boundary::default();
    for k in 0..60 {
        let (x, next) = (0.1 * f64::from(k), 0.1 * f64::from(k + 1));
        boundary.push(Vec2::new(x, 0.0), Vec2::new(next, 0.0));
        boundary.push(Vec2::new(next, height), Vec2::new(x, height));
    }
    boundary
}

fn depth(bodies: [(Boundary, MarkerKind); 2]) -> Option<f64> {
    let [a, b] = bodies;
    let orders = [Surfaces::of([a.clone(), b.clone()]), Surfaces::of([b, a])];
    let depths = orders.map(|surfaces| match surfaces.first_overlap(&fluid_view()) {
        Some(Overlap { body: 1, other: 0, depth, .. }) => Some(depth),
        None => None,
        other => panic!("{other:?}"),
    });
    assert_eq!(depths[0], depths[1]);
    depths[0]
}

#[test]
fn bodies_at_the_same_place_overlap_though_no_corner_is_inside() {
    // Discs of radius 1 have their centres in common, walls their middle.
    for shift in [0.0, 1e-15, 1e-4, 0.02, 6.0] {
        for kind in [INTERFACE, MarkerKind::Points] {
            let found = depth([(circle(0.0, 1.0), kind), (circle(shift, 1.0), kind)]).unwrap();
            assert!((found - 1.0).abs() < 0.03, "{shift} {found}");
        }
    }
    for height in [1.0, 2.0] {
        let found = depth([(wall(1.0), MarkerKind::Points), (wall(height), MarkerKind::Points)]).unwrap();
        assert!(found > 0.3, "{height} {found}");
    }
    // A film thinner than what a grid can tell.
    assert!(depth([(circle(0.0, 1.0), INTERFACE), (circle(0.0, 0.99), INTERFACE)]).unwrap() > 0.9);
}

#[test]
fn bodies_beside_and_inside_one_another_do_not() {
    for kinds in [[INTERFACE; 2], [INTERFACE, MarkerKind::Points], [MarkerKind::Points; 2]] {
        // The polygons of two interfaces touch at less than the distance of the circles.
        let contact = if kinds == [INTERFACE; 2] { 1.999 } else { 1.99 };
        for apart in [contact, 2.0, 3.0, 6.0 - contact] {
            assert_eq!(depth([(circle(0.0, 1.0), kinds[0]), (circle(apart, 1.0), kinds[1])]), None, "{kinds:?}");
        }
    }
    for kind in [INTERFACE, MarkerKind::Points] {
        // In the middle, at the edge, through the edge.
        for place in [0.0, 0.5, 0.501, 6.3] {
            assert_eq!(depth([(circle(0.0, 1.0), INTERFACE), (circle(place, 0.5), kind)]), None, "{place}");
        }
        let found = depth([(circle(0.0, 1.0), INTERFACE), (circle(0.6, 0.5), kind)]).unwrap();
        assert!((found - 0.1).abs() < 1e-12, "{found}");
    }
    // A droplet inside a solid.
    assert!(depth([(circle(0.0, 1.0), MarkerKind::Points), (circle(0.3, 0.5), INTERFACE)]).unwrap() > 0.4);
}

/// A quarter of the grid spacing; without a grid, of the longest side of an interface. Between interfaces a fiftieth.
#[test]
fn contact_is_a_quarter_of_a_spacing() {
    for kind in [INTERFACE, MarkerKind::Points] {
        let pair = |apart: f64| depth([(circle(0.0, 1.0), kind), (circle(apart, 1.0), MarkerKind::Points)]);
        assert_eq!(pair(2.0 - 0.024), None);
        assert!((pair(2.0 - 0.026).unwrap() - 0.026).abs() < 1e-4);
    }
    let pair = |apart: f64| depth([(circle(0.0, 1.0), INTERFACE), (circle(apart, 1.0), INTERFACE)]);
    assert_eq!(pair(2.0 - 0.0019), None);
    assert!((pair(2.0 - 0.0021).unwrap() - 0.0021).abs() < 1e-4);
    let surfaces = Surfaces::of([(circle(0.0, 1.0), INTERFACE), (circle(3.0, 2.0), MarkerKind::Points)]);
    let free = FluidView { spacing: None, ..fluid_view() };
    assert!((surfaces.allowed(surfaces.contact_scale(&fluid_view()), [0, 1]) - 0.025).abs() < 1e-16);
    assert!((surfaces.allowed(surfaces.contact_scale(&fluid_view()), [0, 0]) - 0.002).abs() < 1e-16);
    assert!((surfaces.allowed(surfaces.contact_scale(&free), [1, 0]) - 0.5 * (TAU / 192.0).sin()).abs() < 1e-14);
}
