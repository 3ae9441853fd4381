//! Real spherical harmonics: transforms on grids, derivatives, evaluation at any point, and rotation of coefficients.
//!
//! Use this crate to compute with smooth functions on a sphere. A function is a list of coefficients of the real
//! orthonormal harmonics of degree at most p. A [`Grid`] turns coefficients into values and back, and gives exact
//! integrals. A [`Tilt`] and [`turn_about_z`] rotate a function without a grid.
//!
//! In this example, we expand a temperature on a sphere, differentiate it, and turn it by 90 degrees:
//!
//! ```
//! use sphere_harmonics::{Grid, Point, Tilt, evaluate};
//!
//! let degree = 12;
//! let mut grid = Grid::gauss(degree)?;
//! let values: Vec<f64> = grid.points().map(|point| point.direction()[2].exp()).collect();
//! let mut temperature = vec![0.0; grid.coefficients()];
//! grid.forward(&values, &mut temperature)?;
//!
//! // The derivative along a meridian is -sin(theta) exp(cos(theta)).
//! let mut slope = vec![0.0; values.len()];
//! grid.backward_theta(&temperature, &mut slope)?;
//! for (slope, point) in slope.iter().zip(grid.points()) {
//!     assert!((slope + point.theta.sin() * point.theta.cos().exp()).abs() < 1e-10);
//! }
//!
//! // After a turn by 90 degrees, the hottest point is at the equator.
//! let mut turned = vec![0.0; temperature.len()];
//! Tilt::new(degree, std::f64::consts::FRAC_PI_2)?.apply(&temperature, &mut turned)?;
//! let hottest = evaluate(&turned, Point { theta: std::f64::consts::FRAC_PI_2, phi: std::f64::consts::PI })?;
//! println!("hottest {hottest:.6}, exact {:.6}", 1_f64.exp());
//! assert!((hottest - 1_f64.exp()).abs() < 1e-10);
//! # Ok::<(), sphere_harmonics::HarmonicsError>(())
//! ```
//!
//! # Conventions
//!
//! theta is the angle from the north pole (colatitude) and phi the longitude, both in radians. With the orthonormal
//! Legendre functions `P_lm >= 0` near the north pole (no Condon-Shortley sign), the harmonics are
//!
//! ```text
//! Y_lm = sqrt(2) P_lm(cos theta) cos(m phi),    m > 0
//! Y_l0 =         P_l0(cos theta)
//! Y_lm = sqrt(2) P_l|m|(cos theta) sin(|m| phi), m < 0
//! ```
//!
//! Their squares have the integral 1 over the unit sphere. The coefficient of degree l and order m is at
//! [`index`]`(l, m) = l^2 + l + m`, so that Y_11, Y_1-1 and Y_10 are positive multiples of x, y and z.

mod error;
mod grid;
mod legendre;
mod point;
mod rotation;

pub use error::HarmonicsError;
pub use grid::Grid;
pub use legendre::gauss_legendre;
pub use point::{Harmonics, Point, derivatives, evaluate, harmonics};
pub use rotation::{Tilt, turn_about_z};

/// Largest degree: the tables of a grid for it take about a gigabyte.
pub const LARGEST_DEGREE: usize = 256;

/// Returns the place of the coefficient of degree `l` and order `m`, from -l to l, in a list of coefficients.
///
/// ```
/// assert_eq!([(0, 0), (1, -1), (1, 0), (1, 1)].map(|(l, m)| sphere_harmonics::index(l, m)), [0, 1, 2, 3]);
/// ```
#[must_use]
pub const fn index(l: usize, m: isize) -> usize {
    (l * l + l).wrapping_add_signed(m)
}

/// Returns the number of coefficients, `(degree + 1)^2`.
#[must_use]
pub const fn count(degree: usize) -> usize {
    (degree + 1) * (degree + 1)
}
