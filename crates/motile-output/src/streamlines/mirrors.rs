//! Mirror lines of flows.

use crate::{Raster, Samples};
use motile::base::Vec2;

/// Largest difference of a flow from its mirror image, relative to the flow (root mean square of the samples).
const DIFFERENCE: f64 = 5e-3;
/// Distance from a mirror line within which a point is on it, in spacings of streamlines.
const ON: f64 = 1e-3;

/// Mirror lines of a flow: at most one upright and one level.
#[derive(Debug, Clone)]
pub(crate) struct Mirrors {
    raster: Raster,
    /// Place of the mirror line across each direction, if there is one.
    pub(crate) at: [Option<f64>; 2],
    spacing: f64,
}

impl Mirrors {
    /// Creates mirror lines through a point or the middle of the raster; in a direction that is not periodic only the
    /// middle can be one.
    pub(crate) fn of(field: &Samples<Vec2>, through: Vec2, spacing: f64) -> Self {
        let raster = field.raster;
        let at = [0, 1].map(|k| {
            let middle = raster.origin[k] + 0.5 * raster.size[k];
            let point = Some(through[k]).filter(|p| raster.periodic[k] || (p - middle).abs() < ON * spacing);
            point.into_iter().chain([middle]).find(|&at| is_mirrored(field, k, at))
        });
        Self { raster, at, spacing }
    }

    /// Returns the distance ahead of the mirror line across a direction, at most half a period either way, for a place
    /// with one.
    fn offset(&self, p: Vec2, k: usize) -> Option<f64> {
        let offset = p[k] - self.at[k]?;
        let period = self.raster.size[k];
        Some(if self.raster.periodic[k] { offset - period * (offset / period).round() } else { offset })
    }

    /// Returns the distance of a point from its image in the mirror line across a direction.
    fn gap(&self, p: Vec2, k: usize) -> Option<f64> {
        let offset = self.offset(p, k)?.abs();
        // Half a period away is a mirror line as well.
        let other = if self.raster.periodic[k] { 0.5 * self.raster.size[k] - offset } else { f64::INFINITY };
        Some(2.0 * offset.min(other))
    }

    /// Returns true for points on a mirror line across a direction.
    fn is_on(&self, p: Vec2, k: usize) -> bool {
        self.gap(p, k).is_some_and(|gap| gap < 2.0 * ON * self.spacing)
    }

    /// Returns true for points ahead of all mirror lines or on them: lines elsewhere are images.
    pub(crate) fn is_ahead(&self, p: Vec2) -> bool {
        (0..2).all(|k| self.offset(p, k).is_none_or(|offset| offset > 0.0) || self.is_on(p, k))
    }

    /// Returns true for points nearer to one of their images than a distance, those on a mirror line apart.
    pub(crate) fn is_near_image(&self, p: Vec2, distance: f64) -> bool {
        (0..2).any(|k| !self.is_on(p, k) && self.gap(p, k).is_some_and(|gap| gap < distance))
    }

    /// Returns the step that leads along the mirror line if it starts on one.
    pub(crate) fn along(&self, from: Vec2, mut to: Vec2) -> Vec2 {
        (0..2).filter(|&k| self.is_on(from, k)).for_each(|k| to[k] = from[k]);
        to
    }

    /// Returns the images of a line other than itself.
    pub(crate) fn images(&self, line: &[Vec2]) -> Vec<Vec<Vec2>> {
        let mut all = vec![line.to_vec()];
        for (k, at) in self.at.into_iter().enumerate() {
            let Some(at) = at.filter(|_| line.iter().any(|&p| !self.is_on(p, k))) else { continue };
            let image = |line: &Vec<Vec2>| {
                let reflect = |mut p: Vec2| {
                    p[k] = 2.0 * at - p[k];
                    p
                };
                line.iter().copied().map(reflect).collect()
            };
            let images: Vec<Vec<Vec2>> = all.iter().map(image).collect();
            all.extend(images);
        }
        all.split_off(1)
    }
}

/// Returns true if a flow is its image in the mirror line at a place across a direction.
fn is_mirrored(field: &Samples<Vec2>, k: usize, at: f64) -> bool {
    let (mut difference, mut total) = (0.0, 0.0);
    for (mut p, here) in field.raster.points().into_iter().zip(&field.values) {
        p[k] = 2.0 * at - p[k];
        let mut there = field.at(p);
        there[k] = -there[k];
        difference += (there - here).length_squared();
        total += here.length_squared();
    }
    difference < DIFFERENCE * DIFFERENCE * total
}

#[cfg(test)]
mod tests;
