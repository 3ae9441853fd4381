//! How the flow of a scene is computed.

use ib_core::AnyKernel;
use serde::{Deserialize, Serialize};

/// How velocities come from forces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Method {
    /// Boundary integrals ([`boundary_integral`]): no grid, spectrally accurate; for scenes of interfaces only.
    Integral(IntegralMethod),
    /// The immersed boundary method on a grid ([`ib_core`]): second order in the grid spacing; for any scene in a box
    /// or a channel.
    Grid(GridMethod),
}

impl Default for Method {
    fn default() -> Self {
        Self::Integral(IntegralMethod::default())
    }
}

impl Method {
    /// Which method it is, whatever its settings.
    #[must_use]
    pub fn kind(&self) -> MethodKind {
        match self {
            Self::Integral(_) => MethodKind::Integral,
            Self::Grid(_) => MethodKind::Grid,
        }
    }
}

/// A method without its settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MethodKind {
    /// Boundary integrals.
    Integral,
    /// Immersed boundaries on a grid.
    Grid,
}

/// Resolution of boundary integrals.
///
/// With the default all observables (speed, shape, stresslet, squirmer coefficients, active region, largest
/// concentration) were within a per cent in boxes at activities of -4 and -5, and in a channel of width 2 at -4 except
/// the stresslet (1.6 per cent). For the speed alone a third of it will do ([`crate::recommend`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct IntegralMethod {
    /// Nodes of an interface's shape, 16 to 4096.
    pub nodes: usize,
    /// Cells of the concentration along an interface, which are its markers; at least as many as nodes.
    pub cells: usize,
}

impl IntegralMethod {
    /// Fewest and most nodes.
    pub const NODES: [usize; 2] = [16, 4096];
    /// Most cells.
    pub const MOST_CELLS: usize = 1_000_000;
}

impl Default for IntegralMethod {
    fn default() -> Self {
        Self { nodes: 72, cells: 288 }
    }
}

/// The immersed boundary method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct GridMethod {
    /// Grid spacing h (length); the lengths of the region are whole numbers of it.
    pub spacing: f64,
    /// Spacing of the markers of interfaces (length); `None` for h/2.
    pub marker_spacing: Option<f64>,
    /// Regularised delta function.
    pub kernel: AnyKernel,
    /// Whether interface velocities are corrected to second order ([`ib_core::ImmersedBoundary`]). Needs markers of
    /// equal spacing ([`crate::MarkerMotion::Equidistributed`]), and a sharp contrast where viscosities differ.
    /// Concerns scenes without layers only.
    pub corrected: bool,
    /// Whether modes of an interface that are shorter than the kernel are filtered after each step; without it they
    /// grow in long runs. Concerns markers of equal spacing only.
    pub filter: bool,
    /// How interfaces between fluids of different viscosity are treated.
    pub contrast: Contrast,
    /// Resolution of interfaces where they are layers: where surfaces of solids are ([`crate::Surface::Layer`]), beside
    /// rigid bodies, and where interfaces between different viscosities lie in one another. Takes the place of
    /// corrections, filter and marker spacing; of the spacing h, scenes without solids then have nothing to see.
    /// Concerns no other scenes.
    pub layers: IntegralMethod,
}

impl Default for GridMethod {
    fn default() -> Self {
        Self {
            spacing: 0.05,
            marker_spacing: None,
            kernel: AnyKernel::BSpline4,
            corrected: true,
            filter: true,
            contrast: Contrast::Sharp,
            layers: IntegralMethod::default(),
        }
    }
}

impl GridMethod {
    /// Cowley's grid: Peskin's 4-point function, no mobility correction, a smooth viscosity field, h = 0.05, markers
    /// h/2 apart.
    #[must_use]
    pub fn thesis() -> Self {
        Self {
            kernel: AnyKernel::Peskin4,
            corrected: false,
            filter: false,
            contrast: Contrast::Arithmetic,
            ..Self::default()
        }
    }

    /// The default on a grid of this spacing (length).
    #[must_use]
    pub fn of_spacing(spacing: f64) -> Self {
        Self { spacing, ..Self::default() }
    }
}

/// How the immersed boundary method treats an interface between fluids of different viscosity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contrast {
    /// A jump, by a double layer on the interface ([`ib_core::ImmersedBoundary`]): second order in the grid spacing.
    #[default]
    Sharp,
    /// A smooth viscosity field, Cowley section 2.2.4 ([`ib_core::SmearedContrast`]): first order, without mobility
    /// correction.
    Arithmetic,
}
