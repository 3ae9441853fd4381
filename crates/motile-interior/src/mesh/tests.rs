use std::f64::consts::{PI, TAU};

use motile_base::Vec2;

use super::DiscMesh;

fn area(nodes: &[Vec2], [a, b, c]: [usize; 3]) -> f64 {
    0.5 * (nodes[b] - nodes[a]).perp_dot(nodes[c] - nodes[a])
}

fn placed(mesh: &mut DiscMesh, curve: impl Fn(f64) -> Vec2) -> Vec<Vec2> {
    let markers = mesh.marker_count();
    let mut nodes: Vec<Vec2> = (0..mesh.node_count()).map(|k| curve(TAU * k as f64 / markers as f64)).collect();
    mesh.place(&mut nodes);
    nodes
}

#[test]
fn triangles_fill_the_inside_once() {
    for (markers, spacing) in [(8, 0.1), (64, 0.1), (64, 0.3), (100, 0.02), (129, 0.15)] {
        let mut mesh = DiscMesh::new(markers, spacing).unwrap();
        let nodes = placed(&mut mesh, |a| Vec2::from_angle(a) + 0.1 * Vec2::from_angle(3.0 * a));
        let areas: Vec<f64> = mesh.triangles().iter().map(|triangle| area(&nodes, *triangle)).collect();
        assert!(areas.iter().all(|area| *area > 0.0), "{markers} {spacing}");
        let around: f64 = (0..markers).map(|k| 0.5 * nodes[k].perp_dot(nodes[(k + 1) % markers])).sum();
        assert!((areas.iter().sum::<f64>() - around).abs() < 1e-12, "{markers} {spacing}");
        // Euler: nodes - edges + triangles = 1, edges = (3 triangles + markers)/2
        assert_eq!(2 * mesh.node_count(), mesh.triangles().len() + markers + 2);
        if markers > 8 {
            let smallest = areas.iter().copied().fold(f64::INFINITY, f64::min);
            let ideal = 0.433 * spacing.min(TAU / markers as f64).powi(2);
            assert!(smallest > 0.4 * ideal, "{markers} {spacing}: {smallest} {ideal}");
        }
    }
}

#[test]
fn it_follows_harmonic_motion_exactly() {
    let mut mesh = DiscMesh::new(48, 0.12).unwrap();
    let disc = placed(&mut mesh, Vec2::from_angle);
    let bent =
        placed(&mut mesh, |a| Vec2::new(2.0 + 3.0 * a.cos(), 0.5 * a.sin() - 1.0) + 0.2 * Vec2::from_angle(2.0 * a));
    for (at, moved) in disc.iter().zip(&bent) {
        let wave = Vec2::new(at.x * at.x - at.y * at.y, 2.0 * at.x * at.y);
        let expected = Vec2::new(2.0 + 3.0 * at.x, 0.5 * at.y - 1.0) + 0.2 * wave;
        assert!(moved.distance(expected) < 1e-13);
    }
}

#[test]
fn the_number_of_nodes_is_that_of_the_spacing() {
    let [coarse, fine] = [0.1, 0.05].map(|spacing| DiscMesh::new(200, spacing).unwrap().node_count() as f64);
    assert!((fine / (PI / (0.866 * 0.05 * 0.05)) - 1.0).abs() < 0.2, "{fine}");
    assert!(coarse < 0.6 * fine, "{coarse} {fine}");
    // Also where it is smaller than that of the markers.
    let counts = [0.04, 0.02, 0.01].map(|spacing| DiscMesh::new(64, spacing).unwrap().node_count() as f64);
    assert!(counts.windows(2).all(|pair| (3.0..4.5).contains(&(pair[1] / pair[0]))), "{counts:?}");
    assert!(counts[0] > 1000.0, "{counts:?}");
    for (markers, spacing) in [(7, 0.1), (100, 0.0), (100, 0.51), (100, f64::NAN), (100, 1e-6), (100_000, 1e-6)] {
        DiscMesh::new(markers, spacing).unwrap_err();
    }
    for growth in [0.99, 2.01, f64::NAN] {
        DiscMesh::graded(100, 0.1, growth).unwrap_err();
    }
}

#[test]
fn a_mesh_that_grows_faster_has_fewer_nodes_and_good_triangles() {
    for (markers, spacing) in [(288, 0.1), (96, 0.3), (200, 0.5)] {
        let counts = [1.25, 2.0].map(|growth| {
            let mut mesh = DiscMesh::graded(markers, spacing, growth).unwrap();
            let nodes = placed(&mut mesh, Vec2::from_angle);
            let angle = |[a, b, c]: [usize; 3]| (nodes[b] - nodes[a]).angle_to(nodes[c] - nodes[a]).to_degrees();
            let corners = mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b, c], [b, c, a], [c, a, b]]);
            let least = corners.map(angle).fold(f64::INFINITY, f64::min);
            assert!(least > 15.0, "{markers} {spacing} {growth}: {least}");
            mesh.node_count() as f64
        });
        assert!(counts[1] < 0.7 * counts[0], "{markers} {spacing}: {counts:?}");
    }
}
