//! Droplets that sink or are pushed, against closed forms and an independent boundary-integral program.

use std::f64::consts::PI;

use motile::prelude::*;
use motile::setup::DropletShape;

/// Centroid's velocity over the force, times the viscosity outside, of a round droplet that is pushed along an axis.
fn mobility(
    region: Region,
    method: Method,
    at: [f64; 2],
    ratio: f64,
    (axis, radius): (usize, f64),
    whole: bool,
) -> f64 {
    let (viscosity, push) = (3.0, 2.0);
    let mut force = [0.0; 2];
    force[axis] = push;
    let volume = if region.is_axisymmetric() { 4.0 / 3.0 * PI * radius.powi(3) } else { PI * radius * radius };
    let density = force.map(|part| part / volume);
    let (body_force, force) = if whole { ([0.0; 2], force) } else { (density, [0.0; 2]) };
    let droplet = DropletSetup {
        centre: at,
        viscosity: Some(ratio * viscosity),
        shape: DropletShape::Round { radius },
        body_force,
        force,
        ..DropletSetup::passive(1.0)
    };
    let setup = Setup { region, viscosity, method, droplets: vec![droplet], ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build().expect("a good scene");
    let velocity = scene.observe(droplets[0]).expect("a good state").velocity;
    viscosity * [velocity.x, velocity.y][axis] / push
}

fn nodes(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements: nodes })
}

#[test]
fn droplets_in_a_box_sink_as_they_should() {
    // Closed form at equal viscosities, boundary integrals at others.
    for (side, ratio, exact) in [
        (4.0, 1.0, 0.033735771342),
        (8.0, 1.0, 0.0830352963801),
        (16.0, 1.0, 0.136729352668),
        (6.0, 0.1, 0.0755079898387),
        (12.0, 0.1, 0.129810145033),
    ] {
        let region = Region::Box { lengths: [side; 2] };
        for (axis, whole) in [(0, false), (1, true)] {
            let found = mobility(region, nodes(96), [0.3, -0.2], ratio, (axis, 1.0), whole);
            assert!((found / exact - 1.0).abs() < 1e-9, "{side} {ratio} {axis}: {found} {exact}");
        }
    }
}

#[test]
fn droplets_in_a_channel_sink_as_they_should() {
    // Period and width, height and viscosity ratio, axis, and the value of an independent program.
    let (short, long) = ([6.0, 3.0], [12.0, 5.0]);
    let (open, closed) = (Drive::ZeroGradient, Drive::ZeroFlux);
    for (drive, [length, width], [y, ratio], axis, exact) in [
        (open, short, [0.0, 1.0], 0, 0.080855427649),
        (open, short, [0.0, 1.0], 1, 0.020053241176),
        (open, short, [0.0, 0.1], 1, 0.027597420997),
        (open, short, [0.0, 10.0], 0, 0.061847305758),
        (open, short, [0.0, 10.0], 1, 0.011839336561),
        (closed, short, [0.0, 1.0], 1, 0.020053241176),
        (closed, short, [0.0, 0.1], 0, 0.009364832789),
        (closed, short, [0.0, 0.1], 1, 0.027597420997),
        (closed, short, [0.0, 10.0], 1, 0.011839336561),
        (open, short, [0.3, 1.0], 0, 0.07686518771),
        (open, short, [0.3, 1.0], 1, 0.01808971946),
        (open, short, [0.3, 0.1], 1, 0.024984425788),
        (open, short, [0.3, 10.0], 0, 0.053483647346),
        (open, short, [0.3, 10.0], 1, 0.009026113591),
        (closed, short, [0.3, 1.0], 1, 0.01808971946),
        (closed, short, [0.3, 0.1], 0, 0.012186006477),
        (closed, short, [0.3, 0.1], 1, 0.024984425788),
        (closed, short, [0.3, 10.0], 1, 0.009026113591),
        (open, long, [0.0, 1.0], 0, 0.102530638531),
        (open, long, [0.0, 1.0], 1, 0.049954755677),
        (open, long, [0.0, 0.1], 1, 0.06201131249),
        (open, long, [0.0, 10.0], 0, 0.08830545863),
        (open, long, [0.0, 10.0], 1, 0.037815615701),
        (closed, long, [0.0, 1.0], 1, 0.049954755677),
        (closed, long, [0.0, 0.1], 0, 0.039615497369),
        (closed, long, [0.0, 0.1], 1, 0.06201131249),
        (closed, long, [0.0, 10.0], 1, 0.037815615701),
    ] {
        let region = Region::Channel { length, width, drive };
        let found = mobility(region, nodes(96), [0.7, y], ratio, (axis, 1.0), false);
        assert!((found / exact - 1.0).abs() < 1e-8, "{drive:?} {width} {y} {ratio} {axis}: {found} {exact}");
    }
}

#[test]
fn drops_rise_as_hadamard_and_rybczynski_found() {
    for (ratio, radius) in [(0.1, 1.0), (1.0, 1e-6), (10.0, 1.0)] {
        let exact = (3.0 + 3.0 * ratio) / (2.0 + 3.0 * ratio) / (6.0 * PI * radius);
        for whole in [false, true] {
            let found = mobility(Region::Space, nodes(64), [0.0; 2], ratio, (0, radius), whole);
            assert!((found / exact - 1.0).abs() < 1e-6, "{ratio} {radius}: {found} {exact}");
        }
    }
}

#[test]
fn the_methods_agree() {
    let region = Region::Box { lengths: [6.0; 2] };
    let by_grid = Method::Grid(GridMethod { spacing: 0.05, ..GridMethod::default() });
    let [first, second] = [nodes(96), by_grid].map(|method| mobility(region, method, [0.0; 2], 1.0, (1, 1.0), false));
    assert!((first / second - 1.0).abs() < 5e-3, "{first} {second}");
}

#[test]
fn a_weight_in_the_plane_is_refused() {
    let droplet = DropletSetup { body_force: [0.0, -1.0], ..DropletSetup::passive(1.0) };
    let setup = Setup { region: Region::Plane, droplets: vec![droplet], ..Setup::default() };
    let error = setup.build().expect_err("no speed exists").to_string();
    assert!(error.contains("no speed exists"), "{error}");
}

/// The mean pressure gradient of a box carries the weight in it: force over area, with both methods.
#[test]
fn a_box_bears_a_weight_by_its_mean_pressure_gradient() {
    let (lengths, force) = ([6.0, 5.0], [2.0, -1.5]);
    let by_grid = Method::Grid(GridMethod { spacing: 0.1, ..GridMethod::default() });
    for (method, inside) in [(nodes(48), 1.0), (nodes(48), 10.0), (by_grid, 1.0)] {
        let droplet = DropletSetup { force, viscosity: Some(inside), ..DropletSetup::passive(1.0) };
        let at_rest = DropletSetup { centre: [2.9, 2.4], ..DropletSetup::passive(1.0) };
        let setup = Setup {
            region: Region::Box { lengths },
            viscosity: 1.0,
            method,
            droplets: vec![droplet, at_rest],
            ..Setup::default()
        };
        let mut scene = setup.build().expect("a good scene").scene;
        scene.system_mut().evaluate().expect("a good state");
        let found = scene.system().report().mean_pressure_gradient;
        for axis in 0..2 {
            let exact = force[axis] / (lengths[0] * lengths[1]);
            assert!((found[axis] / exact - 1.0).abs() < 1e-10, "{found:?}");
        }
    }
    // Without a force, it is zero without round-off.
    let setup = Setup { method: nodes(48), droplets: vec![DropletSetup::active(-2.0)], ..Setup::default() };
    let mut scene = setup.build().expect("a good scene").scene;
    scene.system_mut().evaluate().expect("a good state");
    assert_eq!(scene.system().report().mean_pressure_gradient, [0.0; 2]);
}
