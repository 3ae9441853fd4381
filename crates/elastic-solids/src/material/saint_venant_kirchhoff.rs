//! The Saint Venant-Kirchhoff material: linear elasticity in the Green strain.

use crate::material::{DeformationGradient, Mat2};
use crate::{EnergyDensity, Moduli, SolidError};

/// The Saint Venant-Kirchhoff material:
/// ```text
/// E = (A^T A - 1)/2
/// W = (kappa - mu)/2 tr(E)^2 + mu tr(E^2)
/// P = A ((kappa - mu) tr(E) 1 + 2 mu E)
/// ```
/// For large rotations with small strains. It softens under compression and does not resist being flattened: an energy
/// for comparison, not for narrow channels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SaintVenantKirchhoff {
    moduli: Moduli,
}

impl SaintVenantKirchhoff {
    /// Creates a material from shear modulus mu and bulk modulus kappa (force per length).
    ///
    /// # Errors
    /// Returns an error for a modulus that is not positive and finite.
    pub fn new(shear: f64, bulk: f64) -> Result<Self, SolidError> {
        Ok(Self { moduli: Moduli::new(shear, bulk)? })
    }
}

impl From<Moduli> for SaintVenantKirchhoff {
    fn from(moduli: Moduli) -> Self {
        Self { moduli }
    }
}

fn green_strain(gradient: &DeformationGradient) -> Mat2 {
    (gradient.matrix().transpose() * gradient.matrix() - Mat2::IDENTITY) * 0.5
}

impl EnergyDensity for SaintVenantKirchhoff {
    #[inline]
    fn energy(&self, gradient: &DeformationGradient) -> f64 {
        let strain = green_strain(gradient);
        let square = strain.x_axis.length_squared() + strain.y_axis.length_squared();
        0.5 * self.moduli.lame() * strain.trace().powi(2) + self.moduli.shear() * square
    }

    #[inline]
    fn stress(&self, gradient: &DeformationGradient) -> Mat2 {
        let strain = green_strain(gradient);
        let pressure = Mat2::IDENTITY * (self.moduli.lame() * strain.trace());
        gradient.matrix() * (pressure + strain * (2.0 * self.moduli.shear()))
    }

    fn moduli(&self) -> Moduli {
        self.moduli
    }
}
