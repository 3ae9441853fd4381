//! Resolution and accuracy of layers.

use motile_base::{InputError, within};

/// Resolution and accuracy of [`crate::InterfaceFlow`].
///
/// ```
/// use stokes_boundary_integrals::Settings;
///
/// let settings = Settings { nodes: 128, tolerance: 1e-12, ..Settings::default() };
/// assert!(settings.warm_start);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Nodes of a curve ([`Settings::NODES`]): positions, forces and velocities have the modes |m| <= (nodes - 1)/2.
    pub nodes: usize,
    /// Relative accuracy of everything that is truncated, between 1e-15 and 1e-3: images, wall modes, close quadrature
    /// and the residual of the iteration for a viscosity contrast.
    pub tolerance: f64,
    /// Start of the iteration for a viscosity contrast from the velocities of the solution before. It halves the
    /// iterations and lets results depend on earlier ones, by the order of the tolerance.
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
    /// Fewest and most nodes of a curve: 16 carry waves up to 7, and the Stokeslets stored between 4096 take 200 MB.
    pub const NODES: [usize; 2] = [16, 4096];

    /// Largest ratio of the periods of a box: the rows of images of a pair of nodes grow in proportion to it, to 60 at
    /// a tolerance of 1e-8.
    pub const LARGEST_PERIOD_RATIO: f64 = 20.0;

    /// Checks that the numbers of nodes and iterations are within their ranges.
    ///
    /// # Errors
    /// Returns [`InputError::OutOfRange`] for the first number that is not.
    pub fn check(&self) -> Result<(), InputError> {
        let [least, most] = Self::NODES.map(|nodes| nodes as f64);
        within("the number of nodes of a curve", self.nodes as f64, least, most)?;
        within("the largest number of iterations", self.most_iterations as f64, 1.0, 1e6).map(drop)
    }
}

/// Symmetry of the [`crate::SingleLayer`] between nodes that are close to each other, where the corrections of the
/// quadrature decide on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Symmetry {
    /// Symmetric to the accuracy to which the nodes resolve the forces: each direction is corrected by itself, so that
    /// velocities are spectrally accurate at every node.
    ToResolution,
    /// Symmetric to round-off: corrections are computed at the nodes of the curve whose nodes are closer together, and
    /// the other curve gets the transpose; of two with the same spacing each gets the mean of both, so that a mirrored
    /// state has the mirrored flow. Accurate for integrals over smooth fields at the nodes, such as power.
    ToRoundOff,
}
