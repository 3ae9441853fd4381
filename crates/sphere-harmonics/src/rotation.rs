//! Rotation of coefficients.

use std::f64::consts::SQRT_2;

use crate::error::{check_angle, check_degree, degree_of, same_length};
use crate::{HarmonicsError, count};

/// Turns a function about the z axis: afterwards its value at the longitude phi is the old one at `phi + angle`.
///
/// # Errors
/// Returns an error if the number of coefficients belongs to no degree, or if the angle (radians) is not finite.
pub fn turn_about_z(coefficients: &mut [f64], angle: f64) -> Result<(), HarmonicsError> {
    let degree = degree_of(coefficients.len())?;
    check_angle(angle)?;
    for m in 1..=degree {
        let (sin, cos) = (m as f64 * angle).sin_cos();
        for l in m..=degree {
            let (c, s) = (coefficients[l * l + l + m], coefficients[l * l + l - m]);
            coefficients[l * l + l + m] = c * cos + s * sin;
            coefficients[l * l + l - m] = s * cos - c * sin;
        }
    }
    Ok(())
}

/// The rotation about the y axis by one angle, as a matrix for each degree.
///
/// Let R turn the north pole by the angle towards the x axis. [`Tilt::apply`] takes the coefficients of f to the ones
/// of `s -> f(R s)`: the function as seen by an observer whose pole is at that angle. Cosines (m >= 0) and sines
/// (m < 0) do not mix, so degree l has one block of (l + 1)^2 numbers and one of l^2 numbers.
///
/// ```
/// use sphere_harmonics::{Point, Tilt, evaluate};
///
/// let function = [0.1, 0.7, -0.4, 1.3];
/// let mut seen = [0.0; 4];
/// Tilt::new(1, 0.5)?.apply(&function, &mut seen)?;
/// let new_pole = Point { theta: 0.5, phi: 0.0 };
/// let difference = evaluate(&seen, Point::towards([0.0, 0.0, 1.0]))? - evaluate(&function, new_pole)?;
/// assert!(difference.abs() < 1e-15);
/// # Ok::<(), sphere_harmonics::HarmonicsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Tilt {
    degree: usize,
    /// The blocks of the cosines, degree after degree, each row by row.
    cosines: Vec<f64>,
    /// The blocks of the sines.
    sines: Vec<f64>,
    /// Wigner's functions of one pair of orders.
    spare: [Vec<f64>; 2],
}

/// Returns the sum of the first n squares: where the block of degree n with n^2 numbers starts.
const fn squares(n: usize) -> usize {
    if n == 0 { 0 } else { (n - 1) * n * (2 * n - 1) / 6 }
}

impl Tilt {
    /// Computes the blocks up to the degree from Wigner's functions d^l_mk, by their recurrence in l.
    ///
    /// # Errors
    /// Returns an error if the degree is out of range, or if the angle (radians) is not finite.
    pub fn new(degree: usize, angle: f64) -> Result<Self, HarmonicsError> {
        check_degree(degree)?;
        let (cosines, sines) = (vec![0.0; squares(degree + 2)], vec![0.0; squares(degree + 1)]);
        let mut tilt = Self { degree, cosines, sines, spare: [vec![0.0; degree + 1], vec![0.0; degree + 1]] };
        tilt.turn_to(angle)?;
        Ok(tilt)
    }

    /// Computes the blocks for another angle, in the same memory.
    ///
    /// # Errors
    /// Returns an error if the angle (radians) is not finite.
    pub fn turn_to(&mut self, angle: f64) -> Result<(), HarmonicsError> {
        check_angle(angle)?;
        let degree = self.degree;
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let [plus, minus] = &mut self.spare;
        for m in 0..=degree {
            for k in 0..=m {
                wigner(m, k as isize, angle, plus);
                wigner(m, -(k as isize), angle, minus);
                for l in m..=degree {
                    let (p, n) = (plus[l], minus[l]);
                    let size = l + 1;
                    let block = &mut self.cosines[squares(l + 1)..];
                    if k == 0 {
                        // d_m0 and d_0m = (-1)^m d_m0.
                        let factor = if m == 0 { 1.0 } else { SQRT_2 };
                        block[m] = factor * sign(m) * p;
                        block[m * size] = factor * p;
                        continue;
                    }
                    // d_km = (-1)^(m-k) d_mk and d_k-m = d_m-k.
                    block[k * size + m] = sign(m + k) * p + sign(m) * n;
                    block[m * size + k] = p + sign(k) * n;
                    let block = &mut self.sines[squares(l)..];
                    block[(k - 1) * l + m - 1] = sign(m + k) * p - sign(m) * n;
                    block[(m - 1) * l + k - 1] = p - sign(k) * n;
                }
            }
        }
        Ok(())
    }

    /// Returns the degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Returns the matrix of the cosines of degree l <= [`Tilt::degree`], `l + 1` rows of the new orders m = 0, 1 .. l
    /// over columns of the old ones. Empty for a larger l.
    #[must_use]
    pub fn cosines(&self, l: usize) -> &[f64] {
        self.cosines.get(squares(l + 1)..squares(l + 2)).unwrap_or_default()
    }

    /// Returns the matrix of the sines of degree l <= [`Tilt::degree`], l rows of the new orders m = -1, -2 .. -l over
    /// columns of the old ones. Empty for a larger l.
    #[must_use]
    pub fn sines(&self, l: usize) -> &[f64] {
        self.sines.get(squares(l)..squares(l + 1)).unwrap_or_default()
    }

    /// Writes the coefficients of the function as seen from the tilted pole.
    ///
    /// # Errors
    /// Returns an error if a list has another length than the degree needs.
    pub fn apply(&self, coefficients: &[f64], seen: &mut [f64]) -> Result<(), HarmonicsError> {
        same_length("coefficients", count(self.degree), coefficients.len())?;
        same_length("the tilted coefficients", count(self.degree), seen.len())?;
        for l in 0..=self.degree {
            let old = &coefficients[l * l..(l + 1) * (l + 1)];
            let new = &mut seen[l * l..(l + 1) * (l + 1)];
            for (k, row) in self.cosines(l).chunks_exact(l + 1).enumerate() {
                new[l + k] = row.iter().zip(&old[l..]).map(|(entry, value)| entry * value).sum();
            }
            for (k, row) in self.sines(l).chunks_exact(l.max(1)).enumerate() {
                new[l - 1 - k] = row.iter().zip(old[..l].iter().rev()).map(|(entry, value)| entry * value).sum();
            }
        }
        Ok(())
    }
}

/// Writes d^l_mk(angle) for m >= |k| and all l from m up to the last place of `values`.
fn wigner(m: usize, k: isize, angle: f64, values: &mut [f64]) {
    let (half_sin, half_cos) = (0.5 * angle).sin_cos();
    let (x, order, other) = (angle.cos(), m as f64, k as f64);
    let (up, down) = (m.saturating_add_signed(k), m.saturating_add_signed(-k));
    // sqrt((2m)!/((m+k)!(m-k)!)) cos^(m+k) sin^(m-k), factor by factor so that nothing overflows.
    let mut start = if down.is_multiple_of(2) { 1.0 } else { -1.0 };
    let (mut cosines, mut sines) = (up, down);
    for i in 1..=2 * m {
        // The powers are spread evenly over the factors.
        let (factor, left) = if cosines * down.max(1) >= sines * up.max(1) && cosines > 0 || sines == 0 {
            cosines -= 1;
            (half_cos, up - cosines)
        } else {
            sines -= 1;
            (half_sin, down - sines)
        };
        start *= factor * (i as f64 / left as f64).sqrt();
    }
    let (mut before, mut value) = (0.0, start);
    for (l, entry) in values.iter_mut().enumerate().skip(m) {
        *entry = value;
        let n = l as f64;
        let root = |n: f64| ((n * n - order * order) * (n * n - other * other)).sqrt();
        let next = if l == 0 {
            x
        } else {
            ((2.0 * n + 1.0) * (n * (n + 1.0) * x - order * other) * value - (n + 1.0) * root(n) * before)
                / (n * root(n + 1.0))
        };
        (before, value) = (value, next);
    }
}

#[cfg(test)]
mod tests;
