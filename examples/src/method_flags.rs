//! Command line flags that say how a scene is computed.

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use motile::ib_core::{AnyKernel, StepSize};
use motile::{Contrast, GridMethod, IntegralMethod, Method, MethodKind, RepulsionSetup, Setup};

use crate::DropletFlags;
use crate::flags::RADIUS;
use crate::parse::{cells, kernel, nodes, one_of, pair, positive, time_step};

/// Settings that go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Preset {
    /// Those of Cowley, to reproduce its results.
    Thesis,
    /// Accurate ones.
    Accurate,
}

/// How the flow is computed.
pub(crate) const METHODS: [(&str, &str, MethodKind); 2] = [
    ("boundary-integral", "Without a grid", MethodKind::Integral),
    ("immersed-boundary", "On a grid", MethodKind::Grid),
];
/// How a grid treats two viscosities.
const CONTRASTS: [(&str, &str, Contrast); 2] = [
    ("sharp", "A jump at the interface", Contrast::Sharp),
    ("arithmetic", "A smooth viscosity, as in Cowley", Contrast::Arithmetic),
];

/// The numerical method.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct MethodFlags {
    /// How the flow is computed; without it on a grid if a flag of the grid is given, and without a grid otherwise
    #[arg(long, value_parser = one_of(&METHODS))]
    pub method: Option<MethodKind>,
    /// Grid spacing h (R0); without a grid, that of pictures [default: 0.05]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub spacing: Option<f64>,
    /// Time step, 'auto' (half of what is stable), 'adaptive' or 'adaptive:TOLERANCE'; without it the preset's
    #[arg(long, value_parser = time_step, allow_hyphen_values = true)]
    pub dt: Option<StepSize>,
    /// Time to be simulated
    #[arg(long, default_value_t = 60.0, value_parser = positive, allow_hyphen_values = true)]
    pub time: f64,
    /// Regularised delta function of the grid (peskin4, roma3, gaussian6, bspline3 to bspline6); without it the
    /// preset's
    #[arg(long, value_parser = kernel)]
    pub kernel: Option<AnyKernel>,
    /// How a grid treats two viscosities; without it the preset's
    #[arg(long, value_parser = one_of(&CONTRASTS))]
    pub contrast_method: Option<Contrast>,
    /// Nodes of the interface without a grid or beside elastic walls [default: 72]
    #[arg(long, value_parser = nodes, allow_hyphen_values = true)]
    pub nodes: Option<usize>,
    /// Cells of the concentration without a grid [default: 288]
    #[arg(long, value_parser = cells, allow_hyphen_values = true)]
    pub concentration_cells: Option<usize>,
    /// Strength and range of a short-range repulsion between interfaces, solids and walls; without it there is none
    #[arg(long, value_name = "STRENGTH,RANGE", value_parser = pair, allow_hyphen_values = true)]
    pub repulsion: Option<[f64; 2]>,
    /// Gap (R0) below which the run ends
    #[arg(long, value_name = "GAP", allow_hyphen_values = true)]
    pub least_gap: Option<f64>,
    /// Settings that go together
    #[arg(long, value_enum, default_value_t = Preset::Accurate)]
    pub preset: Preset,
}

impl MethodFlags {
    /// Settings that go together, or the scene of a file, with these flags and those of the droplet in place of its
    /// entries.
    ///
    /// # Errors
    /// A flag that the method has no use for; fewer cells than nodes; a time step longer than the run.
    pub fn setup(&self, droplet: &DropletFlags, file: Option<Setup>) -> Result<Setup> {
        let mut setup = file.unwrap_or_else(|| match self.preset {
            Preset::Thesis => Setup::thesis(),
            Preset::Accurate => Setup::default(),
        });
        let preset = if self.preset == Preset::Thesis { GridMethod::thesis() } else { GridMethod::default() };
        let (grid, integral) = match setup.method {
            Method::Grid(grid) => (grid, IntegralMethod::default()),
            Method::Integral(integral) => (preset, integral),
        };
        setup.method = match self.kind(setup.method.kind()) {
            MethodKind::Grid => Method::Grid(self.grid(grid)?),
            MethodKind::Integral => Method::Integral(self.integral(integral)?),
        };
        setup.step = self.dt.unwrap_or(setup.step);
        let repulsion = self.repulsion.map(|[strength, range]| RepulsionSetup { strength, range });
        setup.repulsion = repulsion.or(setup.repulsion);
        setup.least_gap = self.least_gap.or(setup.least_gap);
        if let StepSize::Fixed(dt) = setup.step {
            ensure!(dt <= self.time, "--dt {dt} is longer than --time {}: give a smaller time step", self.time);
        }
        droplet.apply(&mut setup)?;
        settle_contrast(&mut setup);
        Ok(setup)
    }

    /// How the flow is computed: as `--method` says, or else on a grid if the preset is Cowley's or a flag is given
    /// that only a grid has a use for, without a grid if one of the nodes is, and as `base` otherwise.
    fn kind(&self, base: MethodKind) -> MethodKind {
        let for_nodes = self.nodes.is_some() || self.concentration_cells.is_some();
        let for_grid = self.spacing.is_some() || self.kernel.is_some() || self.contrast_method.is_some();
        match self.method {
            Some(kind) => kind,
            None if self.preset == Preset::Thesis || (for_grid && !for_nodes) => MethodKind::Grid,
            None if for_nodes => MethodKind::Integral,
            None => base,
        }
    }

    fn grid(&self, base: GridMethod) -> Result<GridMethod> {
        for (flag, value) in [("nodes", self.nodes), ("concentration-cells", self.concentration_cells)] {
            ensure!(
                value.is_none(),
                "--{flag} means nothing on a grid: leave it out or give --method boundary-integral"
            );
        }
        let spacing = self.spacing.unwrap_or(base.spacing);
        let coarse = self.spacing.is_some_and(|spacing| spacing > 0.25 * RADIUS);
        ensure!(!coarse, "--spacing {spacing} is too coarse for a droplet of radius 1: give at most 0.25");
        Ok(GridMethod {
            spacing,
            kernel: self.kernel.unwrap_or(base.kernel),
            contrast: self.contrast_method.unwrap_or(base.contrast),
            ..base
        })
    }

    fn integral(&self, base: IntegralMethod) -> Result<IntegralMethod> {
        for (flag, given) in [("kernel", self.kernel.is_some()), ("contrast-method", self.contrast_method.is_some())] {
            ensure!(!given, "--{flag} means nothing without a grid: leave it out or give --method immersed-boundary");
        }
        let nodes = self.nodes.unwrap_or(base.nodes);
        let cells = self.concentration_cells.unwrap_or(base.cells.max(4 * nodes));
        ensure!(
            cells >= nodes,
            "--concentration-cells {cells} are fewer than the {nodes} nodes: give at least as many"
        );
        Ok(IntegralMethod { nodes, cells })
    }

    /// The spacing (R0) of the grid, or of pictures where there is none.
    #[must_use]
    pub fn spacing(&self, setup: &Setup) -> f64 {
        match setup.method {
            Method::Grid(grid) => grid.spacing,
            Method::Integral(_) => self.spacing.unwrap_or(GridMethod::default().spacing),
        }
    }
}

/// Leaves the mobility correction out where an arithmetic contrast of different viscosities has none.
pub fn settle_contrast(setup: &mut Setup) {
    let differs = setup.droplets.iter().any(|d| d.viscosity.is_some_and(|inside| inside != setup.viscosity));
    if let Method::Grid(grid) = &mut setup.method
        && grid.contrast == Contrast::Arithmetic
        && differs
    {
        grid.corrected = false;
    }
}
