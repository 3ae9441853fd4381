//! The ellipse closest to the markers.

use glam::{DMat4, DVec4};
use ib_core::Vec2;
use ib_core::input::at_least;

use super::frame::{Frame, aspect_ratio_of, half_chords};
use crate::{InterfaceError, curve::polygon_moments};

/// An ellipse with its axes along those of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EllipseFit {
    /// Half axis along the first axis of the frame (length).
    pub along: f64,
    /// Half axis across it (length).
    pub across: f64,
    /// Centre in the frame (length).
    pub centre: Vec2,
    /// Root mean square of the distance of the interface from the ellipse (length; measured towards its centre).
    pub residual: f64,
}

impl EllipseFit {
    /// Aspect ratio a/b, a along the motion (no dimension; Cowley, section 2.3.4).
    #[must_use]
    pub fn aspect_ratio(&self) -> f64 {
        self.along / self.across
    }
}

/// The ellipse through the markers by least squares, with its axes along and across the first axis of `frame`.
///
/// Half axes a, b and centre (x0, y0) minimise the sum of (rho_k - 1)^2 ds_k with rho = sqrt((x-x0)^2/a^2 +
/// (y-y0)^2/b^2), the distance from the ellipse towards its centre in units of the radius there, by Gauss-Newton
/// iterations. Exact for ellipses whatever the number of markers.
///
/// # Errors
/// Fewer than four markers, markers that are not finite or enclose no area, no convergence.
pub fn fit_ellipse(markers: &[Vec2], frame: &Frame) -> Result<EllipseFit, InterfaceError> {
    at_least("markers", markers.len(), 4)?;
    let moments = polygon_moments(markers)?;
    let no_fit = InterfaceError::NoFit { what: "an ellipse", points: markers.len() };
    let ratio = aspect_ratio_of(&moments, frame)?;
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
        let (mut normal, mut gradient) = (DMat4::ZERO, DVec4::ZERO);
        let (mut sum, mut weights) = (0.0, 0.0);
        for &(point, weight) in &points {
            let r = point - centre;
            let (x, y) = (r.x * p, r.y * q);
            let rho = x.hypot(y);
            if rho == 0.0 {
                return Err(no_fit);
            }
            let row = DVec4::new(x * r.x, y * r.y, -x * p, -y * q) / rho;
            normal += DMat4::from_cols(row * row.x, row * row.y, row * row.z, row * row.w) * weight;
            gradient += row * (weight * (rho - 1.0));
            let distance = r.length() * (1.0 - 1.0 / rho);
            sum += weight * distance * distance;
            weights += weight;
        }
        let step = normal.try_inverse().map(|inverse| inverse * gradient).filter(|step| step.is_finite());
        let Some(step) = step else { return Err(no_fit) };
        // A step may change a half axis by 30 per cent at most.
        let (change, bound) = (step.x.abs().max(step.y.abs()), 0.3 * p.min(q));
        let scale = if change > bound { bound / change } else { 1.0 };
        p -= scale * step.x;
        q -= scale * step.y;
        centre -= Vec2::new(step.z, step.w) * scale;
        last = step.abs().max_element();
        if last < 1e-13 * (p + q) {
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
        remedy: "the shape is too far from an ellipse",
    })
}

#[cfg(test)]
mod tests;
