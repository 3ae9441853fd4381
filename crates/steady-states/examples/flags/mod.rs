//! The command line that both examples share: the droplet, the region, the nodes.

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use motile::stokes_grid::Drive;
use motile::{IntegralMethod, Method, Region, Setup};
use motile_examples::{DropletFlags, positive};

/// Kinds of region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// A periodic box.
    Box,
    /// A channel between rigid walls, periodic along it.
    Channel,
    /// Unbounded fluid.
    Plane,
}

/// What drives the flow along a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Forcing {
    /// No mean pressure gradient, as in Cowley.
    ZeroGradient,
    /// No net flux.
    ZeroFlux,
}

/// A scene of one droplet without a grid.
#[derive(Debug, Args)]
pub(crate) struct SceneFlags {
    #[command(flatten)]
    droplet: DropletFlags,
    /// Region; without it a channel if --width is given, and a box otherwise
    #[arg(long, value_enum)]
    region: Option<Kind>,
    /// Side of the periodic box (R0)
    #[arg(long = "box", value_name = "SIDE", default_value_t = 6.0, value_parser = positive)]
    side: f64,
    /// Distance of the walls (R0) [default: 3]
    #[arg(long, value_parser = positive)]
    width: Option<f64>,
    /// Period of the channel (R0)
    #[arg(long, default_value_t = 12.0, value_parser = positive)]
    length: f64,
    /// Initial distance of the droplet from the centre line (R0)
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    lateral_offset: f64,
    /// What drives the flow along the channel
    #[arg(long, value_enum, default_value_t = Forcing::ZeroGradient)]
    drive: Forcing,
    /// Nodes of shape and concentration
    #[arg(long, default_value_t = 96)]
    nodes: usize,
}

impl SceneFlags {
    /// The scene.
    pub(crate) fn setup(&self) -> Result<Setup> {
        let Self { side, width, length, nodes, .. } = *self;
        let kind = self.region.unwrap_or(if width.is_some() { Kind::Channel } else { Kind::Box });
        ensure!(width.is_none() || kind == Kind::Channel, "--width means nothing here: give --region channel");
        let drive = match self.drive {
            Forcing::ZeroGradient => Drive::ZeroGradient,
            Forcing::ZeroFlux => Drive::ZeroFlux,
        };
        let region = match kind {
            Kind::Plane => Region::Plane,
            Kind::Box => Region::Box { lengths: [side; 2] },
            Kind::Channel => Region::Channel { length, width: width.unwrap_or(3.0), drive },
        };
        let method = Method::Integral(IntegralMethod { nodes, cells: 4 * nodes });
        let mut setup = Setup { region, method, ..Setup::default() };
        self.droplet.apply(&mut setup)?;
        setup.droplets[0].centre[1] = self.lateral_offset;
        setup.check()?;
        Ok(setup)
    }
}
