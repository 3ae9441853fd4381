//! Viscous stress of solids that are more viscous than the fluid.

use motile_base::Vec2;

use crate::{forces::Element, material::Mat2, mesh::TriangleMesh};

/// A viscous stress `eta (L + L^T)` in the triangles of a mesh, in addition to the stress of the fluid in them, with
/// the gradient of velocity L.
#[derive(Debug, Clone)]
pub(crate) struct Damping {
    elements: Vec<Element>,
    /// Viscosity eta, in excess of the fluid's (force per length times time).
    viscosity: f64,
    velocities: Vec<Vec2>,
    forces: Vec<Vec2>,
    /// Stresses of the last solution, xx, yy and xy of each triangle (force per length).
    pub(crate) stresses: Vec<f64>,
    /// Present areas of the triangles (length squared).
    areas: Vec<f64>,
}

impl Damping {
    /// Creates a viscosity in excess of the fluid's (force per length times time).
    pub(crate) fn new(mesh: &TriangleMesh, viscosity: f64) -> Self {
        let none = vec![Vec2::ZERO; mesh.points().len()];
        let (elements, triangles) = (Element::all(mesh), mesh.triangles().len());
        let (stresses, areas) = (vec![0.0; 3 * triangles], mesh.areas().to_vec());
        Self { elements, viscosity, velocities: none.clone(), forces: none, stresses, areas }
    }

    /// Returns the viscosity in excess of the fluid's (force per length times time).
    pub(crate) fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Takes over the present positions of all points (length).
    pub(crate) fn update(&mut self, positions: &[Vec2]) {
        for (area, element) in self.areas.iter_mut().zip(&self.elements) {
            *area = element.area * element.gradient(positions).determinant();
        }
    }

    /// Writes the rates of strain xx, yy and twice xy, times the areas of the triangles (length squared per time). The
    /// points lie at `positions` (length), the numbered ones have these velocities (length per time), and the others
    /// are at rest.
    pub(crate) fn write_rates(
        &mut self,
        positions: &[Vec2],
        free: impl Iterator<Item = (usize, Vec2)>,
        rates: &mut [f64],
    ) {
        free.for_each(|(point, velocity)| self.velocities[point] = velocity);
        for ((element, area), rates) in self.elements.iter().zip(&self.areas).zip(rates.chunks_exact_mut(3)) {
            let spatial = element.gradient_of(&self.velocities) * element.gradient(positions).inverse();
            let (xx, yy, twice) = (spatial.x_axis.x, spatial.y_axis.y, spatial.x_axis.y + spatial.y_axis.x);
            rates.copy_from_slice(&[xx * *area, yy * *area, twice * *area]);
        }
    }

    /// Returns the forces of stresses on all points (force), which lie at `positions` (length).
    pub(crate) fn forces(&mut self, positions: &[Vec2], stresses: &[f64]) -> &[Vec2] {
        self.forces.fill(Vec2::ZERO);
        for (element, stress) in self.elements.iter().zip(stresses.chunks_exact(3)) {
            let gradient = element.gradient(positions);
            let stress = Mat2::from_cols(Vec2::new(stress[0], stress[2]), Vec2::new(stress[2], stress[1]));
            let nominal = stress * (gradient.inverse().transpose() * gradient.determinant());
            element.add_forces(&nominal, &mut self.forces);
        }
        &self.forces
    }

    /// Writes the compliances of the stresses.
    pub(crate) fn write_compliances(&self, compliances: &mut [f64]) {
        for (area, compliances) in self.areas.iter().zip(compliances.chunks_exact_mut(3)) {
            let shear = area / self.viscosity;
            compliances.copy_from_slice(&[0.5 * shear, 0.5 * shear, shear]);
        }
    }

    /// Divides rates by the compliances.
    pub(crate) fn divide_by_compliances(&self, rates: &mut [f64]) {
        for (area, rates) in self.areas.iter().zip(rates.chunks_exact_mut(3)) {
            let shear = self.viscosity / area;
            rates.iter_mut().zip([2.0 * shear, 2.0 * shear, shear]).for_each(|(rate, factor)| *rate *= factor);
        }
    }
}

#[cfg(test)]
mod tests;
