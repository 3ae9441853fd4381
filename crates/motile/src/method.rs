//! Which numerical method computes the flow of a scene.

/// How velocities come from forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Boundary integrals ([`boundary_integral`]): no grid, spectrally accurate; for scenes of interfaces only.
    #[default]
    BoundaryIntegral,
    /// The immersed boundary method on a grid ([`ib_core`]): second order in the grid spacing; for any scene.
    ImmersedBoundary,
}

/// How the immersed boundary method treats an interface between fluids of different viscosity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ContrastMethod {
    /// A jump, by a double layer on the interface ([`ib_core::ImmersedBoundary`]): second order in the grid spacing.
    #[default]
    Sharp,
    /// A smooth viscosity field, thesis section 2.2.4 ([`ib_core::SmearedContrast`]): first order, without mobility
    /// correction.
    Arithmetic,
}
