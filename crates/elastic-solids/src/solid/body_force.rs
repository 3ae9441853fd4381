//! A force on a solid that is uniform over its area, such as its weight.

use motile_base::Vec2;

use crate::mesh::TriangleMesh;

/// Uniform force on a solid: each point takes a third of the area at rest of each of its triangles.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BodyForce {
    density: Vec2,
    /// Areas of the points at rest (length squared).
    areas: Vec<f64>,
}

impl BodyForce {
    /// Creates the force of this density (force per area) on the points of a mesh.
    pub(crate) fn new(mesh: &TriangleMesh, density: Vec2) -> Self {
        let mut areas = vec![0.0; mesh.points().len()];
        for (corners, area) in mesh.triangles().iter().zip(mesh.areas()) {
            corners.iter().for_each(|&corner| areas[corner] += area / 3.0);
        }
        Self { density, areas }
    }

    /// Returns the force per area at rest (force per area).
    pub(crate) fn density(&self) -> Vec2 {
        self.density
    }

    /// Adds the forces on the points (force).
    pub(crate) fn add_forces(&self, forces: &mut [Vec2]) {
        for (force, area) in forces.iter_mut().zip(&self.areas) {
            *force += *area * self.density;
        }
    }
}

#[cfg(test)]
mod tests;
