//! Width of a channel between deformed walls.

use motile_base::{
    Vec2,
    internal::{all_points_finite, at_least},
    positive,
};

use crate::{Solid, SolidError};

/// Smallest and largest width of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Width {
    /// Smallest width (length).
    pub minimum: f64,
    /// Place x of the smallest width (length), within one period from the leftmost point of the lower side.
    pub minimum_at: f64,
    /// Largest width (length).
    pub maximum: f64,
    /// Place x of the largest width (length), within one period from the leftmost point of the lower side.
    pub maximum_at: f64,
}

/// Returns the vertical width of the channel between two walls of a scene: the smallest and the largest over x.
///
/// # Errors
/// Returns an error for walls that are not periodic in x, or with different periods.
pub fn width_between(lower: &Solid, upper: &Solid) -> Result<Width, SolidError> {
    let (first, second) = (lower.mesh().period().unwrap_or(0.0), upper.mesh().period().unwrap_or(0.0));
    let (Some(below), Some(above), true) = (lower.surface(-1), upper.surface(1), first == second) else {
        return Err(SolidError::different_periods(first, second));
    };
    vertical_width(&below, &above, first)
}

/// Returns the vertical distance between two lines through the points `lower` and `upper` (length), each repeated with
/// `period` (length): the smallest and the largest over x, which are at points of one of the lines. If a line
/// overhangs, its side next to the other line counts.
///
/// # Errors
/// Returns an error for empty lists, points that are not finite, a period that is not positive.
fn vertical_width(lower: &[Vec2], upper: &[Vec2], period: f64) -> Result<Width, SolidError> {
    positive("the period", period)?;
    for (name, line) in [("points of the lower side", lower), ("points of the upper side", upper)] {
        at_least(name, line.len(), 1)?;
        all_points_finite(name, line)?;
    }
    let mut width = Width { minimum: f64::INFINITY, minimum_at: 0.0, maximum: f64::NEG_INFINITY, maximum_at: 0.0 };
    let start = lower.iter().map(|point| point.x).fold(f64::INFINITY, f64::min);
    for x in lower.iter().chain(upper).map(|point| point.x) {
        let here = heights(upper, period, x).fold(f64::INFINITY, f64::min)
            - heights(lower, period, x).fold(f64::NEG_INFINITY, f64::max);
        let place = start + (x - start).rem_euclid(period);
        if here < width.minimum {
            (width.minimum, width.minimum_at) = (here, place);
        }
        if here > width.maximum && here.is_finite() {
            (width.maximum, width.maximum_at) = (here, place);
        }
    }
    Ok(width)
}

/// Returns the heights at which a periodic line crosses the vertical through x.
fn heights(line: &[Vec2], period: f64, x: f64) -> impl Iterator<Item = f64> {
    let count = line.len();
    // The direction in which the line runs.
    let total = line[count - 1].x - line[0].x;
    let advance = if total < 0.0 { -period } else { period };
    (0..count).filter_map(move |k| {
        let from = line[k];
        let mut step = line[(k + 1) % count] - from;
        if k + 1 == count {
            step.x += advance;
        }
        // The image of x in front of the segment's start; edges are shorter than half a period.
        let mut ahead = x - from.x;
        ahead -= period * ((ahead - 0.5 * step.x) / period).round();
        if step.x == 0.0 {
            return (ahead == 0.0).then_some(from.y);
        }
        let fraction = ahead / step.x;
        (-1e-12..=1.0 + 1e-12).contains(&fraction).then_some(from.y + step.y * fraction)
    })
}

#[cfg(test)]
mod tests;
