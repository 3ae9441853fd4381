//! The deformation gradient.

use crate::SolidError;

/// A 2x2 matrix.
pub type Mat2 = nalgebra::Matrix2<f64>;

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
        Self::checked(matrix).ok_or(SolidError::NotOrientationPreserving {
            a11: matrix.m11,
            a12: matrix.m12,
            a21: matrix.m21,
            a22: matrix.m22,
            jacobian: matrix.determinant(),
        })
    }

    /// The same without an explanation.
    #[inline]
    pub(crate) fn checked(matrix: Mat2) -> Option<Self> {
        let jacobian = matrix.m11 * matrix.m22 - matrix.m12 * matrix.m21;
        (jacobian > 0.0 && jacobian.is_finite()).then_some(Self { matrix, jacobian })
    }

    /// No deformation.
    #[must_use]
    pub fn identity() -> Self {
        Self { matrix: Mat2::identity(), jacobian: 1.0 }
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
        let a = &self.matrix;
        Mat2::new(a.m22, -a.m21, -a.m12, a.m11)
    }

    /// `tr(A A^T) - 2 J = (A11 - A22)^2 + (A12 + A21)^2`: the square of the difference of the principal stretches, zero
    /// for a rotation with uniform dilation. Free of cancellation.
    #[inline]
    #[must_use]
    pub fn distortion(&self) -> f64 {
        let a = &self.matrix;
        (a.m11 - a.m22).powi(2) + (a.m12 + a.m21).powi(2)
    }
}

#[cfg(test)]
mod tests;
