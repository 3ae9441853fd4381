//! Cells around the nodes of a mesh.

use std::collections::HashMap;

use ib_core::Vec2;

/// The cells around the nodes of a triangulation, bounded by the lines from the middles of the triangles' sides to
/// their centroids: areas, and for each edge between two nodes the weight of the linear elements, half the sum of the
/// cotangents of the angles opposite to it.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    triangles: Vec<[usize; 3]>,
    /// Pairs of nodes that share a side.
    pub(super) edges: Vec<[usize; 2]>,
    /// The edges of each triangle, from its first corner to the second one and so on, and whether the edge is that way
    /// round (1) or the other one (-1).
    sides: Vec<[(usize, f64); 3]>,
    /// Area of each cell (length squared).
    pub(super) areas: Vec<f64>,
    /// Weight of each edge (no dimension).
    pub(super) weights: Vec<f64>,
    /// A place where the mesh is folded, if it is.
    pub(super) folded: Option<Vec2>,
}

impl Cells {
    pub(super) fn new(triangles: Vec<[usize; 3]>, nodes: &[Vec2]) -> Self {
        let mut numbers = HashMap::new();
        let mut edges = Vec::new();
        let mut side = |from: usize, to: usize| {
            let pair = [from.min(to), from.max(to)];
            let number = *numbers.entry(pair).or_insert_with(|| {
                edges.push(pair);
                edges.len() - 1
            });
            (number, if from < to { 1.0 } else { -1.0 })
        };
        let sides = triangles.iter().map(|&[a, b, c]| [side(a, b), side(b, c), side(c, a)]).collect();
        let (areas, weights) = (vec![0.0; nodes.len()], vec![0.0; edges.len()]);
        let mut cells = Self { triangles, edges, sides, areas, weights, folded: None };
        cells.move_to(nodes);
        cells
    }

    /// Takes over where the nodes are (length).
    pub(super) fn move_to(&mut self, nodes: &[Vec2]) {
        self.areas.fill(0.0);
        self.weights.fill(0.0);
        self.folded = None;
        for (corners, sides) in self.triangles.iter().zip(&self.sides) {
            let [a, b, c] = corners.map(|node| nodes[node]);
            let twice = (b - a).perp_dot(c - a);
            if twice.is_nan() || twice <= 0.0 {
                self.folded = Some(a);
            }
            for &node in corners {
                self.areas[node] += twice / 6.0;
            }
            for (&(edge, _), (p, q, r)) in sides.iter().zip([(a, b, c), (b, c, a), (c, a, b)]) {
                self.weights[edge] += 0.5 * (p - r).dot(q - r) / twice;
            }
        }
    }

    /// Writes the fluxes from cell to cell (length squared per time), from the first to the second node of each edge,
    /// of a motion relative to the mesh, and the rates at which the areas of the cells change as the nodes move (length
    /// squared per time).
    pub(super) fn write_fluxes(
        &self,
        nodes: &[Vec2],
        (fluid, motion): (&[Vec2], &[Vec2]),
        fluxes: &mut [f64],
        growth: &mut [f64],
    ) {
        fluxes.fill(0.0);
        growth.fill(0.0);
        for (corners, sides) in self.triangles.iter().zip(&self.sides) {
            let [a, b, c] = corners.map(|node| nodes[node]);
            let [u, v, w] = corners.map(|node| motion[node]);
            let rate = (v - u).perp_dot(c - a) + (b - a).perp_dot(w - u);
            let relative = corners.map(|node| fluid[node] - motion[node]);
            let around = [(a, b, 0, 1, 2), (b, c, 1, 2, 0), (c, a, 2, 0, 1)];
            let centroid = (a + b + c) / 3.0;
            for (k, (&(edge, sign), (from, to, first, second, third))) in sides.iter().zip(around).enumerate() {
                let face = centroid - 0.5 * (from + to);
                // The velocity in the middle of the face, of a linear one.
                let across = (5.0 * (relative[first] + relative[second]) + 2.0 * relative[third]) / 12.0;
                fluxes[edge] += sign * across.perp_dot(face);
                growth[corners[k]] += rate / 6.0;
            }
        }
    }
}
