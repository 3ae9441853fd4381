//! Hyperelastic materials and their moduli.

mod deformation;
mod moduli;
mod mooney_rivlin;
mod neo_hookean;
mod saint_venant_kirchhoff;

pub use deformation::{DeformationGradient, Mat2};
pub use moduli::Moduli;
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::NeoHookean;
pub use saint_venant_kirchhoff::SaintVenantKirchhoff;

/// The strain energy density W of a hyperelastic material and its derivative.
///
/// W is zero and least for a rotation, and does not change when the deformed material is turned. Implement it for a
/// material of your own: a solid needs nothing else.
pub trait EnergyDensity: std::fmt::Debug + Send + Sync + 'static {
    /// Energy density W(A) per reference area (energy per area = force per length in 2D).
    fn energy(&self, gradient: &DeformationGradient) -> f64;

    /// First Piola-Kirchhoff stress `P = dW/dA` (force per reference length).
    fn stress(&self, gradient: &DeformationGradient) -> Mat2;

    /// Shear and bulk modulus of small strains (force per length).
    fn moduli(&self) -> Moduli;

    /// Cauchy stress `P A^T / J` (force per deformed length), symmetric.
    fn cauchy_stress(&self, gradient: &DeformationGradient) -> Mat2 {
        self.stress(gradient) * gradient.matrix().transpose() / gradient.jacobian()
    }
}

#[cfg(test)]
mod tests;
