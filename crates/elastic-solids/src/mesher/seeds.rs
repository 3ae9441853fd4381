//! Seeds: lattices of inner points from which a mesh is relaxed.

use motile_base::{Vec2, within};

use crate::SolidError;
use crate::error::MOST_POINTS;
use crate::mesh::lattice::ROW_HEIGHT;
use crate::mesher::boundary::{Boundary, rows};

/// Shape and position of a lattice inside a boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lay {
    pub(crate) fit: Fit,
    /// Angle by which a lattice of equilateral triangles is turned (radians).
    pub(crate) angle: f64,
    /// Displacement of the lattice in units of columns and rows.
    pub(crate) offset: [f64; 2],
    /// Minimum distance from the boundary over the spacing.
    pub(crate) margin: f64,
}

/// The shape of a lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fit {
    /// Triangles stretched a little, so that whole rows and columns fill the bounding box.
    ToBox,
    /// Equilateral triangles.
    Equilateral,
}

impl Boundary<'_> {
    /// Returns the points of a lattice that lie inside the solid.
    pub(crate) fn seeds(&self, lay: Lay) -> Result<Vec<Vec2>, SolidError> {
        let spacing = self.spacing;
        let margin = lay.margin * spacing;
        let size = self.high - self.low;
        let (start, width) = self.period.unwrap_or((self.low.x, size.x));
        let mut columns = (width / spacing).round().max(1.0);
        let mut rows = rows(size.y, spacing);
        within("the number of points in the bounding box", columns * rows, 1.0, MOST_POINTS)?;
        let mut step = Vec2::new(width / columns, size.y / rows);
        let corner = Vec2::new(start, self.low.y);
        let (rotation, centre) = (Vec2::from_angle(lay.angle), corner + 0.5 * Vec2::new(width, size.y));
        let mut first = corner;
        if lay.fit == Fit::Equilateral {
            step = Vec2::new(spacing, ROW_HEIGHT * spacing);
            // A square of lattice that covers the box however it is turned.
            let reach = 0.5 * width.hypot(size.y);
            first = centre - Vec2::splat(reach);
            (columns, rows) = ((2.0 * reach / step.x).ceil(), (2.0 * reach / step.y).ceil());
            let most = 100.0 * MOST_POINTS;
            within("the number of points in the square about the bounding box", columns * rows, 1.0, most)?;
        }
        first += Vec2::new(lay.offset[0] * step.x, lay.offset[1] * step.y);
        let mut seeds = Vec::new();
        for row in 0..=rows as usize {
            for column in 0..=columns as usize {
                let shift = 0.5 * (row % 2) as f64;
                let seed = first + Vec2::new((column as f64 + shift) * step.x, row as f64 * step.y);
                let seed = if lay.fit == Fit::ToBox { seed } else { centre + rotation.rotate(seed - centre) };
                // The last column of a periodic region is the first of the next.
                let end = 1e-9 * step.x;
                let repeated = self.period.is_some() && !(start - end..start + width - end).contains(&seed.x);
                if !repeated && self.segments.inside(seed) && self.segments.nearest(seed, margin, |_| true).is_none() {
                    seeds.push(seed);
                }
            }
        }
        if self.period.is_some() && lay.fit == Fit::Equilateral {
            // The turned lattice does not meet itself at the seam.
            let left: Vec<Vec2> =
                seeds.iter().filter(|s| s.x < start + margin).map(|s| s + Vec2::new(width, 0.0)).collect();
            seeds.retain(|s| s.x < start + width - margin || left.iter().all(|other| (other - s).length() > margin));
        }
        Ok(seeds)
    }
}
