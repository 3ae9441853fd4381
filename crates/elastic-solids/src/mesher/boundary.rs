//! Boundary of an interior, sampled at the spacing of its mesh and checked.

use motile_base::{Vec2, within};

use crate::error::MOST_POINTS;
use crate::mesh::lattice::ROW_HEIGHT;
use crate::mesher::point_set::PointSet;
use crate::mesher::segments::Segments;
use crate::outline::{Place, Track};
use crate::{Interior, Outline, SolidError};

/// Length of boundary, in spacings, beyond which two nearby parts of it are the two sides of a wall, not of a corner.
const ACROSS: usize = 6;

/// Largest change of the spacing, over itself, that makes rows of triangles fit a wall.
const LARGEST_FIT: f64 = 0.05;

/// Points on the outlines of an interior that make a boundary which can be meshed.
#[derive(Debug)]
pub(crate) struct Boundary<'a> {
    pub(crate) spacing: f64,
    pub(crate) segments: Segments,
    /// Start and period in x (length).
    pub(crate) period: Option<(f64, f64)>,
    /// Corners of the bounding box.
    pub(crate) low: Vec2,
    pub(crate) high: Vec2,
    tracks: Vec<Track<'a>>,
    /// Points of each outline, as places on it and as positions (length).
    places: Vec<Vec<Place>>,
    outlines: Vec<Vec<Vec2>>,
}

impl<'a> Boundary<'a> {
    /// Creates a boundary at about the spacing `asked` (length); with `fitted`, the spacing is changed a little so that
    /// the seeds of a wall are a lattice between its surfaces.
    pub(crate) fn new(interior: &'a Interior, asked: f64, fitted: bool) -> Result<Self, SolidError> {
        let mut spacing = asked;
        if let Some(period) = interior.period() {
            within("the period over the mesh spacing", period / spacing, 6.0, MOST_POINTS)?;
        }
        // Finer samples are taken below, and the inside has many more points.
        let length: f64 = interior.outlines().iter().map(Outline::length).sum();
        within("the length of the outlines over the mesh spacing", length / spacing, 0.0, 0.1 * MOST_POINTS)?;
        let tracks: Vec<Track<'a>> = interior.outlines().iter().map(Track::new).collect();
        let places = |spacing: f64| tracks.iter().map(|track| track.places(spacing, 0.0)).collect::<Vec<_>>();
        let points = |places: &[Vec<Place>]| {
            let of = |(track, places): (&Track<'_>, &Vec<Place>)| places.iter().map(|&place| track.at(place)).collect();
            tracks.iter().zip(places).map(of).collect::<Vec<Vec<Vec2>>>()
        };
        let mut sampled = places(spacing);
        let mut outlines = points(&sampled);
        let (low, high) = bounds(&outlines);
        if interior.period().is_some() && fitted {
            // Triangles that fit the height of the wall without being stretched.
            let fit = (high.y - low.y) / (rows(high.y - low.y, asked) * ROW_HEIGHT);
            if (fit / asked - 1.0).abs() < LARGEST_FIT {
                spacing = fit;
                sampled = places(spacing);
                outlines = points(&sampled);
            }
        }
        let start = interior.outlines().iter().position(|outline| outline.period().is_some());
        let period = start.zip(interior.period()).map(|(outline, period)| (outlines[outline][0].x, period));
        if period.is_some() {
            // Every second row of the seeds stands half a spacing further right; let flat surfaces continue that
            // lattice.
            let rows = rows(high.y - low.y, spacing);
            for (k, outline) in interior.outlines().iter().enumerate() {
                let row = (rows * (outlines[k][0].y - low.y) / (high.y - low.y)).round();
                if row % 2.0 == 1.0 && outline.period().is_some() {
                    sampled[k] = tracks[k].places(spacing, 0.5);
                }
            }
            outlines = points(&sampled);
        }
        // The outlines themselves must not cross, nor the polygons that stand for them.
        for lines in [&points(&places(0.25 * spacing)), &outlines] {
            Segments::uncrossed(lines, period, 2.0 * spacing)?;
        }
        let segments = Segments::new(&outlines, period, 10.0 * spacing);
        let boundary = Self { spacing, places: sampled, tracks, outlines, segments, period, low, high };
        boundary.check_widths(interior, asked)?;
        boundary.check_walls(asked)?;
        Ok(boundary)
    }

    /// Returns the image of a point in the first period.
    fn home(&self, point: Vec2) -> Vec2 {
        let periods = self.period.map_or(0.0, |(start, period)| period * ((point.x - start) / period).floor());
        point - Vec2::new(periods, 0.0)
    }

    /// Checks that no closed outline is narrower than the spacing.
    fn check_widths(&self, interior: &Interior, spacing: f64) -> Result<(), SolidError> {
        for (number, (outline, points)) in interior.outlines().iter().zip(&self.outlines).enumerate() {
            if outline.period().is_some() {
                continue;
            }
            let width = width(&outline.resampled(0.1 * spacing)?);
            if width < spacing {
                let place = points[0];
                return Err(if self.segments.crossings_above(self.home(place), Some(number)) % 2 == 1 {
                    SolidError::hole_too_small(place, width, spacing)
                } else {
                    SolidError::wall_too_thin(place, width, spacing)
                });
            }
        }
        Ok(())
    }

    /// Checks that no two sides of a wall are closer than the spacing.
    fn check_walls(&self, spacing: f64) -> Result<(), SolidError> {
        let reach = spacing * (1.0 - 1e-6);
        for (outline, points) in self.outlines.iter().enumerate() {
            for (index, &point) in points.iter().enumerate() {
                let point = self.home(point);
                let across = self.segments.nearest(point, reach, |other| {
                    let far = other.outline != outline
                        || self.segments.separation(outline, index, other.index).min(self.segments.separation(
                            outline,
                            index,
                            (other.index + 1) % points.len(),
                        )) > ACROSS;
                    far && self.segments.inside((point + (other.from + other.to) * 0.5) * 0.5)
                });
                if let Some(foot) = across {
                    let thickness = (foot - point).length();
                    return Err(SolidError::wall_too_thin(point, thickness, spacing));
                }
            }
        }
        Ok(())
    }

    /// Returns the number of boundary points.
    pub(crate) fn count(&self) -> usize {
        self.outlines.iter().map(Vec::len).sum()
    }

    /// Returns the point set of the boundary points and the `seeds` inside.
    pub(crate) fn point_set(&self, seeds: Vec<Vec2>) -> PointSet<'_> {
        let mut points: Vec<Vec2> = Vec::new();
        let mut boundary = Vec::new();
        for outline in &self.outlines {
            let start = points.len();
            boundary.extend((0..outline.len()).map(|k| [start + k, start + (k + 1) % outline.len()]));
            points.extend(outline);
        }
        let on_boundary = points.len();
        points.extend(seeds);
        PointSet {
            points,
            on_boundary,
            boundary,
            segments: self.segments.clone(),
            tracks: &self.tracks,
            places: self.places.clone(),
            period: self.period,
        }
    }
}

fn bounds(outlines: &[Vec<Vec2>]) -> (Vec2, Vec2) {
    let first = outlines[0][0];
    outlines.iter().flatten().fold((first, first), |(low, high), point| (low.min(*point), high.max(*point)))
}

/// Returns the number of rows of seeds over a height (length) at a spacing (length).
pub(crate) fn rows(height: f64, spacing: f64) -> f64 {
    (height / (ROW_HEIGHT * spacing)).round().max(1.0)
}

/// Returns the smallest distance between two parallel lines with all points between them, over 90 directions (length).
fn width(points: &[Vec2]) -> f64 {
    (0..90)
        .map(|degrees| {
            let direction = Vec2::from_angle(f64::from(2 * degrees).to_radians());
            let along = points.iter().map(|point| point.dot(direction));
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
            high - low
        })
        .fold(f64::INFINITY, f64::min)
}
