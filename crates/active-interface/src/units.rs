//! From the units of a calculation to SI.

use ib_core::input::{finite, positive};

use crate::InterfaceError;

/// What is converted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Length, in m.
    Length,
    /// Time, in s.
    Time,
    /// Speed, in m/s.
    Speed,
    /// Viscosity, in Pa s.
    Viscosity,
    /// Surface tension, in N/m.
    Tension,
    /// Pressure, stress, elastic modulus, in Pa.
    Stress,
    /// Particles per length of interface, in 1/m.
    Concentration,
    /// Activity zeta delta-mu, tension per concentration, in N.
    Activity,
    /// Diffusivity, in m^2/s.
    Diffusivity,
}

impl Quantity {
    /// Its SI unit, as it is written.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Time => "s",
            Self::Speed => "m/s",
            Self::Viscosity => "Pa s",
            Self::Tension => "N/m",
            Self::Stress => "Pa",
            Self::Concentration => "1/m",
            Self::Activity => "N",
            Self::Diffusivity => "m^2/s",
        }
    }
}

/// The units of a calculation: those of length, viscosity and tension are chosen, all others follow.
///
/// ```text
/// time = viscosity length / tension    speed = tension / viscosity          stress = tension / length
/// concentration = 1 / length           activity = tension length            diffusivity = tension length / viscosity
/// ```
/// ```
/// use active_interface::{Units, units::Quantity};
/// let units = Units::thesis();
/// // a speed of 0.15 is 0.15 micrometres a second
/// assert!((units.to_si(Quantity::Speed, 0.15)? - 0.15e-6).abs() < 1e-20);
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    length: f64,
    viscosity: f64,
    tension: f64,
}

impl Units {
    /// Units of length (m), viscosity (Pa s) and tension (N/m).
    ///
    /// # Errors
    /// Values that are not positive.
    pub fn new(length: f64, viscosity: f64, tension: f64) -> Result<Self, InterfaceError> {
        Ok(Self {
            length: positive("the unit of length", length)?,
            viscosity: positive("the unit of viscosity", viscosity)?,
            tension: positive("the unit of tension", tension)?,
        })
    }

    /// Cowley's units (Appendix A): length R0 = 10 um; a viscosity of 100 is 1000 Pa s and a tension gamma0 of 10 is
    /// 100 Pa um, so that the unit of time is 10 s, of speed 1 um/s.
    ///
    /// All of table A.1 follows, but for the activity: its unit is tension times length, 100 Pa um^2, where the table
    /// has 1000 (with which the active part of the tension would be ten times that of the calculation).
    #[must_use]
    pub fn thesis() -> Self {
        Self { length: 1e-5, viscosity: 10.0, tension: 1e-5 }
    }

    /// One unit of the quantity, in SI.
    #[must_use]
    pub fn unit(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Length => self.length,
            Quantity::Time => self.viscosity * self.length / self.tension,
            Quantity::Speed => self.tension / self.viscosity,
            Quantity::Viscosity => self.viscosity,
            Quantity::Tension => self.tension,
            Quantity::Stress => self.tension / self.length,
            Quantity::Concentration => 1.0 / self.length,
            Quantity::Activity => self.tension * self.length,
            Quantity::Diffusivity => self.tension * self.length / self.viscosity,
        }
    }

    /// A value of the calculation, in SI.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn to_si(&self, quantity: Quantity, value: f64) -> Result<f64, InterfaceError> {
        Ok(finite("the value to convert", value)? * self.unit(quantity))
    }

    /// A value in SI, in the units of the calculation.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn from_si(&self, quantity: Quantity, value: f64) -> Result<f64, InterfaceError> {
        Ok(finite("the value to convert", value)? / self.unit(quantity))
    }
}

#[cfg(test)]
mod tests;
