//! The scenes whose steps are measured.

use anyhow::Result;
use motile::base::Region;
use motile::base::{Drive, Vec2};
use motile::elastic_solids::Solid;
use motile::elastic_solids::mesh::fitted_strip;
use motile::ib_core::{ImmersedBoundary, SmearedContrast};
use motile::scene::{Body, Hydrodynamics, Scene};
use motile::setup::{DropletSetup, GridMethod, IntegralMethod, Method, Setup};
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes};
use motile_cli::run::Summary;

use crate::step_cost::phases::Case;
use crate::step_cost::watched::{Stopwatches, Watched};

/// A kind of scene and its size, ready to be made and measured.
pub(crate) type Job = (String, Box<dyn Fn(std::time::Duration) -> Result<Summary>>);

/// Viscosity of the exterior fluid, and of a droplet a hundred times as viscous.
const VISCOSITY: f64 = 100.0;
const THICK: f64 = 1e4;
/// Shear modulus of walls (force per area).
const SHEAR: f64 = 100.0;

/// A scene whose parts are measured: a droplet of this viscosity in a region, by a method.
#[derive(Debug, Clone)]
struct Plan {
    setup: Setup,
    /// The grid that is the measure of its cost.
    spacing: f64,
}

impl Plan {
    fn new(region: Region, spacing: f64, viscosity: Option<f64>) -> Self {
        let method = Method::Grid(GridMethod::of_spacing(spacing));
        let droplets = vec![DropletSetup { viscosity, ..DropletSetup::default() }];
        Self { setup: Setup { region, method, viscosity: VISCOSITY, droplets, ..Setup::default() }, spacing }
    }

    fn droplet(&self, watches: &Stopwatches) -> Result<Watched<impl Body>> {
        Ok(Watched(self.setup.droplet(&self.setup.droplets[0])?, watches.clone()))
    }

    fn grid(&self) -> Result<Grid> {
        let [nx, ny] = self.setup.region.lengths().map(|length| (length / self.spacing).round() as usize);
        Ok(match self.setup.region {
            Region::Channel { .. } => Grid::channel(nx, ny, self.spacing)?,
            _ => Grid::periodic(nx, ny, self.spacing)?,
        })
    }
}

fn square(length: f64) -> Region {
    Region::Box { lengths: [length; 2] }
}

fn between_walls(length: f64, width: f64) -> Region {
    Region::Channel { length, width, drive: Drive::ZeroGradient }
}

/// The droplet of a plan in a flow.
fn case<H: Hydrodynamics>(
    kind: &'static str,
    plan: &Plan,
    flow: H,
    watches: Stopwatches,
    grid: Grid,
) -> Result<Case<Watched<H>>> {
    let mut scene = Scene::new(Watched(flow, watches.clone()));
    scene.add(plan.droplet(&watches)?);
    let dt = scene.system().step_limit().map_or(1e-3, |(limit, _)| 0.2 * limit.dt).min(0.01);
    Ok(Case { kind, scene, watches, grid, kernel: GridMethod::default().kernel, dt, without_grid: false, nodes: 0 })
}

fn name(kind: &str, grid: &Grid) -> String {
    format!("{kind}, {} x {}", grid.nx(), grid.ny())
}

/// A droplet in a box.
fn in_box(kind: &'static str, plan: Plan) -> Result<Job> {
    let grid = plan.grid()?;
    let run = move |budget| {
        let watches = Stopwatches::default();
        let solver = Watched(PeriodicStokes::new(grid, VISCOSITY)?, watches.clone());
        let flow = ImmersedBoundary::new(solver, GridMethod::default().kernel);
        case(kind, &plan, flow, watches, grid)?.measure(budget)
    };
    Ok((name(kind, &grid), Box::new(run)))
}

/// A thick droplet in a box with a smooth viscosity.
fn smeared(plan: Plan) -> Result<Job> {
    let (kind, grid) = ("contrast, arithmetic", plan.grid()?);
    let run = move |budget| {
        let watches = Stopwatches::default();
        let solver = Watched(PeriodicStokes::new(grid, VISCOSITY)?, watches.clone());
        let flow = SmearedContrast::new(solver, GridMethod::default().kernel)?;
        let mut case = case(kind, &plan, flow, watches, grid)?;
        case.dt = 0.01;
        case.measure(budget)
    };
    Ok((name(kind, &grid), Box::new(run)))
}

/// A droplet between rigid walls, or between elastic layers of the thickness `layers` on them.
fn in_channel(kind: &'static str, plan: Plan, layers: Option<f64>) -> Result<Job> {
    let grid = plan.grid()?;
    let run = move |budget| {
        let watches = Stopwatches::default();
        let solver = Watched(ChannelStokes::new(grid, VISCOSITY)?, watches.clone());
        let flow = ImmersedBoundary::new(solver, GridMethod::default().kernel);
        let mut case = case(kind, &plan, flow, watches.clone(), grid)?;
        if let Some(thickness) = layers {
            let [length, width] = plan.setup.region.lengths();
            for bottom in [-0.5 * width, 0.5 * width - thickness] {
                let mesh = fitted_strip(Vec2::new(-0.5 * length, bottom), [length, thickness], plan.spacing)?;
                let wall = Solid::springs(mesh, SHEAR)?.pinned(|s| s.y.abs() > 0.5 * width - 1e-9)?;
                case.scene.add(Watched(wall, watches.clone()));
            }
            case.dt = case.scene.system().step_limit().map_or(1e-3, |(limit, _)| 0.2 * limit.dt).min(0.01);
        }
        case.measure(budget)
    };
    Ok((name(kind, &grid), Box::new(run)))
}

/// A droplet without a grid; the grid of spacing 0.05 is the measure.
fn without_grid(kind: &'static str, plan: Plan, nodes: usize) -> Result<Job> {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    let plan = Plan { setup: Setup { method, ..plan.setup }, ..plan };
    let grid = plan.grid()?;
    let run = move |budget| {
        let watches = Stopwatches::default();
        let case = case(kind, &plan, plan.setup.flow()?, watches, grid)?;
        Case { without_grid: true, nodes, ..case }.measure(budget)
    };
    Ok((format!("{kind}, {nodes} nodes"), Box::new(run)))
}

/// Every kind of scene at several sizes.
pub(crate) fn jobs() -> Result<Vec<Job>> {
    let mut jobs = Vec::new();
    for cells in [60.0, 120.0, 240.0, 480.0] {
        jobs.push(in_box("box", Plan::new(square(6.0), 6.0 / cells, None))?);
    }
    // The same markers in a large box and in channels of the same length.
    jobs.push(in_box("large box", Plan::new(square(12.0), 0.05, None))?);
    for width in [2.0, 5.0, 12.0] {
        jobs.push(in_channel("channel", Plan::new(between_walls(12.0, width), 0.05, None), None)?);
    }
    for spacing in [0.1, 0.05] {
        jobs.push(in_channel("elastic channel", Plan::new(between_walls(12.0, 4.0), spacing, None), Some(0.8))?);
    }
    for cells in [60.0, 120.0, 240.0] {
        jobs.push(smeared(Plan::new(square(6.0), 6.0 / cells, Some(THICK)))?);
    }
    for nodes in [64, 128, 256] {
        jobs.push(without_grid("integrals, box", Plan::new(square(6.0), 0.05, None), nodes)?);
        jobs.push(without_grid("integrals, box, ratio 100", Plan::new(square(6.0), 0.05, Some(THICK)), nodes)?);
        jobs.push(without_grid("integrals, channel", Plan::new(between_walls(12.0, 3.0), 0.05, None), nodes)?);
        let thick = Plan::new(between_walls(12.0, 3.0), 0.05, Some(THICK));
        jobs.push(without_grid("integrals, channel, ratio 100", thick, nodes)?);
    }
    Ok(jobs)
}
