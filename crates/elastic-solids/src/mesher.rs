//! Uniform meshes of what lies between outlines.

mod boundary;
mod point_set;
mod relaxation;
mod seeds;
pub(crate) mod segments;
mod triangulation;

use ib_core::input::finite;

use crate::error::length;
use crate::{Interior, SolidError, TriangleMesh};
use boundary::Boundary;
use point_set::PointSet;
use relaxation::relax;
use seeds::{Fit, Lay};

/// Makes uniform triangle meshes.
///
/// The outlines are resampled at equal spacing, corners kept; the inside is seeded with a lattice of equilateral
/// triangles, no closer to the boundary than 0.4 spacings; the constrained Delaunay triangulation of all these points
/// is relaxed, sweep after sweep, until the edges have about equal length. In this the boundary points slide along the
/// exact outlines, from corner to corner. Where a mesh has less than 6,000 points several lattices are tried, and the
/// mesh whose edge lengths deviate least is returned; the same outlines always gives the same mesh.
///
/// The two ends of a periodic wall share their points, and its spacing is changed by up to 5 per cent so that the
/// lattice fits its height: a lattice stretched across the wall would be anisotropic, for springs by as much as the
/// stretch.
///
/// ```
/// use elastic_solids::{Outline, SolidError};
/// use ib_core::Vec2;
///
/// let disc = Outline::circle(Vec2::ZERO, 1.0)?.mesh(0.1)?;
/// println!("{}", disc.quality());
/// assert!(disc.quality().smallest_angle > 35.0);
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mesher {
    spacing: f64,
    sweeps: usize,
    angle: f64,
}

/// Sweeps of the default.
const SWEEPS: usize = 180;

/// Distance of the seeds from the boundary over the spacing. At about half the height of a row the seeds next to the
/// boundary stand, on average, one row away from it; a larger distance leaves too few of them, which relaxation makes
/// up for by stretching all triangles across a wall.
const MARGIN: f64 = 0.4;

/// Number of points of all the meshes together among which the most even is chosen.
const TRIED_POINTS: usize = 12_000;

impl Mesher {
    /// Edges of length `spacing` (length).
    ///
    /// # Errors
    /// A spacing that is not positive and finite.
    pub fn new(spacing: f64) -> Result<Self, SolidError> {
        Ok(Self { spacing: length("the mesh spacing", spacing)?, sweeps: SWEEPS, angle: 0.0 })
    }

    /// The same with another number of relaxation sweeps (180 otherwise; 0 to leave the seeds where they are).
    #[must_use]
    pub fn sweeps(mut self, sweeps: usize) -> Self {
        self.sweeps = sweeps;
        self
    }

    /// The same with the lattice of the seeds turned by `angle` (radians, 0 otherwise): a mesh of a straight wall that
    /// is not a lattice itself, to see what the mesh does to a result.
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn turned(mut self, angle: f64) -> Result<Self, SolidError> {
        self.angle = finite("the angle of the seeds", angle)?;
        Ok(self)
    }

    /// Meshes the inside of outlines.
    ///
    /// # Errors
    /// Outlines that cross or touch; a hole or part narrower than the spacing; a wall thinner than the spacing; a
    /// period shorter than six spacings; more than 1e6 points; a triangulation that failed.
    pub fn mesh(&self, interior: &Interior) -> Result<TriangleMesh, SolidError> {
        self.mesh_counting(interior).map(|(mesh, _)| mesh)
    }

    /// The mesh, and how often a point was moved for it.
    fn mesh_counting(&self, interior: &Interior) -> Result<(TriangleMesh, usize), SolidError> {
        let boundary = Boundary::new(interior, self.spacing, self.angle == 0.0)?;
        most_even(&boundary, &self.ways(interior), self.sweeps)
    }

    /// Ways to lay the seeds.
    fn ways(&self, interior: &Interior) -> Vec<Lay> {
        let angle = self.angle;
        let lay = |fit, offset, margin| Lay { fit, angle, offset, margin };
        let still = [0.0, 0.0];
        match interior.period() {
            _ if angle != 0.0 => vec![lay(Fit::Equilateral, still, MARGIN)],
            // Flat sides continue the lattice as it is.
            Some(_) => [MARGIN, 0.45, 0.35, 0.55].map(|margin| lay(Fit::ToBox, still, margin)).to_vec(),
            // The first suits a rectangle; nothing tells how a lattice should lie in other closed outlines.
            None => vec![
                lay(Fit::ToBox, still, MARGIN),
                lay(Fit::Equilateral, [0.5, 0.2], MARGIN),
                lay(Fit::Equilateral, [0.25, 0.0], MARGIN),
                lay(Fit::Equilateral, [0.75, 0.0], MARGIN),
                lay(Fit::ToBox, [0.25, 0.0], MARGIN),
                lay(Fit::Equilateral, [0.25, 0.2], MARGIN),
                lay(Fit::Equilateral, [0.5, 0.0], MARGIN),
                lay(Fit::Equilateral, [0.0, 0.4], MARGIN),
                lay(Fit::ToBox, [0.25, 0.2], MARGIN),
                lay(Fit::ToBox, [0.25, -0.2], MARGIN),
                lay(Fit::Equilateral, [0.25, -0.2], MARGIN),
                lay(Fit::ToBox, [0.0, 0.2], MARGIN),
            ],
        }
    }
}

/// The most even of the meshes from different seeds, of as many as are soon made.
fn most_even(boundary: &Boundary<'_>, ways: &[Lay], sweeps: usize) -> Result<(TriangleMesh, usize), SolidError> {
    let mut best: Option<(f64, TriangleMesh)> = None;
    let (mut points, mut moves) = (0, 0);
    for &lay in ways {
        let seeds = boundary.point_set(boundary.seeds(lay)?);
        let Ok((mesh, more)) = relaxed(boundary, seeds, sweeps) else { continue };
        moves += more;
        let size = mesh.points().len();
        points += size;
        let deviation = mesh.quality().edge_deviation;
        if best.as_ref().is_none_or(|(least, _)| deviation < *least) {
            best = Some((deviation, mesh));
        }
        if points + size > TRIED_POINTS {
            break;
        }
    }
    match best {
        Some((_, mesh)) => Ok((mesh, moves)),
        // In a sharp tip points that slide may fold the boundary.
        None => relaxed(boundary, boundary.point_set(boundary.seeds(ways[0])?).with_fixed_boundary(), sweeps),
    }
}

fn relaxed(boundary: &Boundary<'_>, mut set: PointSet<'_>, sweeps: usize) -> Result<(TriangleMesh, usize), SolidError> {
    let (triangles, moves) = relax(&mut set, sweeps, boundary.spacing)?;
    let mesh = match set.period {
        None => TriangleMesh::new(set.points, triangles),
        Some((_, period)) => TriangleMesh::periodic(set.points, triangles, period),
    };
    Ok((complete(mesh?, boundary)?, moves))
}

/// The mesh, where it has the boundary that was asked for: no triangle is missing or too many.
fn complete(mesh: TriangleMesh, boundary: &Boundary<'_>) -> Result<TriangleMesh, SolidError> {
    let found: usize = mesh.boundary_loops().iter().map(|boundary| boundary.points.len()).sum();
    if found == boundary.count() {
        Ok(mesh)
    } else {
        Err(SolidError::MeshingFailed { what: "the boundary is not that of the outlines" })
    }
}

#[cfg(test)]
mod tests;
