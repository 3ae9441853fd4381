//! Interiors: the solid that outlines enclose.

use motile_base::{Vec2, internal::at_least};
use motile_scene::gap::Boundary;

use crate::mesh::TriangleMesh;
use crate::mesher::segments::Segments;
use crate::{Mesher, Outline, SolidError};

/// Solid between outlines: a point is solid where a line upwards from it crosses an odd number of them. One closed
/// outline is a solid, a second one inside it a hole, one outside it another part; two periodic outlines, one above the
/// other, are a wall.
#[derive(Debug, Clone)]
pub struct Interior {
    outlines: Vec<Outline>,
    period: Option<f64>,
}

impl Interior {
    /// Creates a solid between `outlines`, which must not cross (this is checked when it is meshed).
    ///
    /// # Errors
    /// Returns an error if there is no outline, or for periodic outlines of different periods, or an odd number of them
    /// (there would be no end).
    pub fn new(outlines: impl IntoIterator<Item = Outline>) -> Result<Self, SolidError> {
        let outlines: Vec<Outline> = outlines.into_iter().collect();
        at_least("outlines", outlines.len(), 1)?;
        let mut periods = outlines.iter().filter_map(Outline::period);
        let period = periods.next();
        if let (Some(first), Some(second)) = (period, periods.find(|other| Some(*other) != period)) {
            return Err(SolidError::different_periods(first, second));
        }
        let periodic = outlines.iter().filter(|outline| outline.period().is_some()).count();
        if periodic % 2 == 1 {
            return Err(SolidError::open_region(periodic));
        }
        Ok(Self { outlines, period })
    }

    /// Returns the outlines of the solid.
    #[must_use]
    pub fn outlines(&self) -> &[Outline] {
        &self.outlines
    }

    /// Returns the period in x (length); `None` for closed outlines alone.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        self.period
    }

    /// Returns the boundary of the solid by points at about `spacing` (length), with the solid to the left of its
    /// sides: for distances from the solid before there is a mesh of it.
    ///
    /// # Errors
    /// Returns the errors of [`Outline::resampled`]; outlines that cross.
    pub fn boundary(&self, spacing: f64) -> Result<Boundary, SolidError> {
        let lines = self.outlines.iter().map(|outline| outline.resampled(spacing)).collect::<Result<Vec<_>, _>>()?;
        let periodic = self.outlines.iter().zip(&lines).find(|(outline, _)| outline.period().is_some());
        let start = periodic.map(|(outline, line)| (line[0].x, outline.period().unwrap_or_default()));
        let segments = Segments::uncrossed(&lines, start, 2.0 * spacing)?;
        let mut boundary = Boundary::default();
        for (outline, line) in self.outlines.iter().zip(&lines) {
            let around = Vec2::new(outline.period().unwrap_or(0.0), 0.0);
            let ends = line[1..].iter().copied().chain(std::iter::once(line[0] + around));
            let sides: Vec<[Vec2; 2]> = line.iter().copied().zip(ends).map(|(from, to)| [from, to]).collect();
            let [from, to] = sides[0];
            let mut beside = 0.5 * (from + to) + 1e-6 * (to - from).perp();
            beside.x -= start.map_or(0.0, |(start, period)| period * ((beside.x - start) / period).floor());
            let solid_left = segments.inside(beside);
            sides.iter().for_each(|&[a, b]| if solid_left { boundary.push(a, b) } else { boundary.push(b, a) });
        }
        boundary.sort();
        Ok(boundary)
    }

    /// Returns the solid with y reversed; the lower of two periodic outlines comes first again.
    ///
    /// # Errors
    /// None but the errors of [`Outline::mirrored`].
    pub(crate) fn mirrored(&self) -> Result<Self, SolidError> {
        let outlines = self.outlines.iter().rev().map(|outline| outline.mirrored(0.0));
        Self::new(outlines.collect::<Result<Vec<_>, _>>()?)
    }

    /// Returns the uniform mesh of spacing `spacing` (length), by [`Mesher`] with its defaults.
    ///
    /// # Errors
    /// Returns the errors of [`Mesher::mesh`].
    pub fn mesh(&self, spacing: f64) -> Result<TriangleMesh, SolidError> {
        Mesher::new(spacing)?.mesh(self)
    }
}

impl Outline {
    /// Returns the uniform mesh of spacing `spacing` (length) of the inside of a closed outline, by [`Mesher`] with its
    /// defaults.
    ///
    /// # Errors
    /// Returns the errors of [`Mesher::mesh`]; a periodic outline, which encloses nothing.
    pub fn mesh(&self, spacing: f64) -> Result<TriangleMesh, SolidError> {
        Interior::new([self.clone()])?.mesh(spacing)
    }
}
