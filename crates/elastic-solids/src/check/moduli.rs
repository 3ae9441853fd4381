//! Moduli of a mesh, measured by straining it.

use motile_base::{Vec2, same_length, within};

use crate::material::Mat2;
use crate::mesh::TriangleMesh;
use crate::{ElasticForces, SolidError};

/// Moduli measured on a mesh (force per length).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct MeasuredModuli {
    /// Shear modulus.
    pub shear: f64,
    /// Bulk modulus.
    pub bulk: f64,
}

/// Behaviour of the inner points while the boundary is strained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum InnerPoints {
    /// Points that follow the uniform strain: the moduli are the mean over the triangles.
    Strained,
    /// Points that relax to equilibrium: the moduli describe the solid seen from outside, and are never above the
    /// moduli of [`InnerPoints::Strained`].
    Relaxed,
}

/// Returns the shear and bulk modulus of a mesh under the small uniform strain `strain` (dimensionless, 1e-6 to 0.1),
/// with the boundary displaced uniformly.
///
/// The energy density of the simple shear X = s + g (s_y, 0) is mu g^2/2, and of the dilation X = (1 + g) s is 2 kappa
/// g^2. The mean over g and -g is taken, so that the error is of second order in the strain. A periodic mesh cannot
/// dilate: there the stretch X = s + g (0, s_y), of energy density (mu + kappa) g^2/2, takes its place.
///
/// ```
/// use elastic_solids::check::{InnerPoints, measured_moduli};
/// use elastic_solids::{Outline, SolidError, Springs};
/// use elastic_solids::Vec2;
///
/// let disc = Outline::circle(Vec2::ZERO, 1.0)?.mesh(0.1)?;
/// let springs = Springs::new(&disc, 100.0)?;
/// let found = measured_moduli(&disc, &springs, 1e-3, InnerPoints::Relaxed)?;
/// println!("{:.1} and {:.1}", found.shear, found.bulk); // within 2 % of 100 and 200
/// assert!((found.shear - 100.0).abs() < 2.0 && (found.bulk - 200.0).abs() < 4.0);
/// # Ok::<(), SolidError>(())
/// ```
///
/// # Errors
/// Returns an error for forces made for another mesh; a strain out of its range; a relaxation that does not converge,
/// which only an unstable material has.
pub fn measured_moduli(
    mesh: &TriangleMesh,
    law: &dyn ElasticForces,
    strain: f64,
    inner: InnerPoints,
) -> Result<MeasuredModuli, SolidError> {
    same_length("the mesh of the forces", mesh.points().len(), law.point_count())?;
    within("the strain", strain, 1e-6, 0.1)?;
    let stiffness = |direction: Mat2| -> Result<f64, SolidError> {
        let mut sum = 0.0;
        for strain in [strain, -strain] {
            let mut positions: Vec<Vec2> = mesh.points().iter().map(|s| s + direction * *s * strain).collect();
            if inner == InnerPoints::Relaxed {
                relax_inner(mesh, law, &mut positions)?;
            }
            sum += law.energy(&positions)?;
        }
        // Mean of the two energies, over half the strain squared.
        Ok(sum / (mesh.area() * strain * strain))
    };
    let shear = stiffness(Mat2::from_rows_array(&[0.0, 1.0, 0.0, 0.0]))?;
    let bulk = match mesh.period() {
        None => 0.25 * stiffness(Mat2::IDENTITY)?,
        Some(_) => stiffness(Mat2::from_rows_array(&[0.0, 0.0, 0.0, 1.0]))? - shear,
    };
    Ok(MeasuredModuli { shear, bulk })
}

/// Residual force over the force at the boundary at which the inner points count as in equilibrium; the error of the
/// energy, which has a minimum there, is of the order of the square.
const TOLERANCE: f64 = 1e-6;

/// Moves the points that are not on the boundary until the forces on them vanish, by nonlinear conjugate gradients
/// (Polak and Ribiere) with one secant step along each direction, which is exact for small strains.
fn relax_inner(mesh: &TriangleMesh, law: &dyn ElasticForces, positions: &mut [Vec2]) -> Result<(), SolidError> {
    let inner = mesh.inner_points();
    let residual = |positions: &[Vec2], forces: &mut Vec<Vec2>| -> Result<(), SolidError> {
        forces.fill(Vec2::ZERO);
        law.add_forces(positions, forces)?;
        for (force, _) in forces.iter_mut().zip(&inner).filter(|(_, inner)| !**inner) {
            *force = Vec2::ZERO;
        }
        Ok(())
    };
    let dot = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
    let count = positions.len();
    let mut forces = vec![Vec2::ZERO; count];
    // The size of forces to compare with: those that the boundary holds.
    law.add_forces(positions, &mut forces)?;
    let scale = dot(&forces, &forces);
    residual(positions, &mut forces)?;
    let (mut direction, mut before, mut trial) = (forces.clone(), forces.clone(), positions.to_vec());
    let mut squared = dot(&forces, &forces);
    for _ in 0..50 * count.max(20) {
        if squared <= TOLERANCE * TOLERANCE * scale {
            return Ok(());
        }
        // Curvature along the direction from a short way ahead.
        let reach = 1e-4 * mesh_step(mesh) / direction.iter().map(|v| v.length()).fold(0.0, f64::max);
        let slope = dot(&forces, &direction);
        for ((trial, place), step) in trial.iter_mut().zip(positions.iter()).zip(&direction) {
            *trial = place + step * reach;
        }
        before.copy_from_slice(&forces);
        residual(&trial, &mut forces)?;
        let curvature = (slope - dot(&forces, &direction)) / reach;
        if !(curvature > 0.0 && slope.is_finite()) {
            break;
        }
        for (place, step) in positions.iter_mut().zip(&direction) {
            *place += step * (slope / curvature);
        }
        residual(positions, &mut forces)?;
        let squared_before = squared;
        squared = dot(&forces, &forces);
        let keep = ((squared - dot(&forces, &before)) / squared_before).max(0.0);
        for (direction, force) in direction.iter_mut().zip(&forces) {
            *direction = force + *direction * keep;
        }
    }
    Err(SolidError::NoConvergence { residual: (squared / scale).sqrt() })
}

fn mesh_step(mesh: &TriangleMesh) -> f64 {
    (mesh.area() / mesh.triangles().len() as f64).sqrt()
}

#[cfg(test)]
mod tests;
