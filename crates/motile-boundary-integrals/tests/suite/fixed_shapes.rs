//! Velocities at and around fixed shapes against independent reference values.

use crate::reference;

use std::f64::consts::TAU;

use motile_base::{Drive, FlowSample, Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings, TensionPlacement};
use motile_scene::{Hydrodynamics, MarkerKind, Markers};
use reference::Table;

/// Markers of the shape of a table with spectrally accurate forces of the tension 1 + 0.5 cos t.
fn markers(table: &Table, count: usize) -> Markers {
    let mut markers = Markers::new();
    let (a, b) = if table.ellipse { (1.3, 1.0 / 1.3) } else { (1.0, 1.0) };
    let angles: Vec<f64> = (0..count).map(|k| TAU * k as f64 / count as f64).collect();
    markers.push_group(count, MarkerKind::UnevenInterface { viscosity_inside: Some(table.viscosity_inside) });
    for (position, t) in markers.positions_mut().iter_mut().zip(&angles) {
        *position = Vec2::new(a * t.cos(), table.height + b * t.sin());
    }
    let tension: Vec<f64> = angles.iter().map(|t| 1.0 + 0.5 * t.cos()).collect();
    let [positions, forces, _] = markers.lists_mut();
    PeriodicCalculus::new(count)
        .expect("a valid scene")
        .tension_forces(positions, &tension, TensionPlacement::Points, forces)
        .expect("a valid scene");
    markers
}

/// Largest errors at the interface and at the other points.
fn errors(region: Region, table: &Table, nodes: usize, tolerance: f64) -> [f64; 2] {
    let settings = Settings { nodes, tolerance, ..Settings::default() };
    let mut solver = BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene");
    // A multiple of eight, so that the points of the reference are markers.
    let count = nodes.next_multiple_of(8) * 2;
    let mut markers = markers(table, count);
    solver.velocities(&mut markers).expect("a valid scene");
    let difference = |v: Vec2, row: &[f64; 4]| (v.x - row[2]).abs().max((v.y - row[3]).abs());
    let at_markers = (0..8).map(|j| difference(markers.velocities()[j * count / 8], &table.rows[j]));
    let points: Vec<Vec2> = table.rows[8..].iter().map(|row| Vec2::new(row[0], row[1])).collect();
    let mut samples = vec![FlowSample::default(); points.len()];
    solver.sample(&markers, &points, &mut samples).expect("a valid scene");
    let at_points = samples.iter().zip(&table.rows[8..]).map(|(sample, row)| difference(sample.velocity, row));
    [at_markers.fold(0.0, f64::max), at_points.fold(0.0, f64::max)]
}

fn errors_unbounded(table: &Table, nodes: usize, tolerance: f64) -> [f64; 2] {
    if table.period.is_finite() {
        errors(Region::Box { lengths: [table.period, table.period] }, table, nodes, tolerance)
    } else {
        errors(Region::Plane, table, nodes, tolerance)
    }
}

#[test]
fn equal_viscosities() {
    for table in &reference::EQUAL {
        let found = errors_unbounded(table, 96, 1e-13);
        println!("ellipse {} period {}: {found:?}", table.ellipse, table.period);
        assert!(found[0] < 1e-12 && found[1] < 1e-12, "{found:?}");
    }
}

#[test]
fn ten_times_the_viscosity_inside() {
    for table in &reference::RATIO_10 {
        let found = errors_unbounded(table, 96, 1e-13);
        println!("ellipse {} period {}: {found:?}", table.ellipse, table.period);
        assert!(found[0] < 1e-12 && found[1] < 1e-12, "{found:?}");
    }
}

#[test]
fn channel() {
    for table in &reference::CHANNEL {
        let drive = if table.zero_flux { Drive::ZeroFlux } else { Drive::ZeroGradient };
        let region = Region::Channel { length: table.period, width: 3.0, drive };
        let found = errors(region, table, 128, 1e-13);
        println!("ellipse {} zero flux {}: {found:?}", table.ellipse, table.zero_flux);
        assert!(found[0] < 1e-11 && found[1] < 1e-11, "{found:?}");
    }
}
