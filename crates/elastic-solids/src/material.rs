//! Hyperelastic materials and their moduli.

mod matrix;
mod moduli;
mod mooney_rivlin;
mod neo_hookean;
mod saint_venant_kirchhoff;

use crate::SolidError;

pub use matrix::Mat2;
pub use moduli::Moduli;
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::NeoHookean;
pub use saint_venant_kirchhoff::SaintVenantKirchhoff;

/// Strain energy density W(A) of a hyperelastic material as a function of the deformation gradient A, with its
/// derivative.
///
/// W is zero and least for a rotation, and does not change when the deformed material is turned. Implement this trait
/// for your own material: a solid needs nothing else.
pub trait EnergyDensity: std::fmt::Debug + Send + Sync + 'static {
    /// Returns the energy density W(A) per reference area (energy per area, which is force per length in two
    /// dimensions).
    fn energy(&self, gradient: &DeformationGradient) -> f64;

    /// Returns the first Piola-Kirchhoff stress `P = dW/dA` (force per reference length).
    fn stress(&self, gradient: &DeformationGradient) -> Mat2;

    /// Returns the shear and bulk modulus of small strains (force per length).
    fn moduli(&self) -> Moduli;

    /// Returns the Cauchy stress `P A^T / J` (force per deformed length), symmetric.
    fn cauchy_stress(&self, gradient: &DeformationGradient) -> Mat2 {
        self.stress(gradient) * gradient.matrix().transpose() / gradient.jacobian()
    }
}

/// A deformation gradient `A_ij = dX_i / ds_j` (4.5), X the deformed and s the reference position, with a positive
/// determinant: material that is not inverted. Dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeformationGradient {
    matrix: Mat2,
    jacobian: f64,
}

impl DeformationGradient {
    /// Creates a deformation gradient with the matrix A.
    ///
    /// # Errors
    /// Returns [`SolidError::Refused`] if the determinant is not positive and finite.
    pub fn new(matrix: Mat2) -> Result<Self, SolidError> {
        Self::checked(matrix).ok_or_else(|| SolidError::not_orientation_preserving(matrix))
    }

    /// Creates a deformation gradient with the matrix A; `None` if the determinant is not positive and finite.
    #[inline]
    pub(crate) fn checked(matrix: Mat2) -> Option<Self> {
        let jacobian = matrix.determinant();
        (jacobian > 0.0 && jacobian.is_finite()).then_some(Self { matrix, jacobian })
    }

    /// Creates an identity, of the undeformed state.
    #[must_use]
    pub fn identity() -> Self {
        Self { matrix: Mat2::IDENTITY, jacobian: 1.0 }
    }

    /// Returns the matrix A (no dimension).
    #[inline]
    #[must_use]
    pub fn matrix(&self) -> Mat2 {
        self.matrix
    }

    /// Returns the determinant J = det A, the ratio of deformed and reference area (no dimension).
    #[inline]
    #[must_use]
    pub fn jacobian(&self) -> f64 {
        self.jacobian
    }

    /// Returns the cofactor matrix `J A^-T = dJ/dA`.
    #[inline]
    #[must_use]
    pub fn cofactor(&self) -> Mat2 {
        let [a11, a21, a12, a22] = self.matrix.to_cols_array();
        Mat2::from_rows_array(&[a22, -a21, -a12, a11])
    }

    /// Returns the square of the difference of the principal stretches, `tr(A A^T) - 2 J = (A11 - A22)^2 + (A12 +
    /// A21)^2`: zero for a rotation with uniform dilation. The latter form, which is evaluated, is free of
    /// cancellation.
    #[inline]
    #[must_use]
    pub fn distortion(&self) -> f64 {
        let [a11, a21, a12, a22] = self.matrix.to_cols_array();
        (a11 - a22).powi(2) + (a12 + a21).powi(2)
    }
}

#[cfg(test)]
mod tests;
