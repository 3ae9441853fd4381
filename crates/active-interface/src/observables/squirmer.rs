//! Squirmer coefficients: the first two modes of the velocity along the interface.

use std::f64::consts::PI;

use motile_base::{Vec2, internal::all_points_finite, same_length};

use super::frame::{Frame, raw_centroid_velocity};
use super::polar::{Polar, PolarMarkers};
use crate::{InterfaceError, curve::polygon_moments};

/// Frame of reference of the velocity along the interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum VelocityFrame {
    /// Frame of the droplet: the velocity of its centroid is subtracted.
    #[default]
    CoMoving,
    /// Frame of the fluid far away, in which B1 is half as large.
    Laboratory,
}

/// Coefficients of the azimuthal velocity v_theta = B1 sin(theta) + (B2/2) sin(2 theta), Cowley, eq. (2.63).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
#[doc(alias("squirmer", "pusher", "puller"))]
pub struct SquirmerFit {
    /// B1 (length per time), positive for a droplet that swims along the first axis of its frame.
    pub b1: f64,
    /// B2 (length per time).
    pub b2: f64,
}

impl SquirmerFit {
    /// Returns the fit with B1 = 0 if it is no faster than a droplet at rest (length per time).
    pub(super) fn beyond(self, rest: f64) -> Self {
        Self { b1: if self.b1.abs() > rest { self.b1 } else { 0.0 }, ..self }
    }

    /// Returns beta = B2/|B1| (no dimension): positive for pullers, negative for pushers; `None` if B1 is zero.
    #[must_use]
    pub fn beta(&self) -> Option<f64> {
        (self.b1 != 0.0).then(|| self.b2 / self.b1.abs())
    }
}

/// Returns the squirmer coefficients B1 and B2: projections of the azimuthal velocity on the interface on sin(theta)
/// and sin(2 theta)/2, uniformly in the polar angle theta about the centroid. The angle is measured from the first axis
/// of `frame`, whose origin must be the centroid.
///
/// `velocities` are the velocities of the fluid at the markers (length per time) in the laboratory frame. Second order
/// in the marker spacing; spectrally accurate on a circle with equidistant markers.
///
/// # Errors
/// Returns an error for slices of different length, fewer than three markers, values that are not finite, no area.
#[doc(alias("squirmer", "pusher", "puller", "beta"))]
pub fn squirmer_coefficients(
    markers: &[Vec2],
    velocities: &[Vec2],
    reference: VelocityFrame,
    frame: &Frame,
) -> Result<SquirmerFit, InterfaceError> {
    same_length("velocities", markers.len(), velocities.len())?;
    let moments = polygon_moments(markers)?;
    all_points_finite("the velocities", velocities)?;
    let drift = match reference {
        VelocityFrame::CoMoving => raw_centroid_velocity(markers, velocities, &moments),
        VelocityFrame::Laboratory => Vec2::ZERO,
    };
    Ok(raw_squirmer(&PolarMarkers::new(markers, frame), velocities, drift, frame))
}

/// Returns the squirmer coefficients of the velocities less `drift` (length per time).
pub(super) fn raw_squirmer(polar: &PolarMarkers, velocities: &[Vec2], drift: Vec2, frame: &Frame) -> SquirmerFit {
    let mut fit = SquirmerFit::default();
    for ((Polar { direction, .. }, weight), velocity) in polar.weighted().zip(velocities) {
        let part = weight / PI * direction.perp_dot(frame.components(velocity - drift));
        fit.b1 += part * direction.y;
        fit.b2 += part * 4.0 * direction.x * direction.y;
    }
    fit
}

#[cfg(test)]
mod tests;
