//! The neo-Hookean material.

use crate::material::{DeformationGradient, Mat2};
use crate::{EnergyDensity, Moduli, SolidError};

/// The generalised neo-Hookean material of Cowley (4.8):
/// ```text
/// W = mu/2 (tr(A A^T)/J - 2) + kappa/2 (J - 1)^2
/// P = mu/J (A - tr(A A^T)/2 A^-T) + kappa (J - 1) J A^-T                     (4.15)
/// ```
/// (Cowley prints tr(A A) in (4.8) and means tr(A A^T), as in its (4.4)). W grows without bound where the material
/// is flattened.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("hyperelastic", "shear modulus", "elasticity"))]
pub struct NeoHookean {
    moduli: Moduli,
}

impl NeoHookean {
    /// Creates a material from shear modulus mu and bulk modulus kappa (force per length).
    ///
    /// # Errors
    /// Returns an error for a modulus that is not positive and finite.
    pub fn new(shear: f64, bulk: f64) -> Result<Self, SolidError> {
        Ok(Self { moduli: Moduli::new(shear, bulk)? })
    }
}

impl From<Moduli> for NeoHookean {
    fn from(moduli: Moduli) -> Self {
        Self { moduli }
    }
}

impl EnergyDensity for NeoHookean {
    #[inline]
    fn energy(&self, gradient: &DeformationGradient) -> f64 {
        let jacobian = gradient.jacobian();
        0.5 * self.moduli.shear() * gradient.distortion() / jacobian
            + 0.5 * self.moduli.bulk() * (jacobian - 1.0).powi(2)
    }

    #[inline]
    fn stress(&self, gradient: &DeformationGradient) -> Mat2 {
        let ([a11, a21, a12, a22], jacobian) = (gradient.matrix().to_cols_array(), gradient.jacobian());
        // A - tr(A A^T)/(2J) J A^-T, with tr(A A^T) = 2J + distortion, so that nothing cancels near a rotation.
        let (stretch, shear) = (a11 - a22, a12 + a21);
        let deviator = Mat2::from_rows_array(&[stretch, shear, shear, -stretch]);
        let scale = self.moduli.shear() / jacobian;
        let along = self.moduli.bulk() * (jacobian - 1.0) - 0.5 * scale * gradient.distortion() / jacobian;
        deviator * scale + gradient.cofactor() * along
    }

    fn moduli(&self) -> Moduli {
        self.moduli
    }
}
