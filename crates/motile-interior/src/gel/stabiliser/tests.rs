use std::f64::consts::TAU;

use motile_base::Vec2;

use super::Stabiliser;
use crate::{DiscMesh, gel::elements::Elements};

/// On a disc, with the places of the nodes that are not anchored.
fn frozen(anchored: usize) -> (Stabiliser, Vec<Vec2>) {
    let mut mesh = DiscMesh::new(40, 0.2).unwrap();
    let mut nodes: Vec<Vec2> = (0..mesh.node_count()).map(|k| Vec2::from_angle(TAU * k as f64 / 40.0)).collect();
    mesh.place(&mut nodes);
    let mut elements = Elements::new(mesh.triangles().to_vec(), nodes.len(), [None; 2]);
    elements.move_to(&nodes);
    let mut stabiliser = Stabiliser::new(&elements, anchored);
    stabiliser.freeze(&elements, 0.7);
    (stabiliser, nodes.split_off(anchored))
}

#[test]
fn what_is_solved_is_what_is_added() {
    for anchored in [0, 40] {
        let (mut stabiliser, nodes) = frozen(anchored);
        let right: Vec<f64> = nodes.iter().map(|node| (5.0 * node.x).sin() + TAU * (3.0 * node.y).floor()).collect();
        let mut solution = right.clone();
        stabiliser.solve(0.3, &mut solution);
        let mut left = solution.clone();
        stabiliser.add(&solution, -0.3, &mut left);
        for (left, right) in left.iter().zip(&right) {
            assert!((left - right).abs() < 1e-9, "{left} {right}");
        }
    }
}

#[test]
fn it_is_a_diffusion() {
    let (mut stabiliser, nodes) = frozen(0);
    let mut out = vec![0.0; nodes.len()];
    let linear: Vec<f64> = nodes.iter().map(|node| 2.0 * node.x - node.y).collect();
    stabiliser.add(&linear, 1.0, &mut out);
    assert!(out[40..].iter().all(|value| value.abs() < 1e-11));
    // of x^2 the mean over the inside is 2 D
    let square: Vec<f64> = nodes.iter().map(|node| node.x * node.x).collect();
    out.fill(0.0);
    stabiliser.add(&square, 1.0, &mut out);
    let (mut sum, mut area) = (0.0, 0.0);
    for (value, mass) in out.iter().zip(&stabiliser.laplacian.masses).skip(40) {
        sum += value * mass;
        area += mass;
    }
    assert!((sum / area - 1.4).abs() < 0.05, "{}", sum / area);
}
