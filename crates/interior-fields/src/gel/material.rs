//! What a gel is made of.

use ib_core::input::{finite, not_negative, positive};

use crate::InteriorError;

/// The constants of a gel; its viscosity is that of the fluid that it lies in.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct GelMaterial {
    /// Frank constant K (force): what it takes to bend or splay the director.
    pub frank: f64,
    /// Rotational viscosity gamma1 (stress times time): what it takes to turn the director against the fluid.
    pub rotational_viscosity: f64,
    /// Alignment nu1 with the flow (no dimension): negative for rods; beyond -1 and 1 the director finds an angle in a
    /// shear flow, in between it tumbles.
    pub alignment: f64,
    /// Activity zeta_b (stress): negative for a contractile gel, positive for an extensile one.
    pub activity: f64,
}

impl Default for GelMaterial {
    /// A contractile gel of rods whose director relaxes over a radius in some ten units of time, in those of the model.
    fn default() -> Self {
        Self { frank: 10.0, rotational_viscosity: 100.0, alignment: -0.5, activity: -100.0 }
    }
}

impl GelMaterial {
    /// The same, if a gel can be made of it.
    ///
    /// # Errors
    /// A Frank constant that is negative, a rotational viscosity that is not positive, numbers that are not finite.
    pub fn checked(self) -> Result<Self, InteriorError> {
        not_negative("the Frank constant", self.frank)?;
        positive("the rotational viscosity", self.rotational_viscosity)?;
        finite("the alignment", self.alignment)?;
        finite("the activity of the gel", self.activity)?;
        Ok(self)
    }

    /// Diffusivity of the director (length squared per time) in fluid of that viscosity (stress times time), the most
    /// that it is in any direction: `K (1/gamma1 + (1 + |nu1|)^2/(4 eta))`.
    #[must_use]
    pub fn largest_diffusivity(&self, viscosity: f64) -> f64 {
        let coupling = 1.0 + self.alignment.abs();
        self.frank * (1.0 / self.rotational_viscosity + 0.25 * coupling * coupling / viscosity)
    }

    /// The constants with their names.
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
