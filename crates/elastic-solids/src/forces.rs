//! Where a deformed mesh gets its forces from: springs along its edges, hyperelastic material, or a law of your own.

mod hyperelastic;
mod springs;

use ib_core::Vec2;

use crate::material::Mat2;
use crate::{Moduli, SolidError};

pub use hyperelastic::Hyperelastic;
pub use springs::Springs;

/// The elastic forces of a deformed mesh, as the gradient of an energy: [`Hyperelastic`] material or [`Springs`].
///
/// Forces sum to zero and give no torque to round-off, whatever the deformation.
pub trait ElasticForces: std::fmt::Debug + Send + Sync + 'static {
    /// Number of points of the mesh.
    fn point_count(&self) -> usize;

    /// Adds the elastic forces -dE/dX (force) of the mesh with its points at `positions` (length).
    ///
    /// # Errors
    /// Lists of the wrong length; an inverted triangle where the energy is not defined for it.
    fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError>;

    /// The elastic energy E (energy) of the mesh with its points at `positions` (length).
    ///
    /// # Errors
    /// As [`ElasticForces::add_forces`].
    fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError>;

    /// First Piola-Kirchhoff stress (force per reference length) in a triangle whose deformation gradient is
    /// `gradient`, where it is defined; `None` for a triangle beyond the last.
    fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2>;

    /// The largest shear and the largest bulk modulus of small strains (force per length).
    fn stiffest(&self) -> Moduli;
}

#[cfg(test)]
mod tests;
