//! Conversion between the units of a calculation and SI.

use motile_base::{finite, positive};

use crate::InterfaceError;

/// Physical quantity of a number that is converted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
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
    /// Returns the SI unit of the quantity, as it is written.
    #[must_use]
    pub fn unit(self) -> &'static str {
        self.dimension().0
    }

    /// SI unit, and the powers of length, viscosity and tension whose product has the dimension of the quantity.
    fn dimension(self) -> (&'static str, [i32; 3]) {
        match self {
            Self::Length => ("m", [1, 0, 0]),
            Self::Time => ("s", [1, 1, -1]),
            Self::Speed => ("m/s", [0, -1, 1]),
            Self::Viscosity => ("Pa s", [0, 1, 0]),
            Self::Tension => ("N/m", [0, 0, 1]),
            Self::Stress => ("Pa", [-1, 0, 1]),
            Self::Concentration => ("1/m", [-1, 0, 0]),
            Self::Activity => ("N", [1, 0, 1]),
            Self::Diffusivity => ("m^2/s", [1, -1, 1]),
        }
    }
}

/// The units of a calculation: the units of length, viscosity and tension are chosen, and all others follow.
///
/// ```text
/// time = viscosity length / tension    speed = tension / viscosity          stress = tension / length
/// concentration = 1 / length           activity = tension length            diffusivity = tension length / viscosity
/// ```
/// ```
/// use active_interface::{Units, Quantity};
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
    /// Creates units of length (m), viscosity (Pa s) and tension (N/m).
    ///
    /// # Errors
    /// Returns an error for values that are not positive.
    pub fn new(length: f64, viscosity: f64, tension: f64) -> Result<Self, InterfaceError> {
        Ok(Self {
            length: positive("the unit of length", length)?,
            viscosity: positive("the unit of viscosity", viscosity)?,
            tension: positive("the unit of tension", tension)?,
        })
    }

    /// Creates Cowley's units (Appendix A): length R0 = 10 um. A viscosity of 100 is 1000 Pa s and a tension gamma0 of
    /// 10 is 100 Pa um, so that the unit of time is 10 s, of speed 1 um/s.
    ///
    /// All of table A.1 follows, except for the activity: its unit is tension times length, 100 Pa um^2, where the
    /// table has 1000 (with which the active part of the tension would be ten times as large as in the calculation).
    #[must_use]
    pub fn thesis() -> Self {
        Self { length: 1e-5, viscosity: 10.0, tension: 1e-5 }
    }

    /// Returns the unit of the quantity in the calculation, in SI.
    #[must_use]
    pub fn unit(&self, quantity: Quantity) -> f64 {
        let [length, viscosity, tension] = quantity.dimension().1;
        self.length.powi(length) * self.viscosity.powi(viscosity) * self.tension.powi(tension)
    }

    /// Returns the value of the calculation, in SI.
    ///
    /// # Errors
    /// Returns an error for a value that is not finite.
    pub fn to_si(&self, quantity: Quantity, value: f64) -> Result<f64, InterfaceError> {
        Ok(finite("the value to convert", value)? * self.unit(quantity))
    }

    /// Returns the value in SI, in the units of the calculation.
    ///
    /// # Errors
    /// Returns an error for a value that is not finite.
    pub fn from_si(&self, quantity: Quantity, value: f64) -> Result<f64, InterfaceError> {
        Ok(finite("the value to convert", value)? / self.unit(quantity))
    }
}

#[cfg(test)]
mod tests;
