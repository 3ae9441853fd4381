use std::f64::consts::TAU;

use motile_scene::{MarkerBody, MarkerKind, Scene};
use stokes_grid::{PeriodicStokes, ProjectionStokes};

use super::*;
use crate::BSpline;

/// A circle of the radius 0.8 in fluid of the viscosity 2, and the viscosities at its middle and farthest away, on
/// 32 x 32 cells.
fn viscosities<S: StokesSolver + 'static>(solver: S, inside: Option<f64>) -> [f64; 2] {
    let [x0, y0] = solver.grid().origin();
    let middle = Vec2::new(x0 + 1.6, y0 + 1.6);
    let circle = (0..100).map(|k| middle + 0.8 * Vec2::from_angle(TAU * f64::from(k) / 100.0)).collect();
    let mut scene = Scene::new(SmearedContrast::new(solver, BSpline::<4>).unwrap());
    let kind = MarkerKind::Interface { viscosity_inside: inside };
    scene.add(MarkerBody::new("circle", circle, |_, forces| forces.fill(Vec2::ZERO)).with_kind(kind));
    scene.system_mut().evaluate().unwrap();
    let (centres, nodes) = scene.system().hydrodynamics().viscosity_fields();
    // A node has the mean of the four centres around it.
    let mean =
        0.25 * [(15, 15), (16, 15), (15, 16), (16, 16)].map(|(i, j)| centres.values()[j * 32 + i]).iter().sum::<f64>();
    assert!((nodes.values()[16 * 32 + 16] - mean).abs() < 1e-12);
    [centres.values()[16 * 32 + 16], centres.values()[16 * 32]]
}

/// The fluid has its own viscosities on both sides, in a box and between walls.
#[test]
fn both_sides_have_their_viscosities() {
    for inside in [10.0, 0.5, 2.0] {
        let boxed = PeriodicStokes::new(Grid::periodic(32, 32, 0.1).unwrap(), 2.0).unwrap();
        let channel = ProjectionStokes::new(Grid::channel(32, 32, 0.1).unwrap(), 2.0).unwrap();
        for [middle, far] in [viscosities(boxed, Some(inside)), viscosities(channel, Some(inside))] {
            assert!((middle / inside - 1.0).abs() < 0.01 && (far / 2.0 - 1.0).abs() < 0.01, "{middle} {far}");
        }
    }
    let boxed = PeriodicStokes::new(Grid::periodic(32, 32, 0.1).unwrap(), 2.0).unwrap();
    assert_eq!(viscosities(boxed, None), [2.0; 2]);
}
