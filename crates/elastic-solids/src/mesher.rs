//! Uniform triangle meshes of solids given by their outlines.

mod boundary;
mod point_set;
mod relaxation;
mod seeds;
pub(crate) mod segments;
mod triangulation;

use motile_base::finite;

use crate::error::length;
use crate::mesh::TriangleMesh;
use crate::{Interior, SolidError};
use boundary::Boundary;
use point_set::PointSet;
use relaxation::relax;
use seeds::{Fit, Lay};

/// Mesher: makes uniform triangle meshes of interiors.
///
/// The outlines are resampled at equal spacing, corners kept; the inside is seeded with a lattice of equilateral
/// triangles, no closer to the boundary than 0.4 spacings. The constrained Delaunay triangulation of all these points
/// is relaxed, sweep after sweep, until the edges have about equal length. During this, the boundary points slide along
/// the exact outlines, from corner to corner. If a mesh has less than 6,000 points, several lattices are tried, and the
/// mesh whose edge lengths deviate least is returned. The same outlines always give the same mesh.
///
/// The two ends of a periodic wall share their points, and its spacing is changed by up to 5 %, so that the lattice
/// fits its height. A lattice stretched across the wall would be anisotropic, for springs by as much as the stretch.
///
/// ```
/// use elastic_solids::{Outline, SolidError};
/// use elastic_solids::Vec2;
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

/// Default number of relaxation sweeps: several times the twenty or so in which strains as wide as a wall die out.
const SWEEPS: usize = 180;

/// Distance of the seeds from the boundary over the spacing. At about half the height of a row the seeds next to the
/// boundary stand, on average, one row away from it. A larger distance leaves too few of them, which relaxation makes
/// up for by stretching all triangles across a wall.
const MARGIN: f64 = 0.4;

/// Number of points that all the trial meshes have together: a bound on the time that is spent on them.
const TRIED_POINTS: usize = 12_000;

impl Mesher {
    /// Creates a mesher for edges of length `spacing` (length).
    ///
    /// # Errors
    /// Returns an error for a spacing that is not positive and finite.
    pub fn new(spacing: f64) -> Result<Self, SolidError> {
        Ok(Self { spacing: length("the mesh spacing", spacing)?, sweeps: SWEEPS, angle: 0.0 })
    }

    /// Changes the number of relaxation sweeps (180 otherwise; 0 to leave the seeds where they are).
    #[must_use]
    pub fn sweeps(mut self, sweeps: usize) -> Self {
        self.sweeps = sweeps;
        self
    }

    /// Turns the lattice of the seeds by `angle` (radians, 0 otherwise). The mesh of a straight wall is then not a
    /// lattice. Use this to see the influence of the mesh on a result.
    ///
    /// # Errors
    /// Returns an error for an angle that is not finite.
    pub fn turned(mut self, angle: f64) -> Result<Self, SolidError> {
        self.angle = finite("the angle of the seeds", angle)?;
        Ok(self)
    }

    /// Returns the mesh of the inside of outlines.
    ///
    /// # Errors
    /// Returns an error for:
    /// * outlines that cross or touch,
    /// * a hole or part narrower than the spacing,
    /// * a wall thinner than the spacing,
    /// * a period shorter than six spacings,
    /// * more than 1e6 points,
    /// * a triangulation that failed.
    pub fn mesh(&self, interior: &Interior) -> Result<TriangleMesh, SolidError> {
        self.mesh_counting(interior).map(|(mesh, _)| mesh)
    }

    /// Returns the mesh, and the number of moves of points that it took.
    fn mesh_counting(&self, interior: &Interior) -> Result<(TriangleMesh, usize), SolidError> {
        let boundary = Boundary::new(interior, self.spacing, self.angle == 0.0)?;
        most_even(&boundary, &self.ways(interior), self.sweeps)
    }

    /// Lattices of seeds to try.
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

/// Returns the most even of the meshes from different seeds, as many of which are made as [`TRIED_POINTS`] allows.
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

/// Checks that a mesh has the given boundary, so that no triangle is missing or too many.
fn complete(mesh: TriangleMesh, boundary: &Boundary<'_>) -> Result<TriangleMesh, SolidError> {
    let found: usize = mesh.boundary_loops().iter().map(|boundary| boundary.points.len()).sum();
    if found == boundary.count() {
        Ok(mesh)
    } else {
        Err(SolidError::meshing_failed("the boundary is not that of the outlines"))
    }
}

#[cfg(test)]
mod tests;
