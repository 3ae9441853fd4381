//! What can go wrong with an elastic solid.

/// An error of this crate, with the offending values and the remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// A quantity that must be positive and finite is not.
    #[error("{name} is {value}: give a positive finite number")]
    NotPositive {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity outside its range.
    #[error("{name} is {value}: give a number from {minimum} to {maximum}")]
    OutOfRange {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value.
        minimum: f64,
        /// Largest value.
        maximum: f64,
    },
    /// A bulk modulus too small for the energy.
    #[error("bulk modulus {bulk} with shear modulus {shear}: this energy needs a bulk modulus above {minimum}")]
    BulkTooSmall {
        /// The bulk modulus (force per length).
        bulk: f64,
        /// The shear modulus (force per length).
        shear: f64,
        /// What it must be above (force per length).
        minimum: f64,
    },
    /// A deformation that turns the material inside out, flattens it, or is not finite.
    #[error(
        "the deformation gradient [[{a11}, {a12}], [{a21}, {a22}]] has the determinant {jacobian}: it must be positive"
    )]
    NotOrientationPreserving {
        /// Entry 11.
        a11: f64,
        /// Entry 12.
        a12: f64,
        /// Entry 21.
        a21: f64,
        /// Entry 22.
        a22: f64,
        /// Determinant.
        jacobian: f64,
    },
}

/// `value` if it is positive and finite.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<f64, SolidError> {
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err(SolidError::NotPositive { name, value }) }
}

/// `value` if it lies in the closed range.
pub(crate) fn within(name: &'static str, value: f64, minimum: f64, maximum: f64) -> Result<f64, SolidError> {
    if value >= minimum && value <= maximum {
        Ok(value)
    } else {
        Err(SolidError::OutOfRange { name, value, minimum, maximum })
    }
}
