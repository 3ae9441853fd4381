//! Viscous stress of solids that are more viscous than the fluid.

use motile_base::Vec2;

use crate::{forces::Element, mesh::TriangleMesh};

/// A viscous stress `eta (L + L^T)` in the triangles of a mesh, in addition to the stress of the fluid in them, with
/// the gradient of velocity L.
#[derive(Debug, Clone)]
pub(crate) struct Damping {
    elements: Vec<Element>,
    /// Viscosity eta, in excess of the fluid's (force per length times time).
    viscosity: f64,
    velocities: Vec<Vec2>,
    forces: Vec<Vec2>,
}

impl Damping {
    /// Creates a viscosity in excess of the fluid's (force per length times time).
    pub(crate) fn new(mesh: &TriangleMesh, viscosity: f64) -> Self {
        let none = vec![Vec2::ZERO; mesh.points().len()];
        Self { elements: Element::all(mesh), viscosity, velocities: none.clone(), forces: none }
    }

    /// Returns the viscosity in excess of the fluid's (force per length times time).
    pub(crate) fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Returns the forces on all points (force), which lie at `positions` (length), from the velocities (length per
    /// time) of the numbered points that are free; the others are at rest.
    pub(crate) fn forces(&mut self, positions: &[Vec2], free: impl Iterator<Item = (usize, Vec2)>) -> &[Vec2] {
        free.for_each(|(point, velocity)| self.velocities[point] = velocity);
        self.forces.fill(Vec2::ZERO);
        for element in &self.elements {
            let gradient = element.gradient(positions);
            let inverse = gradient.inverse();
            let spatial = element.gradient_of(&self.velocities) * inverse;
            let stress = (spatial + spatial.transpose()) * (self.viscosity * gradient.determinant());
            element.add_forces(&(stress * inverse.transpose()), &mut self.forces);
        }
        &self.forces
    }
}

#[cfg(test)]
mod tests;
