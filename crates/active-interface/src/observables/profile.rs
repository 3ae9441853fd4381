//! Profile of the concentration along the interface.

use motile_base::Vec2;

use super::{fourier::check_concentration, frame::Frame};
use crate::InterfaceError;
use crate::curve::polygon::edges;

/// Concentration as a function of the arc length from the front of the droplet.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct ConcentrationProfile {
    /// Arc length of the middles of the segments, counter-clockwise from the front, ascending in [0, perimeter)
    /// (length).
    pub arc: Vec<f64>,
    /// Concentration there (particles per length).
    pub concentration: Vec<f64>,
    /// Length of the interface.
    pub perimeter: f64,
}

/// Returns the profile of the concentration (Cowley, figure 2.4). The front is the point where the first axis of
/// `frame` leaves the droplet, or the marker furthest along that axis where the axis does not meet the interface.
///
/// # Errors
/// Returns an error for slices of different length, fewer than three markers, values that are not finite, no area,
/// segments without length.
pub fn concentration_profile(
    markers: &[Vec2],
    numbers: &[f64],
    frame: &Frame,
) -> Result<ConcentrationProfile, InterfaceError> {
    check_concentration(markers, numbers)?;
    let mut end = 0.0;
    // Middle, concentration; and the furthest crossing of the axis with its arc length.
    let mut segments = Vec::with_capacity(markers.len());
    let mut front: Option<(f64, f64)> = None;
    let mut foremost = (f64::NEG_INFINITY, 0.0);
    for ((a, b), number) in edges(markers).zip(numbers) {
        let (start, chord) = (end, (b - a).length());
        end += chord;
        segments.push((0.5 * (start + end), number / chord));
        let (a, b) = (frame.coordinates(a), frame.coordinates(b));
        if a.x > foremost.0 {
            foremost = (a.x, start);
        }
        if (a.y <= 0.0) != (b.y <= 0.0) {
            let fraction = a.y / (a.y - b.y);
            let x = a.x + fraction * (b.x - a.x);
            if x > front.map_or(0.0, |front| front.0) {
                front = Some((x, start + fraction * chord));
            }
        }
    }
    let origin = front.unwrap_or(foremost).1;
    for segment in &mut segments {
        let arc = (segment.0 - origin).rem_euclid(end);
        segment.0 = if arc < end { arc } else { 0.0 };
    }
    segments.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (arc, concentration) = segments.into_iter().unzip();
    Ok(ConcentrationProfile { arc, concentration, perimeter: end })
}

#[cfg(test)]
mod tests;
