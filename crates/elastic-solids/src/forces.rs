//! Where a deformed mesh gets its forces from.

use ib_core::Vec2;

use crate::{Mat2, Moduli, SolidError, TriangleMesh};

/// The elastic forces of a deformed mesh, as the gradient of an energy: [`Hyperelastic`](crate::Hyperelastic) material
/// or [`Springs`](crate::Springs).
///
/// Forces sum to zero and give no torque to round-off, whatever the deformation.
pub trait ElasticForces: std::fmt::Debug + Send + Sync + 'static {
    /// Number of points of the mesh.
    fn point_count(&self) -> usize;

    /// Adds the elastic forces -dE/dX (force) of the mesh with its points at `positions` (length).
    ///
    /// # Errors
    /// Lists of the wrong length; a triangle turned inside out where the energy is not defined for it.
    fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError>;

    /// The elastic energy E (energy) of the mesh with its points at `positions` (length).
    ///
    /// # Errors
    /// As [`ElasticForces::add_forces`].
    fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError>;

    /// First Piola-Kirchhoff stress (force per reference length) in a triangle whose deformation gradient is
    /// `gradient`, where it is defined.
    ///
    /// # Panics
    /// A triangle beyond the last.
    fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2>;

    /// The largest shear and the largest bulk modulus of small strains (force per length).
    fn stiffest(&self) -> Moduli;
}

/// A triangle with what its deformation gradient needs: `A = [X1 - X0, X2 - X0] [s1 - s0, s2 - s0]^-1` (4.10).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Element {
    corners: [u32; 3],
    /// What to add to x of the second and third corner across the seam of a periodic mesh.
    shifts: [f64; 2],
    /// Inverse of the matrix of the reference sides.
    inverse: Mat2,
    /// Reference area.
    pub(crate) area: f64,
}

impl Element {
    /// All triangles of a mesh.
    pub(crate) fn all(mesh: &TriangleMesh) -> Vec<Self> {
        (0..mesh.triangles().len())
            .map(|number| {
                let at = mesh.corners(number, mesh.points());
                let home = mesh.triangles()[number];
                let (first, second) = (at[1] - at[0], at[2] - at[0]);
                let inverse = Mat2::new(second.y, -second.x, -first.y, first.x) / first.perp(&second);
                Self {
                    corners: home.map(|point| point as u32),
                    shifts: [1, 2].map(|k| at[k].x - mesh.points()[home[k]].x),
                    inverse,
                    area: mesh.areas()[number],
                }
            })
            .collect()
    }

    /// The deformation gradient A.
    #[inline]
    pub(crate) fn gradient(&self, positions: &[Vec2]) -> Mat2 {
        let [a, b, c] = self.corners.map(|point| positions[point as usize]);
        let first = Vec2::new(b.x + self.shifts[0] - a.x, b.y - a.y);
        let second = Vec2::new(c.x + self.shifts[1] - a.x, c.y - a.y);
        Mat2::new(first.x, second.x, first.y, second.y) * self.inverse
    }

    /// Adds the forces (4.12) of the stress P on the three corners; they sum to zero exactly as far as numbers can.
    #[inline]
    pub(crate) fn add_forces(&self, stress: &Mat2, forces: &mut [Vec2]) {
        let pull = stress * self.inverse.transpose() * self.area;
        let (first, second) = (Vec2::new(pull.m11, pull.m21), Vec2::new(pull.m12, pull.m22));
        let [a, b, c] = self.corners.map(|point| point as usize);
        forces[a] += first + second;
        forces[b] -= first;
        forces[c] -= second;
    }

    /// The middle of the deformed triangle, for messages.
    pub(crate) fn place(&self, positions: &[Vec2]) -> Vec2 {
        let sum: Vec2 = self.corners.iter().map(|&point| positions[point as usize]).sum();
        (sum + Vec2::new(self.shifts[0] + self.shifts[1], 0.0)) / 3.0
    }

    /// The triangle is turned inside out, flat, or not finite.
    pub(crate) fn inverted(&self, triangle: usize, positions: &[Vec2]) -> SolidError {
        let place = self.place(positions);
        let jacobian = self.gradient(positions).determinant();
        SolidError::Inverted { triangle, x: place.x, y: place.y, jacobian }
    }
}

/// Whether lists of a value a point fit a mesh.
pub(crate) fn fits(name: &'static str, found: usize, expected: usize) -> Result<(), SolidError> {
    if found == expected { Ok(()) } else { Err(SolidError::WrongLength { name, expected, found }) }
}

#[cfg(test)]
mod tests;
