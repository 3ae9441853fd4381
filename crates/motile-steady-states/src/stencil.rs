//! Derivatives by differences of high order.

use motile::setup::Setup;
use nalgebra::DVector;

use crate::{Parameter, SteadyError};

/// Rule for a first derivative: places, in steps, and their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stencil(&'static [(f64, f64)]);

impl Stencil {
    /// Central differences of sixth order.
    pub(crate) const CENTRAL: Self = Self(&[
        (-3.0, -1.0 / 60.0),
        (-2.0, 9.0 / 60.0),
        (-1.0, -45.0 / 60.0),
        (1.0, 45.0 / 60.0),
        (2.0, -9.0 / 60.0),
        (3.0, 1.0 / 60.0),
    ]);
    /// Differences of fifth order on one side, for values at the end of their range.
    pub(crate) const FORWARD: Self =
        Self(&[(0.0, -137.0 / 60.0), (1.0, 5.0), (2.0, -5.0), (3.0, 10.0 / 3.0), (4.0, -5.0 / 4.0), (5.0, 1.0 / 5.0)]);

    /// Central differences of second order.
    const SHORT: Self = Self(&[(1.0, 0.5), (-1.0, -0.5)]);
    /// Differences of second order on one side.
    const SHORT_FORWARD: Self = Self(&[(0.0, -1.5), (1.0, 2.0), (2.0, -0.5)]);

    /// Returns differences of second order with a step of a parameter: on one side if the description allows no value
    /// below, as at zero friction.
    pub(crate) fn short(parameter: Parameter, setup: &Setup, step: f64) -> Self {
        let below = parameter.get(setup).and_then(|value| parameter.with(setup, value - step).ok());
        if below.is_some_and(|below| below.check().is_ok()) { Self::SHORT } else { Self::SHORT_FORWARD }
    }

    /// Returns the derivative of a function at zero, by differences with a `step`.
    pub(crate) fn derivative(
        self,
        step: f64,
        mut function: impl FnMut(f64) -> Result<DVector<f64>, SteadyError>,
    ) -> Result<DVector<f64>, SteadyError> {
        let mut sum: Option<DVector<f64>> = None;
        for (place, weight) in self.0 {
            let value = function(place * step)? * (weight / step);
            sum = Some(match sum {
                Some(sum) => sum + value,
                None => value,
            });
        }
        Ok(sum.unwrap_or_else(|| DVector::zeros(0)))
    }
}

#[cfg(test)]
mod tests;
