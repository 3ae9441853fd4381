//! Errors of all functions.

/// A degree, grid, list or angle that cannot be used, with the remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HarmonicsError {
    /// A degree out of range.
    #[error("the degree {degree} is out of range. Use a degree from 1 to {}", crate::LARGEST_DEGREE)]
    Degree {
        /// The degree.
        degree: usize,
    },
    /// A grid too coarse to distinguish all harmonics, or too large.
    #[error("a grid of {rows} x {columns} points is too coarse for degree {degree}. Use at least {} rows and {} \
             columns, and at most {} of each", degree + 1, 2 * degree + 1, crate::grid::MOST)]
    Grid {
        /// The degree.
        degree: usize,
        /// Number of colatitudes.
        rows: usize,
        /// Number of longitudes.
        columns: usize,
    },
    /// A list of another length than needed.
    #[error("{what} have {found} entries, but the grid or degree needs {expected}")]
    Length {
        /// Contents of the list.
        what: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
    /// A number of coefficients that no degree has.
    #[error(
        "{found} coefficients belong to no degree. Use (p + 1)^2 coefficients for degree p, from 1 to {}",
        crate::LARGEST_DEGREE
    )]
    NotSquare {
        /// Entries given.
        found: usize,
    },
    /// An angle that is not finite.
    #[error("the angle {angle} is not a finite number. Use radians")]
    Angle {
        /// The angle.
        angle: f64,
    },
}

/// Refuses lists of another length.
pub(crate) fn same_length(what: &'static str, expected: usize, found: usize) -> Result<(), HarmonicsError> {
    if expected == found { Ok(()) } else { Err(HarmonicsError::Length { what, expected, found }) }
}

/// Refuses degrees out of range.
pub(crate) fn check_degree(degree: usize) -> Result<usize, HarmonicsError> {
    let usable = (1..=crate::LARGEST_DEGREE).contains(&degree);
    if usable { Ok(degree) } else { Err(HarmonicsError::Degree { degree }) }
}

/// Returns the degree p for which `found` is the number of coefficients, (p + 1)^2.
pub(crate) fn degree_of(found: usize) -> Result<usize, HarmonicsError> {
    let degree = found.isqrt().saturating_sub(1);
    let usable = crate::count(degree) == found && (1..=crate::LARGEST_DEGREE).contains(&degree);
    if usable { Ok(degree) } else { Err(HarmonicsError::NotSquare { found }) }
}

/// Refuses angles that are not finite.
pub(crate) fn check_angle(angle: f64) -> Result<f64, HarmonicsError> {
    if angle.is_finite() { Ok(angle) } else { Err(HarmonicsError::Angle { angle }) }
}
