//! The geometries with known Green's functions.

use num_complex::Complex64;

use crate::{
    LayerError,
    error::{finite, positive},
};

/// What is held fixed along a channel, beside the forces in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Forcing {
    /// The mean pressure gradient dp/dx (force per volume); a negative one drives fluid to positive x.
    Gradient(f64),
    /// The flux, the integral of u over the width (area per time); the mean pressure gradient is what this takes.
    Flux(f64),
}

/// No mean pressure gradient.
impl Default for Forcing {
    fn default() -> Self {
        Self::Gradient(0.0)
    }
}

/// A geometry with a known Green's function of the Stokes equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Geometry {
    /// The unbounded plane, the fluid at rest far away.
    Plane,
    /// A rectangle with periodic boundaries; the velocity, that inside the curves included, has zero mean.
    Box {
        /// Periods in x and y (length).
        lengths: [f64; 2],
    },
    /// A channel along x, periodic in x, with no-slip walls at y = -width/2 and y = width/2.
    Channel {
        /// Period in x (length).
        length: f64,
        /// Distance between the walls (length).
        width: f64,
        /// What is held fixed.
        forcing: Forcing,
    },
}

impl Geometry {
    /// Refuses lengths that are not positive and finite and a forcing that is not finite.
    pub(crate) fn check(&self) -> Result<(), LayerError> {
        match *self {
            Self::Plane => Ok(()),
            Self::Box { lengths: [lx, ly] } => {
                positive("the period in x", lx)?;
                positive("the period in y", ly)
            }
            Self::Channel { length, width, forcing: Forcing::Gradient(value) | Forcing::Flux(value) } => {
                positive("the period of the channel", length)?;
                positive("the width of the channel", width)?;
                finite("the forcing of the channel", value)
            }
        }
    }

    pub(crate) fn images(&self) -> Images {
        let periods = match *self {
            Self::Plane => [None; 2],
            Self::Box { lengths } => lengths.map(Some),
            Self::Channel { length, .. } => [Some(length), None],
        };
        Images { periods }
    }

    /// Area of a box (length squared), infinite otherwise.
    pub(crate) fn area(&self) -> f64 {
        if let Self::Box { lengths: [lx, ly] } = self { lx * ly } else { f64::INFINITY }
    }
}

/// Periodic images: the periods in x and y (length), where there are any.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Images {
    pub(crate) periods: [Option<f64>; 2],
}

impl Images {
    /// The shortest vector that differs from d by periods.
    pub(crate) fn wrap(&self, d: Complex64) -> Complex64 {
        let wrap = |value: f64, period: Option<f64>| period.map_or(value, |p| value - p * (value / p).round());
        Complex64::new(wrap(d.re, self.periods[0]), wrap(d.im, self.periods[1]))
    }

    /// Zero and the vectors to the neighbouring images.
    pub(crate) fn shifts(&self) -> impl Iterator<Item = Complex64> + use<> {
        let steps = |period: Option<f64>| {
            let p = period.unwrap_or(0.0);
            let count = if period.is_some() { 3 } else { 1 };
            [0.0, p, -p].into_iter().take(count)
        };
        let [x, y] = self.periods;
        steps(x).flat_map(move |dx| steps(y).map(move |dy| Complex64::new(dx, dy)))
    }
}
