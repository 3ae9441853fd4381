//! Implicit treatment of the short waves that bending makes stiff.

use std::f64::consts::TAU;

use motile_base::{ComplexTransform, InputError, Vec2};
use num_complex::Complex64;

/// Decay of the short waves of the markers, which the bending flattens faster than a step follows. It is added to the
/// implicit part of a step and taken off the explicit one, so that states at rest stay at rest and errors are of second
/// order in the step.
///
/// With the mean viscosity eta of both sides, a wave of the number q (1/length) on a flat interface decays at the rate
/// `r = B q^3/(4 eta)`. A midpoint step dt is stable if the implicit decay is at least `r/2 - 1/dt`. The stabiliser
/// takes `r - 1/dt`, so that a neighbour that doubles the mobility does no harm, and nothing of waves that decay more
/// slowly than 1/dt, which the step follows as if there were no stabiliser.
#[derive(Debug, Clone)]
pub(in crate::interface) struct BendingStabiliser {
    transform: ComplexTransform,
    /// Rate of decay of each coefficient (1/time).
    rates: Vec<f64>,
    values: Vec<Complex64>,
    /// True in a step that the rates are prepared for.
    active: bool,
}

/// Quantities that the rates of decay depend on.
#[derive(Debug, Clone, Copy)]
pub(in crate::interface) struct Stiffness {
    /// Length of the curve, or of one period of it (length).
    pub(in crate::interface) perimeter: f64,
    /// Mean viscosity of both sides (stress times time).
    pub(in crate::interface) viscosity: f64,
    /// Largest rate of a flat interface of unit tension and viscosity (1/length).
    pub(in crate::interface) largest: f64,
    /// Length of the step (time).
    pub(in crate::interface) dt: f64,
    /// Number of modes that move.
    pub(in crate::interface) modes: usize,
}

impl BendingStabiliser {
    /// Creates an inactive stabiliser for so many markers.
    ///
    /// # Errors
    /// Returns an error for more markers than a Fourier transform takes.
    pub(in crate::interface) fn new(count: usize) -> Result<Self, InputError> {
        let transform = ComplexTransform::new(count)?;
        Ok(Self { transform, rates: vec![0.0; count], values: vec![Complex64::ZERO; count], active: false })
    }

    /// Switches the stabiliser off.
    pub(in crate::interface) fn rest(&mut self) {
        self.active = false;
    }

    /// Prepares a step at the present shape, from the tension (force) that makes a flat interface relax as fast as the
    /// bending does at a wave number (1/length).
    pub(in crate::interface) fn prepare(&mut self, tension: impl Fn(f64) -> f64, of: Stiffness) {
        let count = self.rates.len();
        let most = (of.modes.saturating_sub(1) / 2).min(count / 2);
        for (index, rate) in self.rates.iter_mut().enumerate() {
            let number = index.min(count - index);
            let wave = TAU * number as f64 / of.perimeter;
            let response = (0.25 * wave).min(of.largest) / of.viscosity;
            let excess = (response * tension(wave) - 1.0 / of.dt).max(0.0);
            *rate = if number <= most { excess } else { 0.0 };
        }
        self.active = true;
    }

    /// Takes the decay off the explicit rates (length per time) of markers.
    pub(in crate::interface) fn release(&mut self, markers: &[Vec2], advance: f64, rate: &mut [f64]) {
        if self.transform_of(markers.iter().map(|marker| marker.to_array()), advance) {
            self.add_decay(-1.0, rate);
        }
    }

    /// Adds `factor` times the implicit decay at these positions x, y (length).
    pub(in crate::interface) fn add(&mut self, positions: &[f64], advance: f64, factor: f64, out: &mut [f64]) {
        if self.transform_of(pairs(positions), advance) {
            self.add_decay(factor, out);
        }
    }

    /// Replaces positions by those that reach them in the time `factor` against the decay.
    pub(in crate::interface) fn solve(&mut self, positions: &mut [f64], advance: f64, factor: f64) {
        if self.transform_of(pairs(positions), advance) {
            // The change alone is transformed back, so that waves that do not decay keep all digits.
            for (value, rate) in self.values.iter_mut().zip(&self.rates) {
                *value *= -factor * rate / (1.0 + factor * rate);
            }
            let _ = self.transform.inverse(&mut self.values);
            for (pair, value) in positions.chunks_exact_mut(2).zip(&self.values) {
                pair[0] += value.re;
                pair[1] += value.im;
            }
        }
    }

    /// Adds `factor` times the decay of the coefficients.
    fn add_decay(&mut self, factor: f64, out: &mut [f64]) {
        self.values.iter_mut().zip(&self.rates).for_each(|(value, rate)| *value *= rate);
        let _ = self.transform.inverse(&mut self.values);
        for (pair, value) in out.chunks_exact_mut(2).zip(&self.values) {
            pair[0] -= factor * value.re;
            pair[1] -= factor * value.im;
        }
    }

    /// Takes the coefficients of positions, without the part that advances from period to period; false if there is
    /// nothing to do.
    fn transform_of(&mut self, positions: impl ExactSizeIterator<Item = [f64; 2]>, advance: f64) -> bool {
        let count = self.values.len();
        if !self.active || positions.len() != count {
            return false;
        }
        let (scale, step) = (1.0 / count as f64, advance / count as f64);
        for (k, (value, [x, y])) in self.values.iter_mut().zip(positions).enumerate() {
            *value = scale * Complex64::new(x - step * k as f64, y);
        }
        // The lists are as long as the transform, so that the call cannot fail.
        self.transform.forward(&mut self.values).is_ok()
    }
}

/// Returns the pairs x, y of a list.
fn pairs(positions: &[f64]) -> impl ExactSizeIterator<Item = [f64; 2]> {
    positions.chunks_exact(2).map(|pair| [pair[0], pair[1]])
}

#[cfg(test)]
mod tests;
