//! Material constants of a gel.

use motile_base::{finite, not_negative, positive};

use crate::InteriorError;

/// Material constants of an active polar gel, in the notation of Cowley (1.5), (1.7). Its viscosity equals the
/// viscosity of the fluid around the nodes.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("active gel", "nematic", "polar gel", "liquid crystal", "cytoskeleton"))]
pub struct GelMaterial {
    /// Frank constant K1 (force times length), the stiffness against splay of the director, and against bend unless
    /// `bend` is given.
    pub frank: f64,
    /// Frank constant K3 (force times length), the stiffness against bend; `None` for as much as against splay.
    pub bend: Option<f64>,
    /// Coefficient k of spontaneous splay (force), the energy `k INT div p`. It acts at the interface alone: if it is
    /// negative, the director turns outwards there. Without effect in a periodic box.
    pub spontaneous_splay: f64,
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
        Self {
            frank: 10.0,
            bend: None,
            spontaneous_splay: 0.0,
            rotational_viscosity: 100.0,
            alignment: -0.5,
            activity: -100.0,
        }
    }
}

impl GelMaterial {
    /// Returns the material itself, if its constants are possible.
    ///
    /// # Errors
    /// Returns an error for Frank constants that are negative; a rotational viscosity that is not positive; constants
    /// that are not finite.
    pub fn checked(self) -> Result<Self, InteriorError> {
        not_negative("the Frank constant", self.frank)?;
        not_negative("the Frank constant of bend", self.bend())?;
        finite("the spontaneous splay", self.spontaneous_splay)?;
        positive("the rotational viscosity", self.rotational_viscosity)?;
        finite("the alignment", self.alignment)?;
        finite("the activity of the gel", self.activity)?;
        Ok(self)
    }

    /// Returns the Frank constant K3 of bend (force times length).
    #[must_use]
    pub fn bend(&self) -> f64 {
        self.bend.unwrap_or(self.frank)
    }

    /// Returns the largest diffusivity of the director (length squared per time) in any direction, by the molecular
    /// field and by the flow that it drives. It is, in fluid of viscosity eta (stress times time),
    /// `K (1/gamma1 + (1 + |nu1|)^2/(4 eta))` with the larger Frank constant K.
    #[must_use]
    pub fn largest_diffusivity(&self, viscosity: f64) -> f64 {
        self.frank.max(self.bend()) * self.mobility(viscosity)
    }

    /// Returns the largest rate at which a couple per area turns the director, itself and by the flow that it drives
    /// (1/(stress times time)).
    pub(super) fn mobility(&self, viscosity: f64) -> f64 {
        let coupling = 1.0 + self.alignment.abs();
        1.0 / self.rotational_viscosity + 0.25 * coupling * coupling / viscosity
    }

    /// Constants with their names.
    pub(super) fn properties(&self) -> Vec<(String, f64)> {
        let Self { frank, spontaneous_splay, rotational_viscosity, alignment, activity, .. } = *self;
        let named = [
            ("the Frank constant", frank),
            ("the Frank constant of bend", self.bend()),
            ("the spontaneous splay", spontaneous_splay),
            ("the rotational viscosity", rotational_viscosity),
            ("the alignment", alignment),
            ("the activity of the gel", activity),
        ];
        named.map(|(name, value)| (name.to_owned(), value)).to_vec()
    }
}

#[cfg(test)]
mod tests;
