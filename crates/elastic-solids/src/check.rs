//! Checks that every energy and every law of forces must pass, as figures. Use them for your own materials.

mod moduli;

use motile_base::{Vec2, internal::all_points_finite, positive, same_length};

use crate::material::{DeformationGradient, Mat2};
use crate::mesh::TriangleMesh;
use crate::{ElasticForces, EnergyDensity, SolidError};

pub use moduli::{InnerPoints, MeasuredModuli, measured_moduli};

/// Returns the largest entry of `P - dW/dA` (force per length) at the deformation gradient `deformation`. This is the
/// error of the stress P of an energy density W, with dW/dA by central differences of width `step` (no dimension; at
/// 5e-6 round-off and truncation are about equal).
///
/// ```
/// use elastic_solids::check::stress_error;
/// use elastic_solids::{Mat2, NeoHookean, SolidError};
///
/// let material = NeoHookean::new(1.0, 2.0)?;
/// let error = stress_error(&material, Mat2::from_rows_array(&[1.2, 0.3, 0.0, 0.9]), 5e-6)?;
/// assert!(error < 1e-8);
/// # Ok::<(), SolidError>(())
/// ```
///
/// # Errors
/// Returns an error for a step that is not positive; a deformation, or one that is a step away, whose determinant is
/// not positive.
pub fn stress_error(energy: &dyn EnergyDensity, deformation: Mat2, step: f64) -> Result<f64, SolidError> {
    positive("the step", step)?;
    let stress = energy.stress(&DeformationGradient::new(deformation)?).to_cols_array();
    let mut largest = 0.0_f64;
    for entry in 0..4 {
        let at = |shift: f64| {
            let mut moved = deformation.to_cols_array();
            moved[entry] += shift;
            DeformationGradient::new(Mat2::from_cols_array(&moved)).map(|gradient| energy.energy(&gradient))
        };
        let difference = (at(step)? - at(-step)?) / (2.0 * step);
        largest = largest.max((stress[entry] - difference).abs());
    }
    Ok(largest)
}

/// Resultant and torque of the elastic forces over the sum of their magnitudes, both zero except for round-off.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ForceBalance {
    /// Magnitude of the sum of the forces (no dimension).
    pub sum: f64,
    /// Torque about the origin (length). Without meaning for a periodic mesh.
    pub torque: f64,
}

/// Returns the balance of the elastic forces of a mesh with its points at `positions` (length): zero to round-off,
/// whatever the deformation.
///
/// # Errors
/// Returns an error for positions that are not finite; the errors of [`ElasticForces::add_forces`].
pub fn force_balance(law: &dyn ElasticForces, positions: &[Vec2]) -> Result<ForceBalance, SolidError> {
    all_points_finite("the positions", positions)?;
    let mut forces = vec![Vec2::ZERO; positions.len()];
    law.add_forces(positions, &mut forces)?;
    let size = forces.iter().map(|v| v.length()).sum::<f64>().max(f64::MIN_POSITIVE);
    let torque: f64 = positions.iter().zip(&forces).map(|(position, force)| position.perp_dot(*force)).sum();
    Ok(ForceBalance { sum: forces.iter().sum::<Vec2>().length() / size, torque: torque.abs() / size })
}

/// Returns the patch test. It is the largest force on a point inside a mesh under the uniform deformation `X = A s`,
/// over the largest on its boundary (no dimension). It is zero to round-off for uniform hyperelastic material on any
/// mesh that is not periodic, and for springs on a lattice of equilateral triangles.
///
/// # Errors
/// Returns an error for forces made for another mesh; a deformation that is not finite; the errors of
/// [`ElasticForces::add_forces`].
pub fn patch_residual(mesh: &TriangleMesh, law: &dyn ElasticForces, deformation: Mat2) -> Result<f64, SolidError> {
    same_length("the mesh of the forces", mesh.points().len(), law.point_count())?;
    let positions: Vec<Vec2> = mesh.points().iter().map(|s| deformation * *s).collect();
    all_points_finite("the deformed points", &positions)?;
    let mut forces = vec![Vec2::ZERO; positions.len()];
    law.add_forces(&positions, &mut forces)?;
    let inside = mesh.inner_points();
    let largest = |wanted: bool| {
        let chosen = forces.iter().zip(&inside).filter(|(_, inside)| **inside == wanted);
        chosen.map(|(force, _)| force.length()).fold(0.0, f64::max)
    };
    Ok(largest(true) / largest(false).max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests;
