//! Calculus of periodic functions given by equally spaced samples.

use std::f64::consts::TAU;

use fourier::PeriodicSeries;
use input_checks::{InputError, same_length, within};
use num_complex::Complex64;

use super::MOST_POINTS;
use crate::{LayerError, Vec2};

/// Where on the curve the tension of [`PeriodicCalculus::tension_forces`] is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TensionPlacement {
    /// At the points, entry k at point k.
    Points,
    /// Half way between points, entry k between point k and point k + 1.
    Segments,
}

/// Derivatives and the forces of a surface tension, for curves of a fixed number of points.
///
/// Samples k = 0 .. len - 1 belong to the parameter alpha = 2 pi k / len. Everything is spectrally accurate: the error
/// falls faster than any power of len for smooth curves. Nothing is allocated after construction.
#[derive(Debug, Clone)]
pub struct PeriodicCalculus {
    curve: PeriodicSeries,
    forces: PeriodicSeries,
    period: Vec2,
}

impl PeriodicCalculus {
    /// Plans for `len` samples.
    ///
    /// # Errors
    /// Fewer than 4 samples or more than 1,048,576.
    pub fn new(len: usize) -> Result<Self, LayerError> {
        within("the number of samples", len as f64, 4.0, MOST_POINTS)?;
        let series = PeriodicSeries::new(len)?;
        Ok(Self { curve: series.clone(), forces: series, period: Vec2::ZERO })
    }

    /// The same for open curves that go on by this much in a turn of the parameter (length).
    #[must_use]
    pub fn with_period(self, period: Vec2) -> Self {
        Self { period, ..self }
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.curve.len()
    }

    /// Always false.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The derivative by alpha (unit of the values, alpha being an angle).
    ///
    /// # Errors
    /// Slices of another length than planned for.
    pub fn derivative(&mut self, values: &[Vec2], out: &mut [Vec2]) -> Result<(), LayerError> {
        self.check(values.len(), out.len())?;
        self.curve.analyse_vectors(values)?;
        self.curve.differentiate();
        Ok(self.curve.write_vectors(out)?)
    }

    /// Forces on the fluid (force) at the points of an interface with the given surface tension (force):
    /// `F_k = (2 pi / len) d(gamma tau)/dalpha` at point k, the force per length F = d(gamma tau)/ds times the length
    /// that belongs to the point. Their sum is zero to round-off.
    ///
    /// This is the spectrally accurate counterpart of the difference `gamma_k t_k - gamma_(k-1) t_(k-1)` of segment
    /// tensions, whose error is of second order in the spacing.
    ///
    /// # Errors
    /// Slices of another length than planned for.
    pub fn tension_forces(
        &mut self,
        positions: &[Vec2],
        tension: &[f64],
        placement: TensionPlacement,
        forces: &mut [Vec2],
    ) -> Result<(), LayerError> {
        self.check(positions.len(), forces.len())?;
        same_length("tension", self.len(), tension.len())?;
        let len = self.len();
        let shift = match placement {
            TensionPlacement::Points => 0.0,
            TensionPlacement::Segments => std::f64::consts::PI / len as f64,
        };
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
        same_length("values", self.len(), values)?;
        same_length("out", self.len(), out)
    }
}
