//! Cells around the nodes of a triangulation.

use motile_base::Vec2;

use crate::laplacian::{Sides, edges};

/// Cells around the nodes of a triangulation, bounded by the lines from the midpoints of the triangles' sides to their
/// centroids.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    triangles: Vec<[usize; 3]>,
    /// Edges between neighbouring nodes, the lower number first.
    pub(super) edges: Vec<[usize; 2]>,
    /// Edges of each triangle from its first corner to the second one and so on, with their orientation, 1 or -1.
    sides: Vec<Sides>,
    /// Area of each cell (length squared).
    pub(super) areas: Vec<f64>,
    /// Weight of each edge in linear elements: half the sum of the cotangents of the angles opposite to it (no
    /// dimension).
    pub(super) weights: Vec<f64>,
    /// Corner of a triangle of negative area (length), if there is one.
    pub(super) folded: Option<Vec2>,
}

impl Cells {
    pub(super) fn new(triangles: Vec<[usize; 3]>, nodes: &[Vec2]) -> Self {
        let (edges, sides) = edges(&triangles);
        let (areas, weights) = (vec![0.0; nodes.len()], vec![0.0; edges.len()]);
        let mut cells = Self { triangles, edges, sides, areas, weights, folded: None };
        cells.move_to(nodes);
        cells
    }

    /// Takes over the positions of the nodes (length).
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

    /// Writes the fluxes of fluid relative to the mesh from cell to cell, from the first to the second node of each
    /// edge, and the rates of change of the cells' areas (both length squared per time), from the velocities of fluid
    /// and nodes at the nodes (length per time).
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
                // A linear velocity in the middle of the face.
                let across = (5.0 * (relative[first] + relative[second]) + 2.0 * relative[third]) / 12.0;
                fluxes[edge] += sign * across.perp_dot(face);
                growth[corners[k]] += rate / 6.0;
            }
        }
    }

    /// Fills negative numbers of particles from neighbouring cells that have some, so that the sum stays: passes over
    /// the edges until no number is negative, at most `passes`.
    pub(super) fn fill_up(&self, numbers: &mut [f64], passes: usize) {
        for _ in 0..passes {
            if numbers.iter().all(|&number| number >= 0.0) {
                break;
            }
            for &[i, j] in &self.edges {
                for (poor, rich) in [(i, j), (j, i)] {
                    if numbers[poor] < 0.0 && numbers[rich] > 0.0 {
                        let given = (-numbers[poor]).min(numbers[rich]);
                        numbers[poor] += given;
                        numbers[rich] -= given;
                    }
                }
            }
        }
    }
}
