//! Evaluation at any point of the sphere.

use crate::error::{check_angle, check_degree, degree_of, same_length};
use crate::legendre::{Legendre, pair};
use crate::{HarmonicsError, count, index};

/// A point of the unit sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Angle from the north pole (radians).
    pub theta: f64,
    /// Longitude (radians).
    pub phi: f64,
}

impl Point {
    /// Returns the point in this direction, which need not have length 1; the north pole for a direction of length 0.
    #[must_use]
    pub fn towards([x, y, z]: [f64; 3]) -> Self {
        Self { theta: x.hypot(y).atan2(z), phi: y.atan2(x) }
    }

    /// Returns the unit vector x, y, z.
    #[must_use]
    pub fn direction(self) -> [f64; 3] {
        let ((s, c), (sin, cos)) = (self.theta.sin_cos(), self.phi.sin_cos());
        [s * cos, s * sin, c]
    }
}

/// Returns the values of all harmonics up to `degree` at a point, by [`index`].
///
/// # Errors
/// Returns an error if the degree is out of range, or if an angle is not finite.
pub fn harmonics(degree: usize, point: Point) -> Result<Vec<f64>, HarmonicsError> {
    let mut harmonics = Harmonics::new(degree)?;
    harmonics.place(point)?;
    Ok(harmonics.values)
}

/// The harmonics at one point after the other.
///
/// Use this in place of [`harmonics`] and [`derivatives`] if there are many points: only [`Harmonics::new`] allocates.
///
/// ```
/// use sphere_harmonics::{Harmonics, Point};
///
/// let mut here = Harmonics::new(1)?;
/// here.place(Point::towards([0.0, 0.0, 1.0]))?;
/// // At the north pole, only Y_00 and Y_10 are not zero.
/// assert!(here.values()[1] == 0.0 && here.values()[2] > 0.0 && here.values()[3] == 0.0);
/// # Ok::<(), sphere_harmonics::HarmonicsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Harmonics {
    degree: usize,
    table: Legendre,
    /// Cosine and sine of each order.
    waves: Vec<[f64; 2]>,
    values: Vec<f64>,
}

impl Harmonics {
    /// Creates memory for harmonics up to a degree, and places it at the north pole.
    ///
    /// # Errors
    /// Returns an error if the degree is out of range.
    pub fn new(degree: usize) -> Result<Self, HarmonicsError> {
        check_degree(degree)?;
        let (waves, values) = (vec![[1.0, 0.0]; degree + 1], vec![0.0; count(degree)]);
        let mut harmonics = Self { degree, table: Legendre::default(), waves, values };
        harmonics.place(Point { theta: 0.0, phi: 0.0 })?;
        Ok(harmonics)
    }

    /// Returns the degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Computes all harmonics at a point.
    ///
    /// # Errors
    /// Returns an error if an angle is not finite.
    pub fn place(&mut self, point: Point) -> Result<(), HarmonicsError> {
        check_angle(point.phi)?;
        self.table.update(self.degree, check_angle(point.theta)?);
        for (m, wave) in self.waves.iter_mut().enumerate() {
            let (sin, cos) = (m as f64 * point.phi).sin_cos();
            *wave = [cos, sin];
            for l in m..=self.degree {
                let value = self.table.value[pair(l, m)];
                self.values[index(l, -(m as isize))] = value * sin;
                self.values[index(l, m as isize)] = value * cos;
            }
        }
        Ok(())
    }

    /// Returns the values of all harmonics at the point, by [`index`].
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the value of a function at the point and its derivatives by theta and by phi over sin(theta), as
    /// [`derivatives`] does.
    ///
    /// # Errors
    /// Returns an error if the number of coefficients belongs to another degree.
    pub fn derivatives(&self, coefficients: &[f64]) -> Result<[f64; 3], HarmonicsError> {
        same_length("coefficients", count(self.degree), coefficients.len())?;
        let mut sums = [0.0; 3];
        for (m, [cos, sin]) in self.waves.iter().enumerate() {
            for l in m..=self.degree {
                let c = coefficients[index(l, m as isize)];
                let s = if m == 0 { 0.0 } else { coefficients[index(l, -(m as isize))] };
                sums[0] += self.table.value[pair(l, m)] * (c * cos + s * sin);
                sums[1] += self.table.theta[pair(l, m)] * (c * cos + s * sin);
                sums[2] += self.table.phi[pair(l, m)] * (s * cos - c * sin);
            }
        }
        Ok(sums)
    }
}

/// Returns the value at a point of the function with these coefficients.
///
/// ```
/// use sphere_harmonics::{Point, evaluate};
///
/// // The coordinate x is sqrt(4 pi/3) Y_11.
/// let x = [0.0, 0.0, 0.0, (4.0 * std::f64::consts::PI / 3.0).sqrt()];
/// let value = evaluate(&x, Point::towards([3.0, 0.0, 4.0]))?;
/// assert!((value - 0.6).abs() < 1e-15);
/// # Ok::<(), sphere_harmonics::HarmonicsError>(())
/// ```
///
/// # Errors
/// Returns an error if the number of coefficients belongs to no degree, or if an angle is not finite.
pub fn evaluate(coefficients: &[f64], point: Point) -> Result<f64, HarmonicsError> {
    let values = harmonics(degree_of(coefficients.len())?, point)?;
    Ok(values.iter().zip(coefficients).map(|(value, coefficient)| value * coefficient).sum())
}

/// Returns the value of the function with these coefficients at a point, and its derivatives by theta and by phi over
/// sin(theta), which are its slopes along the meridian and along the parallel. They are finite at the poles too.
///
/// ```
/// use sphere_harmonics::{Point, derivatives};
///
/// // The coordinate x at the north pole grows along the meridian phi = 0.
/// let x = [0.0, 0.0, 0.0, (4.0 * std::f64::consts::PI / 3.0).sqrt()];
/// let [value, along_theta, along_phi] = derivatives(&x, Point { theta: 0.0, phi: 0.0 })?;
/// assert!(value == 0.0 && (along_theta - 1.0).abs() < 1e-15 && along_phi == 0.0);
/// # Ok::<(), sphere_harmonics::HarmonicsError>(())
/// ```
///
/// # Errors
/// Returns an error if the number of coefficients belongs to no degree, or if an angle is not finite.
pub fn derivatives(coefficients: &[f64], point: Point) -> Result<[f64; 3], HarmonicsError> {
    let mut harmonics = Harmonics::new(degree_of(coefficients.len())?)?;
    harmonics.place(point)?;
    harmonics.derivatives(coefficients)
}
