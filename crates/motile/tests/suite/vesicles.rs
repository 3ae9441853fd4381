//! Membranes that do not stretch, against steady states of an independent program.

use std::f64::consts::PI;

use motile::active_interface::{Cortex, Curve};
use motile::prelude::*;
use motile::setup::{DropletShape, FlowSetup};

/// An ellipse of area pi a^2 and of a reduced area `4 pi A/L^2`: its half-axes.
fn half_axes(radius: f64, reduced: f64) -> [f64; 2] {
    let axes = |ratio: f64| [radius * ratio.sqrt(), radius / ratio.sqrt()];
    let of = |ratio: f64| {
        let [along, across] = axes(ratio);
        let perimeter = Curve::ellipse(along, across).expect("an ellipse").perimeter();
        4.0 * PI * PI * radius * radius / (perimeter * perimeter)
    };
    let (mut low, mut high) = (1.0, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of(middle) > reduced { low = middle } else { high = middle }
    }
    axes(0.5 * (low + high))
}

/// A vesicle in shear: units of length and of viscosity, reduced area, `eta G R^3/B`, viscosity ratio, nodes.
struct Vesicle {
    length: f64,
    viscosity: f64,
    reduced: f64,
    softness: f64,
    ratio: f64,
    nodes: usize,
}

/// Inclination (degrees), speed along the membrane over G R, deformation, and the relative change of the perimeter, at
/// the time `until` over the shear rate.
fn treading(of: &Vesicle, until: f64) -> [f64; 4] {
    let &Vesicle { length, viscosity, reduced, softness, ratio, nodes } = of;
    let rate = 2.0;
    let droplet = DropletSetup {
        shape: DropletShape::Ellipse { half_axes: half_axes(length, reduced) },
        angle: 0.5,
        bending: viscosity * rate * length.powi(3) / softness,
        viscosity: Some(ratio * viscosity),
        cortex: Cortex::inextensible(),
        area_constraint: true,
        ..DropletSetup::passive(0.0)
    };
    let setup = Setup {
        region: Region::Plane,
        viscosity,
        method: Method::Integral(IntegralMethod { nodes, elements: 2 * nodes }),
        flow: FlowSetup { shear: rate, ..FlowSetup::default() },
        droplets: vec![droplet],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().expect("a good scene");
    let before = scene.observe(droplets[0]).expect("a good scene").perimeter;
    scene.run(until / rate).go().expect("a good run");
    println!("steps {} work {:?}", scene.system().steps(), scene.system().work());
    let after = scene.observe(droplets[0]).expect("a good scene").perimeter;
    let markers = scene.system().markers();
    let (places, velocities) = (markers.positions(), markers.velocities());
    let seen = motile::scene::Deformation::of(places, velocities).expect("a curve");
    let count = places.len();
    let speed = (0..count).map(|k| {
        let tangent = (places[(k + 1) % count] - places[(k + count - 1) % count]).try_normalize().expect("apart");
        velocities[k].dot(tangent)
    });
    let speed = speed.sum::<f64>() / count as f64;
    let angle = seen.angle_of_moments.expect("not round").to_degrees();
    [angle, speed.abs() / (rate * length), seen.by_moments, after / before - 1.0]
}

#[test]
fn vesicles_in_shear_tread_as_in_the_steady_state() {
    // Newton's method for the tangent angle and the tension, 10 and 16 even modes.
    for (length, reduced, softness, ratio, nodes, [angle, speed, deformation]) in [
        // In metres and pascal seconds.
        (1e-6, 0.9, 1.0, 1.0, 24, [31.02433854, 0.45139453, 0.26471716]),
        (1.0, 0.85, 10.0, 1.0, 32, [28.24024465, 0.39691206 / 0.85_f64.sqrt(), 0.32622929]),
        // The deformation is not known.
        (1.0, 0.9, 1.0, 2.0, 24, [25.35898258, 0.384792 / 0.9_f64.sqrt(), f64::NAN]),
    ] {
        let vesicle = Vesicle { length, viscosity: 1e-3 + length, reduced, softness, ratio, nodes };
        let found = treading(&vesicle, 20.0);
        println!("{reduced} {softness} {ratio}: {found:?} against {angle} {speed} {deformation}");
        assert!((found[0] - angle).abs() < 0.002, "{found:?}");
        assert!(
            (found[1] - speed).abs() < 1e-5 && (deformation.is_nan() || (found[2] - deformation).abs() < 2e-6),
            "{found:?}"
        );
        // Polygons of another shape have another length.
        assert!(found[3].abs() < 2e-4, "{found:?}");
    }
}

#[test]
fn membranes_that_do_not_stretch_are_refused_where_they_are_not_resolved() {
    let droplet = DropletSetup { cortex: Cortex::inextensible(), bending: 1.0, ..DropletSetup::passive(10.0) };
    let on_grid = Setup {
        region: Region::Box { lengths: [6.0; 2] },
        method: Method::Grid(GridMethod { spacing: 0.1, ..GridMethod::default() }),
        droplets: vec![droplet.clone()],
        ..Setup::default()
    };
    let in_space = Setup { region: Region::Space, droplets: vec![droplet], ..Setup::default() };
    for setup in [on_grid, in_space] {
        let error = setup.build().expect_err("a membrane that is not resolved").to_string();
        assert!(error.contains("cortex.inextensible") || error.contains("bending"), "{error}");
    }
}

#[test]
fn round_vesicles_are_refused() {
    let droplet = DropletSetup { cortex: Cortex::inextensible(), bending: 1.0, ..DropletSetup::passive(0.0) };
    let setup = Setup { region: Region::Plane, droplets: vec![droplet], ..Setup::default() };
    let error = setup.build().expect_err("a circle cannot deform").to_string();
    assert!(error.contains("round") && error.contains("ellipse"), "{error}");
}

#[test]
fn vesicles_at_rest_stay() {
    // Without bending, tension and flow, an ellipse that does not stretch has no forces at all.
    let droplet = DropletSetup {
        shape: DropletShape::Ellipse { half_axes: [1.3, 0.8] },
        cortex: Cortex::inextensible(),
        ..DropletSetup::passive(0.0)
    };
    let setup = Setup { region: Region::Plane, droplets: vec![droplet], ..Setup::default() };
    let mut scene = setup.build().expect("a good scene").scene;
    scene.run(1.0).go().expect("a good run");
    let markers = scene.system_mut().evaluate().expect("a good state");
    assert!(markers.velocities().iter().all(|velocity| velocity.length() < 1e-12));
}
