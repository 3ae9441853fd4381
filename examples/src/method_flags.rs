//! Command line flags that say how a scene is computed.

use anyhow::{Result, bail, ensure};
use clap::{Args, ValueEnum};
use motile::ib_core::AnyKernel;
use motile::scene::gap::Repulsion;
use motile::scene::{StepSize, integrator::IntegratorKind};
use motile::setup::{GridMethod, IntegralMethod, LayersMethod, Method, MethodKind, Setup};

use crate::DropletFlags;
use crate::parse::{elements, kernel, nodes, one_of, pair, positive, time_step};

/// Settings that go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Preset {
    /// Those of Cowley, to reproduce its results.
    Thesis,
    /// Accurate ones.
    Accurate,
}

/// How the flow is computed.
pub(crate) const METHODS: [(&str, &str, MethodKind); 3] = [
    (MethodKind::Integral.name(), "Without a grid", MethodKind::Integral),
    (
        MethodKind::Layers.name(),
        "Interfaces and surfaces of solids exact, the inside of solids on a grid",
        MethodKind::Layers,
    ),
    (MethodKind::Grid.name(), "On a grid", MethodKind::Grid),
];

const INTEGRATORS: [(&str, &str, IntegratorKind); 3] = [
    ("midpoint", "Two stages a step", IntegratorKind::Midpoint),
    ("runge-kutta-chebyshev", "Long steps of many stages, for stiff solids", IntegratorKind::RungeKuttaChebyshev),
    ("runge-kutta", "Fourth order, without particles", IntegratorKind::RungeKutta),
];

/// The numerical method.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct MethodFlags {
    /// How the flow is computed; without it as the scene says. No other flag but --preset changes it
    #[arg(long, value_parser = one_of(&METHODS))]
    pub method: Option<MethodKind>,
    /// Grid spacing h (R0); without a grid, that of pictures [default: a twentieth of the droplet's radius]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub spacing: Option<f64>,
    /// Time step, 'auto' (half of what is stable), 'adaptive' or 'adaptive:TOLERANCE'; without it the preset's
    #[arg(long, value_parser = time_step, allow_hyphen_values = true)]
    pub dt: Option<StepSize>,
    /// Integrator; without it the scene's, which is the midpoint rule unless a file says otherwise
    #[arg(long, value_parser = one_of(&INTEGRATORS))]
    pub integrator: Option<IntegratorKind>,
    /// Time to be simulated
    #[arg(long, default_value_t = 60.0, value_parser = positive, allow_hyphen_values = true)]
    pub time: f64,
    /// Regularised delta function of the grid (peskin4, roma3, gaussian6, bspline3 to bspline6); without it the
    /// preset's
    #[arg(long, value_parser = kernel)]
    pub kernel: Option<AnyKernel>,
    /// Nodes of the interface without a grid or among layers [default: 72]
    #[arg(long, value_parser = nodes, allow_hyphen_values = true)]
    pub nodes: Option<usize>,
    /// Cells of the concentration without a grid or among layers [default: 288]
    #[arg(long, value_parser = elements, allow_hyphen_values = true)]
    pub elements: Option<usize>,
    /// Strength and range of a short-range repulsion between interfaces, solids and walls; without it there is none
    #[arg(long, value_name = "STRENGTH,RANGE", value_parser = pair, allow_hyphen_values = true)]
    pub repulsion: Option<[f64; 2]>,
    /// Gap (R0) below which the run ends
    #[arg(long, value_name = "GAP", allow_hyphen_values = true)]
    pub least_gap: Option<f64>,
    /// Hold the scene, which has to be its own mirror image in y = 0, symmetric
    #[arg(long)]
    pub mirror_symmetric: bool,
    /// Settings that go together
    #[arg(long, value_enum, default_value_t = Preset::Accurate)]
    pub preset: Preset,
}

impl MethodFlags {
    /// Settings that go together, or the scene of a file, with these flags and those of the droplet in place of its
    /// entries.
    ///
    /// # Errors
    /// A flag that the method has no use for; fewer elements than nodes; a time step longer than the run.
    pub fn setup(&self, droplet: &DropletFlags, file: Option<Setup>) -> Result<Setup> {
        let mut setup = file.unwrap_or_else(|| match self.preset {
            Preset::Thesis => Setup::thesis(),
            Preset::Accurate => Setup::default(),
        });
        // The droplets of a file may be of any size.
        let radius = setup.length_scale();
        let (grid, layers) = (GridMethod::default(), LayersMethod::default());
        let grid = GridMethod { spacing: radius * grid.spacing, ..grid };
        let layers = LayersMethod { spacing: radius * layers.spacing, ..layers };
        setup.method = match (self.kind(setup.method.kind()), setup.method) {
            (MethodKind::Integral, Method::Integral(base)) => Method::Integral(self.integral(base)?),
            (MethodKind::Integral, _) => Method::Integral(self.integral(IntegralMethod::default())?),
            (MethodKind::Layers, Method::Layers(base)) => Method::Layers(self.layers(base, radius)?),
            (MethodKind::Layers, _) => Method::Layers(self.layers(layers, radius)?),
            (MethodKind::Grid, Method::Grid(base)) => Method::Grid(self.grid(base, radius)?),
            (MethodKind::Grid, _) if self.preset == Preset::Thesis => {
                Method::Grid(self.grid(GridMethod::thesis(), radius)?)
            }
            (MethodKind::Grid, _) => Method::Grid(self.grid(grid, radius)?),
            (kind, _) => bail!("--method {}: there are no flags for it, give a scene file", kind.name()),
        };
        setup.step = self.dt.unwrap_or(setup.step);
        setup.integrator = self.integrator.unwrap_or(setup.integrator);
        if let Some([strength, range]) = self.repulsion {
            setup.repulsion = Some(Repulsion::new(strength, range)?);
        }
        setup.least_gap = self.least_gap.or(setup.least_gap);
        setup.mirror_symmetric |= self.mirror_symmetric;
        if let StepSize::Fixed(dt) = setup.step {
            ensure!(dt <= self.time, "--dt {dt} is longer than --time {}: give a smaller time step", self.time);
        }
        droplet.apply(&mut setup)?;
        let differs = setup.droplets.iter().any(|d| d.viscosity.is_some_and(|inside| inside != setup.viscosity));
        let corrected = matches!(setup.method, Method::Grid(GridMethod { corrected: true, .. }));
        ensure!(
            !(differs && corrected),
            "--method grid smears another viscosity inside over the grid: give --method layers, or \
             --preset thesis"
        );
        Ok(setup)
    }

    /// The method that `--method` names; without it on a grid if the preset is Cowley's, and as `base` otherwise.
    fn kind(&self, base: MethodKind) -> MethodKind {
        self.method.unwrap_or(if self.preset == Preset::Thesis { MethodKind::Grid } else { base })
    }

    fn grid(&self, base: GridMethod, radius: f64) -> Result<GridMethod> {
        for (flag, value) in [("nodes", self.nodes), ("elements", self.elements)] {
            ensure!(value.is_none(), "--{flag} means nothing on a grid: leave it out or give --method integral");
        }
        Ok(GridMethod {
            spacing: self.grid_spacing(base.spacing, radius)?,
            kernel: self.kernel.unwrap_or(base.kernel),
            ..base
        })
    }

    fn layers(&self, base: LayersMethod, radius: f64) -> Result<LayersMethod> {
        let [nodes, elements] = self.resolution([base.nodes, base.elements], 0)?;
        let spacing = self.grid_spacing(base.spacing, radius)?;
        Ok(LayersMethod { nodes, elements, spacing, kernel: self.kernel.unwrap_or(base.kernel) })
    }

    fn integral(&self, base: IntegralMethod) -> Result<IntegralMethod> {
        ensure!(self.kernel.is_none(), "--kernel means nothing without a grid: leave it out or give --method grid");
        let [nodes, elements] = self.resolution([base.nodes, base.elements], base.elements)?;
        Ok(IntegralMethod { nodes, elements })
    }

    /// The spacing of a grid for droplets of that radius (lengths), `base` where none is given.
    fn grid_spacing(&self, base: f64, radius: f64) -> Result<f64> {
        let spacing = self.spacing.unwrap_or(base);
        let coarse = self.spacing.is_some_and(|spacing| spacing > 0.25 * radius);
        let most = 0.25 * radius;
        ensure!(!coarse, "--spacing {spacing} is too coarse for a droplet of radius {radius}: give at most {most}");
        Ok(spacing)
    }

    /// Nodes and elements; where nodes are given four elements a node, and no fewer than `least`.
    fn resolution(&self, [nodes, elements]: [usize; 2], least: usize) -> Result<[usize; 2]> {
        let elements = self.nodes.map_or(elements, |nodes| least.max(4 * nodes));
        let (nodes, elements) = (self.nodes.unwrap_or(nodes), self.elements.unwrap_or(elements));
        ensure!(elements >= nodes, "--elements {elements} are fewer than the {nodes} nodes: give at least as many");
        Ok([nodes, elements])
    }

    /// The spacing (length) of the grid, or of pictures where there is none, by default a twentieth of a radius.
    #[must_use]
    pub fn spacing(&self, setup: &Setup) -> f64 {
        setup.method.spacing().or(self.spacing).unwrap_or(GridMethod::default().spacing * setup.length_scale())
    }
}
