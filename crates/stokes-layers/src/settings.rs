//! How finely and how exactly layers are computed.

use input_checks::{InputError, within};

/// Resolution and accuracy of [`crate::InterfaceFlow`].
///
/// ```
/// use stokes_layers::Settings;
///
/// let settings = Settings { nodes: 128, tolerance: 1e-12, ..Settings::default() };
/// assert!(settings.warm_start);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Nodes of a curve, 16 to 4096: positions, forces and velocities are kept to the modes |m| <= (nodes - 1)/2.
    pub nodes: usize,
    /// Relative accuracy of everything that is truncated: images, wall modes, close quadrature and the residual of the
    /// iteration for a viscosity contrast. Between 1e-15 and 1e-3.
    pub tolerance: f64,
    /// Start the iteration for a viscosity contrast from the velocities of the solution before. It halves the
    /// iterations and lets results depend on what was computed before, by the order of the tolerance.
    pub warm_start: bool,
    /// Iterations for a viscosity contrast after which a solution fails.
    pub most_iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { nodes: 64, tolerance: 1e-8, warm_start: true, most_iterations: 300 }
    }
}

impl Settings {
    pub(crate) fn check(&self) -> Result<(), InputError> {
        within("the number of nodes", self.nodes as f64, 16.0, 4096.0)?;
        within("the tolerance", self.tolerance, 1e-15, 1e-3)?;
        within("the largest number of iterations", self.most_iterations as f64, 1.0, 1e6).map(drop)
    }
}
