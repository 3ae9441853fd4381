//! The scenes whose steps are measured.

use anyhow::Result;
use motile::Swimmer;
use motile::active_interface::{ActiveDroplet, Curve, InitialConcentration};
use motile::boundary_integral::{BoundaryIntegral, Forcing, Region, Settings};
use motile::elastic_solids::{Solid, mesh::fitted_strip};
use motile::ib_core::{Body, Hydrodynamics, ImmersedBoundary, Scene, SmearedContrast, Vec2};
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes};
use motile_examples::Summary;

use crate::step_cost::phases::Case;
use crate::step_cost::watched::{Stopwatches, Watched};

/// A kind of scene and its size, ready to be made and measured.
pub(crate) type Job = (String, Box<dyn Fn(std::time::Duration) -> Result<Summary>>);

/// Viscosity of the surroundings, and of a droplet a hundred times as viscous.
const VISCOSITY: f64 = 100.0;
const THICK: f64 = 1e4;
/// Shear modulus of walls (force per area).
const SHEAR: f64 = 100.0;

fn droplet(swimmer: &Swimmer, watches: &Stopwatches) -> Result<Watched<impl Body>> {
    Ok(Watched(swimmer.droplet()?, watches.clone()))
}

fn swimmer(lengths: [f64; 2], spacing: f64, inside: Option<f64>) -> Swimmer {
    Swimmer { lengths, spacing, viscosity: VISCOSITY, viscosity_inside: inside, ..Swimmer::default() }
}

/// All bodies of `scene` and the droplet of `swimmer`.
fn case<H: Hydrodynamics>(
    kind: &'static str,
    swimmer: &Swimmer,
    flow: H,
    watches: Stopwatches,
    grid: Grid,
) -> Result<Case<Watched<H>>> {
    let mut scene = Scene::new(Watched(flow, watches.clone()));
    scene.add(droplet(swimmer, &watches)?);
    let dt = scene.system().step_limit().map_or(1e-3, |(limit, _)| 0.2 * limit.dt).min(0.01);
    Ok(Case { kind, scene, watches, grid, kernel: swimmer.kernel, dt, without_grid: false, nodes: 0 })
}

fn periodic(swimmer: &Swimmer) -> Result<Grid> {
    let [nx, ny] = swimmer.lengths.map(|length| (length / swimmer.spacing).round() as usize);
    Ok(Grid::periodic(nx, ny, swimmer.spacing)?)
}

fn between_walls(swimmer: &Swimmer) -> Result<Grid> {
    let [nx, ny] = swimmer.lengths.map(|length| (length / swimmer.spacing).round() as usize);
    Ok(Grid::channel(nx, ny, swimmer.spacing)?)
}

fn name(kind: &str, grid: &Grid) -> String {
    format!("{kind}, {} x {}", grid.nx(), grid.ny())
}

/// A droplet in a box; sharp contrast if it is thicker than its surroundings.
fn in_box(kind: &'static str, swimmer: Swimmer) -> Result<Job> {
    let grid = periodic(&swimmer)?;
    let run = move |budget| {
        let watches = Stopwatches::default();
        let solver = Watched(PeriodicStokes::new(grid, VISCOSITY)?, watches.clone());
        let flow = ImmersedBoundary::new(solver, swimmer.kernel);
        case(kind, &swimmer, flow, watches, grid)?.measure(budget)
    };
    Ok((name(kind, &grid), Box::new(run)))
}

/// A thick droplet in a box with a smooth viscosity.
fn smeared(swimmer: Swimmer) -> Result<Job> {
    let (kind, grid) = ("contrast, arithmetic", periodic(&swimmer)?);
    let run = move |budget| {
        let watches = Stopwatches::default();
        let solver = Watched(PeriodicStokes::new(grid, VISCOSITY)?, watches.clone());
        let flow = SmearedContrast::new(solver, swimmer.kernel)?;
        let mut case = case(kind, &swimmer, flow, watches, grid)?;
        case.dt = 0.01;
        case.measure(budget)
    };
    Ok((name(kind, &grid), Box::new(run)))
}

/// A droplet between rigid walls, or between elastic layers of the thickness `layers` on them.
fn in_channel(kind: &'static str, swimmer: Swimmer, layers: Option<f64>) -> Result<Job> {
    let grid = between_walls(&swimmer)?;
    let run = move |budget| {
        let watches = Stopwatches::default();
        let solver = Watched(ChannelStokes::new(grid, VISCOSITY)?, watches.clone());
        let flow = ImmersedBoundary::new(solver, swimmer.kernel);
        let mut case = case(kind, &swimmer, flow, watches.clone(), grid)?;
        if let Some(thickness) = layers {
            let [length, width] = swimmer.lengths;
            for bottom in [-0.5 * width, 0.5 * width - thickness] {
                let mesh = fitted_strip(Vec2::new(-0.5 * length, bottom), [length, thickness], swimmer.spacing)?;
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
fn without_grid(kind: &'static str, swimmer: &Swimmer, nodes: usize, walls: bool) -> Result<Job> {
    let swimmer = Swimmer { nodes, concentration_cells: 4 * nodes, ..swimmer.clone() };
    let grid = if walls { between_walls(&swimmer)? } else { periodic(&swimmer)? };
    let run = move |budget| {
        let watches = Stopwatches::default();
        let settings = Settings { nodes, ..Settings::default() };
        let [lx, ly] = swimmer.lengths;
        // The droplet of the library's own scene, whose markers are the cells of its concentration.
        let markers = Curve::circle(swimmer.radius)?.markers(4 * nodes)?;
        let numbers = InitialConcentration::polarised(swimmer.mean_concentration, 0.0)?.particle_numbers(&markers)?;
        let mut droplet = ActiveDroplet::new(&markers, numbers, swimmer.tension()?, swimmer.diffusion)?;
        if let Some(inside) = swimmer.viscosity_inside {
            droplet = droplet.with_viscosity_inside(inside)?;
        }
        let droplet = Watched(droplet, watches.clone());
        let region = if walls {
            Region::Channel { length: lx, width: ly, forcing: Forcing::default() }
        } else {
            Region::Box { lengths: [lx, ly] }
        };
        let flow = BoundaryIntegral::new(region, VISCOSITY, settings)?
            .with_reference_perimeter(std::f64::consts::TAU * swimmer.radius)?;
        integrals(kind, Scene::new(Watched(flow, watches.clone())), droplet, watches, (grid, &swimmer), budget)
    };
    Ok((format!("{kind}, {nodes} nodes"), Box::new(run)))
}

fn integrals<H: Hydrodynamics>(
    kind: &'static str,
    mut scene: Scene<H>,
    droplet: Watched<impl Body>,
    watches: Stopwatches,
    (grid, swimmer): (Grid, &Swimmer),
    budget: std::time::Duration,
) -> Result<Summary> {
    scene.add(droplet);
    let dt = scene.system().step_limit().map_or(1e-3, |(limit, _)| 0.2 * limit.dt).min(0.01);
    let nodes = swimmer.nodes;
    Case { kind, scene, watches, grid, kernel: swimmer.kernel, dt, without_grid: true, nodes }.measure(budget)
}

/// Every kind of scene at several sizes.
pub(crate) fn jobs() -> Result<Vec<Job>> {
    let mut jobs = Vec::new();
    for cells in [60.0, 120.0, 240.0, 480.0] {
        jobs.push(in_box("box", swimmer([6.0; 2], 6.0 / cells, None))?);
    }
    // The same markers in a large box and in channels of the same length.
    jobs.push(in_box("large box", swimmer([12.0; 2], 0.05, None))?);
    for width in [2.0, 5.0, 12.0] {
        jobs.push(in_channel("channel", swimmer([12.0, width], 0.05, None), None)?);
    }
    for spacing in [0.1, 0.05] {
        jobs.push(in_channel("elastic channel", swimmer([12.0, 4.0], spacing, None), Some(0.8))?);
    }
    for cells in [60.0, 120.0, 240.0] {
        jobs.push(in_box("contrast, sharp", swimmer([6.0; 2], 6.0 / cells, Some(THICK)))?);
        jobs.push(smeared(swimmer([6.0; 2], 6.0 / cells, Some(THICK)))?);
    }
    for nodes in [64, 128, 256] {
        jobs.push(without_grid("integrals, box", &swimmer([6.0; 2], 0.05, None), nodes, false)?);
        jobs.push(without_grid("integrals, box, ratio 100", &swimmer([6.0; 2], 0.05, Some(THICK)), nodes, false)?);
        jobs.push(without_grid("integrals, channel", &swimmer([12.0, 3.0], 0.05, None), nodes, true)?);
        let thick = swimmer([12.0, 3.0], 0.05, Some(THICK));
        jobs.push(without_grid("integrals, channel, ratio 100", &thick, nodes, true)?);
    }
    Ok(jobs)
}
