//! Matrices of the plane.

use std::ops::{Add, AddAssign, Div, Mul, Sub};

use motile_base::Vec2;

/// A 2x2 matrix, such as a deformation gradient or a stress.
///
/// ```
/// use elastic_solids::Mat2;
/// use elastic_solids::Vec2;
///
/// let shear = Mat2::from_rows_array(&[1.0, 0.5, 0.0, 1.0]);
/// assert_eq!(shear * Vec2::Y, Vec2::new(0.5, 1.0));
/// assert_eq!(shear * shear.inverse(), Mat2::IDENTITY);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mat2 {
    /// First column.
    pub x_axis: Vec2,
    /// Second column.
    pub y_axis: Vec2,
}

impl Mat2 {
    /// Matrix of zeros.
    pub const ZERO: Self = Self::from_cols(Vec2::ZERO, Vec2::ZERO);
    /// The unit matrix.
    pub const IDENTITY: Self = Self::from_diagonal(Vec2::ONE);

    /// Creates a matrix with these columns.
    #[inline]
    #[must_use]
    pub const fn from_cols(x_axis: Vec2, y_axis: Vec2) -> Self {
        Self { x_axis, y_axis }
    }

    /// Creates a matrix of the entries a11, a21, a12, a22, column by column.
    #[inline]
    #[must_use]
    pub const fn from_cols_array(&[a11, a21, a12, a22]: &[f64; 4]) -> Self {
        Self::from_cols(Vec2::new(a11, a21), Vec2::new(a12, a22))
    }

    /// Creates a matrix of the entries a11, a12, a21, a22, row by row.
    #[inline]
    #[must_use]
    pub const fn from_rows_array(&[a11, a12, a21, a22]: &[f64; 4]) -> Self {
        Self::from_cols_array(&[a11, a21, a12, a22])
    }

    /// Creates a diagonal matrix with these entries.
    #[inline]
    #[must_use]
    pub const fn from_diagonal(diagonal: Vec2) -> Self {
        Self::from_cols_array(&[diagonal.x, 0.0, 0.0, diagonal.y])
    }

    /// Creates a rotation by `angle` (radians, counter-clockwise).
    #[inline]
    #[must_use]
    pub fn from_angle(angle: f64) -> Self {
        let along = Vec2::from_angle(angle);
        Self::from_cols(along, along.perp())
    }

    /// Returns the entries a11, a21, a12, a22, column by column.
    #[inline]
    #[must_use]
    pub const fn to_cols_array(self) -> [f64; 4] {
        [self.x_axis.x, self.x_axis.y, self.y_axis.x, self.y_axis.y]
    }

    /// Returns the transposed matrix.
    #[inline]
    #[must_use]
    pub const fn transpose(&self) -> Self {
        Self::from_rows_array(&self.to_cols_array())
    }

    /// Returns the trace a11 + a22.
    #[inline]
    #[must_use]
    pub fn trace(&self) -> f64 {
        self.x_axis.x + self.y_axis.y
    }

    /// Returns the determinant a11 a22 - a12 a21.
    #[inline]
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.x_axis.perp_dot(self.y_axis)
    }

    /// Returns the inverse matrix; its entries are not finite where the determinant is zero.
    #[inline]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let [a11, a21, a12, a22] = self.to_cols_array();
        Self::from_rows_array(&[a22, -a12, -a21, a11]) * (1.0 / self.determinant())
    }
}

impl Mul<Vec2> for Mat2 {
    type Output = Vec2;

    #[inline]
    fn mul(self, vector: Vec2) -> Vec2 {
        self.x_axis * vector.x + self.y_axis * vector.y
    }
}

impl Mul for Mat2 {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::from_cols(self * other.x_axis, self * other.y_axis)
    }
}

impl Mul<f64> for Mat2 {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self::from_cols(self.x_axis * factor, self.y_axis * factor)
    }
}

impl Mul<Mat2> for f64 {
    type Output = Mat2;

    #[inline]
    fn mul(self, matrix: Mat2) -> Mat2 {
        matrix * self
    }
}

impl Div<f64> for Mat2 {
    type Output = Self;

    #[inline]
    fn div(self, divisor: f64) -> Self {
        Self::from_cols(self.x_axis / divisor, self.y_axis / divisor)
    }
}

impl Add for Mat2 {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self::from_cols(self.x_axis + other.x_axis, self.y_axis + other.y_axis)
    }
}

impl Sub for Mat2 {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::from_cols(self.x_axis - other.x_axis, self.y_axis - other.y_axis)
    }
}

impl AddAssign for Mat2 {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
