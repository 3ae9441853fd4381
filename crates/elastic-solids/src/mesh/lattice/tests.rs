use motile_base::InputError;

use super::*;

#[test]
fn a_strip_is_equilateral_and_periodic() {
    let mesh = equilateral_strip(Vec2::new(-1.0, 2.0), 8, 5, 0.25).unwrap();
    let quality = mesh.quality();
    assert_eq!((quality.points, quality.triangles), (8 * 6, 2 * 8 * 5));
    assert!(quality.edge_deviation < 1e-14);
    assert!((quality.smallest_angle - 60.0).abs() < 1e-10);
    assert!((mesh.area() - 2.0 * 5.0 * ROW_HEIGHT * 0.25).abs() < 1e-13);
    assert_eq!(mesh.period(), Some(2.0));
    // Two surfaces, the solid to their left.
    let loops = mesh.boundary_loops();
    assert_eq!(loops.len(), 2);
    let mut advances = loops.iter().map(|l| (l.periods, l.points.len())).collect::<Vec<_>>();
    advances.sort_unstable();
    assert_eq!(advances, [(-1, 8), (1, 8)]);
    // Euler's formula on a cylinder: points - edges + triangles = 0.
    assert_eq!(quality.points + quality.triangles, mesh.edges().len());
}

#[test]
fn a_fitted_strip_fills_its_rectangle() {
    let mesh = fitted_strip(Vec2::ZERO, [3.0, 1.0], 0.11).unwrap();
    assert!((mesh.area() - 3.0).abs() < 1e-12);
    let highest = mesh.points().iter().map(|p| p.y).fold(0.0, f64::max);
    assert!((highest - 1.0).abs() < 1e-14);
    assert!(mesh.quality().edge_deviation < 8e-4);
}

#[test]
fn a_block_is_equilateral() {
    for (columns, rows) in [(1, 1), (2, 2), (4, 3), (3, 6)] {
        let mesh = equilateral_block(Vec2::ZERO, columns, rows, 0.5).unwrap();
        let quality = mesh.quality();
        assert_eq!(quality.triangles, rows * (2 * columns - 1));
        assert!(quality.edge_deviation < 1e-13);
        assert_eq!(mesh.boundary_loops().len(), 1);
        assert_eq!(mesh.boundary_loops()[0].periods, 0);
        // Euler's formula on a disc.
        assert_eq!(quality.points + quality.triangles, mesh.edges().len() + 1);
    }
}

#[test]
fn sizes_that_make_no_lattice_are_refused() {
    let origin = Vec2::ZERO;
    assert!(matches!(
        equilateral_strip(origin, 2, 4, 0.1),
        Err(SolidError::Input(InputError::TooFew { minimum: 3, .. }))
    ));
    assert!(matches!(
        equilateral_strip(origin, 5, 0, 0.1),
        Err(SolidError::Input(InputError::TooFew { minimum: 1, .. }))
    ));
    assert!(matches!(equilateral_strip(origin, 5, 4, -0.1), Err(SolidError::Input(InputError::NotPositive { .. }))));
    assert!(matches!(fitted_strip(origin, [1.0, 1.0], 1e-12), Err(SolidError::Input(InputError::OutOfRange { .. }))));
    assert!(matches!(
        fitted_strip(origin, [f64::NAN, 1.0], 0.1),
        Err(SolidError::Input(InputError::NotPositive { .. }))
    ));
    assert!(matches!(equilateral_block(origin, 0, 1, 0.1), Err(SolidError::Input(InputError::TooFew { .. }))));
    let nowhere = Vec2::new(f64::NAN, 0.0);
    assert!(matches!(equilateral_block(nowhere, 1, 1, 0.1), Err(SolidError::Input(InputError::EntryNotFinite { .. }))));
}
