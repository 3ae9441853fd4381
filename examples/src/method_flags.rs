//! Command line flags that say how a scene is computed.

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use motile::{
    ContrastMethod, Method, Swimmer,
    ib_core::{AnyKernel, StepSize},
};

use crate::flags::RADIUS;
use crate::parse::{TimeStep, count, kernel, positive};

/// Most cells of a grid in a direction.
const MOST_CELLS: f64 = 4096.0;
/// Automatic time steps, as a fraction of the stability limit.
const STEP_OF_LIMIT: f64 = 0.5;

/// Settings that go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Preset {
    /// Those of the thesis, to reproduce its results.
    Thesis,
    /// Accurate ones.
    Accurate,
}

/// How the flow is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FlowMethod {
    /// Without a grid.
    BoundaryIntegral,
    /// On a grid.
    ImmersedBoundary,
}

/// How a grid treats two viscosities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Contrast {
    /// A jump at the interface.
    Sharp,
    /// A smooth viscosity, as in the thesis.
    Arithmetic,
}

/// The numerical method.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct MethodFlags {
    /// How the flow is computed; without it on a grid if a flag of the grid is given, and without a grid otherwise
    #[arg(long, value_enum)]
    pub method: Option<FlowMethod>,
    /// Grid spacing h (R0); without a grid, that of pictures [default: 0.05]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub spacing: Option<f64>,
    /// Time step, 'auto' (half of what is stable), 'adaptive' or 'adaptive:TOLERANCE'; without it the preset's
    #[arg(long, allow_hyphen_values = true)]
    pub dt: Option<TimeStep>,
    /// Time to be simulated
    #[arg(long, default_value_t = 60.0, value_parser = positive, allow_hyphen_values = true)]
    pub time: f64,
    /// Regularised delta function of the grid (peskin4, roma3, gaussian6, bspline3 to bspline6); without it the
    /// preset's
    #[arg(long, value_parser = kernel)]
    pub kernel: Option<AnyKernel>,
    /// How a grid treats two viscosities; without it the preset's
    #[arg(long, value_enum)]
    pub contrast_method: Option<Contrast>,
    /// Nodes of the interface without a grid [default: 72]
    #[arg(long, value_parser = count, allow_hyphen_values = true)]
    pub nodes: Option<usize>,
    /// Cells of the concentration without a grid [default: 288]
    #[arg(long, value_parser = count, allow_hyphen_values = true)]
    pub concentration_cells: Option<usize>,
    /// Settings that go together
    #[arg(long, value_enum, default_value_t = Preset::Accurate)]
    pub preset: Preset,
}

impl MethodFlags {
    /// How the flow is computed: as `--method` says, or else on a grid if the preset is the thesis' or a flag is given
    /// that only a grid has a use for, and without a grid otherwise.
    #[must_use]
    pub fn method(&self) -> Method {
        let for_nodes = self.nodes.is_some() || self.concentration_cells.is_some();
        let for_grid = self.spacing.is_some() || self.kernel.is_some() || self.contrast_method.is_some();
        match self.method {
            Some(FlowMethod::BoundaryIntegral) => Method::BoundaryIntegral,
            Some(FlowMethod::ImmersedBoundary) => Method::ImmersedBoundary,
            None if self.preset == Preset::Thesis || (for_grid && !for_nodes) => Method::ImmersedBoundary,
            None => Method::BoundaryIntegral,
        }
    }

    /// The grid spacing (R0).
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing.unwrap_or(Swimmer::default().spacing)
    }

    /// A swimmer by this method, whose other parameters are still to be set.
    #[must_use]
    pub fn swimmer(&self) -> Swimmer {
        let base = match self.preset {
            Preset::Thesis => Swimmer::thesis(),
            Preset::Accurate => Swimmer::default(),
        };
        let contrast = self.contrast_method.map(|contrast| match contrast {
            Contrast::Sharp => ContrastMethod::Sharp,
            Contrast::Arithmetic => ContrastMethod::Arithmetic,
        });
        let nodes = self.nodes.unwrap_or(base.nodes);
        Swimmer {
            method: self.method(),
            contrast: contrast.unwrap_or(base.contrast),
            spacing: self.spacing(),
            kernel: self.kernel.unwrap_or(base.kernel),
            nodes,
            concentration_cells: self.concentration_cells.unwrap_or(base.concentration_cells.max(4 * nodes)),
            step: self.step(),
            ..base
        }
    }

    /// The time step asked for: by `--dt`, or else the preset's (1e-3 for the thesis').
    #[must_use]
    pub fn step(&self) -> StepSize {
        match (self.dt, self.preset) {
            (Some(TimeStep::Fixed(dt)), _) => StepSize::Fixed(dt),
            (Some(TimeStep::Adaptive(tolerance)), _) => StepSize::Adaptive { tolerance },
            (None, Preset::Thesis) => Swimmer::thesis().step,
            (Some(TimeStep::Auto), _) | (None, Preset::Accurate) => StepSize::OfLimit(STEP_OF_LIMIT),
        }
    }

    /// Refuses what does not fit together, for a region with sides of these lengths (R0), each with the name of its
    /// flag.
    ///
    /// # Errors
    /// On a grid, a spacing that does not divide a length ([`MethodFlags::cells`]); fewer cells than nodes; a flag that
    /// the method has no use for; a time step that is too long or too short for the run.
    pub fn check(&self, sides: &[(f64, &str)]) -> Result<()> {
        match self.method() {
            Method::ImmersedBoundary => {
                let unused = [("nodes", self.nodes), ("concentration-cells", self.concentration_cells)];
                for (flag, value) in unused {
                    ensure!(
                        value.is_none(),
                        "--{flag} means nothing on a grid: leave it out or give --method boundary-integral"
                    );
                }
                for &(side, flag) in sides {
                    self.cells(side, flag)?;
                }
            }
            Method::BoundaryIntegral => {
                let unused = [("kernel", self.kernel.is_some()), ("contrast-method", self.contrast_method.is_some())];
                for (flag, given) in unused {
                    ensure!(
                        !given,
                        "--{flag} means nothing without a grid: leave it out or give --method immersed-boundary"
                    );
                }
                let Swimmer { nodes, concentration_cells, .. } = self.swimmer();
                ensure!(
                    concentration_cells >= nodes,
                    "--concentration-cells {concentration_cells} are fewer than the {nodes} nodes: give at least as many"
                );
            }
        }
        if let StepSize::Fixed(dt) = self.step() {
            let (time, steps) = (self.time, self.time / dt);
            ensure!(dt <= time, "--dt {dt} is longer than --time {time}: give a smaller time step");
            ensure!(steps <= 1e9, "--time {time} takes {steps:.1e} steps of --dt {dt}: give a larger time step");
        }
        Ok(())
    }

    /// The number of cells over `length` (R0), the value of flag `flag`.
    ///
    /// # Errors
    /// A spacing that does not divide the length, that is too coarse for a droplet (less than four cells a radius), or
    /// that makes for more than 4096 cells.
    pub fn cells(&self, length: f64, flag: &str) -> Result<usize> {
        let h = self.spacing();
        ensure!(h <= 0.25 * RADIUS, "--spacing {h} is too coarse for a droplet of radius 1: give at most 0.25");
        let cells = length / h;
        ensure!(
            cells <= MOST_CELLS,
            "--{flag} {length} at --spacing {h} makes {cells:.0} cells, more than {MOST_CELLS}: give a larger spacing"
        );
        let whole = cells.round();
        let fitting = (whole * h * 1e9).round() / 1e9;
        ensure!(
            (cells - whole).abs() <= 1e-9 * whole,
            "--{flag} {length} is {cells:.3} cells of --spacing {h}: give --{flag} {fitting} or a spacing that divides it"
        );
        Ok(whole as usize)
    }
}
