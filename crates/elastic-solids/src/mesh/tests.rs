//! Connectivity of hand-made meshes.

use crate::error::refused as is_refused;
use motile_base::InputError;

use super::*;

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// A square with a square hole: eight points, eight triangles.
fn frame() -> TriangleMesh {
    let square = |r: f64| [v(-r, -r), v(r, -r), v(r, r), v(-r, r)];
    let points = square(2.0).into_iter().chain(square(1.0)).collect();
    // Every other triangle is given clockwise.
    let triangles = (0..4).flat_map(|k| {
        let n = (k + 1) % 4;
        [[k, n, 4 + k], [n, 4 + k, 4 + n]]
    });
    TriangleMesh::new(points, triangles.collect()).unwrap()
}

#[test]
fn a_frame_has_two_loops_with_the_solid_to_their_left() {
    let mesh = frame();
    assert!((mesh.area() - 12.0).abs() < 1e-14);
    assert!((mesh.point_areas().iter().sum::<f64>() - 12.0).abs() < 1e-14);
    assert_eq!(mesh.edges().len(), 16);
    assert_eq!(mesh.edges().iter().filter(|edge| edge.triangles.1.is_none()).count(), 8);
    let signed: Vec<f64> = mesh
        .boundary_loops()
        .iter()
        .map(|boundary| {
            let polygon = mesh.raw_polygon(boundary, mesh.points());
            (0..polygon.len()).map(|k| 0.5 * polygon[k].perp_dot(polygon[(k + 1) % polygon.len()])).sum()
        })
        .collect();
    assert!(signed.len() == 2 && signed.contains(&16.0) && signed.contains(&-4.0), "{signed:?}");
}

#[test]
fn edges_name_the_triangles_to_their_left_and_right() {
    let mesh = frame();
    for edge in mesh.edges() {
        let left = &mesh.triangles()[edge.triangles.0];
        let from = left.iter().position(|&p| p == edge.points[0]).unwrap();
        assert_eq!(left[(from + 1) % 3], edge.points[1]);
        if let Some(right) = edge.triangles.1 {
            let right = &mesh.triangles()[right];
            let from = right.iter().position(|&p| p == edge.points[1]).unwrap();
            assert_eq!(right[(from + 1) % 3], edge.points[0]);
        }
    }
}

#[test]
fn a_point_where_two_parts_touch_gives_loops_that_follow_their_triangles() {
    let points = vec![v(0.0, 0.0), v(1.0, 0.0), v(0.0, 1.0), v(-1.0, 0.0), v(0.0, -1.0)];
    let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 3, 4]]).unwrap();
    assert_eq!(mesh.boundary_loops().iter().map(|l| l.points.len()).collect::<Vec<_>>(), [3, 3]);
}

#[test]
fn triangles_across_the_seam_are_as_large_as_the_others() {
    let points: Vec<Vec2> = (0..8).map(|k| v(0.3 + f64::from(k % 4), f64::from(k / 4))).collect();
    let triangles = (0..4).flat_map(|k| {
        let n = (k + 1) % 4;
        [[k, n, 4 + k], [n, 4 + n, 4 + k]]
    });
    let mesh = TriangleMesh::periodic(points, triangles.collect(), 4.0).unwrap();
    assert!(mesh.areas().iter().all(|area| (area - 0.5).abs() < 1e-14));
    for edge in mesh.edges() {
        assert!(mesh.edge_vector(edge, mesh.points()).length() < 1.5);
    }
    // Moved as a whole by more than a period, nothing changes.
    let moved: Vec<Vec2> = mesh.points().iter().map(|p| p + v(5.7, 1.0)).collect();
    for triangle in 0..8 {
        let corners = mesh.raw_corners(triangle, &moved);
        assert!(((corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) - 1.0).abs() < 1e-13);
    }
    for boundary in mesh.boundary_loops() {
        let polygon = mesh.raw_polygon(boundary, &moved);
        let advance = polygon[3].x - polygon[0].x;
        assert!((advance - 3.0 * f64::from(boundary.periods)).abs() < 1e-13);
    }
}

#[test]
fn what_a_mesh_does_not_have() {
    let mesh = equilateral_strip(v(0.0, 0.0), 4, 2, 1.0).unwrap();
    let points = mesh.points();
    assert!(mesh.corners(15, points).is_some() && mesh.corners(16, points).is_none());
    assert!(mesh.corners(99, points).is_none() && mesh.corners(0, &points[1..]).is_none());
    let boundary = &mesh.boundary_loops()[0];
    assert!(mesh.boundary_polygon(boundary, points).is_some());
    assert!(mesh.boundary_polygon(boundary, &points[1..]).is_none());
    let foreign = BoundaryLoop { points: vec![0, 99], periods: 0 };
    assert!(mesh.boundary_polygon(&foreign, points).is_none());
    let material = crate::NeoHookean::new(1.0, 2.0).unwrap();
    let law = crate::forces::Hyperelastic::new(&mesh, material);
    assert!(law.material(15).is_some() && law.material(16).is_none());
    for law in [&law as &dyn crate::ElasticForces, &crate::forces::Springs::new(&mesh, 1.0).unwrap()] {
        let stress = |triangle| law.stress(triangle, &crate::material::Mat2::IDENTITY);
        assert!(stress(15).is_some() && stress(16).is_none());
    }
    let solid = crate::Solid::hyperelastic(mesh, material);
    assert!(solid.gradient(15).is_some() && solid.gradient(16).is_none());
}

#[test]
fn bad_meshes_are_refused() {
    let corners = || vec![v(0.0, 0.0), v(1.0, 0.0), v(0.0, 1.0), v(1.0, 1.0)];
    let refused =
        |points: Vec<Vec2>, triangles: &[[usize; 3]]| TriangleMesh::new(points, triangles.to_vec()).unwrap_err();
    assert!(matches!(refused(corners(), &[]), SolidError::Input(InputError::TooFew { .. })));
    assert!(is_refused(&refused(corners(), &[[0, 1, 2]]), "point 3 at (1.0000, 1.0000) belongs to no triangle"));
    assert!(is_refused(&refused(corners(), &[[0, 1, 4]]), "triangle 0 names point 4, which does not exist"));
    assert!(is_refused(&refused(corners(), &[[0, 1, 1]]), "triangle 0 near (0.0000, 0.0000) is flat"));
    let mut points = corners();
    points[3] = v(0.5, 0.5);
    assert!(is_refused(&refused(points, &[[1, 2, 3]]), "triangle 0 near (1.0000, 0.0000) is flat"));
    let mut points = corners();
    points[2].y = f64::NAN;
    assert!(matches!(refused(points, &[[0, 1, 2]]), SolidError::Input(InputError::EntryNotFinite { index: 2, .. })));
    // The same triangle twice, and two on the same side of an edge.
    let overlap = "triangles overlap at the edge between points";
    assert!(is_refused(&refused(corners(), &[[0, 1, 2], [0, 1, 2], [1, 2, 3]]), overlap));
    assert!(is_refused(&refused(corners(), &[[0, 1, 2], [0, 1, 3]]), overlap));
    let wide = TriangleMesh::periodic(corners(), vec![[0, 1, 2], [1, 2, 3]], 2.0);
    assert!(is_refused(&wide.unwrap_err(), "triangle 0 is too wide: it is 1.0000 wide, which is half the period 2"));
    assert!(matches!(
        TriangleMesh::periodic(corners(), vec![[0, 1, 2]], -1.0),
        Err(SolidError::Input(InputError::NotPositive { .. }))
    ));
}

#[test]
fn a_finer_boundary_has_twice_as_many_points_and_the_same_shape() {
    let strip = equilateral_strip(v(-1.0, -1.0), 20, 6, 0.1).unwrap();
    let finer = strip.with_finer_boundary(|s| s.y > -0.9).unwrap();
    assert!((finer.area() - strip.area()).abs() < 1e-12);
    let counts: Vec<usize> = finer.boundary_loops().iter().map(|boundary| boundary.points.len()).collect();
    assert_eq!(counts, [20, 40]);
    let upper: Vec<Vec2> = finer.raw_polygon(&finer.boundary_loops()[1], finer.points());
    assert!(upper.windows(2).all(|pair| (pair[0] - pair[1] - v(0.05, 0.0)).length() < 1e-12), "{upper:?}");
    // Corners stay where they are, sides straight.
    let frame = frame();
    let finer = frame.with_finer_boundary(|_| true).unwrap();
    assert_eq!(finer.points().len(), 16);
    assert!((finer.area() - 12.0).abs() < 1e-12);
    // New points of a circle lie on it to fourth order.
    let errors = [0.2, 0.1].map(|spacing| {
        let disc = crate::Outline::circle(v(0.3, 0.1), 1.0).unwrap().mesh(spacing).unwrap();
        let finer = disc.with_finer_boundary(|_| true).unwrap();
        let points = finer.boundary_loops()[0].points.iter();
        points.map(|point| (finer.points()[*point].distance(v(0.3, 0.1)) - 1.0).abs()).fold(0.0, f64::max)
    });
    assert!(errors[0] < 1e-4 && (errors[0] / errors[1]).log2() > 3.5, "{errors:?}");
}
