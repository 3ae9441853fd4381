//! Errors against the number of nodes and markers.

use crate::scenes;

use std::f64::consts::TAU;

use motile_base::{Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, Settings};
use motile_scene::{Hydrodynamics, Markers};
use scenes::{Ellipse, markers};

const COUNT: usize = 384;

fn solve(region: Region, markers: &mut Markers, nodes: usize) {
    let settings = Settings { nodes, tolerance: 1e-14, ..Settings::default() };
    BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene").velocities(markers).expect("a valid scene");
}

fn largest(a: &[Vec2], b: &[Vec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).length()).fold(0.0, f64::max)
}

#[test]
fn errors_fall_faster_than_any_power_of_the_nodes() {
    let ellipse = Ellipse { axes: [1.3, 1.0 / 1.3], ..Ellipse::circle(0.0, 0.0, |t| t.cos().exp()) };
    for ratio in [1.0, 100.0, 0.01] {
        let shape = Ellipse { viscosity: Some(ratio), ..ellipse };
        let region = Region::Box { lengths: [6.0, 6.0] };
        let mut reference = markers(&[shape], COUNT);
        solve(region, &mut reference, 192);
        let errors = [16, 24, 32, 48, 64].map(|nodes| {
            let mut found = markers(&[shape], COUNT);
            solve(region, &mut found, nodes);
            largest(found.velocities(), reference.velocities())
        });
        println!("ratio {ratio}: {errors:?}");
        // Orders between one number of nodes and the next: they grow.
        let order = |i: usize, nodes: f64| (errors[i] / errors[i + 1]).ln() / nodes.ln();
        assert!(order(0, 1.5) > 5.0 && order(1, 4.0 / 3.0) > 8.0 && order(2, 1.5) > 12.0, "{errors:?}");
        assert!(errors[4] < 2e-10, "{errors:?}");
    }
}

#[test]
fn a_circle_is_exact_with_few_nodes() {
    // Tension 1 + cos t on a unit circle: a translation by half of 1/(2 (eta_in + eta_ext)) and the matching flow.
    let circle = Ellipse { viscosity: Some(4.0), ..Ellipse::circle(0.0, 0.0, |t| 1.0 + t.cos()) };
    let mut reference = markers(&[circle], COUNT);
    solve(Region::Plane, &mut reference, 96);
    for nodes in [16, 17, 24, 33] {
        let mut found = markers(&[circle], COUNT);
        solve(Region::Plane, &mut found, nodes);
        let error = largest(found.velocities(), reference.velocities());
        assert!(error < 1e-14, "{nodes}: {error:e}");
    }
}

#[test]
fn forces_of_segments_are_of_second_order_in_the_markers() {
    // gamma_k t_k - gamma_(k-1) t_(k-1) with the chord t_k and the tension half way along it.
    let tension = |t: f64| 1.0 + 0.5 * t.cos();
    let shape = Ellipse { axes: [1.3, 1.0 / 1.3], viscosity: Some(10.0), ..Ellipse::circle(0.0, 0.0, tension) };
    let error = |count: usize| {
        let mut exact = markers(&[shape], count);
        let mut segments = exact.clone();
        let tangent = |k: usize| {
            let chord = exact.positions()[(k + 1) % count] - exact.positions()[k % count];
            chord.normalize() * tension(TAU * (k as f64 + 0.5) / count as f64)
        };
        for (k, force) in segments.forces_mut().iter_mut().enumerate() {
            *force = tangent(k) - tangent((k + count - 1) % count);
        }
        solve(Region::Plane, &mut exact, 64);
        solve(Region::Plane, &mut segments, 64);
        let scale = exact.velocities().iter().map(|v| v.length()).fold(0.0, f64::max);
        largest(segments.velocities(), exact.velocities()) / scale
    };
    let errors = [64, 128, 256, 512].map(error);
    println!("{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.009, "{errors:?}");
    }
}
