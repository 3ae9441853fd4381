//! Viscosity of the cortex of an interface.

use motile_base::not_negative;
use serde::{Deserialize, Serialize};

use crate::InterfaceError;

/// Viscosity of the cortex, the thin layer of an interface that resists stretching along it.
///
/// An interface with a cortex carries the tension `T = gamma + eta_s Th`, with the rate of stretching `Th = tau.dv/ds`
/// of the fluid on it (1/time). In the plane, a line has no other viscosity than this one. The surface of a body of
/// revolution has a shear viscosity too (Boussinesq and Scriven). Its stresses along the meridian and around the axis
/// are `gamma + kappa_d (e_1 + e_2) +- mu_s (e_1 - e_2)`, with the rates of stretching e_1 and e_2. The
/// dilatational viscosity kappa_d takes the place of eta_s.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("surface viscosity", "interfacial viscosity", "Boussinesq"))]
pub struct Cortex {
    /// Viscosity eta_s where there are no particles (force times time); everywhere, if it does not depend on them.
    pub viscosity: f64,
    /// Increase of eta_s per concentration of the particles (force times time times length).
    pub per_concentration: f64,
    /// Shear viscosity mu_s of the interface of a body of revolution (force times time per length). There, the other
    /// two are dilatational viscosities, a length less in dimension.
    pub shear_viscosity: f64,
    /// True if the interface does not stretch at all: `tau.dv/ds = 0` everywhere, the limit of a large viscosity eta_s,
    /// whose number then does not matter. The tension becomes the multiplier of this constraint. Lipid membranes are
    /// such interfaces. Give them a bending modulus as well.
    pub inextensible: bool,
}

impl Cortex {
    /// Creates a cortex of one viscosity eta_s (force times time).
    #[must_use]
    pub fn new(viscosity: f64) -> Self {
        Self { viscosity, ..Self::default() }
    }

    /// Creates the cortex of an interface that does not stretch.
    #[must_use]
    #[doc(alias("vesicle", "lipid membrane"))]
    pub fn inextensible() -> Self {
        Self { inextensible: true, ..Self::default() }
    }

    /// Returns the viscosity eta_s at a concentration (force times time).
    #[must_use]
    pub fn viscosity_at(&self, concentration: f64) -> f64 {
        self.viscosity + self.per_concentration * concentration.max(0.0)
    }

    /// Returns true if there is no cortex.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Refuses numbers that are negative or not finite.
    ///
    /// # Errors
    /// Returns an error that names the number.
    pub fn check(&self) -> Result<(), InterfaceError> {
        not_negative("the viscosity of the cortex", self.viscosity)?;
        not_negative("the viscosity of the cortex per concentration", self.per_concentration)?;
        not_negative("the shear viscosity of the cortex", self.shear_viscosity)?;
        Ok(())
    }
}
