//! Material constants of a gel.

use motile_base::{finite, not_negative, positive};

use crate::InteriorError;

/// Material constants of an active polar gel, in the notation of Cowley (1.5), (1.7). Its viscosity equals the
/// viscosity of the fluid around the nodes.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("active gel", "nematic", "polar gel", "liquid crystal", "cytoskeleton"))]
pub struct GelMaterial {
    /// Frank constant K (force times length), the stiffness against splay and bend of the director.
    pub frank: f64,
    /// Rotational viscosity gamma1 (stress times time), the resistance of the director to turning against the fluid.
    pub rotational_viscosity: f64,
    /// Flow alignment nu1 (no dimension), negative for rods. In a shear flow, the director takes a fixed angle if
    /// |nu1| > 1, and tumbles otherwise.
    pub alignment: f64,
    /// Activity zeta_b (stress): negative for a contractile gel, positive for an extensile one.
    pub activity: f64,
}

impl Default for GelMaterial {
    /// Creates a contractile gel of rods whose director relaxes over a droplet of radius 1 in about ten units of time.
    fn default() -> Self {
        Self { frank: 10.0, rotational_viscosity: 100.0, alignment: -0.5, activity: -100.0 }
    }
}

impl GelMaterial {
    /// Returns the material itself, if its constants are possible.
    ///
    /// # Errors
    /// Returns an error for a Frank constant that is negative; a rotational viscosity that is not positive; constants
    /// that are not finite.
    pub fn checked(self) -> Result<Self, InteriorError> {
        not_negative("the Frank constant", self.frank)?;
        positive("the rotational viscosity", self.rotational_viscosity)?;
        finite("the alignment", self.alignment)?;
        finite("the activity of the gel", self.activity)?;
        Ok(self)
    }

    /// Returns the largest diffusivity of the director (length squared per time) in any direction, in fluid of
    /// viscosity eta (stress times time): `K (1/gamma1 + (1 + |nu1|)^2/(4 eta))`, by the molecular field and by the
    /// flow that it drives.
    #[must_use]
    pub fn largest_diffusivity(&self, viscosity: f64) -> f64 {
        let coupling = 1.0 + self.alignment.abs();
        self.frank * (1.0 / self.rotational_viscosity + 0.25 * coupling * coupling / viscosity)
    }

    /// Constants with their names.
    pub(super) fn properties(&self) -> Vec<(String, f64)> {
        let Self { frank, rotational_viscosity, alignment, activity } = *self;
        let named = [
            ("the Frank constant", frank),
            ("the rotational viscosity", rotational_viscosity),
            ("the alignment", alignment),
            ("the activity of the gel", activity),
        ];
        named.map(|(name, value)| (name.to_owned(), value)).to_vec()
    }
}

#[cfg(test)]
mod tests;
