//! Friction of interfaces that depends on the place, and friction with walls, against closed forms.

use std::f64::consts::TAU;

use motile::active_interface::theory::{FlatInterface, Stratum, StratumEnd};
use motile::active_interface::{Field, Fields, Vec2};
use motile::prelude::*;
use motile::scene::{Hydrodynamics, Scene};
use motile::setup::{
    DropletShape, FieldEntry, FieldsSetup, GradientSetup, InterfaceSetup, InterfaceShape, LayersMethod,
    ModulationSetup, WaveSetup,
};

const NODES: usize = 48;

fn integral() -> Method {
    Method::Integral(IntegralMethod { nodes: NODES, elements: 2 * NODES })
}

/// A slope along x that is zero at the origin.
fn slope(along_x: f64) -> Vec<FieldEntry> {
    let gradient = GradientSetup { slope: [along_x, 0.0], origin: [0.0; 2] };
    vec![FieldEntry { gradient: Some(gradient), ..FieldEntry::default() }]
}

/// Solves `matrix x = right` by elimination.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    for k in 0..count {
        let pivot = (k..count).max_by(|&a, &b| matrix[a][k].abs().total_cmp(&matrix[b][k].abs())).expect("rows");
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        for row in k + 1..count {
            let factor = matrix[row][k] / matrix[k][k];
            let (above, below) = matrix.split_at_mut(row);
            let entries = below[0].iter_mut().zip(&above[k]);
            entries.skip(k).for_each(|(entry, pivots)| *entry -= factor * pivots);
            right[row] -= factor * right[k];
        }
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|column| matrix[k][column] * right[column]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right
}

/// Returns the amplitudes u_m of cos(m theta) outward and w_m of sin(m theta) along a circle, m from 1, for the tension
/// x and the friction `base + rise x`, in the plane.
///
/// The fluid resists with `(2 Sigma/R) [[m, 1], [1, m]] (u, w)`, and u = w for m = 1, because no force is on the fluid
/// in all. Friction is relative to a substrate that moves at U.
fn graded_modes(radius: f64, sigma: f64, base: f64, rise: f64) -> Vec<[f64; 2]> {
    let most = 16;
    // Unknowns: u_1 = w_1, U, then u_m, w_m.
    let (column_u, column_w) =
        (|m: usize| if m == 1 { 0 } else { 2 * m - 2 }, |m: usize| if m == 1 { 0 } else { 2 * m - 1 });
    let (mut matrix, mut right) = (vec![vec![0.0; 2 * most]; 2 * most], vec![0.0; 2 * most]);
    for m in 1..=most {
        let rows = [2 * m - 2, 2 * m - 1];
        let fluid = 2.0 * sigma / radius;
        matrix[rows[0]][column_u(m)] += fluid * m as f64;
        matrix[rows[0]][column_w(m)] += fluid;
        matrix[rows[1]][column_u(m)] += fluid;
        matrix[rows[1]][column_w(m)] += fluid * m as f64;
        // Products with the friction, of which the outward part of mode 0 is taken up by the pressure.
        for (other, part) in [(m, base), (m + 1, 0.5 * rise * radius), (m.wrapping_sub(1), 0.5 * rise * radius)] {
            if (1..=most).contains(&other) {
                matrix[rows[0]][column_u(other)] += part;
                matrix[rows[1]][column_w(other)] += part;
                if other == 1 {
                    matrix[rows[0]][1] -= part;
                    matrix[rows[1]][1] += part;
                }
            }
        }
    }
    // The tension -d gamma/ds along, and outward -gamma.
    (right[0], right[1]) = (-1.0, -1.0);
    let found = solve(matrix, right);
    (1..=most).map(|m| [found[column_u(m)], found[column_w(m)]]).collect()
}

#[test]
fn graded_friction_couples_the_modes_of_a_circle() {
    let (sigma, base, rise) = (200.0, 300.0, 250.0);
    let droplet = DropletSetup {
        friction: base,
        fields: FieldsSetup { tension: slope(1.0), friction: slope(rise), ..FieldsSetup::default() },
        ..DropletSetup::passive(10.0)
    };
    let setup = Setup {
        region: Region::Plane,
        viscosity: 0.5 * sigma,
        method: integral(),
        droplets: vec![droplet],
        ..Setup::default()
    };
    let mut scene = setup.build().expect("a good scene").scene;
    scene.system_mut().evaluate().expect("a good state");
    let markers = scene.system().markers();
    let count = markers.positions().len() as f64;
    let radius = markers.positions()[0].length();
    let exact = graded_modes(radius, sigma, base, rise);
    for (m, [outward, along]) in exact.iter().enumerate().take(5) {
        let m = m as f64 + 1.0;
        let (mut u, mut w) = (0.0, 0.0);
        for (x, v) in markers.positions().iter().zip(markers.velocities()) {
            let angle = x.y.atan2(x.x);
            let n = x.normalize();
            u += v.dot(n) * 2.0 / count * (m * angle).cos();
            w += v.dot(n.perp()) * 2.0 / count * (m * angle).sin();
        }
        let scale = exact[0][0].abs();
        assert!(
            (u - outward).abs() < 1e-6 * scale && (w - along).abs() < 1e-6 * scale,
            "{m}: {u} {outward} {w} {along}"
        );
    }
    // Without a slope, the closed form of uniform friction.
    let uniform = graded_modes(radius, sigma, base, 0.0)[0][0];
    assert!((uniform * (4.0 * sigma / radius + base) + 1.0).abs() < 1e-12, "{uniform}");
}

/// A uniform field is the same as a number, also one that changes in time, and the other method agrees.
#[test]
fn a_uniform_field_of_friction_is_friction() {
    let velocity = |friction: f64, field: Option<f64>, method: Method| {
        let modulation = Some(ModulationSetup { frequency: 1.0, mean: 0.5, amplitude: 0.5, phase: 0.0 });
        let entry = |value| FieldEntry { uniform: Some(value), modulation, ..FieldEntry::default() };
        let droplet = DropletSetup {
            shape: DropletShape::Ellipse { half_axes: [1.3, 0.8] },
            friction,
            fields: FieldsSetup {
                tension: vec![FieldEntry {
                    wave: Some(WaveSetup { amplitude: 1.0, wave_vector: [TAU / 6.0, 0.0], frequency: 0.0, phase: 0.4 }),
                    ..FieldEntry::default()
                }],
                friction: field.map(entry).into_iter().collect(),
                ..FieldsSetup::default()
            },
            ..DropletSetup::passive(10.0)
        };
        let setup = Setup { method, droplets: vec![droplet], ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().expect("a good scene");
        scene.observe(droplets[0]).expect("a good state").velocity
    };
    let plain = velocity(80.0, None, integral());
    let field = velocity(30.0, Some(50.0), integral());
    let layers = velocity(
        0.0,
        Some(80.0),
        Method::Layers(LayersMethod { nodes: NODES, elements: 2 * NODES, ..LayersMethod::default() }),
    );
    assert!((field - plain).length() < 1e-7 * plain.length(), "{field} {plain}");
    assert!((layers - plain).length() < 1e-5 * plain.length(), "{layers} {plain}");
}

/// Friction that vanishes on half of a droplet costs iterations, but not the solution.
#[test]
fn friction_may_vanish_in_places() {
    let step = |place: Vec2| if place.x > 0.0 { 500.0 } else { 0.0 };
    let droplet = DropletSetup { particles: Some(Particles::default()), ..DropletSetup::default() };
    let setup = Setup { method: integral(), droplets: vec![droplet], ..Setup::default() };
    let made = setup.droplet(&setup.droplets[0]).expect("a good droplet");
    let friction = Some(Field::of(step));
    let made = made.with_fields(Fields { friction, ..Default::default() }).expect("fields");
    let mut scene = Scene::new(setup.flow().expect("a good scene"));
    scene.add(made);
    scene.system_mut().evaluate().expect("a good state");
    assert!(scene.system().report().residual < 1e-5);
    let work = Hydrodynamics::work(scene.system().hydrodynamics());
    assert!(work.evaluations < 60, "{work:?}");
}

/// Walls rub along the interface: a wave of a flat interface moves as with the resistance `f (1/d + 1/H)` along it.
#[test]
fn walls_rub_on_a_flat_interface() {
    let (below, above, film, tension, height) = (0.6, 2.0, 40.0, 10.0, 1e-5);
    let region = Region::Channel { length: TAU, width: below + above, drive: Drive::ZeroGradient };
    let line = InterfaceSetup {
        height: below - 0.5 * (below + above),
        shape: InterfaceShape::Waves { cosines: vec![height], sines: Vec::new() },
        wall_friction: film,
        ..InterfaceSetup::passive(tension)
    };
    let setup = Setup {
        region,
        viscosity: 100.0,
        method: integral(),
        interfaces: vec![line],
        droplets: Vec::new(),
        ..Setup::default()
    };
    let mut scene = setup.build().expect("a good scene").scene;
    scene.system_mut().evaluate().expect("a good state");
    let theory = FlatInterface { wave_number: 1.0, tension, activity: 0.0, concentration: 1.0, diffusivity: 0.0 };
    let [lower, upper] =
        [below, above].map(|thickness| Stratum { viscosity: 100.0, end: StratumEnd::Wall { thickness } });
    // A cortex resists a wave along the interface alone, too.
    let friction = film * (1.0 / below + 1.0 / above);
    let [[_, across], [_, up]] = theory.resisted_mobility(lower, upper, [friction, 0.0]).expect("theory");
    let markers = scene.system().markers();
    let count = markers.positions().len() as f64;
    let (mut u, mut v) = (0.0, 0.0);
    for (x, velocity) in markers.positions().iter().zip(markers.velocities()) {
        u += velocity.x * x.x.sin() * 2.0 / count;
        v += velocity.y * x.x.cos() * 2.0 / count;
    }
    let exact = [across, up].map(|mobility| -mobility * tension * height);
    assert!(
        (u - exact[0]).abs() < 1e-4 * exact[0].abs() && (v - exact[1]).abs() < 1e-4 * exact[1].abs(),
        "{u} {v} {exact:?}"
    );
}

#[test]
fn friction_that_cannot_be_is_refused() {
    let graded = |friction: f64, along_x: f64, region: Region| {
        let fields = FieldsSetup { friction: slope(along_x), ..FieldsSetup::default() };
        let droplet = DropletSetup { friction, fields, ..DropletSetup::passive(1.0) };
        Setup { region, method: integral(), droplets: vec![droplet], ..Setup::default() }
    };
    let mut scene = graded(1.0, 10.0, Region::Plane).build().expect("checked at each state").scene;
    let error = scene.system_mut().evaluate().expect_err("negative friction").to_string();
    assert!(error.contains("friction"), "{error}");
    let error = graded(0.0, 0.1, Region::Space).build().expect_err("no friction in space").to_string();
    assert!(error.contains("fields.friction"), "{error}");
    let rubbing = |region| Setup {
        region,
        droplets: vec![DropletSetup { wall_friction: 1.0, ..DropletSetup::passive(1.0) }],
        ..Setup::default()
    };
    let error = rubbing(Region::Box { lengths: [6.0; 2] }).build().expect_err("no walls").to_string();
    assert!(error.contains("wall-friction"), "{error}");
}
