//! Derivatives along curves given by equally spaced points, and the forces of a surface tension.

use std::f64::consts::TAU;

use motile_base::{InputError, PeriodicSeries, Vec2, same_length, within};
use num_complex::Complex64;

use crate::LayerError;

/// Largest number of points that a curve is given by: its transform takes about 50 MB.
pub const MOST_POINTS: f64 = 1_048_576.0;

/// Places on the curve that the values of [`PeriodicCalculus::tension_forces`] belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum TensionPlacement {
    /// At the points, entry k at point k.
    Points,
    /// Half way between points, entry k between points k and k + 1.
    Segments,
}

impl TensionPlacement {
    /// Returns by how much of the parameter (radians) the first value lies beyond the first of `len` points.
    #[must_use]
    pub fn shift(self, len: usize) -> f64 {
        match self {
            Self::Points => 0.0,
            Self::Segments => std::f64::consts::PI / len as f64,
        }
    }
}

/// Spectral derivatives and the forces of a surface tension, for curves of a fixed number of points.
///
/// Point k = 0 .. len - 1 belongs to the parameter alpha = 2 pi k / len. Functions are trigonometric polynomials
/// through the points, so that for smooth curves the error falls faster than any power of len. Nothing is allocated
/// after construction.
#[derive(Debug, Clone)]
pub struct PeriodicCalculus {
    curve: PeriodicSeries,
    forces: PeriodicSeries,
    period: Vec2,
}

impl PeriodicCalculus {
    /// Creates a plan for closed curves of `len` points.
    ///
    /// # Errors
    /// Returns an error for fewer than 4 points or more than 1,048,576.
    pub fn new(len: usize) -> Result<Self, LayerError> {
        within("the number of points", len as f64, 4.0, MOST_POINTS)?;
        let series = PeriodicSeries::new(len)?;
        Ok(Self { curve: series.clone(), forces: series, period: Vec2::ZERO })
    }

    /// Returns a plan for open curves that advance by `period` (length) in a turn of the parameter.
    #[must_use]
    pub fn with_period(self, period: Vec2) -> Self {
        Self { period, ..self }
    }

    /// Writes the derivative by alpha of a periodic function at the points (dimension of the values, alpha being an
    /// angle).
    ///
    /// # Errors
    /// Returns an error for slices of another length than planned for.
    pub fn derivative(&mut self, values: &[Vec2], out: &mut [Vec2]) -> Result<(), LayerError> {
        self.check(values.len(), out.len())?;
        self.curve.analyse_vectors(values)?;
        self.curve.differentiate();
        Ok(self.curve.write_vectors(out)?)
    }

    /// Writes the forces on the fluid (force) at the points of an interface with the surface tension gamma (force in
    /// 2D): `F_k = (2 pi / len) d(gamma tau)/dalpha` at point k, tau the unit tangent. It is the force per length
    /// `d(gamma tau)/ds` times the arc length that belongs to the point; the forces sum up to zero to round-off.
    ///
    /// The difference `gamma_k t_k - gamma_(k-1) t_(k-1)` of the tensions of segments is its counterpart of second
    /// order in the spacing.
    ///
    /// # Errors
    /// Returns an error for slices of another length than planned for.
    pub fn tension_forces(
        &mut self,
        positions: &[Vec2],
        tension: &[f64],
        placement: TensionPlacement,
        forces: &mut [Vec2],
    ) -> Result<(), LayerError> {
        self.check(positions.len(), forces.len())?;
        same_length("tension", self.curve.len(), tension.len())?;
        let len = self.curve.len();
        let shift = placement.shift(self.curve.len());
        let step = self.period / len as f64;
        self.curve.analyse(positions.iter().enumerate().map(|(k, x)| {
            let x = *x - step * k as f64;
            Complex64::new(x.x, x.y)
        }))?;
        self.curve.differentiate();
        self.curve.shift(shift);
        let weight = TAU / len as f64;
        let gain = Complex64::new(self.period.x, self.period.y) / TAU;
        let tangents = self.curve.values().iter().map(|tangent| tangent + gain).zip(tension);
        self.forces.analyse(tangents.map(|(tangent, tension)| tangent * (weight * tension / tangent.norm())))?;
        self.forces.differentiate();
        self.forces.shift(-shift);
        Ok(self.forces.write_vectors(forces)?)
    }

    fn check(&self, values: usize, out: usize) -> Result<(), InputError> {
        same_length("values", self.curve.len(), values)?;
        same_length("out", self.curve.len(), out)
    }
}

#[cfg(test)]
mod tests;
