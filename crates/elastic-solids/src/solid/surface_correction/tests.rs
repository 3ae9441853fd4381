//! Tests of the surface correction.

use super::*;
use crate::mesh::BoundaryLoop;
use crate::{Interior, Mesher, Outline};
use ib_core::{CubicQuadratic, Domain};

fn discretisation(spacing: f64) -> Discretisation {
    Discretisation {
        domain: Domain { origin: [0.02, -0.03], periods: [Some(3.0), Some(3.0)], walls: None },
        viscosity: 7.0,
        spacing: Some(spacing),
        shape_modes: None,
        interface_stiffness: 0.0,
        mobility_deficit: Some(Arc::new(MobilityDeficit::new(&CubicQuadratic::default()))),
    }
}

/// The velocities of all points under forces, in a deformed state with pinned points.
fn velocities(mesh: &TriangleMesh, forces: &[Vec2]) -> Vec<Vec2> {
    let count = mesh.points().len();
    let free: Vec<usize> = (0..count).filter(|&k| mesh.points()[k].y > -0.8).collect();
    let discretisation = discretisation(0.1);
    let mut correction = SurfaceCorrection::new(mesh, &free, &discretisation).unwrap();
    let bent = |s: &Vec2| Vec2::new(s.x + 0.4 * s.y * s.y, s.y + 0.2 * (2.0 * s.x).sin());
    let positions: Vec<Vec2> = mesh.points().iter().map(bent).collect();
    correction.update(mesh, &free, &discretisation, &positions, forces);
    let mut rate = vec![0.0; 2 * free.len()];
    correction.add(&mut rate);
    let mut velocities = vec![Vec2::ZERO; count];
    for (pair, point) in rate.chunks_exact(2).zip(free) {
        velocities[point] = Vec2::new(pair[0], pair[1]);
    }
    velocities
}

#[test]
fn it_is_reciprocal_and_takes_energy() {
    let disc = Outline::circle(Vec2::ZERO, 1.0).unwrap();
    let mesh = Mesher::new(0.1).unwrap().mesh(&Interior::new([disc]).unwrap()).unwrap();
    let count = mesh.points().len();
    let forces = |a: f64, b: f64| -> Vec<Vec2> {
        (0..count).map(|k| k as f64).map(|k| Vec2::new((a * k).sin(), (b * k + 1.0).cos())).collect()
    };
    let power = |f: &[Vec2], v: &[Vec2]| f.iter().zip(v).map(|(f, v)| f.dot(*v)).sum::<f64>();
    let (one, two) = (forces(0.7, 1.9), forces(2.3, 0.4));
    let (moved_by_one, moved_by_two) = (velocities(&mesh, &one), velocities(&mesh, &two));
    let (there, back) = (power(&two, &moved_by_one), power(&one, &moved_by_two));
    let size = power(&one, &moved_by_one);
    assert!(size > 1e-3 && power(&two, &moved_by_two) > 1e-3, "{size}");
    assert!((there - back).abs() < 1e-12 * size, "{there} {back}");
}

#[test]
fn uniform_shear_forces_on_a_flat_surface() {
    // The surface misses (h/eta) G f_t, the grid's harmonic included.
    let mesh = crate::mesh::fitted_strip(Vec2::new(0.0, -1.0), [3.0, 1.5], 0.1).unwrap();
    let deficit = MobilityDeficit::new(&CubicQuadratic::default());
    let free: Vec<usize> = (0..mesh.points().len()).filter(|&k| mesh.points()[k].y > -0.99).collect();
    let upper: &BoundaryLoop = mesh.boundary_loops().iter().find(|line| mesh.points()[line.points[0]].y > 0.0).unwrap();
    let mut forces = vec![Vec2::ZERO; mesh.points().len()];
    for &point in &upper.points {
        forces[point].x = 3.0 / upper.points.len() as f64;
    }
    let discretisation = discretisation(0.1);
    let mut correction = SurfaceCorrection::new(&mesh, &free, &discretisation).unwrap();
    correction.update(&mesh, &free, &discretisation, mesh.points(), &forces);
    let mut rate = vec![0.0; 2 * free.len()];
    correction.add(&mut rate);
    let place = (0.5 - discretisation.domain.origin[1]) / 0.1;
    let harmonic = 2.0 * deficit.harmonic(0.0) * (std::f64::consts::TAU * place).cos();
    let expected = 0.1 / discretisation.viscosity * (deficit.flat(Vec2::new(1.0, 0.0)) - harmonic);
    for (pair, &point) in rate.chunks_exact(2).zip(&free) {
        if upper.points.contains(&point) {
            // The harmonic of the lines across has all but died out.
            assert!((pair[0] / expected - 1.0).abs() < 5e-4 && pair[1].abs() < 1e-12, "{pair:?} {expected}");
        } else if mesh.points()[point].y < 0.0 {
            assert!(pair[0] == 0.0 && pair[1] == 0.0, "deeper than its reach: {pair:?}");
        }
    }
}
