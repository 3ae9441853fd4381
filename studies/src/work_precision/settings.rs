//! One way of computing a scene.

use motile::ib_core::{AnyKernel, Kernel};
use motile::scene::StepSize;
use motile::setup::{GridMethod, IntegralMethod, Method, Setup};
use motile_cli::run::Summary;

/// How velocities come from forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Flow {
    /// Boundary integrals with shape nodes and elements of the concentration.
    Integrals {
        /// Shape nodes.
        nodes: usize,
        /// Cells of the concentration.
        elements: usize,
    },
    /// A grid of spacing h with markers `ratio` h apart.
    Grid {
        /// Spacing (length).
        h: f64,
        /// Marker spacing over h.
        ratio: f64,
    },
}

/// The preset that is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Preset {
    Default,
    Thesis,
}

/// How the state advances.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stepper {
    Midpoint,
    /// Runge-Kutta-Chebyshev with at most so many stages.
    Chebyshev(usize),
}

/// One way of computing a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Settings {
    pub(crate) preset: Preset,
    pub(crate) flow: Flow,
    pub(crate) kernel: AnyKernel,
    pub(crate) corrected: bool,
    pub(crate) step: StepSize,
    pub(crate) stepper: Stepper,
}

impl Settings {
    /// The default.
    pub(crate) fn preset() -> Self {
        let IntegralMethod { nodes, elements } = IntegralMethod::default();
        Self::integrals(nodes, elements)
    }

    /// Boundary integrals with steps of half the limit.
    pub(crate) fn integrals(nodes: usize, elements: usize) -> Self {
        Self { flow: Flow::Integrals { nodes, elements }, ..Self::grid(0.1, 0.5) }
    }

    /// A grid with the default kernel, its correction, and steps of half the limit.
    pub(crate) fn grid(h: f64, ratio: f64) -> Self {
        Self {
            preset: Preset::Default,
            flow: Flow::Grid { h, ratio },
            kernel: AnyKernel::BSpline4,
            corrected: true,
            step: StepSize::OfLimit(0.5),
            stepper: Stepper::Midpoint,
        }
    }

    /// Cowley's method on a grid of another spacing with other steps.
    pub(crate) fn thesis(h: f64, step: StepSize) -> Self {
        Self {
            preset: Preset::Thesis,
            flow: Flow::Grid { h, ratio: 0.5 },
            kernel: AnyKernel::Peskin4,
            corrected: false,
            step,
            stepper: Stepper::Midpoint,
        }
    }

    pub(crate) fn with_step(self, step: StepSize) -> Self {
        Self { step, ..self }
    }

    pub(crate) fn with_kernel(self, kernel: AnyKernel) -> Self {
        Self { kernel, ..self }
    }

    pub(crate) fn uncorrected(self) -> Self {
        Self { corrected: false, ..self }
    }

    pub(crate) fn with_stepper(self, stepper: Stepper) -> Self {
        Self { stepper, ..self }
    }

    /// The preset's scene with these settings.
    pub(crate) fn setup(&self) -> Setup {
        let base = match self.preset {
            Preset::Default => Setup::default(),
            Preset::Thesis => Setup::thesis(),
        };
        let grid = if let Method::Grid(grid) = base.method { grid } else { GridMethod::default() };
        let method = match self.flow {
            Flow::Integrals { nodes, elements } => Method::Integral(IntegralMethod { nodes, elements }),
            Flow::Grid { h, ratio } => Method::Grid(GridMethod {
                spacing: h,
                marker_spacing: Some(ratio * h),
                kernel: self.kernel,
                corrected: self.corrected,
                ..grid
            }),
        };
        Setup { method, step: self.step, ..base }
    }

    /// The family of methods, one colour of a figure.
    pub(crate) fn family(&self) -> &'static str {
        match self.flow {
            _ if self.preset == Preset::Thesis => "thesis",
            Flow::Integrals { .. } => "boundary integrals",
            Flow::Grid { .. } if self.corrected => "grid, corrected",
            Flow::Grid { .. } => "grid, uncorrected",
        }
    }

    /// For people.
    pub(crate) fn label(&self) -> String {
        let flow = match self.flow {
            Flow::Integrals { nodes, elements } => format!("{nodes} nodes, {elements} elements"),
            Flow::Grid { h, ratio, .. } => format!("h = {h}, ds = {ratio} h, {}", self.kernel.name()),
        };
        let step = match self.step {
            StepSize::Fixed(dt) => format!("dt = {dt}"),
            StepSize::OfLimit(fraction) => format!("dt = {fraction} of the limit"),
            StepSize::Adaptive { tolerance } => format!("adaptive {tolerance:e}"),
            other => format!("{other:?}"),
        };
        let stepper = match self.stepper {
            Stepper::Midpoint => String::new(),
            Stepper::Chebyshev(stages) => format!(", RKC up to {stages} stages"),
        };
        format!("{flow}, {step}{stepper}")
    }

    /// For files.
    pub(crate) fn name(&self) -> String {
        let text = format!("{}_{}", self.family(), self.label());
        let short = text.replace(" of the limit", "L").replace([' ', ','], "").replace('=', "");
        short.replace("uptostages", "")
    }

    /// The columns of a table.
    pub(crate) fn put(&self, summary: &mut Summary) {
        summary.put("family", self.family(), "");
        summary.put("settings", self.label(), "");
    }

    /// True for the preset as it is.
    pub(crate) fn is_preset(&self) -> Option<&'static str> {
        let mut plain = match self.preset {
            Preset::Default => Setup::default(),
            Preset::Thesis => Setup::thesis(),
        };
        if let Method::Grid(grid) = &mut plain.method {
            grid.marker_spacing = Some(0.5 * grid.spacing);
        }
        let midpoint = self.stepper == Stepper::Midpoint;
        (midpoint && self.setup() == plain).then_some(match self.preset {
            Preset::Default => "default",
            Preset::Thesis => "thesis()",
        })
    }
}
