//! Vectors of the plane.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign};

use serde::{Deserialize, Serialize};

/// A vector of the plane: a position, force or velocity, of the dimension that its place gives it. In files it is the
/// list `[x, y]`.
///
/// ```
/// use motile_base::Vec2;
///
/// let corner = Vec2::new(3.0, 4.0);
/// assert_eq!(corner.length(), 5.0);
/// assert_eq!(2.0 * corner - Vec2::X, Vec2::from((5.0, 8.0)));
/// assert_eq!(corner.perp_dot(Vec2::Y), 3.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 2]", into = "[f64; 2]")]
pub struct Vec2 {
    /// Component along the x axis.
    pub x: f64,
    /// Component along the y axis.
    pub y: f64,
}

impl Vec2 {
    /// No components.
    pub const ZERO: Self = Self::splat(0.0);
    /// Both components one.
    pub const ONE: Self = Self::splat(1.0);
    /// The unit vector along the x axis.
    pub const X: Self = Self::new(1.0, 0.0);
    /// The unit vector along the y axis.
    pub const Y: Self = Self::new(0.0, 1.0);
    /// Both components not a number.
    pub const NAN: Self = Self::splat(f64::NAN);

    /// Creates a vector from its components.
    #[inline]
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Creates a vector whose two components are `value`.
    #[inline]
    #[must_use]
    pub const fn splat(value: f64) -> Self {
        Self::new(value, value)
    }

    /// Creates the unit vector at `angle` (radians) from the x axis, counter-clockwise.
    #[inline]
    #[must_use]
    pub fn from_angle(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self::new(cos, sin)
    }

    /// Returns the angle from the x axis, counter-clockwise (radians, -pi to pi).
    #[inline]
    #[must_use]
    pub fn to_angle(self) -> f64 {
        self.y.atan2(self.x)
    }

    /// Returns the angle from this vector to `other`, counter-clockwise (radians, -pi to pi).
    #[inline]
    #[must_use]
    pub fn angle_to(self, other: Self) -> f64 {
        self.perp_dot(other).atan2(self.dot(other))
    }

    /// Returns the components [x, y].
    #[inline]
    #[must_use]
    pub const fn to_array(self) -> [f64; 2] {
        [self.x, self.y]
    }

    /// Returns the scalar product.
    #[inline]
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// Returns the vector product `x1 y2 - y1 x2`, the area of the parallelogram from this vector to `other`.
    #[inline]
    #[must_use]
    pub fn perp_dot(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Returns this vector turned by a quarter, counter-clockwise.
    #[inline]
    #[must_use]
    pub const fn perp(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// Returns `other` turned by the angle of this vector and stretched by its length: the product as complex numbers.
    #[inline]
    #[must_use]
    pub fn rotate(self, other: Self) -> Self {
        Self::new(self.x * other.x - self.y * other.y, self.y * other.x + self.x * other.y)
    }

    /// Returns the length of the vector.
    #[inline]
    #[must_use]
    pub fn length(self) -> f64 {
        self.length_squared().sqrt()
    }

    /// Returns the square of the length.
    #[inline]
    #[must_use]
    pub fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Returns the distance between two points.
    #[inline]
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        (self - other).length()
    }

    /// Returns the unit vector in the direction of this one, which must not be zero: zero has none and gives NaN.
    #[inline]
    #[must_use]
    pub fn normalize(self) -> Self {
        self * (1.0 / self.length())
    }

    /// Returns the unit vector in the direction of this one; `None` for zero and for vectors that are not finite.
    #[inline]
    #[must_use]
    pub fn try_normalize(self) -> Option<Self> {
        let inverse = 1.0 / self.length();
        (inverse.is_finite() && inverse > 0.0).then(|| self * inverse)
    }

    /// Returns the point at `fraction` of the way to `other`.
    #[inline]
    #[must_use]
    pub fn lerp(self, other: Self, fraction: f64) -> Self {
        self * (1.0 - fraction) + other * fraction
    }

    /// Returns the smaller of each component, the component of `other` if they cannot be compared.
    #[inline]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        let least = |a: f64, b: f64| if a < b { a } else { b };
        Self::new(least(self.x, other.x), least(self.y, other.y))
    }

    /// Returns the larger of each component, the component of `other` if they cannot be compared.
    #[inline]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        let most = |a: f64, b: f64| if a > b { a } else { b };
        Self::new(most(self.x, other.x), most(self.y, other.y))
    }

    /// Returns the larger component.
    #[inline]
    #[must_use]
    pub fn max_element(self) -> f64 {
        self.x.max(self.y)
    }

    /// Returns the size of each component.
    #[inline]
    #[must_use]
    pub fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs())
    }

    /// Returns each component rounded to the nearest whole number, halves away from zero.
    #[inline]
    #[must_use]
    pub fn round(self) -> Self {
        Self::new(self.x.round(), self.y.round())
    }

    /// Returns `true` if neither component is infinite or not a number.
    #[inline]
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl From<[f64; 2]> for Vec2 {
    #[inline]
    fn from([x, y]: [f64; 2]) -> Self {
        Self::new(x, y)
    }
}

impl From<Vec2> for [f64; 2] {
    #[inline]
    fn from(vector: Vec2) -> Self {
        vector.to_array()
    }
}

impl From<(f64, f64)> for Vec2 {
    #[inline]
    fn from((x, y): (f64, f64)) -> Self {
        Self::new(x, y)
    }
}

impl From<Vec2> for (f64, f64) {
    #[inline]
    fn from(vector: Vec2) -> Self {
        (vector.x, vector.y)
    }
}

impl fmt::Display for Vec2 {
    /// Returns `[x, y]`, with the digits that are asked for.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match f.precision() {
            Some(digits) => write!(f, "[{:.digits$}, {:.digits$}]", self.x, self.y),
            None => write!(f, "[{}, {}]", self.x, self.y),
        }
    }
}

impl Index<usize> for Vec2 {
    type Output = f64;

    /// x for 0, y for 1; panics for any other axis, as an array of two does.
    #[inline]
    fn index(&self, axis: usize) -> &f64 {
        [&self.x, &self.y][axis]
    }
}

impl IndexMut<usize> for Vec2 {
    #[inline]
    fn index_mut(&mut self, axis: usize) -> &mut f64 {
        [&mut self.x, &mut self.y][axis]
    }
}

impl Neg for Vec2 {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl Neg for &Vec2 {
    type Output = Vec2;

    #[inline]
    fn neg(self) -> Vec2 {
        -*self
    }
}

/// A binary operator by the components of its operands, for values and references.
macro_rules! by_components {
    ($($trait:ident $method:ident ($left:ty, $right:ty) |$a:ident, $b:ident| $x:expr, $y:expr;)+) => {$(
        impl $trait<$right> for $left {
            type Output = Vec2;

            #[inline]
            fn $method(self, other: $right) -> Vec2 {
                let ($a, $b) = (self, other);
                Vec2::new($x, $y)
            }
        }

        impl $trait<&$right> for $left {
            type Output = Vec2;

            #[inline]
            fn $method(self, other: &$right) -> Vec2 {
                self.$method(*other)
            }
        }

        impl $trait<$right> for &$left {
            type Output = Vec2;

            #[inline]
            fn $method(self, other: $right) -> Vec2 {
                (*self).$method(other)
            }
        }

        impl $trait<&$right> for &$left {
            type Output = Vec2;

            #[inline]
            fn $method(self, other: &$right) -> Vec2 {
                (*self).$method(*other)
            }
        }
    )+};
}

by_components! {
    Add add (Vec2, Vec2) |a, b| a.x + b.x, a.y + b.y;
    Sub sub (Vec2, Vec2) |a, b| a.x - b.x, a.y - b.y;
    Mul mul (Vec2, Vec2) |a, b| a.x * b.x, a.y * b.y;
    Div div (Vec2, Vec2) |a, b| a.x / b.x, a.y / b.y;
    Mul mul (Vec2, f64) |a, b| a.x * b, a.y * b;
    Mul mul (f64, Vec2) |a, b| a * b.x, a * b.y;
    Div div (Vec2, f64) |a, b| a.x / b, a.y / b;
}

/// A binary operator with assignment, from the one without.
macro_rules! assigning {
    ($($trait:ident $method:ident ($right:ty) $operator:tt;)+) => {$(
        impl $trait<$right> for Vec2 {
            #[inline]
            fn $method(&mut self, other: $right) {
                *self = *self $operator other;
            }
        }
    )+};
}

assigning! {
    AddAssign add_assign (Vec2) +;
    AddAssign add_assign (&Vec2) +;
    SubAssign sub_assign (Vec2) -;
    SubAssign sub_assign (&Vec2) -;
    MulAssign mul_assign (f64) *;
    DivAssign div_assign (f64) /;
}

impl Sum for Vec2 {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::ZERO, |sum, vector| sum + vector)
    }
}

impl<'a> Sum<&'a Self> for Vec2 {
    fn sum<I: Iterator<Item = &'a Self>>(iter: I) -> Self {
        iter.copied().sum()
    }
}

#[cfg(test)]
mod tests;
