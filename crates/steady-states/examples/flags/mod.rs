//! The command line that both examples share: the droplet, the region, the nodes.

use anyhow::{Result, bail, ensure};
use clap::{Args, ValueEnum};
use motile::stokes_grid::Drive;
use motile::{IntegralMethod, Method, Region, RigidBodySetup, Setup};
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
    /// Radius of a rigid nucleus (R0) [default: there is none]
    #[arg(long, value_name = "RADIUS", value_parser = positive, allow_hyphen_values = true)]
    core_radius: Option<f64>,
    /// Where the nucleus starts, from the droplet's centre (R0): aside, the droplet may go round in circles
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    core_offset: Vec<f64>,
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
        let offset = match self.core_offset.as_slice() {
            [] => [0.0; 2],
            &[x, y] if self.core_radius.is_some() => [x, y],
            _ => bail!("--core-offset is two numbers, as in 0,0.4, and needs --core-radius"),
        };
        if let Some(radius) = self.core_radius {
            let [x, y] = setup.droplets[0].centre;
            let centre = [x + offset[0], y + offset[1]];
            setup.rigid_bodies.push(RigidBodySetup { centre, ..RigidBodySetup::disc(radius) });
        }
        setup.check()?;
        Ok(setup)
    }
}
