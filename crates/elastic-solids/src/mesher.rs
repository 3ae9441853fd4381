//! Uniform meshes of any region.

use ib_core::Vec2;

use crate::error::{finite, positive, within};
use crate::lattice::ROW_HEIGHT;
use crate::relaxation::relax;
use crate::segments::Segments;
use crate::triangulation::{PointSet, refine};
use crate::{Region, SolidError, TriangleMesh};

/// Makes uniform triangle meshes.
///
/// The outlines are resampled at equal spacing, corners kept; the inside is seeded with a lattice of equilateral
/// triangles, no closer to the boundary than 0.45 spacings; the constrained Delaunay triangulation of all these points
/// is relaxed, sweep after sweep, until the edges have about equal length. The two ends of a periodic wall share their
/// points, and its spacing is changed by up to 5 per cent so that the lattice fits its height: a lattice stretched
/// across the wall would be anisotropic, for springs by as much as the stretch.
///
/// ```
/// use elastic_solids::*;
/// use ib_core::Vec2;
///
/// let disc = Outline::circle(Vec2::zeros(), 1.0)?.mesh(0.1)?;
/// println!("{}", disc.quality());
/// assert!(disc.quality().smallest_angle > 30.0);
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mesher {
    spacing: f64,
    method: Method,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    Relaxed { sweeps: usize, angle: f64 },
    Refined,
}

/// How the lattice of the seeds is laid.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fit {
    /// Stretched a little, so that whole rows and columns fill the bounding box.
    ToBox,
    Equilateral,
}

/// Distance of the seeds from the boundary over the spacing. At about half the height of a row the seeds next to the
/// boundary stand, on average, one row away from it; a larger distance leaves too few of them, which relaxation makes
/// up for by stretching all triangles across a wall.
const MARGIN: f64 = 0.45;

/// Sweeps of the default.
const SWEEPS: usize = 120;

/// Length of boundary, in spacings, beyond which two nearby parts of it are the two sides of a wall, not of a corner.
const ACROSS: usize = 6;

/// Largest change of the spacing, over itself, that makes rows of triangles fit a wall.
const LARGEST_FIT: f64 = 0.05;

/// Most points of a mesh.
const MOST_POINTS: f64 = 1e7;

impl Mesher {
    /// Edges of length `spacing` (length).
    ///
    /// # Errors
    /// A spacing that is not positive and finite.
    pub fn new(spacing: f64) -> Result<Self, SolidError> {
        Ok(Self {
            spacing: positive("the mesh spacing", spacing)?,
            method: Method::Relaxed { sweeps: SWEEPS, angle: 0.0 },
        })
    }

    /// The same with another number of relaxation sweeps (120 otherwise; 0 to leave the seeds where they are).
    #[must_use]
    pub fn sweeps(mut self, sweeps: usize) -> Self {
        self.method = Method::Relaxed { sweeps, angle: self.angle() };
        self
    }

    /// The same with the lattice of the seeds turned by `angle` (radians, 0 otherwise): a mesh of a straight wall that
    /// is not a lattice itself, to see what the mesh does to a result.
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn turned(mut self, angle: f64) -> Result<Self, SolidError> {
        let sweeps = if let Method::Relaxed { sweeps, .. } = self.method { sweeps } else { SWEEPS };
        self.method = Method::Relaxed { sweeps, angle: finite("the angle of the seeds", angle)? };
        Ok(self)
    }

    fn angle(&self) -> f64 {
        if let Method::Relaxed { angle, .. } = self.method { angle } else { 0.0 }
    }

    /// The same by Delaunay refinement instead of seeds and relaxation: for odd shapes. Its edges are much less even.
    /// Not for periodic regions.
    #[must_use]
    pub fn refinement(mut self) -> Self {
        self.method = Method::Refined;
        self
    }

    /// Meshes a region.
    ///
    /// # Errors
    /// Outlines that cross or touch; a hole or part narrower than the spacing; a wall thinner than the spacing; a
    /// period shorter than six spacings; more than 1e7 points; a triangulation that failed.
    pub fn mesh(&self, region: &Region) -> Result<TriangleMesh, SolidError> {
        let boundary = Boundary::new(region, self.spacing, matches!(self.method, Method::Relaxed { angle: 0.0, .. }))?;
        let mesh = match self.method {
            Method::Refined if region.period().is_some() => Err(SolidError::Unsupported {
                what: "refining a periodic region",
                remedy: "mesh it by relaxation, the default",
            })?,
            Method::Refined => {
                let (points, triangles) = refine(&boundary.point_set(Vec::new()), self.spacing)?;
                TriangleMesh::new(points, triangles)?
            }
            Method::Relaxed { sweeps, angle } => {
                // Around a closed outline a lattice stretched to fit its box is sometimes better, sometimes worse than one
                // of equilateral triangles.
                let ways: &[Fit] = match boundary.period {
                    Some(_) if angle == 0.0 => &[Fit::ToBox],
                    None if angle == 0.0 => &[Fit::ToBox, Fit::Equilateral],
                    _ => &[Fit::Equilateral],
                };
                let meshes: Vec<TriangleMesh> =
                    ways.iter().map(|&fit| boundary.relaxed(fit, angle, sweeps)).collect::<Result<_, _>>()?;
                let best = meshes.into_iter().min_by(|a, b| {
                    let deviation = |mesh: &TriangleMesh| mesh.quality().edge_deviation;
                    deviation(a).total_cmp(&deviation(b))
                });
                best.ok_or(SolidError::MeshingFailed { what: "there is no way to lay the seeds" })?
            }
        };
        // The mesh has the boundary that was asked for, no triangle is missing or too many.
        let found: usize = mesh.boundary_loops().iter().map(|boundary| boundary.points.len()).sum();
        let expected: usize = boundary.outlines.iter().map(Vec::len).sum();
        if found != expected {
            return Err(SolidError::MeshingFailed { what: "the boundary is not that of the outlines" });
        }
        Ok(mesh)
    }
}

/// The checked boundary of a region at the spacing of its mesh.
struct Boundary {
    spacing: f64,
    outlines: Vec<Vec<Vec2>>,
    segments: Segments,
    period: Option<(f64, f64)>,
    low: Vec2,
    high: Vec2,
}

impl Boundary {
    /// `fitted` where the seeds of a wall are to be a lattice between its surfaces.
    fn new(region: &Region, asked: f64, fitted: bool) -> Result<Self, SolidError> {
        let mut spacing = asked;
        if let Some(period) = region.period() {
            within("the period over the mesh spacing", period / spacing, 6.0, MOST_POINTS)?;
        }
        for outline in region.outlines() {
            // Finer samples are taken below, and the inside has many more points.
            within(
                "the length of an outline over the mesh spacing",
                outline.length() / spacing,
                0.0,
                0.1 * MOST_POINTS,
            )?;
        }
        let resampled = |spacing: f64| {
            region.outlines().iter().map(|outline| outline.resampled(spacing)).collect::<Result<Vec<_>, _>>()
        };
        let mut outlines = resampled(spacing)?;
        let (low, high) = bounds(&outlines);
        if region.period().is_some() && fitted {
            // Triangles that fit the height of the wall without being stretched.
            let fit = (high.y - low.y) / (rows(high.y - low.y, asked) * ROW_HEIGHT);
            if (fit / asked - 1.0).abs() < LARGEST_FIT {
                spacing = fit;
                outlines = resampled(spacing)?;
            }
        }
        let start = region.outlines().iter().position(|outline| outline.period().is_some());
        let period = start.zip(region.period()).map(|(outline, period)| (outlines[outline][0].x, period));
        if period.is_some() {
            // Every second row of the seeds stands half a spacing further right; let flat surfaces continue that
            // lattice.
            let rows = rows(high.y - low.y, spacing);
            for (points, outline) in outlines.iter_mut().zip(region.outlines()) {
                let row = (rows * (points[0].y - low.y) / (high.y - low.y)).round();
                if row % 2.0 == 1.0 && outline.period().is_some() {
                    *points = outline.resampled_from(spacing, 0.5)?;
                }
            }
        }
        // The outlines themselves must not cross, nor the polygons that stand for them.
        for lines in [&resampled(0.25 * spacing)?, &outlines] {
            if let Some(place) = Segments::new(lines, period, 2.0 * spacing).first_crossing() {
                return Err(SolidError::Crossing { x: place.x, y: place.y });
            }
        }
        let segments = Segments::new(&outlines, period, 10.0 * spacing);
        let boundary = Self { spacing, outlines, segments, period, low, high };
        boundary.check_widths(region, asked)?;
        boundary.check_walls(asked)?;
        Ok(boundary)
    }

    /// The image of a point in the first period.
    fn home(&self, point: Vec2) -> Vec2 {
        let periods = self.period.map_or(0.0, |(start, period)| period * ((point.x - start) / period).floor());
        point - Vec2::new(periods, 0.0)
    }

    /// No closed outline narrower than the spacing.
    fn check_widths(&self, region: &Region, spacing: f64) -> Result<(), SolidError> {
        for (number, (outline, points)) in region.outlines().iter().zip(&self.outlines).enumerate() {
            if outline.period().is_some() {
                continue;
            }
            let width = width(&outline.resampled(0.1 * spacing)?);
            if width < spacing {
                let [x, y] = points[0].into();
                return Err(if self.segments.crossings_above(self.home(points[0]), Some(number)) % 2 == 1 {
                    SolidError::HoleTooSmall { x, y, width, spacing }
                } else {
                    SolidError::WallTooThin { x, y, thickness: width, spacing }
                });
            }
        }
        Ok(())
    }

    /// No two sides of a wall closer than the spacing.
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
                    let thickness = (foot - point).norm();
                    return Err(SolidError::WallTooThin { x: point.x, y: point.y, thickness, spacing });
                }
            }
        }
        Ok(())
    }

    /// The mesh after relaxation.
    fn relaxed(&self, fit: Fit, angle: f64, sweeps: usize) -> Result<TriangleMesh, SolidError> {
        let mut set = self.point_set(self.seeds(fit, angle)?);
        let triangles = relax(&mut set, sweeps, self.spacing)?;
        match set.period {
            None => TriangleMesh::new(set.points, triangles),
            Some((_, period)) => TriangleMesh::periodic(set.points, triangles, period),
        }
    }

    /// A lattice inside, of equilateral triangles turned by an angle, or of nearly equilateral ones that fit the bounding
    /// box.
    fn seeds(&self, fit: Fit, angle: f64) -> Result<Vec<Vec2>, SolidError> {
        let spacing = self.spacing;
        let size = self.high - self.low;
        let (start, width) = self.period.unwrap_or((self.low.x, size.x));
        let mut columns = (width / spacing).round().max(1.0);
        let mut rows = rows(size.y, spacing);
        within("the number of points in the bounding box", columns * rows, 1.0, MOST_POINTS)?;
        let mut step = Vec2::new(width / columns, size.y / rows);
        let corner = Vec2::new(start, self.low.y);
        let (rotation, centre) = (nalgebra::Rotation2::new(angle), corner + 0.5 * Vec2::new(width, size.y));
        let mut first = corner;
        if fit == Fit::Equilateral {
            step = Vec2::new(spacing, ROW_HEIGHT * spacing);
            // A square of lattice that covers the box however it is turned.
            let reach = 0.5 * width.hypot(size.y);
            first = centre - Vec2::repeat(reach);
            (columns, rows) = ((2.0 * reach / step.x).ceil(), (2.0 * reach / step.y).ceil());
        }
        let mut seeds = Vec::new();
        for row in 0..=rows as usize {
            for column in 0..=columns as usize {
                let shift = 0.5 * (row % 2) as f64;
                let seed = first + Vec2::new((column as f64 + shift) * step.x, row as f64 * step.y);
                let seed = if fit == Fit::ToBox { seed } else { centre + rotation * (seed - centre) };
                // The last column of a periodic region is the first of the next.
                let end = 1e-9 * step.x;
                let repeated = self.period.is_some() && !(start - end..start + width - end).contains(&seed.x);
                if !repeated
                    && self.segments.inside(seed)
                    && self.segments.nearest(seed, MARGIN * spacing, |_| true).is_none()
                {
                    seeds.push(seed);
                }
            }
        }
        if self.period.is_some() && fit == Fit::Equilateral {
            // The turned lattice does not meet itself at the seam.
            let margin = MARGIN * spacing;
            let left: Vec<Vec2> =
                seeds.iter().filter(|s| s.x < start + margin).map(|s| s + Vec2::new(width, 0.0)).collect();
            seeds.retain(|s| s.x < start + width - margin || left.iter().all(|other| (other - s).norm() > margin));
        }
        Ok(seeds)
    }

    fn point_set(&self, seeds: Vec<Vec2>) -> PointSet<'_> {
        let mut points: Vec<Vec2> = Vec::new();
        let mut boundary = Vec::new();
        for outline in &self.outlines {
            let start = points.len();
            boundary.extend((0..outline.len()).map(|k| [start + k, start + (k + 1) % outline.len()]));
            points.extend(outline);
        }
        let fixed = points.len();
        points.extend(seeds);
        PointSet { points, fixed, boundary, segments: &self.segments, period: self.period }
    }
}

fn bounds(outlines: &[Vec<Vec2>]) -> (Vec2, Vec2) {
    let first = outlines[0][0];
    outlines.iter().flatten().fold((first, first), |(low, high), point| (low.inf(point), high.sup(point)))
}

/// Rows of seeds over a height.
fn rows(height: f64, spacing: f64) -> f64 {
    (height / (ROW_HEIGHT * spacing)).round().max(1.0)
}

/// The smallest distance between two parallel lines that hold the points between them, over 90 directions.
fn width(points: &[Vec2]) -> f64 {
    (0..90)
        .map(|degrees| {
            let direction = nalgebra::Rotation2::new(f64::from(2 * degrees).to_radians()) * Vec2::x();
            let along = points.iter().map(|point| point.dot(&direction));
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
            high - low
        })
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests;
