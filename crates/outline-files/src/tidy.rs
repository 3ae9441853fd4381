//! Outlines that run counter-clockwise, without repeated points.

use motile_base::{
    Vec2,
    polygon::{self, CrossingFinder},
    positive,
};

use crate::OutlineError;

/// Least area of an outline over the square of its perimeter (no dimension).
const LEAST_AREA: f64 = 1e-9;
/// Largest coordinate (unit of the file).
const MOST: f64 = 1e50;
/// Distance below which points coincide, over the extent of the outline: round-off.
const SAME: f64 = 1e-12;

/// Least part of a period that the points of a line cover.
const LEAST_COVERED: f64 = 0.01;

const IN_ORDER: &str = "Give the points in order around the shape. For an outline that was traced from a picture, set \
                        `smooth` to one or two pixels";

/// A closed outline whose sides do not cross, or a line that repeats itself along x.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Its points, counter-clockwise; the last one is joined to the first. A line runs towards larger x, and the next
    /// image of its first point follows the last one.
    pub points: Vec<Vec2>,
    /// Area of its polygon (unit squared); between a line and y = 0, of one period.
    pub area: f64,
    /// Perimeter of its polygon, of a line the length of one period (unit).
    pub perimeter: f64,
    /// Centroid of the area; of a line the middle of its extent.
    pub centroid: Vec2,
    /// Number of points that were left out, because they repeat their neighbour.
    pub repeated: usize,
    /// True if the points were given clockwise, or against x.
    pub was_clockwise: bool,
}

/// Returns the closed outline through points: finite, without repeated points, counter-clockwise.
///
/// # Errors
/// Returns an error for points that are not finite, fewer than three different points, an outline that encloses no area
/// or crosses itself.
pub fn closed(points: &[Vec2]) -> Result<Outline, OutlineError> {
    let outline = around(points)?;
    let found = CrossingFinder::default().first_crossing(&outline.points)?;
    let Some((first, second)) = found else { return Ok(outline) };
    let end = |k: usize| outline.points[(k + 1) % outline.points.len()];
    // Numbers as the points were given, in their direction.
    let number = |k: usize| {
        let start = if outline.was_clockwise { end(k) } else { outline.points[k] };
        points.iter().position(|point| *point == start).unwrap_or(k)
    };
    let mut numbers = [first, second].map(number);
    numbers.sort_unstable();
    let [a, b] = [first, second].map(|k| [outline.points[k], end(k)]);
    Err(OutlineError::crossing(meeting(a, b), numbers, IN_ORDER))
}

/// Returns the outline of [`closed`] or, with a `period` (unit), of [`line()`], through points that may touch or cross
/// one another, for example points of an outline that was traced in a picture.
///
/// # Errors
/// Returns the errors of [`closed`] and [`line()`], except for crossings.
pub fn touching(points: &[Vec2], period: Option<f64>) -> Result<Outline, OutlineError> {
    match period {
        None => around(points),
        Some(period) => along(points, period),
    }
}

/// Returns the closed outline through points that may still cross.
pub(crate) fn around(points: &[Vec2]) -> Result<Outline, OutlineError> {
    let mut kept = without_repeats(points)?;
    let extent = extent(&kept);
    while kept.len() > 1 && kept[kept.len() - 1].distance(kept[0]) <= SAME * extent {
        kept.pop();
    }
    if kept.len() < 3 {
        return Err(OutlineError::TooFewPoints { found: kept.len(), least: 3 });
    }
    let perimeter: f64 = polygon::edges(&kept).map(|(a, b)| a.distance(b)).sum();
    let (area, arm) = polygon::area_and_arm(&kept);
    if area.is_nan() || area.abs() <= LEAST_AREA * perimeter * perimeter {
        return Err(OutlineError::NoArea);
    }
    let centroid = kept[0] + arm;
    let was_clockwise = area < 0.0;
    let repeated = points.len() - kept.len();
    if was_clockwise {
        kept[1..].reverse();
    }
    Ok(Outline { points: kept, area: area.abs(), perimeter, centroid, repeated, was_clockwise })
}

/// Returns the place where two sides cross, or the start of the first where they lie along one another.
fn meeting([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> Vec2 {
    let t = (c - a).perp_dot(d - c) / (b - a).perp_dot(d - c);
    if t.is_finite() { a.lerp(b, t.clamp(0.0, 1.0)) } else { a }
}

/// Returns the line through points that repeats itself along x with a period (length).
///
/// The line runs towards larger x and has no repeated points. If the last point is the image of the first one, it is
/// left out.
///
/// # Errors
/// Returns an error for a period that is not positive, points that are not finite, and fewer than two different points.
/// Returns an error for ends that are further apart than a period, and for a line that crosses itself or its image.
pub fn line(points: &[Vec2], period: f64) -> Result<Outline, OutlineError> {
    let outline = along(points, period)?;
    if outline.points.len() > 2
        && let Some((first, second)) = CrossingFinder::default().first_crossing_over(&outline.points, period)?
    {
        return Err(OutlineError::crossing(outline.points[first], [first, second], IN_ORDER));
    }
    Ok(outline)
}

/// Returns the line through points that may still cross.
pub(crate) fn along(points: &[Vec2], period: f64) -> Result<Outline, OutlineError> {
    positive("the period of the line", period)?;
    let mut kept = without_repeats(points)?;
    let was_clockwise = kept.first().zip(kept.last()).is_some_and(|(first, last)| last.x < first.x);
    if was_clockwise {
        kept.reverse();
    }
    let image = Vec2::new(period, 0.0);
    let ends = |kept: &[Vec2]| kept.first().copied().zip(kept.last().copied());
    if ends(&kept).is_some_and(|(first, last)| kept.len() > 1 && (last - first).distance(image) < 1e-6 * period) {
        kept.pop();
    }
    if kept.len() < 2 {
        return Err(OutlineError::TooFewPoints { found: kept.len(), least: 2 });
    }
    if ends(&kept).is_some_and(|(first, last)| last.x - first.x >= period) {
        return Err(OutlineError::Kind {
            what: "the ends of the line are further apart than the length of the region",
            remedy: "Set `scale` so that one period of the line fits, or cut the line to one period",
        });
    }
    let far = Vec2::splat(f64::INFINITY);
    let [low, high] = kept.iter().fold([far, -far], |[low, high], p| [low.min(*p), high.max(*p)]);
    if high.x - low.x < LEAST_COVERED * period {
        return Err(OutlineError::Kind {
            what: "the line stands upright: it covers hardly any of the length of the region",
            remedy: "Set `scale` so that it covers one period, or give points over the whole length",
        });
    }
    let next = kept.iter().skip(1).copied().chain(kept.first().map(|first| *first + image));
    let (mut area, mut perimeter) = (0.0, 0.0);
    for (a, b) in kept.iter().zip(next) {
        area += 0.5 * (b.x - a.x) * (a.y + b.y);
        perimeter += a.distance(b);
    }
    let centroid = 0.5 * (low + high);
    let repeated = points.len() - kept.len();
    Ok(Outline { points: kept, area, perimeter, centroid, repeated, was_clockwise })
}

/// Removes points that repeat the point before them.
fn without_repeats(points: &[Vec2]) -> Result<Vec<Vec2>, OutlineError> {
    let usable = |point: &Vec2| point.abs().max_element() < MOST && point.is_finite();
    if let Some(number) = points.iter().position(|point| !usable(point)) {
        return Err(OutlineError::not_finite(number, points[number]));
    }
    let extent = extent(points);
    let mut kept: Vec<Vec2> = Vec::with_capacity(points.len());
    for &point in points {
        if kept.last().is_none_or(|last| last.distance(point) > SAME * extent) {
            kept.push(point);
        }
    }
    Ok(kept)
}

/// Returns the larger side of the box around points (unit).
fn extent(points: &[Vec2]) -> f64 {
    let far = Vec2::splat(f64::INFINITY);
    let [low, high] = points.iter().fold([far, -far], |[low, high], p| [low.min(*p), high.max(*p)]);
    if points.is_empty() { 0.0 } else { (high - low).max_element() }
}

#[cfg(test)]
mod tests;
