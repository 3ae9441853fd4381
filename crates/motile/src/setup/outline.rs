//! Outlines from files and points.

mod report;
mod source;

pub use report::OutlineReport;

use active_interface::Curve;
use motile_base::Vec2;
use outline_files::{Outline, OutlineError};
use serde::{Deserialize, Serialize};

use super::checked::Checked;
use crate::SetupError;

/// Most points of an outline.
const MOST_POINTS: usize = 1_000_000;

/// An outline from a file or from points: the contour of a cell that was traced in a picture, a polygon that was
/// clicked by hand, the sides of a channel that were drawn.
///
/// Files are tables of points (CSV, also `.vertex` files), SVG, GeoJSON or regions of interest of ImageJ (`.roi`); the
/// format is found from the contents. The direction of the points does not matter, and a last point that repeats the
/// first is left out. [`Setup::outlines`](super::Setup::outlines) reports by how much area, perimeter and place of the
/// shape differ from the polygon through the points.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::{DropletShape, OutlineSetup};
///
/// // A square of 20 x 20 um that was clicked, with corners rounded by 4 um, in units of 10 um.
/// let points = vec![[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]];
/// let outline = OutlineSetup { scale: 0.1, rounding: Some(0.4), ..OutlineSetup::of_points(points) };
/// let droplet = DropletSetup { shape: DropletShape::Outline(outline), ..DropletSetup::passive(10.0) };
/// let setup = Setup { droplets: vec![droplet], ..Setup::default() };
/// let report = &setup.outlines()?[0];
/// let exact = 4.0 - (4.0 - std::f64::consts::PI) * 0.16;
/// println!("area {:.4} of {:.4}", report.area, report.polygon_area); // area 3.8627 of 4.0000
/// assert!((report.area - exact).abs() < 1e-12);
/// # Ok::<(), motile::SetupError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("contour", "segmentation", "csv", "svg", "geojson", "roi", "vertex"))]
pub struct OutlineSetup {
    /// Path of the file, in a scene file relative to it. When the scene is read, the points of the file take its place
    /// ([`Setup::with_files`](super::Setup::with_files)), so that a description does not depend on files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Name of the outline in a file of several; `None` for the only one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Number of the outline in a file of several, from 0; `None` for the only one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub index: Option<usize>,
    /// The points instead of a file, in any unit.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 2]>,
    /// Length of the unit of the points, such as the side of a pixel (length).
    pub scale: f64,
    /// If true, y runs downwards in the file, as in pictures; `None` for true in SVG files, regions of ImageJ
    /// and QuPath, and tables of rows and columns, and false otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flip: Option<bool>,
    /// Place of the file that comes to lie in `place`; `None` for the centroid where a body has a centre, and for the
    /// origin of the file otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub origin: Option<OutlineOrigin>,
    /// Where `origin` comes to lie (length), relative to the centre of a body that has one.
    pub place: [f64; 2],
    /// Distance by which a smooth curve may pass the points (length): one or two pixels for an outline that was traced
    /// in a picture. It is the smoothest curve within this distance, and it keeps the area. `None` for a curve through
    /// the points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smooth: Option<f64>,
    /// Radius of the arcs in place of the corners, between straight sides (length); 0 for sharp corners of solids and
    /// walls. `None` for a smooth curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rounding: Option<f64>,
}

/// Place of a file that comes to lie in a place of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum OutlineOrigin {
    /// The centroid of the area of the outline, of a line the middle of its extent.
    Centroid,
    /// The origin of the file.
    File,
    /// A point of the file, in its unit.
    Point([f64; 2]),
}

impl Default for OutlineSetup {
    /// Creates an outline of no points.
    fn default() -> Self {
        Self {
            file: None,
            name: None,
            index: None,
            points: Vec::new(),
            scale: 1.0,
            flip: None,
            origin: None,
            place: [0.0; 2],
            smooth: None,
            rounding: None,
        }
    }
}

/// Points of an outline in their place, ready for a curve.
pub(super) struct Prepared {
    /// The polygon as it was given (length).
    pub(super) given: Outline,
    /// Points of the curve: the corners of the polygon, or fewer of a smooth one (length).
    pub(super) points: Vec<Vec2>,
}

impl OutlineSetup {
    /// Creates the outline of a file, whose unit is the unit of the scene.
    #[must_use]
    pub fn of_file(file: impl Into<String>) -> Self {
        Self { file: Some(file.into()), ..Self::default() }
    }

    /// Creates the outline through points (length).
    #[must_use]
    pub fn of_points(points: Vec<[f64; 2]>) -> Self {
        Self { points, ..Self::default() }
    }

    /// Returns the points in their place: of a closed outline, or of a line that repeats itself with a period (length).
    pub(super) fn prepared(&self, period: Option<f64>, usual: OutlineOrigin) -> Result<Prepared, SetupError> {
        let source = self.source()?;
        source.check(period.is_some())?;
        let up = if self.flip.unwrap_or(source.y_runs_down) { -1.0 } else { 1.0 };
        let scaled = |[x, y]: [f64; 2]| Vec2::new(x, up * y) * self.scale;
        let points: Vec<Vec2> = source.points.iter().copied().map(scaled).collect();
        let (mut given, mut points) = match (self.smooth, period) {
            (Some(distance), _) => {
                let given = outline_files::touching(&points, period)?;
                let smoothed = outline_files::smooth(&points, period, distance)?;
                (given, smoothed.points)
            }
            (None, None) => {
                let given = outline_files::closed(&points)?;
                (given.clone(), given.points)
            }
            (None, Some(period)) => {
                let given = outline_files::line(&points, period)?;
                (given.clone(), given.points)
            }
        };
        let from = match self.origin.unwrap_or(usual) {
            // Of the curve, which may bulge beyond the polygon more on one side than on the other.
            OutlineOrigin::Centroid if period.is_none() => centroid(&self.curve_through(&points)?),
            OutlineOrigin::Centroid => given.centroid,
            OutlineOrigin::File => Vec2::ZERO,
            OutlineOrigin::Point(point) => scaled(point),
        };
        let shift = Vec2::from(self.place) - from;
        given.points.iter_mut().chain(&mut points).for_each(|point| *point += shift);
        given.centroid += shift;
        Ok(Prepared { given, points })
    }

    /// Returns the closed curve of the outline about the centre of a body.
    pub(super) fn curve(&self, usual: OutlineOrigin) -> Result<Curve, SetupError> {
        self.curve_through(&self.prepared(None, usual)?.points)
    }

    /// Returns the curve through points that are in their place.
    fn curve_through(&self, points: &[Vec2]) -> Result<Curve, SetupError> {
        Ok(match self.rounding {
            None => Curve::through_points(points)?,
            Some(0.0) => Curve::polygon(points)?,
            Some(radius) => Curve::rounded_polygon(points, radius)?,
        })
    }

    /// Refuses numbers out of their range, and keys that exclude one another; `sharp` where corners may be sharp.
    pub(super) fn check(&self, checked: &Checked<'_>, at: &str, sharp: bool) -> Result<(), SetupError> {
        let key = |name: &str| format!("{at}.{name}");
        let remedy = "an outline has either a file or points. Give one of them";
        let both = self.file.is_some() && !self.points.is_empty();
        checked.refuse_if(both, &key("file"), "given with points", remedy)?;
        let neither = self.file.is_none() && self.points.is_empty();
        checked.refuse_if(neither, &key("file"), "not given", remedy)?;
        let choice = self.name.is_some() || self.index.is_some();
        let remedy = "name and index choose one of the outlines of a file. Remove the key";
        checked.refuse_if(choice && self.file.is_none(), &key("index"), "given with points", remedy)?;
        let remedy = "an outline is chosen by its name or by its index. Give one of them";
        checked.refuse_if(self.name.is_some() && self.index.is_some(), &key("index"), "given with a name", remedy)?;
        let remedy = format!("use at most {MOST_POINTS} points");
        let wrong = self.points.len() > MOST_POINTS;
        checked.refuse_if(wrong, &key("points"), format!("{} points", self.points.len()), remedy)?;
        checked.positive(&key("scale"), self.scale)?;
        checked.all_finite(&key("place"), &self.place)?;
        checked.positive(&key("smooth"), self.smooth)?;
        if let Some(OutlineOrigin::Point(point)) = self.origin {
            checked.all_finite(&key("origin.point"), &point)?;
        }
        let Some(radius) = self.rounding else { return Ok(()) };
        if sharp {
            checked.not_negative(&key("rounding"), radius)?;
        } else {
            checked.positive(&key("rounding"), radius)?;
        }
        let remedy = "a smooth outline has no corners to round. Remove one of the two keys";
        checked.refuse_if(self.smooth.is_some(), &key("rounding"), "given with smooth", remedy)
    }
}

/// Points of a file or a description.
struct Source {
    points: Vec<[f64; 2]>,
    /// False for what a file says is an open line; `None` for points that may be either.
    closed: Option<bool>,
    y_runs_down: bool,
}

impl Source {
    /// Refuses a line where a closed outline is needed, and the other way round.
    fn check(&self, line: bool) -> Result<(), OutlineError> {
        let what = match (self.closed, line) {
            (Some(false), false) => Some((
                "this outline is an open line in the file, but a body needs a closed one",
                "Close it in the program that wrote it",
            )),
            (Some(true), true) => Some((
                "this outline is closed in the file, but this needs a line from one end of the region to the other",
                "Draw an open line, or use a closed outline as a body",
            )),
            _ => None,
        };
        what.map_or(Ok(()), |(what, remedy)| Err(OutlineError::Kind { what, remedy }))
    }
}

/// Samples of a curve whose centroid is taken.
const CENTRED: usize = 4096;

/// Returns the centroid of what a curve encloses (length).
fn centroid(curve: &Curve) -> Vec2 {
    let samples: Vec<Vec2> = (0..CENTRED).map(|k| curve.point(k as f64 / CENTRED as f64)).collect();
    samples[0] + motile_base::polygon::area_and_arm(&samples).1
}

#[cfg(test)]
mod tests;
