//! The command line that the examples of steady states share: the droplet, the region, the nodes.

use anyhow::{Result, bail, ensure};
use clap::Args;
use motile::base::Region;
use motile::setup::{ExchangeSetup, IntegralMethod, Method, RigidBodySetup, Setup};
use motile_examples::{AlongFlags, DropletFlags, RegionKind, positive};

/// A scene of one droplet without a grid.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct SteadyFlags {
    #[command(flatten)]
    droplet: DropletFlags,
    /// Region; without it a channel if --width is given, a tube if --tube-radius is, and a box otherwise
    #[arg(long, value_enum)]
    region: Option<RegionKind>,
    /// Side of the periodic box (R0)
    #[arg(long = "box", value_name = "SIDE", default_value_t = 6.0, value_parser = positive)]
    side: f64,
    /// Distance of the walls (R0) [default: 3]
    #[arg(long, value_parser = positive)]
    width: Option<f64>,
    /// Radius of a tube in three dimensions (R0) [default: 2]
    #[arg(long, value_name = "RADIUS", value_parser = positive, allow_hyphen_values = true)]
    tube_radius: Option<f64>,
    #[command(flatten)]
    along: AlongFlags,
    /// Radius of a rigid nucleus (R0) [default: there is none]
    #[arg(long, value_name = "RADIUS", value_parser = positive, allow_hyphen_values = true)]
    core_radius: Option<f64>,
    /// Where the nucleus starts, from the droplet's centre (R0): aside, the droplet may go round in circles
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    core_offset: Vec<f64>,
    /// Rate of binding to the interface from a well-mixed inside (R0 per time); needs --k-off [default: no exchange]
    #[arg(long, requires = "k_off", value_parser = positive, allow_hyphen_values = true)]
    k_on: Option<f64>,
    /// Rate of unbinding into the inside (1/time)
    #[arg(long, requires = "k_on", value_parser = positive, allow_hyphen_values = true)]
    k_off: Option<f64>,
    /// Shear rate of an imposed flow u = (G y, 0) in unbounded fluid (1/time)
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    shear: f64,
    /// Extension rate of an imposed flow u = (E x, -E y) in unbounded fluid (1/time)
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    extension: f64,
    /// Nodes of shape and concentration
    #[arg(long, default_value_t = 96)]
    nodes: usize,
}

impl SteadyFlags {
    /// The scene.
    ///
    /// # Errors
    /// Flags that do not fit together, a scene that cannot be.
    pub fn setup(&self) -> Result<Setup> {
        let Self { side, width, tube_radius, nodes, along: AlongFlags { length, lateral_offset, .. }, .. } = *self;
        let drive = self.along.driven();
        let kind = self.region.unwrap_or(match (width, tube_radius) {
            (Some(_), _) => RegionKind::Channel,
            (_, Some(_)) => RegionKind::Tube,
            _ => RegionKind::Box,
        });
        ensure!(
            tube_radius.is_none() || kind == RegionKind::Tube,
            "--tube-radius means nothing here: give --region tube"
        );
        ensure!(width.is_none() || kind == RegionKind::Channel, "--width means nothing here: give --region channel");
        let region = match kind {
            RegionKind::Plane => Region::Plane,
            RegionKind::Space => Region::Space,
            RegionKind::Tube => Region::tube(tube_radius.unwrap_or(2.0)),
            RegionKind::Box => Region::Box { lengths: [side; 2] },
            RegionKind::Channel => Region::Channel { length, width: width.unwrap_or(3.0), drive },
        };
        let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
        let mut setup = Setup { region, method, ..Setup::default() };
        self.droplet.apply(&mut setup)?;
        setup.flow.wall_velocity = self.along.wall_velocity;
        (setup.flow.shear, setup.flow.extension) = (self.shear, self.extension);
        setup.droplets[0].centre[1] = lateral_offset;
        if let (Some(particles), (Some(k_on), Some(k_off))) =
            (&mut setup.droplets[0].particles, (self.k_on, self.k_off))
        {
            particles.exchange = Some(ExchangeSetup::new(k_on, k_off));
        }
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
