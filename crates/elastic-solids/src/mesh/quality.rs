//! Quality of meshes: evenness of edges and angles.

use crate::mesh::TriangleMesh;

/// Quality of a mesh in the reference state: scatter of its edge lengths and angles.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct MeshQuality {
    /// Number of points.
    pub points: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Mean length of the edges (length).
    pub mean_edge: f64,
    /// Standard deviation of the edge lengths over their mean (dimensionless).
    pub edge_deviation: f64,
    /// Fraction of the edges whose length is off the mean by more than a fifth (dimensionless).
    pub uneven_edges: f64,
    /// Length of the shortest edge (length).
    pub shortest_edge: f64,
    /// Length of the longest edge (length).
    pub longest_edge: f64,
    /// Smallest angle of a triangle (degrees).
    pub smallest_angle: f64,
    /// Largest angle of a triangle (degrees).
    pub largest_angle: f64,
}

impl std::fmt::Display for MeshQuality {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { points, triangles, mean_edge, shortest_edge, longest_edge, .. } = self;
        let (deviation, smallest, largest) = (100.0 * self.edge_deviation, self.smallest_angle, self.largest_angle);
        write!(f, "{points} points, {triangles} triangles, edges {mean_edge:.4} (+- {deviation:.1} %, ")?;
        write!(f, "{shortest_edge:.4} to {longest_edge:.4}), angles {smallest:.1} to {largest:.1} degrees")
    }
}

impl TriangleMesh {
    /// Returns the quality of the mesh in the reference state.
    #[must_use]
    pub fn quality(&self) -> MeshQuality {
        let lengths: Vec<f64> =
            self.edges().iter().map(|edge| self.edge_vector(edge, self.points()).length()).collect();
        let count = lengths.len() as f64;
        let mean = lengths.iter().sum::<f64>() / count;
        let variance = lengths.iter().map(|length| (length - mean).powi(2)).sum::<f64>() / count;
        let uneven = lengths.iter().filter(|&length| (length - mean).abs() > 0.2 * mean).count() as f64;
        let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
        for triangle in 0..self.triangles().len() {
            let corners = self.raw_corners(triangle, self.points());
            for k in 0..3 {
                let (a, b) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
                let angle = a.angle_to(b);
                smallest = smallest.min(angle);
                largest = largest.max(angle);
            }
        }
        MeshQuality {
            points: self.points().len(),
            triangles: self.triangles().len(),
            mean_edge: mean,
            edge_deviation: variance.sqrt() / mean,
            uneven_edges: uneven / count,
            shortest_edge: lengths.iter().copied().fold(f64::INFINITY, f64::min),
            longest_edge: lengths.iter().copied().fold(0.0, f64::max),
            smallest_angle: smallest.to_degrees(),
            largest_angle: largest.to_degrees(),
        }
    }
}
