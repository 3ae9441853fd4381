//! Shear and bulk modulus of an isotropic material in the plane.

use motile_base::{positive, within};

use crate::SolidError;

/// Shear and bulk modulus of an isotropic material in two dimensions (force per length).
///
/// Under a small strain e the stress is `kappa tr(e) 1 + 2 mu (e - tr(e)/2 1)`, with mu the shear and kappa the bulk
/// modulus. Both are positive, so that every strain costs energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moduli {
    shear: f64,
    bulk: f64,
}

impl Moduli {
    /// Creates moduli from the shear modulus mu and the bulk modulus kappa (force per length).
    ///
    /// # Errors
    /// Returns an error for a modulus that is not positive and finite.
    pub fn new(shear: f64, bulk: f64) -> Result<Self, SolidError> {
        Ok(Self { shear: positive("the shear modulus", shear)?, bulk: positive("the bulk modulus", bulk)? })
    }

    /// Creates moduli from Young's modulus E (force per length) and Poisson's ratio nu of the plane (no dimension):
    /// `mu = E / (2 (1 + nu))`, `kappa = E / (2 (1 - nu))`.
    ///
    /// # Errors
    /// Returns an error if Young's modulus is not positive, or Poisson's ratio not between -1 and 1 (its bounds in two
    /// dimensions).
    pub fn from_young(young: f64, poisson: f64) -> Result<Self, SolidError> {
        positive("Young's modulus", young)?;
        within("Poisson's ratio", poisson, -1.0 + f64::EPSILON, 1.0 - f64::EPSILON)?;
        Self::new(young / (2.0 * (1.0 + poisson)), young / (2.0 * (1.0 - poisson)))
    }

    /// Creates moduli of a lattice of springs: kappa = 2 mu, Poisson's ratio 1/3 (Cowley (4.17) and below).
    ///
    /// # Errors
    /// Returns an error for a shear modulus that is not positive and finite.
    pub fn of_springs(shear: f64) -> Result<Self, SolidError> {
        Self::new(shear, 2.0 * shear)
    }

    /// Creates moduli of a lattice with Cowley's spring constant k (force per length squared): `mu = 3/16 h k` (Cowley
    /// (4.18)), kappa = 2 mu, where h = 0.05 is Cowley's lattice spacing, whatever the spacing of the run.
    ///
    /// # Errors
    /// Returns an error for a spring constant that is not positive and finite.
    pub fn from_thesis_spring_constant(k: f64) -> Result<Self, SolidError> {
        positive("the spring constant", k)?;
        Self::of_springs(3.0 / 16.0 * THESIS_SPACING * k)
    }

    /// Creates moduli of springs whose shear modulus is known to be positive.
    pub(crate) fn springs_of_checked(shear: f64) -> Self {
        Self { shear, bulk: 2.0 * shear }
    }

    /// Returns the larger shear modulus and larger bulk modulus of two materials.
    pub(crate) fn larger(&self, other: &Self) -> Self {
        Self { shear: self.shear.max(other.shear), bulk: self.bulk.max(other.bulk) }
    }

    /// Returns the shear modulus mu (force per length).
    #[must_use]
    pub fn shear(&self) -> f64 {
        self.shear
    }

    /// Returns the bulk modulus kappa (force per length).
    #[must_use]
    pub fn bulk(&self) -> f64 {
        self.bulk
    }

    /// Returns the first Lame coefficient of the plane, kappa - mu (force per length); may be negative.
    #[must_use]
    pub fn lame(&self) -> f64 {
        self.bulk - self.shear
    }

    /// Returns the Young's modulus of the plane, `4 kappa mu / (kappa + mu)` (force per length).
    #[must_use]
    pub fn young(&self) -> f64 {
        4.0 * self.bulk * self.shear / (self.bulk + self.shear)
    }

    /// Returns the Poisson's ratio of the plane, `(kappa - mu) / (kappa + mu)` (no dimension; Cowley (4.17)).
    #[must_use]
    pub fn poisson(&self) -> f64 {
        (self.bulk - self.shear) / (self.bulk + self.shear)
    }
}

/// Lattice spacing of Cowley (length, in units of the droplet's radius).
const THESIS_SPACING: f64 = 0.05;

#[cfg(test)]
mod tests;
