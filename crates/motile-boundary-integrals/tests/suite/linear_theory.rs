//! Small disturbances of a circle in free space against Cowley's linear theory, by the velocities themselves.

use std::f64::consts::TAU;

use motile_base::{Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings, TensionPlacement};
use motile_scene::{Hydrodynamics, MarkerKind, Markers};

const COUNT: usize = 128;
const VISCOSITIES: [[f64; 2]; 3] = [[100.0, 100.0], [1000.0, 10.0], [10.0, 100.0]];

/// Radial and tangential velocities on `R = 1 + bump cos(k t)` with the tension `1 + wave cos(k t)`.
fn velocities(k: usize, bump: f64, wave: f64, [inside, outside]: [f64; 2]) -> [Vec<f64>; 2] {
    let settings = Settings { tolerance: 1e-14, ..Settings::default() };
    let mut solver = BoundaryIntegral::new(Region::Plane, outside, settings).expect("a valid scene");
    let mut markers = Markers::new();
    markers.push_group(COUNT, MarkerKind::Interface { viscosity_inside: Some(inside) });
    let angle = |j: usize| TAU * j as f64 / COUNT as f64;
    for (j, position) in markers.positions_mut().iter_mut().enumerate() {
        let r = 1.0 + bump * (k as f64 * angle(j)).cos();
        *position = r * Vec2::new(angle(j).cos(), angle(j).sin());
    }
    let tension: Vec<f64> = (0..COUNT).map(|j| 1.0 + wave * (k as f64 * angle(j)).cos()).collect();
    let [positions, forces, _] = markers.lists_mut();
    PeriodicCalculus::new(COUNT)
        .expect("a valid scene")
        .tension_forces(positions, &tension, TensionPlacement::Points, forces)
        .expect("a valid scene");
    solver.velocities(&mut markers).expect("a valid scene");
    let component = |tangential: bool| {
        let part = |(j, v): (usize, &Vec2)| {
            let (sin, cos) = angle(j).sin_cos();
            if tangential { cos * v.y - sin * v.x } else { cos * v.x + sin * v.y }
        };
        markers.velocities().iter().enumerate().map(part).collect()
    };
    [component(false), component(true)]
}

fn project(values: &[f64], wave: impl Fn(f64) -> f64) -> f64 {
    let sum: f64 = values.iter().enumerate().map(|(j, v)| v * wave(TAU * j as f64 / COUNT as f64)).sum();
    2.0 * sum / COUNT as f64
}

#[test]
fn shape_modes_relax_at_the_rate_of_2_18() {
    for viscosities in VISCOSITIES {
        for k in 2..8 {
            let bump = 1e-4;
            // The difference of bumps of both signs leaves the terms of third order.
            let [plus, _] = velocities(k, bump, 0.0, viscosities);
            let [minus, _] = velocities(k, -bump, 0.0, viscosities);
            let odd: Vec<f64> = plus.iter().zip(&minus).map(|(a, b)| 0.5 * (a - b)).collect();
            let rate = project(&odd, |t| (k as f64 * t).cos()) / bump;
            let expected = -(k as f64) / (2.0 * (viscosities[0] + viscosities[1]));
            assert!((rate / expected - 1.0).abs() < 1e-6, "k = {k}: {rate} {expected}");
        }
    }
}

#[test]
fn tension_waves_drive_the_flow_of_2_19() {
    // The rate of (2.19) without diffusion is -c0 times the divergence of the flow along the surface.
    for viscosities in VISCOSITIES {
        for k in 2..8 {
            let [radial, tangential] = velocities(k, 0.0, 0.3, viscosities);
            let speed = project(&tangential, |t| (k as f64 * t).sin());
            let expected = -0.3 / (2.0 * (viscosities[0] + viscosities[1]));
            assert!((speed / expected - 1.0).abs() < 1e-12, "k = {k}: {speed} {expected}");
            assert!(radial.iter().all(|v| v.abs() < 1e-13 * expected.abs().max(1.0)));
        }
    }
}
