//! Calculus of periodic functions given by equally spaced samples.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::{
    MOST_POINTS,
    transform::{Transform, differentiate, wave},
};
use crate::{
    LayerError, Vec2,
    error::{same_length, within},
};

/// Where on the curve the tension of [`PeriodicCalculus::tension_forces`] is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TensionPlacement {
    /// At the points, entry k at point k.
    Points,
    /// Half way between points, entry k between point k and point k + 1.
    Segments,
}

/// Derivatives and the forces of a surface tension, for closed curves of a fixed number of points.
///
/// Samples k = 0 .. len - 1 belong to the parameter alpha = 2 pi k / len. Everything is spectrally accurate: the error
/// falls faster than any power of len for smooth curves. Nothing is allocated after construction.
#[derive(Debug, Clone)]
pub struct PeriodicCalculus {
    transform: Transform,
    curve: Vec<Complex64>,
    work: Vec<Complex64>,
}

impl PeriodicCalculus {
    /// Plans for `len` samples.
    ///
    /// # Errors
    /// Fewer than 4 samples or more than 1,048,576.
    pub fn new(len: usize) -> Result<Self, LayerError> {
        within("the number of samples", len as f64, 4.0, MOST_POINTS)?;
        let zeros = vec![Complex64::default(); len];
        Ok(Self { transform: Transform::new(len), curve: zeros.clone(), work: zeros })
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
        load(values, &mut self.work);
        self.transform.forward(&mut self.work);
        differentiate(&mut self.work);
        self.transform.inverse(&mut self.work);
        store(&self.work, out);
        Ok(())
    }

    /// Forces on the fluid (force) at the points of a closed interface with the given surface tension (force):
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
        same_length("tension", tension.len(), self.len())?;
        let len = self.len();
        let shift = match placement {
            TensionPlacement::Points => 0.0,
            TensionPlacement::Segments => std::f64::consts::PI / len as f64,
        };
        load(positions, &mut self.curve);
        self.transform.forward(&mut self.curve);
        differentiate(&mut self.curve);
        rotate(&mut self.curve, shift);
        self.transform.inverse(&mut self.curve);
        for ((value, tangent), tension) in self.work.iter_mut().zip(&self.curve).zip(tension) {
            *value = tangent * (tension / tangent.norm());
        }
        self.transform.forward(&mut self.work);
        differentiate(&mut self.work);
        rotate(&mut self.work, -shift);
        self.transform.inverse(&mut self.work);
        let weight = TAU / len as f64;
        for (force, value) in forces.iter_mut().zip(&self.work) {
            *force = Vec2::new(value.re * weight, value.im * weight);
        }
        Ok(())
    }

    fn check(&self, values: usize, out: usize) -> Result<(), LayerError> {
        same_length("values", values, self.len())?;
        same_length("out", out, self.len())
    }
}

/// Shifts samples with this spectrum by `shift` in the parameter.
fn rotate(spectrum: &mut [Complex64], shift: f64) {
    let len = spectrum.len();
    for (index, value) in spectrum.iter_mut().enumerate() {
        *value *= Complex64::cis(wave(index, len) * shift);
    }
}

fn load(values: &[Vec2], out: &mut [Complex64]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = Complex64::new(value.x, value.y);
    }
}

fn store(values: &[Complex64], out: &mut [Vec2]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = Vec2::new(value.re, value.im);
    }
}
