//! Linear finite elements on triangles.

use motile_base::Vec2;

/// Linear elements on a triangulation: gradients of the basis functions and areas at the present positions of the
/// nodes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Elements {
    pub(super) triangles: Vec<[usize; 3]>,
    /// Periods in x and y, where nodes at the periodic edge belong to triangles across it.
    periods: [Option<f64>; 2],
    /// Gradients of the three basis functions of each triangle (1/length).
    pub(super) gradients: Vec<[Vec2; 3]>,
    /// Area of each triangle (length squared).
    pub(super) areas: Vec<f64>,
    /// Mass of each node: a third of the areas around it (length squared).
    pub(super) masses: Vec<f64>,
    /// Number of the triangle of minimum area.
    pub(super) least: usize,
}

impl Elements {
    pub(super) fn new(triangles: Vec<[usize; 3]>, nodes: usize, periods: [Option<f64>; 2]) -> Self {
        let count = triangles.len();
        let (gradients, areas) = (vec![[Vec2::ZERO; 3]; count], vec![0.0; count]);
        Self { triangles, periods, gradients, areas, masses: vec![0.0; nodes], least: 0 }
    }

    /// Returns the vector from one position to another, the shortest over periodic images.
    pub(super) fn between(&self, from: Vec2, to: Vec2) -> Vec2 {
        let mut way = to - from;
        let [x, y] = self.periods;
        if let Some(period) = x {
            way.x -= period * (way.x / period).round();
        }
        if let Some(period) = y {
            way.y -= period * (way.y / period).round();
        }
        way
    }

    /// Returns the position of a point of a triangle (length) from the weights of its corners.
    pub(super) fn place(&self, triangle: usize, nodes: &[Vec2], weights: [f64; 3]) -> Vec2 {
        let [a, b, c] = self.triangles[triangle].map(|node| nodes[node]);
        a + weights[1] * self.between(a, b) + weights[2] * self.between(a, c)
    }

    /// Takes over the positions of the nodes (length).
    pub(super) fn move_to(&mut self, nodes: &[Vec2]) {
        self.masses.fill(0.0);
        self.least = 0;
        for number in 0..self.triangles.len() {
            let [a, b, c] = self.triangles[number];
            let (first, second) = (self.between(nodes[a], nodes[b]), self.between(nodes[a], nodes[c]));
            let twice = first.perp_dot(second);
            // The gradient of a corner's function is the opposite edge, turned inwards, over twice the area.
            let (on_b, on_c) = (-second.perp() / twice, first.perp() / twice);
            self.gradients[number] = [-on_b - on_c, on_b, on_c];
            self.areas[number] = 0.5 * twice;
            for node in [a, b, c] {
                self.masses[node] += twice / 6.0;
            }
            if self.areas[number] < self.areas[self.least] {
                self.least = number;
            }
        }
    }

    /// Returns the gradient (d/dx, d/dy) in a triangle of vectors given at the nodes.
    #[inline]
    pub(super) fn gradient(&self, triangle: usize, values: &[Vec2]) -> [Vec2; 2] {
        let corners = self.triangles[triangle].iter().zip(&self.gradients[triangle]);
        corners.fold([Vec2::ZERO; 2], |[x, y], (&node, slope)| [x + slope.x * values[node], y + slope.y * values[node]])
    }
}

#[cfg(test)]
mod tests;
