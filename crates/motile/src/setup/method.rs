//! Methods of computing the flow of a scene.

use ib_core::AnyKernel;
use motile_boundary_integrals::Settings;
use serde::{Deserialize, Serialize};

use super::{HarmonicsMethod, checked::Checked};
use crate::SetupError;

/// Fewest and most markers of an interface, which are as many as its elements.
pub(super) const MARKERS: [f64; 2] = [8.0, IntegralMethod::MOST_ELEMENTS as f64];

/// Method that computes velocities from forces. If a method cannot compute a scene, the error names the methods that
/// can.
///
/// | | integral | layers | grid |
/// |---|---|---|---|
/// | region | plane, box, channel; space, tube | box, channel | box, channel |
/// | droplets, shells | spectral | spectral | second order, uncorrected first |
/// | in one another, of other viscosities | spectral | spectral | first order, uncorrected |
/// | rigid bodies | spectral | spectral | |
/// | rigid walls of any shape | spectral | | |
/// | elastic solids | | surface exact, second order | first order, uncorrected |
/// | fibres | free, in the plane, one viscosity | first order | first order |
/// | gels | | second order | second order, uncorrected first |
/// | slip along straight walls | spectral | as droplets; else some cells away | as droplets, some cells away |
/// | friction of the fluid | | | second order, uncorrected first |
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Method {
    /// Boundary integrals ([`motile_boundary_integrals`]): no grid, spectrally accurate.
    Integral(IntegralMethod),
    /// Interfaces and the surfaces of solids as layers, which are exact among each other, and the inner points of
    /// solids on a grid ([`motile_boundary_integrals::ImmersedLayers`]). Without solids the same as boundary integrals.
    Layers(LayersMethod),
    /// The immersed boundary method on a grid ([`ib_core::ImmersedBoundary`], [`ib_core::SmearedContrast`]).
    Grid(GridMethod),
    /// Spherical harmonics ([`space_droplets`]), for droplets in three dimensions without symmetry.
    Harmonics(HarmonicsMethod),
}

impl Default for Method {
    fn default() -> Self {
        Self::Integral(IntegralMethod::default())
    }
}

impl Method {
    /// Returns the method, whatever its settings.
    #[must_use]
    pub fn kind(&self) -> MethodKind {
        match self {
            Self::Integral(_) => MethodKind::Integral,
            Self::Layers(_) => MethodKind::Layers,
            Self::Grid(_) => MethodKind::Grid,
            Self::Harmonics(_) => MethodKind::Harmonics,
        }
    }

    /// Returns the nodes that carry the shape of a body in two dimensions or with an axis; `None` where markers do.
    pub(super) fn nodes(&self) -> Option<usize> {
        match self {
            Self::Integral(IntegralMethod { nodes, .. }) | Self::Layers(LayersMethod { nodes, .. }) => Some(*nodes),
            Self::Grid(_) | Self::Harmonics(_) => None,
        }
    }

    /// Returns the nodes and elements of an interface, or the grid by which its markers are spaced.
    pub(super) fn resolution(&self) -> Result<[usize; 2], &GridMethod> {
        match self {
            Self::Integral(IntegralMethod { nodes, elements }) | Self::Layers(LayersMethod { nodes, elements, .. }) => {
                Ok([*nodes, *elements])
            }
            Self::Grid(grid) => Err(grid),
            // A great circle has waves up to the degree.
            Self::Harmonics(HarmonicsMethod { degree }) => Ok([2 * degree, 2 * degree]),
        }
    }

    /// Returns the grid spacing h (length); `None` without a grid.
    #[must_use]
    pub fn spacing(&self) -> Option<f64> {
        match self {
            Self::Integral(_) | Self::Harmonics(_) => None,
            Self::Layers(layers) => Some(layers.spacing),
            Self::Grid(grid) => Some(grid.spacing),
        }
    }
}

/// A method without its settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MethodKind {
    /// Boundary integrals.
    Integral,
    /// Layers, combined with a grid for the inner points of solids.
    Layers,
    /// Immersed boundaries on a grid.
    Grid,
    /// Spherical harmonics.
    Harmonics,
}

impl MethodKind {
    /// Returns its name: in a scene file, on the command line, and in summaries.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Integral => "integral",
            Self::Layers => "layers",
            Self::Grid => "grid",
            Self::Harmonics => "harmonics",
        }
    }
}

/// Resolution of boundary integrals.
///
/// With the default all observables (speed, shape, stresslet, squirmer coefficients, active region, largest
/// concentration) were within 1 % in boxes at activities of -4 and -5, and in a channel of width 2 at -4 except the
/// stresslet (1.6 %). For the speed alone, a third of it will do ([`crate::recommend`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct IntegralMethod {
    /// Nodes of an interface's shape, 16 to 4096. With fewer than 24, runs warn, because the speed is off by up to two
    /// percent with any number of elements.
    pub nodes: usize,
    /// Elements of an interface, which carry the concentration and end at its markers; at least as many as nodes.
    /// Elastic interfaces, shells and droplets that resist bending have half as many again as nodes if that is more.
    pub elements: usize,
}

impl IntegralMethod {
    /// Fewest and most nodes.
    pub const NODES: [usize; 2] = Settings::NODES;
    /// Most elements.
    pub const MOST_ELEMENTS: usize = 1_000_000;
}

impl Default for IntegralMethod {
    fn default() -> Self {
        Self { nodes: 72, elements: 288 }
    }
}

/// Resolution of layers, and of the grid that complements them.
///
/// The points of solids on a surface are its nodes, 16 or more; inner points are two or more grid spacings apart. A
/// round droplet that touches the walls on both sides starts squeezed a little, with a gap on each side.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct LayersMethod {
    /// Nodes of an interface's shape, 16 to 4096.
    pub nodes: usize,
    /// Elements of an interface, which carry the concentration and end at its markers; at least as many as nodes.
    pub elements: usize,
    /// Grid spacing h (length); the lengths of the region are whole numbers of it. The grid sees the inner points of
    /// solids and other points with forces on them; its spacing is h/2 if there are solids whose forces are spread over
    /// triangles.
    pub spacing: f64,
    /// Regularised delta function: a composite B-spline, with which solids keep their volume.
    pub kernel: AnyKernel,
}

impl Default for LayersMethod {
    fn default() -> Self {
        let IntegralMethod { nodes, elements } = IntegralMethod::default();
        Self { nodes, elements, spacing: 0.05, kernel: AnyKernel::BSpline4 }
    }
}

impl LayersMethod {
    /// Creates the default for a grid of this spacing (length).
    #[must_use]
    pub fn of_spacing(spacing: f64) -> Self {
        Self { spacing, ..Self::default() }
    }
}

/// The immersed boundary method.
///
/// Fluid of other viscosities is a smooth viscosity field (Cowley section 2.2.4, [`ib_core::SmearedContrast`]), and the
/// surface of a solid is smeared over the grid like all its points, as in Cowley. A stiff surface stops the fluid 0.31
/// to 0.44 grid spacings in front of it (with the default kernel). Both are of first order, and neither has a mobility
/// correction; [`Method::Layers`] is more accurate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct GridMethod {
    /// Grid spacing h (length); the lengths of the region are whole numbers of it.
    pub spacing: f64,
    /// Spacing of the markers of interfaces (length); `None` for h/2.
    pub marker_spacing: Option<f64>,
    /// Regularised delta function.
    pub kernel: AnyKernel,
    /// Correction of interface velocities to second order ([`ib_core::ImmersedBoundary`]). Without it, they are of
    /// first order, and runs warn. In a 6 x 6 box at h = R/10, the speed at activities of -2, -3 and -4 is off by -0.5,
    /// 1.2 and 3.1 %, and the stresslet is -48, -30 and 24 instead of -34, -5 and 58. At h = R/5 and -4, it has the
    /// wrong sign. The correction needs markers of equal spacing, see [`active_interface::Motion`], and one viscosity,
    /// and is refused if there are solids.
    pub corrected: bool,
    /// Solver of the Stokes equations on the grid.
    pub solver: GridSolver,
}

impl Default for GridMethod {
    fn default() -> Self {
        let solver = GridSolver::default();
        Self { spacing: 0.05, marker_spacing: None, kernel: AnyKernel::BSpline4, corrected: true, solver }
    }
}

/// Solver of the Stokes equations on a grid.
///
/// Apart from lagged walls, all give the same flow to round-off, so choose by cost; see
/// [`stokes_grid::ProjectionStokes`] for numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum GridSolver {
    /// The streamfunction, which is fastest ([`stokes_grid::PeriodicStokes`], [`stokes_grid::ChannelStokes`]).
    #[default]
    Streamfunction,
    /// Cowley's projection with exact no-slip walls ([`stokes_grid::ProjectionStokes`]).
    Projection,
    /// Cowley's projection as in the thesis: in a channel, wall values come from the solution before
    /// ([`stokes_grid::WallTreatment::Lagged`]), so that fluid slips along walls at first order in the time step.
    ///
    /// Walls are exact all the same if droplets have another viscosity, or if solids damp: flows of these are iterated,
    /// and the iteration needs solutions that do not depend on each other. In a box there are no walls, and nothing
    /// lags.
    LaggedProjection,
}

impl GridMethod {
    /// Creates Cowley's grid: the projection method with lagged walls, Peskin's 4-point function, no mobility
    /// correction, h = 0.05, markers h/2 apart.
    #[must_use]
    pub fn thesis() -> Self {
        Self { kernel: AnyKernel::Peskin4, corrected: false, solver: GridSolver::LaggedProjection, ..Self::default() }
    }

    /// Creates the default on a grid of this spacing (length).
    #[must_use]
    pub fn of_spacing(spacing: f64) -> Self {
        Self { spacing, ..Self::default() }
    }

    /// Creates the method without the mobility correction, as viscosity contrasts and solids need it, on a grid of this
    /// spacing (length).
    #[must_use]
    pub fn uncorrected(spacing: f64) -> Self {
        Self { corrected: false, ..Self::of_spacing(spacing) }
    }
}

impl IntegralMethod {
    pub(super) fn check(&self, place: &str) -> Result<(), SetupError> {
        let (checked, Self { nodes, elements }) = (Checked { place }, *self);
        let [least, most] = Self::NODES;
        let remedy = format!("use a number from {least} to {most}");
        checked.refuse_if(!(least..=most).contains(&nodes), "nodes", nodes, remedy)?;
        let remedy = format!("use a number from {nodes}, that of the nodes, to {}", MARKERS[1]);
        checked.refuse_if(elements < nodes || elements as f64 > MARKERS[1], "elements", elements, remedy)
    }
}
