//! The deformation gradient.

/// A 2x2 matrix.
pub use glam::DMat2 as Mat2;

use crate::SolidError;

/// A deformation gradient `A_ij = dX_i / ds_j` (4.5), X the deformed and s the reference position, with a positive
/// determinant: material that is not inverted. Dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeformationGradient {
    matrix: Mat2,
    jacobian: f64,
}

impl DeformationGradient {
    /// From the matrix.
    ///
    /// # Errors
    /// [`SolidError::NotOrientationPreserving`] where the determinant is not positive and finite.
    pub fn new(matrix: Mat2) -> Result<Self, SolidError> {
        let [a11, a21, a12, a22] = matrix.to_cols_array();
        let jacobian = matrix.determinant();
        Self::checked(matrix).ok_or(SolidError::NotOrientationPreserving { a11, a12, a21, a22, jacobian })
    }

    /// The same without an explanation.
    #[inline]
    pub(crate) fn checked(matrix: Mat2) -> Option<Self> {
        let jacobian = matrix.determinant();
        (jacobian > 0.0 && jacobian.is_finite()).then_some(Self { matrix, jacobian })
    }

    /// No deformation.
    #[must_use]
    pub fn identity() -> Self {
        Self { matrix: Mat2::IDENTITY, jacobian: 1.0 }
    }

    /// The matrix A.
    #[inline]
    #[must_use]
    pub fn matrix(&self) -> &Mat2 {
        &self.matrix
    }

    /// J = det A, the deformed over the reference area.
    #[inline]
    #[must_use]
    pub fn jacobian(&self) -> f64 {
        self.jacobian
    }

    /// The cofactor matrix `J A^-T = dJ/dA`.
    #[inline]
    #[must_use]
    pub fn cofactor(&self) -> Mat2 {
        let [a11, a21, a12, a22] = self.matrix.to_cols_array();
        Mat2::from_rows_array(&[a22, -a21, -a12, a11])
    }

    /// `tr(A A^T) - 2 J = (A11 - A22)^2 + (A12 + A21)^2`: the square of the difference of the principal stretches, zero
    /// for a rotation with uniform dilation. Free of cancellation.
    #[inline]
    #[must_use]
    pub fn distortion(&self) -> f64 {
        let [a11, a21, a12, a22] = self.matrix.to_cols_array();
        (a11 - a22).powi(2) + (a12 + a21).powi(2)
    }
}

#[cfg(test)]
mod tests;
