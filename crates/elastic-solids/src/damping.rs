//! Viscous stress of solids that are more viscous than the fluid.

use motile_base::Vec2;

use crate::{forces::Element, mesh::TriangleMesh};

/// A viscous stress `eta (L + L^T)` in the triangles of a mesh, beside that of the fluid in them, with the gradient of
/// velocity L.
#[derive(Debug, Clone)]
pub(crate) struct Damping {
    elements: Vec<Element>,
    /// Viscosity eta, in excess of the fluid's (force per length times time).
    viscosity: f64,
    velocities: Vec<Vec2>,
    forces: Vec<Vec2>,
}

impl Damping {
    /// A viscosity in excess of the fluid's (force per length times time).
    pub(crate) fn new(mesh: &TriangleMesh, viscosity: f64) -> Self {
        let none = vec![Vec2::ZERO; mesh.points().len()];
        Self { elements: Element::all(mesh), viscosity, velocities: none.clone(), forces: none }
    }

    /// Viscosity in excess of the fluid's (force per length times time).
    pub(crate) fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Adds the forces on the points `free`, which have these velocities (length per time), with all points at
    /// `positions` (length); the other points are at rest.
    pub(crate) fn add_forces(
        &mut self,
        (positions, free): (&[Vec2], &[usize]),
        velocities: &[Vec2],
        forces: &mut [Vec2],
    ) {
        for (&point, velocity) in free.iter().zip(velocities) {
            self.velocities[point] = *velocity;
        }
        self.forces.fill(Vec2::ZERO);
        for element in &self.elements {
            let gradient = element.gradient(positions);
            let inverse = gradient.inverse();
            let spatial = element.gradient_of(&self.velocities) * inverse;
            let stress = (spatial + spatial.transpose()) * (self.viscosity * gradient.determinant());
            element.add_forces(&(stress * inverse.transpose()), &mut self.forces);
        }
        for (force, &point) in forces.iter_mut().zip(free) {
            *force += self.forces[point];
        }
    }
}

#[cfg(test)]
mod tests;
