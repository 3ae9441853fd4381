//! Forces of hyperelastic material.

use ib_core::Vec2;

use crate::forces::{Element, fits};
use crate::{DeformationGradient, ElasticForces, EnergyDensity, Mat2, Moduli, SolidError, TriangleMesh};

/// Elastic forces of a hyperelastic material on a triangle mesh (thesis section 4.2.1.1): the deformation gradient A is
/// constant in each triangle, the energy is the sum of W(A) A_ref over the triangles (4.11), and the force on a point
/// is minus its derivative (4.12).
#[derive(Debug, Clone)]
pub struct Hyperelastic<E> {
    elements: Vec<Element>,
    /// One for all triangles, or one each.
    materials: Vec<E>,
    points: usize,
}

impl<E: EnergyDensity> Hyperelastic<E> {
    /// One material everywhere.
    #[must_use]
    pub fn new(mesh: &TriangleMesh, material: E) -> Self {
        Self { elements: Element::all(mesh), materials: vec![material], points: mesh.points().len() }
    }

    /// The material of each triangle as a function of its centroid in the reference state (length).
    ///
    /// # Errors
    /// Those of the function.
    pub fn graded(
        mesh: &TriangleMesh,
        mut material: impl FnMut(Vec2) -> Result<E, SolidError>,
    ) -> Result<Self, SolidError> {
        let triangles = 0..mesh.triangles().len();
        let materials = triangles.map(|triangle| material(mesh.centroid(triangle))).collect::<Result<_, _>>()?;
        Ok(Self { elements: Element::all(mesh), materials, points: mesh.points().len() })
    }

    /// The material of a triangle.
    ///
    /// # Panics
    /// A triangle beyond the last.
    #[must_use]
    pub fn material(&self, triangle: usize) -> &E {
        &self.materials[if self.materials.len() == 1 { 0 } else { triangle }]
    }
}

impl<E: EnergyDensity> ElasticForces for Hyperelastic<E> {
    fn point_count(&self) -> usize {
        self.points
    }

    fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
        fits("the positions", positions.len(), self.points)?;
        fits("the forces", forces.len(), self.points)?;
        for (triangle, element) in self.elements.iter().enumerate() {
            let gradient = DeformationGradient::checked(element.gradient(positions))
                .ok_or_else(|| element.inverted(triangle, positions))?;
            element.add_forces(&self.material(triangle).stress(&gradient), forces);
        }
        Ok(())
    }

    fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError> {
        fits("the positions", positions.len(), self.points)?;
        let mut energy = 0.0;
        for (triangle, element) in self.elements.iter().enumerate() {
            let gradient = DeformationGradient::checked(element.gradient(positions))
                .ok_or_else(|| element.inverted(triangle, positions))?;
            energy += self.material(triangle).energy(&gradient) * element.area;
        }
        Ok(energy)
    }

    fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2> {
        Some(self.material(triangle).stress(&DeformationGradient::checked(*gradient)?))
    }

    fn stiffest(&self) -> Moduli {
        let first = self.materials[0].moduli();
        self.materials.iter().fold(first, |stiffest, material| stiffest.larger(&material.moduli()))
    }
}
