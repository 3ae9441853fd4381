//! Least squares ellipse through the markers.

use motile_base::{Vec2, internal::at_least};

use super::frame::{Frame, aspect_ratio_of, half_chords};
use super::least_squares::NormalEquations;
use crate::{
    InterfaceError,
    curve::{polygon::AreaMoments, polygon_moments},
};

/// An ellipse with its axes along the axes of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct EllipseFit {
    /// Half axis along the first axis of the frame (length).
    pub along: f64,
    /// Half axis along the second axis of the frame (length).
    pub across: f64,
    /// Centre in the frame (length).
    pub centre: Vec2,
    /// Root mean square of the distance of the interface from the ellipse (length; measured towards its centre).
    pub residual: f64,
}

impl EllipseFit {
    /// Returns the aspect ratio a/b, a along the motion (no dimension; Cowley, section 2.3.4).
    #[must_use]
    pub fn aspect_ratio(&self) -> f64 {
        self.along / self.across
    }
}

/// Returns the least squares ellipse through the markers, with its axes along and across the first axis of `frame`.
///
/// Half axes a, b and centre (x0, y0) minimise the sum of (rho_k - 1)^2 ds_k with rho = sqrt((x-x0)^2/a^2 +
/// (y-y0)^2/b^2), the distance from the ellipse towards its centre in units of the radius there, by Gauss-Newton
/// iterations. Exact for ellipses whatever the number of markers.
///
/// # Errors
/// Returns an error for fewer than four markers, markers that are not finite or enclose no area, no convergence.
pub fn fit_ellipse(markers: &[Vec2], frame: &Frame) -> Result<EllipseFit, InterfaceError> {
    at_least("markers", markers.len(), 4)?;
    raw_ellipse(markers, &polygon_moments(markers)?, frame)
}

/// Returns the least squares ellipse through markers whose polygon has these moments.
pub(super) fn raw_ellipse(
    markers: &[Vec2],
    moments: &AreaMoments,
    frame: &Frame,
) -> Result<EllipseFit, InterfaceError> {
    let no_fit = || InterfaceError::no_fit("an ellipse", markers.len());
    let ratio = aspect_ratio_of(moments, frame)?;
    let radius = (moments.area.abs() / std::f64::consts::PI).sqrt();
    let centroid = frame.coordinates(moments.centroid);
    let points: Vec<(Vec2, f64)> = markers
        .iter()
        .zip(half_chords(markers))
        .map(|(marker, chord)| ((frame.coordinates(*marker) - centroid) / radius, chord.length() / radius))
        .collect();
    // Inverse half axes and centre, in units of the radius.
    let (mut p, mut q, mut centre) = (ratio.sqrt().recip(), ratio.sqrt(), Vec2::ZERO);
    let mut last = f64::INFINITY;
    for _ in 0..100 {
        let mut equations = NormalEquations::new();
        for &(point, weight) in &points {
            let r = point - centre;
            let (x, y) = (r.x * p, r.y * q);
            let rho = (x * x + y * y).sqrt();
            if rho == 0.0 {
                return Err(no_fit());
            }
            let (x, y) = (x / rho, y / rho);
            equations.add([x * r.x, y * r.y, -x * p, -y * q], weight, rho - 1.0);
        }
        let Some(step) = equations.step(0.0) else { return Err(no_fit()) };
        // A step may change a half axis by 30 per cent at most.
        let (change, bound) = (step[0].abs().max(step[1].abs()), 0.3 * p.min(q));
        let scale = if change > bound { bound / change } else { 1.0 };
        p -= scale * step[0];
        q -= scale * step[1];
        centre -= Vec2::new(step[2], step[3]) * scale;
        last = step.iter().fold(0.0, |largest, change| largest.max(change.abs()));
        if last < 1e-13 * (p + q) {
            let [sum, weights] = points.iter().fold([0.0; 2], |[sum, weights], &(point, weight)| {
                let r = point - centre;
                let rho = Vec2::new(r.x * p, r.y * q).length();
                [sum + weight * r.length_squared() * (1.0 - 1.0 / rho).powi(2), weights + weight]
            });
            return Ok(EllipseFit {
                along: radius / p,
                across: radius / q,
                centre: centroid + centre * radius,
                residual: radius * (sum / weights).sqrt(),
            });
        }
    }
    Err(InterfaceError::NoConvergence {
        what: "the fit of an ellipse",
        residual: last,
        tolerance: 1e-13,
        remedy: "Use a shape that is closer to an ellipse",
    })
}

#[cfg(test)]
mod tests;
