//! Elastic shells with a viscosity, against closed forms.

use std::f64::consts::TAU;

use motile::active_interface::Vec2;
use motile::elastic_solids::Shell;
use motile::prelude::*;
use motile::scene::{Body, Scene, Viscous};
use motile::setup::ShellSetup;

const COUNT: usize = 96;

/// A circle whose points are moved along it by `part sin(m angle)` of its radius.
fn pulled(radius: f64, m: f64, part: f64) -> Vec<Vec2> {
    let angle = |k: usize| TAU * k as f64 / COUNT as f64;
    (0..COUNT).map(|k| radius * Vec2::from_angle(angle(k) + part * (m * angle(k)).sin())).collect()
}

fn in_plane(viscosity: f64) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: COUNT });
    Setup { region: Region::Plane, viscosity, method, ..Setup::default() }
}

/// Amplitude of the velocity along the circle in the mode of the displacement.
fn back(shell: Shell, m: f64, viscosity: f64) -> f64 {
    let mut scene = Scene::new(in_plane(viscosity).flow().expect("a flow"));
    scene.add(shell);
    scene.system_mut().evaluate().expect("a good state");
    let velocities = scene.system().markers().velocities();
    let along = velocities.iter().enumerate().map(|(k, v)| {
        let angle = TAU * k as f64 / COUNT as f64;
        v.dot(Vec2::from_angle(angle).perp()) * (m * angle).sin()
    });
    along.sum::<f64>() * 2.0 / COUNT as f64
}

/// A displacement a sin(m theta) along a circle makes the tension `E m a cos(m theta)/R`, with which the points go back
/// at `E m a/(R (2 Sigma + m eta_s/R))`.
#[test]
fn stretched_shells_relax_as_the_closed_form() {
    for (radius, inside, outside) in [(1.0, 1.0, 1.0), (1e-6, 3.0, 1.0)] {
        let (modulus, part) = (10.0 * radius, 1e-5);
        for m in [2.0, 3.0, 5.0] {
            for viscosity in [0.0, 0.5 * radius, 1e3 * radius] {
                let shell = Shell::new(&pulled(radius, m, 0.0), modulus, 0.0).expect("a shell");
                let shell = shell.deformed(&pulled(radius, m, part)).expect("a shell");
                let shell = shell.with_viscosity(viscosity).and_then(|it| it.with_viscosity_inside(inside));
                let found = back(shell.expect("a shell"), m, outside);
                let exact = -modulus * m * part / (2.0 * (inside + outside) + m * viscosity / radius);
                assert!((found / exact - 1.0).abs() < 1e-4, "{radius} {m} {viscosity}: {found} {exact}");
            }
        }
    }
}

/// The forces of stresses are minus the transpose of the rates, and a stretched shell of any viscosity loses energy.
#[test]
fn forces_are_the_transpose_of_rates() {
    let mut shell =
        Shell::new(&pulled(1.0, 3.0, 0.2), 1.0, 0.1).and_then(|it| it.with_viscosity(2.0)).expect("a shell");
    let view = motile::scene::Hydrodynamics::fluid_view(&in_plane(1.0).flow().expect("a flow"));
    let mut forces = vec![Vec2::ZERO; COUNT];
    shell.write_forces(&view, &mut forces).expect("forces");
    let number = |k: usize, seed: f64| (seed * (k as f64 + 0.7)).sin();
    let velocities: Vec<Vec2> = (0..COUNT).map(|k| Vec2::new(number(k, 12.9), number(k, 78.2))).collect();
    let stresses: Vec<f64> = (0..COUNT).map(|k| number(k, 37.7)).collect();
    let mut rates = vec![0.0; COUNT];
    shell.write_rates(&velocities, &mut rates);
    forces.fill(Vec2::ZERO);
    shell.add_stress_forces(&stresses, &mut forces);
    let power: f64 = forces.iter().zip(&velocities).map(|(force, velocity)| force.dot(*velocity)).sum();
    let stored: f64 = stresses.iter().zip(&rates).map(|(stress, rate)| stress * rate).sum();
    assert!((power + stored).abs() < 1e-11 * stored.abs().max(1.0), "{power} {stored}");
    assert!(forces.iter().sum::<Vec2>().length() < 1e-12);
}

#[test]
fn viscous_shells_are_refused_on_a_grid() {
    let shell = ShellSetup { cortex_viscosity: 1.0, ..ShellSetup::default() };
    let method = Method::Grid(GridMethod::default());
    let setup = Setup { method, droplets: Vec::new(), shells: vec![shell], ..Setup::default() };
    let error = setup.build().expect_err("not resolved").to_string();
    assert!(error.contains("cortex-viscosity"), "{error}");
}
