//! Fourier modes of the shape and of the concentration.

use std::f64::consts::PI;

use motile_base::{Vec2, internal::all_finite, same_length};

use super::frame::Frame;
use super::polar::{Polar, PolarMarkers};
use crate::curve::polygon::edges;
use crate::{InterfaceError, curve::polygon_moments};

/// Fourier coefficients of f(theta) = mean + sum over k >= 1 of cosines[k-1] cos k theta + sines[k-1] sin k theta, in
/// the unit of f.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct FourierModes {
    /// Mean over the polar angle.
    pub mean: f64,
    /// Coefficients of cos theta, cos 2 theta, ...
    pub cosines: Vec<f64>,
    /// Coefficients of sin theta, sin 2 theta, ...
    pub sines: Vec<f64>,
}

impl FourierModes {
    /// Returns the amplitude sqrt(a_k^2 + b_k^2) of mode `k`, 0 for modes that were not computed; for k = 0 the mean.
    #[must_use]
    pub fn amplitude(&self, k: usize) -> f64 {
        match k.checked_sub(1) {
            None => self.mean,
            Some(i) => match (self.cosines.get(i), self.sines.get(i)) {
                (Some(a), Some(b)) => a.hypot(*b),
                _ => 0.0,
            },
        }
    }

    /// Creates coefficients of samples (unit vector at the polar angle, weight in integrals over it, value): the waves
    /// are powers of the unit vector as a complex number.
    pub(super) fn sum(count: usize, samples: impl Iterator<Item = (Vec2, f64, f64)>) -> Self {
        let mut modes = Self { mean: 0.0, cosines: vec![0.0; count], sines: vec![0.0; count] };
        for (Vec2 { x, y }, weight, value) in samples {
            let part = weight * value / PI;
            modes.mean += 0.5 * part;
            let (mut cos, mut sin) = (x, y);
            for (a, b) in modes.cosines.iter_mut().zip(&mut modes.sines) {
                *a += part * cos;
                *b += part * sin;
                (cos, sin) = (cos * x - sin * y, cos * y + sin * x);
            }
        }
        modes
    }
}

/// Returns the first `count` Fourier modes of the shape r(theta) (length) about the origin of `frame`, theta from its
/// first axis.
///
/// Integrals over the polar angle by the sum over markers: spectrally accurate on a circle with equidistant
/// markers, second order in the marker spacing otherwise. Meant for shapes on which r is single-valued.
///
/// # Errors
/// Returns an error for fewer than three markers, markers that are not finite or enclose no area.
pub fn shape_modes(markers: &[Vec2], frame: &Frame, count: usize) -> Result<FourierModes, InterfaceError> {
    polygon_moments(markers)?;
    Ok(raw_shape_modes(&PolarMarkers::new(markers, frame), count))
}

pub(super) fn raw_shape_modes(polar: &PolarMarkers, count: usize) -> FourierModes {
    FourierModes::sum(
        count,
        polar.weighted().map(|(Polar { direction, radius, .. }, weight)| (direction, weight, radius)),
    )
}

/// Checks that markers and particle numbers have a concentration as a function of place.
pub(super) fn check_concentration(markers: &[Vec2], numbers: &[f64]) -> Result<(), InterfaceError> {
    same_length("numbers", markers.len(), numbers.len())?;
    polygon_moments(markers)?;
    all_finite("the particle numbers", numbers)?;
    if let Some(index) = edges(markers).position(|(a, b)| a == b) {
        return Err(InterfaceError::coincident_points(index));
    }
    Ok(())
}

/// Returns the first `count` Fourier modes of the concentration (particles per length) as a function of the polar angle
/// about the origin of `frame`, theta from its first axis. The `numbers` are the particle numbers of the segments.
///
/// The averages over the segments are turned into values mode by mode, so that on a circle with equidistant markers
/// the modes are exact; second order in the marker spacing otherwise.
///
/// # Errors
/// Returns an error for slices of different length, fewer than three markers, values that are not finite, no area,
/// segments without length.
pub fn concentration_modes(
    markers: &[Vec2],
    numbers: &[f64],
    frame: &Frame,
    count: usize,
) -> Result<FourierModes, InterfaceError> {
    check_concentration(markers, numbers)?;
    let lengths: Vec<f64> = edges(markers).map(|(a, b)| (b - a).length()).collect();
    Ok(raw_concentration_modes(&PolarMarkers::new(markers, frame), numbers, &lengths, count))
}

/// Returns the modes of numbers of particles on segments of these lengths (length).
pub(super) fn raw_concentration_modes(
    polar: &PolarMarkers,
    numbers: &[f64],
    lengths: &[f64],
    count: usize,
) -> FourierModes {
    let values = numbers.iter().zip(lengths).map(|(number, length)| number / length);
    let samples = polar.segments().zip(values).map(|((direction, width), value)| (direction, width, value));
    let mut modes = FourierModes::sum(count, samples);
    for (i, (a, b)) in modes.cosines.iter_mut().zip(&mut modes.sines).enumerate() {
        let half = (i + 1) as f64 * PI / numbers.len() as f64;
        let damping = half.sin() / half;
        // Modes that the segments do not resolve stay as they are.
        if damping > 0.5 {
            *a /= damping;
            *b /= damping;
        }
    }
    modes
}

#[cfg(test)]
mod tests;
