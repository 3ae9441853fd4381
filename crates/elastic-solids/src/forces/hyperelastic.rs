//! Hyperelastic material on a triangle mesh.

use motile_base::{Vec2, same_length};

use super::patches::Patches;
use crate::material::{DeformationGradient, Mat2};
use crate::mesh::TriangleMesh;
use crate::{ElasticForces, EnergyDensity, Moduli, SolidError};

/// Elastic forces of a hyperelastic material on a triangle mesh (Cowley section 4.2.1.1). The deformation gradient A is
/// constant in each triangle, the energy is the sum of W(A) A_ref over the triangles (4.11), and the force on a point
/// is minus its derivative (4.12).
///
/// Linear triangles whose area can hardly change have too few ways left to move. If the bulk modulus is above ten times
/// the shear modulus, triangles share their change of area two by two (de Souza Neto, Pires and Owen 2005), with which
/// displacements are of second order in the size of the triangles at any bulk modulus.
#[derive(Debug, Clone)]
pub struct Hyperelastic<E> {
    elements: Vec<Element>,
    /// A single material for all triangles, or one for each.
    materials: Vec<E>,
    points: usize,
    /// Triangles that share their change of area.
    patches: Option<Patches>,
}

/// Ratio of bulk and shear modulus above which triangles share their change of area. Linear triangles alone are as far
/// off as patches are at a ratio of 1, and 5 times as far at 100 (`tests/manufactured.rs`).
const PATCHED: f64 = 10.0;

impl<E: EnergyDensity> Hyperelastic<E> {
    /// Creates forces of one material everywhere.
    #[must_use]
    pub fn new(mesh: &TriangleMesh, material: E) -> Self {
        Self::of(mesh, vec![material])
    }

    /// Returns the forces of a material that is a function of the reference position (length), taken at the centroid of
    /// each triangle.
    ///
    /// # Errors
    /// Returns the errors of the function.
    pub fn graded(
        mesh: &TriangleMesh,
        mut material: impl FnMut(Vec2) -> Result<E, SolidError>,
    ) -> Result<Self, SolidError> {
        let triangles = 0..mesh.triangles().len();
        let materials = triangles.map(|triangle| material(mesh.centroid(triangle))).collect::<Result<_, _>>()?;
        Ok(Self::of(mesh, materials))
    }

    fn of(mesh: &TriangleMesh, materials: Vec<E>) -> Self {
        let locks = materials.iter().any(|material| material.moduli().bulk() > PATCHED * material.moduli().shear());
        let patches = locks.then(|| Patches::of(mesh));
        Self { elements: Element::all(mesh), materials, points: mesh.points().len(), patches }
    }

    /// Returns the material of a triangle; `None` for one beyond the last.
    #[must_use]
    pub fn material(&self, triangle: usize) -> Option<&E> {
        (triangle < self.elements.len()).then(|| self.raw_material(triangle))
    }

    #[inline]
    fn raw_material(&self, triangle: usize) -> &E {
        &self.materials[if self.materials.len() == 1 { 0 } else { triangle }]
    }
}

impl<E: EnergyDensity> ElasticForces for Hyperelastic<E> {
    fn point_count(&self) -> usize {
        self.points
    }

    fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
        same_length("the positions", self.points, positions.len())?;
        same_length("the forces", self.points, forces.len())?;
        if let Some(patches) = &self.patches {
            return self.add_patched_forces(patches, positions, forces);
        }
        for (triangle, element) in self.elements.iter().enumerate() {
            let gradient = element.deformation(triangle, positions)?;
            element.add_forces(&self.raw_material(triangle).stress(&gradient), forces);
        }
        Ok(())
    }

    fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError> {
        same_length("the positions", self.points, positions.len())?;
        let mut energy = 0.0;
        if let Some(patches) = &self.patches {
            let gradient = |triangle: usize| self.elements[triangle].deformation(triangle, positions);
            for patch in patches.iter() {
                let [shared, _] = self.shared(patch, gradient)?;
                for &triangle in patch {
                    let scaled = scaled(&gradient(triangle)?, shared)?;
                    energy += self.raw_material(triangle).energy(&scaled) * self.elements[triangle].area;
                }
            }
            return Ok(energy);
        }
        for (triangle, element) in self.elements.iter().enumerate() {
            let gradient = element.deformation(triangle, positions)?;
            energy += self.raw_material(triangle).energy(&gradient) * element.area;
        }
        Ok(energy)
    }

    fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2> {
        Some(self.material(triangle)?.stress(&DeformationGradient::checked(*gradient)?))
    }

    /// Returns the triangles that share their change of area have one pressure, the pressure of the patch.
    fn stresses(&self, gradients: &[Mat2]) -> Option<Vec<Mat2>> {
        let own =
            gradients.iter().map(|gradient| DeformationGradient::checked(*gradient)).collect::<Option<Vec<_>>>()?;
        let mut stresses: Vec<Mat2> = own
            .iter()
            .enumerate()
            .map(|(triangle, own)| Some(self.material(triangle)?.stress(own)))
            .collect::<Option<_>>()?;
        for patch in self.patches.iter().flat_map(Patches::iter) {
            patch.iter().for_each(|triangle| stresses[*triangle] = Mat2::ZERO);
            self.shared_stresses(patch, |triangle| Ok(own[triangle]), |triangle, stress| stresses[triangle] += stress)
                .ok()?;
        }
        Some(stresses)
    }

    fn stiffest(&self) -> Moduli {
        let first = self.materials[0].moduli();
        self.materials.iter().fold(first, |stiffest, material| stiffest.larger(&material.moduli()))
    }
}

impl<E: EnergyDensity> Hyperelastic<E> {
    /// Returns the ratio J' of the deformed to the reference area of a patch (no dimension), and the latter (length
    /// squared), from the deformation gradients of its triangles.
    fn shared(
        &self,
        patch: &[usize],
        gradient: impl Fn(usize) -> Result<DeformationGradient, SolidError>,
    ) -> Result<[f64; 2], SolidError> {
        let (mut deformed, mut reference) = (0.0, 0.0);
        for &triangle in patch {
            let area = self.elements[triangle].area;
            deformed += gradient(triangle)?.jacobian() * area;
            reference += area;
        }
        Ok([deformed / reference, reference])
    }

    /// Adds the forces of all patches; apart from the path of single triangles, which it would slow.
    #[inline(never)]
    fn add_patched_forces(&self, patches: &Patches, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
        let gradient = |triangle: usize| self.elements[triangle].deformation(triangle, positions);
        patches.iter().try_for_each(|patch| {
            self.shared_stresses(patch, gradient, |triangle, stress| {
                self.elements[triangle].add_forces(&stress, forces);
            })
        })
    }

    /// Gives the stresses (force per reference length) of the triangles of a patch to `add`, two of each, which add up.
    /// With P the stress of the scaled gradient A' = s A and w = P : A'/2, the derivative of a triangle's energy by A
    /// is `s P - w cof(A)/J`, and that by the area of the patch is the sum of w over the triangles, times their
    /// reference areas, over J' and the reference area of the patch.
    #[inline]
    fn shared_stresses(
        &self,
        patch: &[usize],
        gradient: impl Fn(usize) -> Result<DeformationGradient, SolidError>,
        mut add: impl FnMut(usize, Mat2),
    ) -> Result<(), SolidError> {
        let [shared, area] = self.shared(patch, &gradient)?;
        let mut pressure = 0.0;
        for &triangle in patch {
            let own = gradient(triangle)?;
            let scaled = scaled(&own, shared)?;
            let stress = self.raw_material(triangle).stress(&scaled);
            let work = 0.5 * (stress * scaled.matrix().transpose()).trace();
            pressure += work * self.elements[triangle].area / (shared * area);
            add(triangle, stress * (shared / own.jacobian()).sqrt() - own.cofactor() * (work / own.jacobian()));
        }
        for &triangle in patch {
            add(triangle, gradient(triangle)?.cofactor() * pressure);
        }
        Ok(())
    }
}

/// Returns the deformation gradient with another change of area J', `A sqrt(J'/J)`.
#[inline]
fn scaled(own: &DeformationGradient, shared: f64) -> Result<DeformationGradient, SolidError> {
    DeformationGradient::new(own.matrix() * (shared / own.jacobian()).sqrt())
}

/// A triangle, prepared for its deformation gradient `A = [X1 - X0, X2 - X0] [s1 - s0, s2 - s0]^-1` (4.10).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Element {
    corners: [u32; 3],
    /// Additions to x of the second and third corner across the edge of a periodic mesh (length).
    shifts: [f64; 2],
    /// Inverse of the matrix of the reference sides (1/length).
    inverse: Mat2,
    /// Reference area (length squared).
    pub(crate) area: f64,
}

impl Element {
    /// Elements of all triangles of a mesh.
    pub(crate) fn all(mesh: &TriangleMesh) -> Vec<Self> {
        (0..mesh.triangles().len()).map(|number| Self::of(mesh, number)).collect()
    }

    /// Creates an element of a triangle of a mesh.
    pub(crate) fn of(mesh: &TriangleMesh, number: usize) -> Self {
        let at = mesh.raw_corners(number, mesh.points());
        let home = mesh.triangles()[number];
        Self {
            corners: home.map(|point| point as u32),
            shifts: [1, 2].map(|k| at[k].x - mesh.points()[home[k]].x),
            inverse: Mat2::from_cols(at[1] - at[0], at[2] - at[0]).inverse(),
            area: mesh.areas()[number],
        }
    }

    /// Returns the deformation gradient A (no dimension) with the points of the mesh at `positions` (length).
    #[inline]
    pub(crate) fn gradient(&self, positions: &[Vec2]) -> Mat2 {
        let [a, b, c] = self.corners.map(|point| positions[point as usize]);
        let first = Vec2::new(b.x + self.shifts[0] - a.x, b.y - a.y);
        let second = Vec2::new(c.x + self.shifts[1] - a.x, c.y - a.y);
        Mat2::from_cols(first, second) * self.inverse
    }

    /// Returns the gradient, by the reference position, of a field of values at the points of the mesh.
    #[inline]
    pub(crate) fn gradient_of(&self, values: &[Vec2]) -> Mat2 {
        let [a, b, c] = self.corners.map(|point| values[point as usize]);
        Mat2::from_cols(b - a, c - a) * self.inverse
    }

    /// Returns the deformation gradient of an element that is not inverted; `triangle` is its index, for messages.
    #[inline(always)]
    pub(crate) fn deformation(&self, triangle: usize, positions: &[Vec2]) -> Result<DeformationGradient, SolidError> {
        DeformationGradient::checked(self.gradient(positions)).ok_or_else(|| self.inverted(triangle, positions))
    }

    /// Adds the forces (4.12) of the stress P on the three corners; they sum to zero to round-off.
    #[inline]
    pub(crate) fn add_forces(&self, stress: &Mat2, forces: &mut [Vec2]) {
        let pull = *stress * self.inverse.transpose() * self.area;
        let (first, second) = (pull.x_axis, pull.y_axis);
        let [a, b, c] = self.corners.map(|point| point as usize);
        forces[a] += first + second;
        forces[b] -= first;
        forces[c] -= second;
    }

    /// Returns the error for a triangle that is inverted, flat, or not finite.
    fn inverted(&self, triangle: usize, positions: &[Vec2]) -> SolidError {
        let sum: Vec2 = self.corners.iter().map(|&point| positions[point as usize]).sum();
        let place = (sum + Vec2::new(self.shifts[0] + self.shifts[1], 0.0)) / 3.0;
        SolidError::Inverted { triangle, place, jacobian: self.gradient(positions).determinant() }
    }
}
