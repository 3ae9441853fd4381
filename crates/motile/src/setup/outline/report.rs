//! Reports of what became of outlines.

use motile_base::Vec2;
use outline_files::Outline;

use super::{OutlineOrigin, OutlineSetup};
use crate::SetupError;
use crate::setup::{DropletShape, InterfaceShape, Setup, SolidOutline};

/// Samples of a curve that are compared with the polygon.
const SAMPLES: usize = 4096;
/// Most pairs of samples and sides that are compared.
const MOST_PAIRS: usize = 20_000_000;

/// The shape that a body has got from an outline, next to the polygon through the points of the file.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OutlineReport {
    /// Key of the outline in the description.
    pub key: String,
    /// Number of the points.
    pub points: usize,
    /// Number of points that were left out, because they repeat their neighbour.
    pub repeated: usize,
    /// True if the points were given clockwise, or against x.
    pub was_clockwise: bool,
    /// Largest distance between the shape and the polygon, in either direction (length).
    pub distance: f64,
    /// Area of the polygon; of a line above y = 0, in one period (length squared).
    pub polygon_area: f64,
    /// Area of the shape (length squared).
    pub area: f64,
    /// Perimeter of the polygon; of a line the length of one period (length).
    pub polygon_perimeter: f64,
    /// Perimeter of the shape (length).
    pub perimeter: f64,
    /// Centroid of the polygon (length), for a body with a centre relative to it.
    pub centroid: [f64; 2],
}

impl Setup {
    /// Returns a report for each outline of the description: by how much the shape differs from the polygon through the
    /// points.
    ///
    /// # Errors
    /// Returns an error for an outline that cannot be read or used, with its key.
    pub fn outlines(&self) -> Result<Vec<OutlineReport>, SetupError> {
        let mut reports = Vec::new();
        for (key, shape) in self.shapes() {
            if let DropletShape::Outline(outline) = shape {
                let key = format!("{key}.outline");
                reports.push(outline.report(&key, OutlineOrigin::Centroid).map_err(|error| error.of(&key))?);
            }
        }
        let [period, _] = self.region.lengths();
        for (at, outline) in self.outlines_of_solids() {
            let key = |name: &str| format!("{at}.{name}");
            let line = |key: String, given: &OutlineSetup| -> Result<OutlineReport, SetupError> {
                let made = || -> Result<OutlineReport, SetupError> {
                    let prepared = given.prepared(Some(period), OutlineOrigin::File)?;
                    let made = outline.line(period)?.resampled(period / SAMPLES as f64)?;
                    Ok(report(&key, &prepared.given, &made, Some(period)))
                };
                made().map_err(|error| error.of(&key))
            };
            reports.extend(match outline {
                SolidOutline::Closed(given) => {
                    let key = key("closed");
                    Some(given.report(&key, OutlineOrigin::File).map_err(|error| error.of(&key))?)
                }
                SolidOutline::WallBelowLine(given) => Some(line(key("wall-below-line"), given)?),
                SolidOutline::WallAboveLine(given) => Some(line(key("wall-above-line"), given)?),
                _ => None,
            });
        }
        for (at, shape) in self.lines() {
            if let InterfaceShape::Line(outline) = shape {
                let key = format!("{at}.line");
                let made = || -> Result<OutlineReport, SetupError> {
                    let prepared = outline.prepared(Some(period), OutlineOrigin::File)?;
                    let points = active_interface::line_through(&prepared.points, period, SAMPLES)?;
                    Ok(report(&key, &prepared.given, &points, Some(period)))
                };
                reports.push(made().map_err(|error| error.of(&key))?);
            }
        }
        Ok(reports)
    }
}

impl OutlineSetup {
    /// Returns the report of a closed outline.
    fn report(&self, key: &str, usual: OutlineOrigin) -> Result<OutlineReport, SetupError> {
        let prepared = self.prepared(None, usual)?;
        let curve = self.curve_through(&prepared.points)?;
        let samples: Vec<Vec2> = (0..SAMPLES).map(|k| curve.point(k as f64 / SAMPLES as f64)).collect();
        let report = report(key, &prepared.given, &samples, None);
        Ok(OutlineReport { area: curve.area(), perimeter: curve.perimeter(), ..report })
    }
}

/// Returns the report of samples of a shape.
fn report(key: &str, given: &Outline, shape: &[Vec2], period: Option<f64>) -> OutlineReport {
    let advance = Vec2::new(period.unwrap_or(0.0), 0.0);
    // As many of each as can be compared in little time; the corners of a polygon of few points are all among them.
    let most = |count: usize, others: usize| (count * others).div_ceil(MOST_PAIRS).max(1);
    let from_shape = furthest(shape, most(shape.len(), given.points.len()), &given.points, advance);
    let from_points = furthest(&given.points, most(given.points.len(), shape.len()), shape, advance);
    let mut next = shape.iter().skip(1).copied().chain(shape.first().map(|first| *first + advance));
    let (mut area, mut perimeter) = (0.0, 0.0);
    for a in shape {
        let Some(b) = next.next() else { break };
        area += 0.5 * (b.x - a.x) * (a.y + b.y);
        perimeter += a.distance(b);
    }
    // Heights that were moved after the area was taken.
    let ends = given.points.iter().skip(1).copied().chain(given.points.first().map(|first| *first + advance));
    let below: f64 = given.points.iter().zip(ends).map(|(a, b)| 0.5 * (b.x - a.x) * (a.y + b.y)).sum();
    OutlineReport {
        key: key.to_owned(),
        points: given.points.len(),
        repeated: given.repeated,
        was_clockwise: given.was_clockwise,
        distance: from_shape.max(from_points),
        polygon_area: if period.is_some() { below } else { given.area },
        area,
        polygon_perimeter: given.perimeter,
        perimeter,
        centroid: given.centroid.into(),
    }
}

/// Returns the largest distance of every `stride`-th point from the line through others, and its images.
fn furthest(points: &[Vec2], stride: usize, others: &[Vec2], advance: Vec2) -> f64 {
    let images: &[f64] = if advance == Vec2::ZERO { &[0.0] } else { &[-1.0, 0.0, 1.0] };
    let ends = others.iter().skip(1).copied().chain(others.first().map(|first| *first + advance));
    let sides: Vec<[Vec2; 2]> = others.iter().copied().zip(ends).map(|(a, b)| [a, b]).collect();
    let nearest = |point: Vec2| {
        let squared = |[a, b]: [Vec2; 2]| {
            let along = b - a;
            let length = along.length_squared();
            let t = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
            (a + along * t - point).length_squared()
        };
        let of_image = |image: f64| sides.iter().map(move |side| side.map(|end| end + advance * image)).map(squared);
        images.iter().flat_map(|image| of_image(*image)).fold(f64::INFINITY, f64::min).sqrt()
    };
    points.iter().step_by(stride).map(|point| nearest(*point)).fold(0.0, f64::max)
}
