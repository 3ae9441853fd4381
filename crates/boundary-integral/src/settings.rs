//! How finely and how exactly a flow is computed.

use crate::{BoundaryIntegralError, error::positive};

/// Resolution and accuracy of [`crate::BoundaryIntegral`].
///
/// ```
/// use boundary_integral::Settings;
///
/// let settings = Settings { nodes: 128, tolerance: 1e-12, ..Settings::default() };
/// assert!(settings.warm_start);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Shape nodes of an interface, 16 to 4096: its positions, forces and velocities are kept to the modes
    /// |m| <= (nodes - 1)/2.
    pub nodes: usize,
    /// Relative accuracy of everything that is truncated: images, wall modes, close quadrature and the residual of the
    /// iteration for a viscosity contrast. Between 1e-15 and 1e-3.
    pub tolerance: f64,
    /// Start the iteration for a viscosity contrast from the velocities of the evaluation before. It halves the
    /// iterations and lets results depend on what was computed before, by the order of the tolerance.
    pub warm_start: bool,
    /// Iterations for a viscosity contrast after which an evaluation fails.
    pub most_iterations: usize,
    /// Perimeter of the smallest interface (length) that `medium` assumes until a first evaluation has seen the real
    /// one.
    pub reference_perimeter: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            nodes: 64,
            tolerance: 1e-8,
            warm_start: true,
            most_iterations: 300,
            reference_perimeter: std::f64::consts::TAU,
        }
    }
}

impl Settings {
    pub(crate) fn check(&self) -> Result<(), BoundaryIntegralError> {
        let range = |name, value: f64, least: f64, most: f64| {
            if (least..=most).contains(&value) {
                Ok(())
            } else {
                Err(BoundaryIntegralError::OutOfRange { name, value, least, most })
            }
        };
        range("the number of nodes", self.nodes as f64, 16.0, 4096.0)?;
        range("the tolerance", self.tolerance, 1e-15, 1e-3)?;
        range("the largest number of iterations", self.most_iterations as f64, 1.0, 1e6)?;
        positive("the reference perimeter", self.reference_perimeter)
    }
}
