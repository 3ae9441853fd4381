//! The region of scenes that can be in any.

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use motile::base::Region;
use motile::setup::Setup;

use crate::flags::RADIUS;
use crate::parse::positive;
use crate::{AlongFlags, BoxFlags, RegionFlags};

/// Kinds of region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RegionKind {
    /// A periodic box.
    Box,
    /// A channel between rigid walls, periodic along it.
    Channel,
    /// Unbounded fluid in two dimensions.
    Plane,
    /// Unbounded fluid in three dimensions, around a body of revolution.
    Space,
    /// A straight tube in three dimensions without flux, around a body of revolution.
    Tube,
}

/// A region of any kind.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct AnyRegionFlags {
    /// Region
    #[arg(long, value_enum, default_value_t = RegionKind::Box)]
    pub region: RegionKind,
    /// The box
    #[command(flatten)]
    pub periodic: BoxFlags,
    /// Distance of the walls of a channel (R0)
    #[arg(long, default_value_t = 3.0, value_parser = positive, allow_hyphen_values = true)]
    pub width: f64,
    /// The channel
    #[command(flatten)]
    pub along: AlongFlags,
    /// Radius of a tube (R0)
    #[arg(long, default_value_t = 2.0, value_parser = positive, allow_hyphen_values = true)]
    pub tube_radius: f64,
}

impl AnyRegionFlags {
    /// Overrides the region of a scene.
    ///
    /// # Errors
    /// A region that is unreasonably large, a channel that is narrower than the droplet, a place that is not given by
    /// `--lateral-offset` in a channel.
    pub fn apply(&self, setup: &mut Setup) -> Result<()> {
        let AlongFlags { flux, gradient, wall_velocity, .. } = self.along;
        let driven = flux.is_some() || gradient.is_some() || wall_velocity.is_some();
        ensure!(
            self.region == RegionKind::Channel || !driven,
            "--flux, --gradient and --wall-velocity are for channels: give --region channel, or --shear"
        );
        match self.region {
            RegionKind::Box => self.periodic.apply(setup),
            RegionKind::Plane | RegionKind::Space | RegionKind::Tube => {
                self.periodic.apply(setup)?;
                setup.region = match self.region {
                    RegionKind::Plane => Region::Plane,
                    RegionKind::Space => Region::Space,
                    _ => Region::tube(self.tube_radius),
                };
                Ok(())
            }
            RegionKind::Channel => {
                let width = self.width;
                ensure!(
                    width >= 2.0 * RADIUS,
                    "--width {width} is too small for a droplet of diameter 2: give 2 or more"
                );
                ensure!(
                    self.periodic.offset.is_none(),
                    "--offset is for boxes and unbounded fluid: give --lateral-offset in a channel"
                );
                self.periodic.impose(setup);
                self.along.apply(setup, 0.0, width)
            }
        }
    }
}

impl RegionFlags for AnyRegionFlags {
    fn caption(&self) -> Result<String> {
        Ok(match self.region {
            RegionKind::Channel => format!("w = {},  l = {}", self.width, self.along.length),
            RegionKind::Tube => format!("W = {}", self.tube_radius),
            RegionKind::Space => "three dimensions".to_owned(),
            RegionKind::Box | RegionKind::Plane => String::new(),
        })
    }
}
