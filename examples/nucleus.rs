//! A droplet with a nucleus.
//!
//! `cargo run --release --example nucleus` lets a droplet swim that has a rigid disc inside; `--core shell` an elastic
//! membrane around fluid, `--core disc` an elastic disc (on a grid), `--core none` nothing. In a periodic box, in a
//! channel or in unbounded fluid. Prints what was measured and writes to `out/nucleus/` what the example
//! `swimming_droplet` writes. `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Args, Parser, ValueEnum};
use motile::ib_core::{Body, Handle, Vec2};
use motile::stokes_grid::Drive;
use motile::{
    Built, GridMethod, Hold, IntegralMethod, Material, Method, MethodKind, Region, RigidBodySetup, Setup, ShellSetup,
    SolidOutline, SolidSetup,
};
use motile_examples::{MethodFlags, RegionFlags, SceneFlags, WatchedRun, not_negative, pair, positive, turning_rate};

/// Which region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RegionKind {
    /// Periodic along x and y.
    Box,
    /// Rigid walls in y, periodic along x, no mean pressure gradient.
    Channel,
    /// Unbounded fluid.
    Plane,
}

/// What is inside the droplet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Core {
    /// An elastic disc, neo-Hookean; needs a grid.
    Disc,
    /// A rigid disc.
    Rigid,
    /// An elastic membrane around fluid.
    Shell,
    /// Nothing.
    None,
}

/// The region and the core.
#[derive(Debug, Clone, PartialEq, Args)]
struct CoreFlags {
    /// The region that the fluid fills
    #[arg(long, value_enum, default_value_t = RegionKind::Box)]
    region: RegionKind,
    /// Side of the periodic box, period of the channel (R0)
    #[arg(long = "box", value_name = "SIDE", default_value_t = 6.0, value_parser = positive, allow_hyphen_values = true)]
    side: f64,
    /// Distance of the channel's walls (R0)
    #[arg(long, default_value_t = 3.0, value_parser = positive, allow_hyphen_values = true)]
    width: f64,
    /// What is inside the droplet
    #[arg(long, value_enum, default_value_t = Core::Rigid)]
    core: Core,
    /// Radius of the core (R0)
    #[arg(long, default_value_t = 0.5, value_parser = positive, allow_hyphen_values = true)]
    core_radius: f64,
    /// Initial position of the core, from the centre of the droplet (R0)
    #[arg(long, value_name = "X,Y", default_value = "0,0", value_parser = pair, allow_hyphen_values = true)]
    core_offset: [f64; 2],
    /// Viscosity inside a shell; without it that of the droplet
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    core_viscosity: Option<f64>,
    /// Shear modulus of a disc (the bulk modulus is twice that) or stretching modulus of a shell [default: 1000, 10]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    core_stiffness: Option<f64>,
    /// Bending modulus of a shell [default: 0.1]
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    core_bending: Option<f64>,
}

impl RegionFlags for CoreFlags {
    fn caption(&self) -> Result<String> {
        let core = self.core.to_possible_value().map_or(String::new(), |core| core.get_name().to_owned());
        Ok(if self.core == Core::None { String::new() } else { format!("{core} of radius {}", self.core_radius) })
    }
}

impl CoreFlags {
    /// Puts region and core into a scene.
    fn apply(&self, method: &MethodFlags, setup: &mut Setup) -> Result<()> {
        setup.region = match self.region {
            RegionKind::Box => Region::Box { lengths: [self.side; 2] },
            RegionKind::Channel => Region::Channel { length: self.side, width: self.width, drive: Drive::ZeroGradient },
            RegionKind::Plane => Region::Plane,
        };
        for (flag, given, used) in [
            ("core-viscosity", self.core_viscosity.is_some(), self.core == Core::Shell),
            ("core-bending", self.core_bending.is_some(), self.core == Core::Shell),
            ("core-stiffness", self.core_stiffness.is_some(), matches!(self.core, Core::Shell | Core::Disc)),
        ] {
            ensure!(used || !given, "--{flag} means nothing to this core: leave it out or give --core shell");
        }
        let (centre, radius) = (self.core_offset, self.core_radius);
        match self.core {
            Core::None => {}
            Core::Rigid => {
                setup.rigid_bodies =
                    vec![RigidBodySetup { centre, name: "core".into(), ..RigidBodySetup::disc(radius) }];
            }
            Core::Shell => {
                let usual = ShellSetup::default();
                setup.shells = vec![ShellSetup {
                    centre,
                    name: "core".into(),
                    viscosity: self.core_viscosity,
                    shape: motile::DropletShape::Round { radius },
                    stretching: self.core_stiffness.unwrap_or(usual.stretching),
                    bending: self.core_bending.unwrap_or(usual.bending),
                    ..usual
                }];
            }
            Core::Disc => {
                if let (None, Method::Integral(layers)) = (method.method, setup.method) {
                    setup.method = Method::Grid(GridMethod { layers, ..GridMethod::default() });
                }
                let shear = self.core_stiffness.unwrap_or(1000.0);
                let material = Material::NeoHookean { shear, bulk: 2.0 * shear };
                let disc = SolidSetup::new(SolidOutline::Disc { centre, radius }, material);
                setup.solids = vec![SolidSetup { hold: Hold::Free, name: "core".into(), ..disc }];
            }
        }
        Ok(())
    }
}

/// A droplet with a nucleus.
#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    scene: SceneFlags<CoreFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { scene: flags }: &Flags) -> Result<()> {
    // Nodes and cells are those of interfaces, on a grid too.
    let (nodes, cells) = (flags.method.nodes, flags.method.concentration_cells);
    let grid = flags.method.method == Some(MethodKind::Grid);
    let method = if grid {
        MethodFlags { nodes: None, concentration_cells: None, ..flags.method.clone() }
    } else {
        flags.method.clone()
    };
    let mut setup = method.setup(&flags.droplet, None)?;
    if let (true, Method::Grid(grid)) = (grid, &mut setup.method) {
        let nodes = nodes.unwrap_or(grid.layers.nodes);
        grid.layers = IntegralMethod { nodes, cells: cells.unwrap_or(4 * nodes) };
    }
    flags.region.apply(&flags.method, &mut setup)?;

    // The run, with all that watches it.
    let built = setup.build()?;
    let core = core_of(&built);
    let mut run = WatchedRun::new(built, &setup, flags, "nucleus")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let turning = turning_rate(run.records());
    let speed = run.last()?.observables.speed();
    summary.put("turning_rate", turning, "of the heading, in the second half of the run (radians per time)");
    summary.put("track_radius", turning.map(|rate| speed / rate.abs()), "of the track, speed over turning rate (R0)");
    if let Some(core) = core {
        let centroid = run.last()?.observables.centroid;
        let body = run.scene.system_mut();
        body.evaluate()?;
        let flow = body.flow_at(core)?;
        let count = flow.positions.len() as f64;
        let mean = |values: &[Vec2]| values.iter().sum::<Vec2>() / count;
        summary.put("core_speed", mean(flow.velocities).length(), "of the core (R0 per time)");
        let offset = mean(flow.positions) - centroid;
        summary.put("core_offset", offset.length(), "of the core from the centroid of the droplet, in the end (R0)");
    } else {
        summary.put("core_speed", f64::NAN, "there is no core");
        summary.put("core_offset", f64::NAN, "there is no core");
    }
    run.finish(&summary)
}

/// The body inside the droplet.
fn core_of(built: &Built) -> Option<Handle<dyn Body>> {
    let rigid = built.rigid_bodies.first().map(|body| (*body).into());
    let shell = built.shells.first().map(|shell| (*shell).into());
    rigid.or(shell).or(built.solids.first().map(|solid| (*solid).into()))
}
