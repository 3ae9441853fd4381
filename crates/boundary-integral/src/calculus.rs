//! Calculus of periodic functions given by equally spaced samples.

use std::f64::consts::TAU;

use ib_core::Vec2;
use num_complex::Complex64;

use crate::{
    BoundaryIntegralError,
    error::same_length,
    transform::{Transform, copy_band, differentiate, largest_wave, truncate, wave},
};

/// Where on the curve the tension of [`PeriodicCalculus::tension_forces`] is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TensionPlacement {
    /// At the markers, entry k at marker k.
    Markers,
    /// Half way between markers, entry k between marker k and marker k + 1.
    Segments,
}

/// Derivatives, the logarithmic operator and the force of a tension, for closed curves of a fixed number of markers.
///
/// Samples k = 0 .. len - 1 belong to the parameter alpha = 2 pi k / len. Everything is spectrally accurate: the error
/// falls faster than any power of len for smooth curves. Nothing is allocated after construction.
#[derive(Debug)]
pub struct PeriodicCalculus {
    transform: Transform,
    curve: Vec<Complex64>,
    work: Vec<Complex64>,
}

impl PeriodicCalculus {
    /// Plans for `len` samples.
    ///
    /// # Errors
    /// Fewer than 4 samples.
    pub fn new(len: usize) -> Result<Self, BoundaryIntegralError> {
        if len < 4 {
            return Err(BoundaryIntegralError::TooFew { name: "the number of samples", found: len, least: 4 });
        }
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
    pub fn derivative(&mut self, values: &[Vec2], out: &mut [Vec2]) -> Result<(), BoundaryIntegralError> {
        self.check(values.len(), out.len())?;
        load(values, &mut self.work);
        self.transform.forward(&mut self.work);
        differentiate(&mut self.work);
        self.transform.inverse(&mut self.work);
        store(&self.work, out);
        Ok(())
    }

    /// The logarithmic operator of Kress and Martensen,
    /// `(K g)(alpha) = - integral of 1/2 ln(4 sin^2((alpha - beta)/2)) g(beta) dbeta`, which multiplies mode m by
    /// `pi/|m|` and mode 0 by 0 (unit of the values).
    ///
    /// # Errors
    /// Slices of another length than planned for.
    pub fn log_operator(&mut self, values: &[Vec2], out: &mut [Vec2]) -> Result<(), BoundaryIntegralError> {
        self.check(values.len(), out.len())?;
        let len = self.len();
        load(values, &mut self.work);
        self.transform.forward(&mut self.work);
        self.work[0] = Complex64::default();
        for (index, value) in self.work.iter_mut().enumerate().skip(1) {
            *value *= std::f64::consts::PI / index.min(len - index) as f64;
        }
        self.transform.inverse(&mut self.work);
        store(&self.work, out);
        Ok(())
    }

    /// Forces on the fluid (force) at the markers of a closed interface with the given surface tension (force):
    /// `F_k = (2 pi / len) d(gamma tau)/dalpha` at marker k, the thesis' F = d(gamma tau)/ds times the length that
    /// belongs to the marker. Their sum is zero to round-off.
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
    ) -> Result<(), BoundaryIntegralError> {
        self.check(positions.len(), forces.len())?;
        same_length("tension", tension.len(), self.len())?;
        let len = self.len();
        let shift = match placement {
            TensionPlacement::Markers => 0.0,
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

    fn check(&self, values: usize, out: usize) -> Result<(), BoundaryIntegralError> {
        same_length("values", values, self.len())?;
        same_length("out", out, self.len())
    }
}

/// Truncates periodic samples of a vector to their lowest modes, in place and without allocation.
///
/// A body whose flow is resolved by fewer nodes than it has markers passes the rates of its markers through this, so
/// that no motion arises that the flow does not see. A band of n modes keeps the wave numbers |m| <= (n - 1)/2, as
/// [`crate::BoundaryIntegral`] does with n nodes.
#[derive(Debug)]
pub struct BandLimit {
    transform: Transform,
    work: Vec<Complex64>,
    modes: usize,
}

impl BandLimit {
    /// A plan for `len` samples of which the lowest `modes` modes are kept.
    ///
    /// # Errors
    /// No modes, or more than samples.
    pub fn new(len: usize, modes: usize) -> Result<Self, BoundaryIntegralError> {
        if modes == 0 {
            return Err(BoundaryIntegralError::TooFew { name: "the number of modes", found: 0, least: 1 });
        }
        if modes > len {
            return Err(BoundaryIntegralError::BandTooWide { modes, len });
        }
        Ok(Self { transform: Transform::new(len), work: vec![Complex64::default(); len], modes })
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.work.len()
    }

    /// Always false.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Number of modes kept.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Truncates `values`.
    ///
    /// # Errors
    /// A slice of another length than planned for.
    pub fn apply(&mut self, values: &mut [Vec2]) -> Result<(), BoundaryIntegralError> {
        same_length("values", values.len(), self.len())?;
        load(values, &mut self.work);
        self.transform.forward(&mut self.work);
        truncate(&mut self.work, largest_wave(self.modes));
        self.transform.inverse(&mut self.work);
        store(&self.work, values);
        Ok(())
    }
}

/// Trigonometric interpolation of periodic samples to another number of samples of the same curve, or truncation where
/// there are fewer.
#[derive(Debug)]
pub struct Resample {
    from: Transform,
    to: Transform,
    source: Vec<Complex64>,
    target: Vec<Complex64>,
}

impl Resample {
    /// A plan from `from` samples to `to` samples.
    ///
    /// # Errors
    /// No samples.
    pub fn new(from: usize, to: usize) -> Result<Self, BoundaryIntegralError> {
        if from.min(to) == 0 {
            return Err(BoundaryIntegralError::TooFew { name: "the number of samples", found: 0, least: 1 });
        }
        let (source, target) = (vec![Complex64::default(); from], vec![Complex64::default(); to]);
        Ok(Self { from: Transform::new(from), to: Transform::new(to), source, target })
    }

    /// Resamples `values` into `out`.
    ///
    /// # Errors
    /// Slices of other lengths than planned for.
    pub fn apply(&mut self, values: &[Vec2], out: &mut [Vec2]) -> Result<(), BoundaryIntegralError> {
        same_length("values", values.len(), self.source.len())?;
        same_length("out", out.len(), self.target.len())?;
        load(values, &mut self.source);
        self.from.forward(&mut self.source);
        copy_band(&self.source, &mut self.target, largest_wave(values.len().min(out.len())));
        self.to.inverse(&mut self.target);
        store(&self.target, out);
        Ok(())
    }
}

/// Shifts samples with this spectrum by `shift` in the parameter.
fn rotate(spectrum: &mut [Complex64], shift: f64) {
    let len = spectrum.len();
    for (index, value) in spectrum.iter_mut().enumerate() {
        *value *= Complex64::cis(wave(index, len) * shift);
    }
}

pub(crate) fn load(values: &[Vec2], out: &mut [Complex64]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = Complex64::new(value.x, value.y);
    }
}

pub(crate) fn store(values: &[Complex64], out: &mut [Vec2]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = Vec2::new(value.re, value.im);
    }
}
