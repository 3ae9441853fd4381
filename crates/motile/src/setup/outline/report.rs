//! Reports of what became of outlines.

use motile_base::{PeriodicSeries, Vec2, internal::told, polygon};
use outline_files::{Outline, OutlineError};

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
    /// Perimeter of what the nodes of the method carry of the shape of a body (length); on a grid, and of walls and
    /// solids, of the shape itself.
    pub resolved_perimeter: f64,
    /// Centroid of the polygon (length), for a body with a centre relative to it.
    pub centroid: [f64; 2],
    /// Part of the period that the points of a line cover, before the line goes straight to the image of its first
    /// point; 1 for a closed outline.
    pub covered: f64,
}

/// Part of a period that two points at equal distances cover.
const COVERED: f64 = 0.5;
/// Difference of areas or perimeters over the value above which there is a remark.
const REMARKABLE: f64 = 0.02;

impl OutlineReport {
    /// Returns what a user should know of the shape: an area that differs from the polygon, and steps that the nodes
    /// do not carry.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let Self { key, points, area, polygon_area, perimeter, resolved_perimeter, covered, .. } = self;
        let mut remarks = Vec::new();
        if *covered < COVERED {
            remarks.push(format!(
                "{key}: the points of the line cover only {:.0} % of the length of the region, and a straight piece \
                 the rest. Set `scale` so that one period of the line fits, if you meant that",
                100.0 * covered
            ));
        }
        let off = area / polygon_area - 1.0;
        if off.abs() > REMARKABLE && *covered == 1.0 {
            let (percent, more) = (100.0 * off.abs(), if off > 0.0 { "larger" } else { "smaller" });
            remarks.push(format!(
                "{key}: the area of the smooth curve through its {points} points is {percent:.1} % {more} than the \
                 area of their polygon. Give more points, or set `rounding` if the sides are straight"
            ));
        }
        if *resolved_perimeter < (1.0 - REMARKABLE) * perimeter {
            remarks.push(format!(
                "{key}: the perimeter of the shape is {}, and the nodes carry {} of it. If the outline follows the \
                 steps of pixels, set `smooth` to the length of one or two pixels. Otherwise use more nodes",
                told(*perimeter),
                told(*resolved_perimeter)
            ));
        }
        remarks
    }
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
                let nodes = self.method.nodes();
                reports.push(outline.report(&key, OutlineOrigin::Centroid, nodes).map_err(|error| error.of(&key))?);
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
                    Some(given.report(&key, OutlineOrigin::File, None).map_err(|error| error.of(&key))?)
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
    /// Returns the report of a closed outline, of which so many nodes carry a part.
    fn report(&self, key: &str, usual: OutlineOrigin, nodes: Option<usize>) -> Result<OutlineReport, SetupError> {
        let prepared = self.prepared(None, usual)?;
        let curve = self.curve_through(&prepared.points)?;
        let mut samples: Vec<Vec2> = (0..SAMPLES).map(|k| curve.point(k as f64 / SAMPLES as f64)).collect();
        let report = report(key, &prepared.given, &samples, None);
        let perimeter = curve.perimeter();
        let mut resolved_perimeter = perimeter;
        if let Some(nodes) = nodes {
            let mut series = PeriodicSeries::new(SAMPLES).map_err(OutlineError::from)?;
            series.truncate_vectors(&mut samples, nodes).map_err(OutlineError::from)?;
            resolved_perimeter = polygon::edges(&samples).map(|(a, b)| a.distance(b)).sum();
        }
        Ok(OutlineReport { area: curve.area(), perimeter, resolved_perimeter, ..report })
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
        resolved_perimeter: perimeter,
        centroid: given.centroid.into(),
        covered: period.map_or(1.0, |period| covered(&given.points) / period),
    }
}

/// Returns the extent of points along x (length).
fn covered(points: &[Vec2]) -> f64 {
    let [low, high] = points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.x), b.max(p.x)]);
    high - low
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
