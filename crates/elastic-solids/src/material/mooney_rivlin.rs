//! The Mooney-Rivlin material, a rubber with two shear constants.

use motile_base::{positive, within};

use crate::material::{DeformationGradient, Mat2};
use crate::{EnergyDensity, Moduli, SolidError};

/// The compressible Mooney-Rivlin material under plane strain (stretch 1 out of the plane):
/// ```text
/// W  = C1 (J^(-2/3) I1 - 3) + C2 (J^(-4/3) I2 - 3) + K/2 (J - 1)^2
/// I1 = tr(A A^T) + 1,   I2 = tr(A A^T) + J^2
/// C1 = (1 - q) mu/2,   C2 = q mu/2,   K = kappa - mu/3
/// ```
/// with mu, kappa the shear and bulk modulus of the plane (force per length), q the part of mu that the second
/// invariant carries, A the deformation gradient in the plane and J its determinant. q = 0 is the neo-Hookean solid of
/// three dimensions. It differs from [`NeoHookean`](crate::NeoHookean) in its response to a change of area, which under
/// plane strain distorts the material in three dimensions too.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("hyperelastic", "rubber"))]
pub struct MooneyRivlin {
    moduli: Moduli,
    first: f64,
    second: f64,
    volumetric: f64,
}

impl MooneyRivlin {
    /// Creates a material from shear modulus mu and bulk modulus kappa of the plane (force per length) and the fraction
    /// q of the second invariant (0 to 1).
    ///
    /// # Errors
    /// Returns an error for a modulus that is not positive and finite, a fraction out of its range, `kappa <= mu/3` (no
    /// bulk modulus left in three dimensions).
    pub fn new(shear: f64, bulk: f64, fraction: f64) -> Result<Self, SolidError> {
        let moduli = Moduli::new(shear, bulk)?;
        within("the fraction of the second invariant", fraction, 0.0, 1.0)?;
        let volumetric = positive("the bulk modulus less a third of the shear modulus", bulk - shear / 3.0)?;
        let (first, second) = (0.5 * (1.0 - fraction) * shear, 0.5 * fraction * shear);
        Ok(Self { moduli, first, second, volumetric })
    }
}

impl EnergyDensity for MooneyRivlin {
    #[inline]
    fn energy(&self, gradient: &DeformationGradient) -> f64 {
        let jacobian = gradient.jacobian();
        let trace = gradient.distortion() + 2.0 * jacobian;
        let scale = jacobian.cbrt().powi(-2);
        self.first * (scale * (trace + 1.0) - 3.0)
            + self.second * (scale * scale * (trace + jacobian * jacobian) - 3.0)
            + 0.5 * self.volumetric * (jacobian - 1.0).powi(2)
    }

    #[inline]
    fn stress(&self, gradient: &DeformationGradient) -> Mat2 {
        let jacobian = gradient.jacobian();
        let trace = gradient.distortion() + 2.0 * jacobian;
        let scale = jacobian.cbrt().powi(-2);
        let (first, second) = (self.first * scale, self.second * scale * scale);
        // dW/d tr(A A^T) and dW/dJ; the derivatives of these two by A are 2A and the cofactor matrix.
        let by_trace = first + second;
        let by_jacobian = (-2.0 * first * (trace + 1.0) + second * (2.0 * jacobian * jacobian - 4.0 * trace))
            / (3.0 * jacobian)
            + self.volumetric * (jacobian - 1.0);
        gradient.matrix() * (2.0 * by_trace) + gradient.cofactor() * by_jacobian
    }

    fn moduli(&self) -> Moduli {
        self.moduli
    }
}

#[cfg(test)]
mod tests;
