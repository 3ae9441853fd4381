//! Contact of the surface of a solid with itself.

use std::ops::Range;

use motile_base::{Vec2, polygon::CrossingFinder};

use crate::{SolidError, mesh::TriangleMesh};

/// Finds where the surface of a solid has come to cross itself, curve by curve.
#[derive(Debug, Clone, Default)]
pub(super) struct SelfContact {
    /// Curves by their entries in the list of points, and their advance in a turn (length).
    curves: Vec<(Range<usize>, f64)>,
    /// Points of all curves, and what is added to their x (length).
    points: Vec<(usize, f64)>,
    places: Vec<Vec2>,
    finder: CrossingFinder,
}

impl SelfContact {
    /// Creates an of the surface of a mesh, without curves that touch themselves in the reference state.
    pub(super) fn of(mesh: &TriangleMesh) -> Self {
        let mut found = Self::default();
        for outline in mesh.boundary_loops() {
            let first = found.points.len();
            let (mut shift, mut last) = (0.0, mesh.points()[outline.points[0]].x);
            found.points.extend(outline.points.iter().map(|&point| {
                let x = mesh.points()[point].x;
                shift -= mesh.period().map_or(0.0, |period| period * ((x - last) / period).round());
                last = x;
                (point, shift)
            }));
            let advance = f64::from(outline.periods) * mesh.period().unwrap_or(0.0);
            found.curves.push((first..found.points.len(), advance));
        }
        let mut curves = std::mem::take(&mut found.curves);
        curves.retain(|curve| matches!(found.crossing(curve, mesh.points()), Ok(None)));
        Self { curves, ..found }
    }

    /// Refuses a surface that crosses itself with the points at `positions` (length).
    pub(super) fn check(&mut self, positions: &[Vec2]) -> Result<(), SolidError> {
        let curves = std::mem::take(&mut self.curves);
        let found = curves.iter().find_map(|curve| self.crossing(curve, positions).transpose());
        self.curves = curves;
        let Some([first, second]) = found.transpose()? else { return Ok(()) };
        Err(SolidError::SelfContact { place: positions[first], first, second })
    }

    /// Returns the points at which the sides of a curve start that meet.
    fn crossing(
        &mut self,
        (range, advance): &(Range<usize>, f64),
        positions: &[Vec2],
    ) -> Result<Option<[usize; 2]>, SolidError> {
        let points = &self.points[range.clone()];
        self.places.clear();
        self.places.extend(points.iter().map(|&(point, shift)| positions[point] + Vec2::new(shift, 0.0)));
        let found = self.finder.first_crossing_over(&self.places, *advance)?;
        Ok(found.map(|(first, second)| [points[first].0, points[second].0]))
    }
}

#[cfg(test)]
mod tests;
