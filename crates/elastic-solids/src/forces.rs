//! Elastic forces of a deformed mesh: springs along its edges, hyperelastic material, or your own law.

mod hyperelastic;
mod inner_stress;
mod patches;
mod springs;

use motile_base::Vec2;

use crate::material::Mat2;
use crate::mesh::TriangleMesh;
use crate::{Moduli, SolidError};

pub(crate) use hyperelastic::Element;
pub use hyperelastic::Hyperelastic;
pub(crate) use inner_stress::add_stress_of_bar;
pub use springs::Springs;

/// Elastic forces of a deformed mesh, as minus the gradient of an energy: [`Hyperelastic`] material or [`Springs`].
///
/// The energy does not change when the deformed mesh is moved or turned, so that forces have neither a sum nor a
/// torque, to round-off.
pub trait ElasticForces: std::fmt::Debug + Send + Sync + 'static {
    /// Returns the number of points of the mesh.
    fn point_count(&self) -> usize;

    /// Adds the elastic forces -dE/dX (force) of the mesh with its points at `positions` (length).
    ///
    /// # Errors
    /// Returns an error for lists of the wrong length; an inverted triangle where the energy is not defined for it.
    fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError>;

    /// Returns the elastic energy E (energy) of the mesh with its points at `positions` (length).
    ///
    /// # Errors
    /// Returns the errors of [`ElasticForces::add_forces`].
    fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError>;

    /// Returns the first Piola-Kirchhoff stress (force per reference length) in a triangle whose deformation gradient
    /// is `gradient`, where it is defined. It is `None` for a triangle beyond the last.
    fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2>;

    /// Returns the first Piola-Kirchhoff stresses (force per reference length) in all triangles with these deformation
    /// gradients, the same as [`ElasticForces::stress`] unless triangles act on each other; `None` if one is not
    /// defined.
    fn stresses(&self, gradients: &[Mat2]) -> Option<Vec<Mat2>> {
        gradients.iter().enumerate().map(|(triangle, gradient)| self.stress(triangle, gradient)).collect()
    }

    /// Returns the largest shear modulus and largest bulk modulus of small strains (force per length), which bound the
    /// time step.
    fn stiffest(&self) -> Moduli;
}

/// A straight bar between two points of a mesh, across the periodic edge of a periodic one where its points stand
/// there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bar {
    pub(crate) ends: [u32; 2],
    /// Addition to x of the second end across the periodic edge (length).
    pub(crate) shift: f64,
    /// Length in the reference state (length).
    pub(crate) length: f64,
}

impl Bar {
    /// Bars along all edges of a mesh, in their order, at their reference lengths.
    pub(crate) fn all(mesh: &TriangleMesh) -> impl Iterator<Item = Self> {
        mesh.edges().iter().map(|edge| Self {
            ends: edge.points.map(|point| point as u32),
            shift: f64::from(edge.periods) * mesh.period().unwrap_or(0.0),
            length: mesh.edge_vector(edge, mesh.points()).length(),
        })
    }

    /// Returns the vector from the first end to the second (length).
    #[inline]
    pub(crate) fn span(&self, positions: &[Vec2]) -> Vec2 {
        let [from, to] = self.ends.map(|point| positions[point as usize]);
        Vec2::new(to.x + self.shift - from.x, to.y - from.y)
    }

    /// Adds `force` to that on the first end, and the opposite force to that on the second.
    #[inline]
    pub(crate) fn add_pull(&self, force: Vec2, forces: &mut [Vec2]) {
        let [from, to] = self.ends.map(|point| point as usize);
        forces[from] += force;
        forces[to] -= force;
    }
}

#[cfg(test)]
mod tests;
