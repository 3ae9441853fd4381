//! Scenes that the studies start from.

use motile::base::Drive;
use motile::base::Region;
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::ib_core::SmearedContrast;
use motile::setup::{AnyFlow, ExcludedVolume, GridMethod, IntegralMethod, LayersMethod, Method, Setup};
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes};

use crate::validation::StudyError;

/// The default scene on a grid of spacing `h` (length).
#[must_use]
pub fn on_grid(h: f64) -> Setup {
    Setup { method: Method::Grid(GridMethod::of_spacing(h)), ..Setup::default() }
}

/// The default scene by layers beside a grid of spacing `h` (length).
#[must_use]
pub fn by_layers(h: f64) -> Setup {
    Setup { method: Method::Layers(LayersMethod::of_spacing(h)), ..Setup::default() }
}

/// The default scene by boundary integrals with `nodes` nodes and `cells` cells of the concentration.
#[must_use]
pub fn without_grid(nodes: usize, elements: usize) -> Setup {
    Setup { method: Method::Integral(IntegralMethod { nodes, elements }), ..Setup::default() }
}

/// The scene of the reference table of steady swimmers in a box, from one that has its box and viscosities: A is twice
/// the size of the activity.
#[must_use]
pub fn reference(mut base: Setup, activity: f64) -> Setup {
    for particles in base.droplets.iter_mut().filter_map(|droplet| droplet.particles.as_mut()) {
        (particles.activity, particles.excluded_volume) = (activity, ExcludedVolume::Step(2.0 * activity.abs()));
    }
    base
}

/// A channel between rigid walls whose pressure is periodic.
#[must_use]
pub fn open_channel(length: f64, width: f64) -> Region {
    Region::Channel { length, width, drive: Drive::ZeroGradient }
}

/// The flow in a region by a method, with a relative tolerance for the iterations that boundary integrals and a smeared
/// contrast take.
///
/// # Errors
/// Those of a setup.
pub fn flow(region: Region, method: Method, viscosity: f64, tolerance: f64) -> Result<AnyFlow, StudyError> {
    match method {
        Method::Integral(IntegralMethod { nodes, .. }) => {
            let settings = Settings { nodes, tolerance, ..Settings::default() };
            Ok(Box::new(BoundaryIntegral::new(region, viscosity, settings)?))
        }
        Method::Grid(GridMethod { spacing, kernel, corrected: false, .. }) => {
            let [nx, ny] = region.lengths().map(|length| (length / spacing).round() as usize);
            let Region::Channel { drive, .. } = region else {
                let solver = PeriodicStokes::new(Grid::periodic(nx, ny, spacing)?, viscosity)?;
                return Ok(Box::new(SmearedContrast::with_tolerance(solver, kernel, tolerance)?));
            };
            let mut solver = ChannelStokes::new(Grid::channel(nx, ny, spacing)?, viscosity)?;
            solver.set_drive(drive)?;
            Ok(Box::new(SmearedContrast::with_tolerance(solver, kernel, tolerance)?))
        }
        _ => Ok(Setup { region, method, viscosity, droplets: Vec::new(), ..Setup::default() }.flow()?),
    }
}

/// A solver in a channel of a length and a width.
///
/// # Errors
/// Those of a grid and its drive.
pub fn channel_solver(lengths: [f64; 2], h: f64, drive: Drive, viscosity: f64) -> Result<ChannelStokes, StudyError> {
    let [nx, ny] = lengths.map(|length| (length / h).round() as usize);
    let mut solver = ChannelStokes::new(Grid::channel(nx, ny, h)?, viscosity)?;
    solver.set_drive(drive)?;
    Ok(solver)
}
