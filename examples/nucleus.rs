//! A droplet with a nucleus.
//!
//! `cargo run --release --example nucleus` lets a droplet swim that has a rigid disc inside; `--core shell` an elastic
//! membrane around fluid, `--core disc` an elastic disc (on a grid), `--core none` nothing. In a periodic box, in a
//! channel or in unbounded fluid. Prints what was measured and writes to `out/nucleus/` what the example
//! `swimming_droplet` writes. `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Args, Parser, ValueEnum};
use motile::base::Vec2;
use motile::scene::{Body, Handle};
use motile::setup::{
    Built, DropletShape, Hold, LayersMethod, Material, Method, RigidBodySetup, Setup, ShellSetup, SolidOutline,
    SolidSetup,
};
use motile_examples::{AnyRegionFlags, Preset, SceneFlags, not_negative, pair, positive, turning_rate};

/// Radius of the droplet, and the smallest one of a core (R0): the time steps are in proportion to it.
const RADIUS: f64 = 1.0;
const LEAST_RADIUS: f64 = 0.02;

/// Body inside the droplet.
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

/// The core.
#[derive(Debug, Clone, PartialEq, Args)]
struct CoreFlags {
    /// Body inside the droplet
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

impl CoreFlags {
    /// Puts the core into a scene.
    fn apply(&self, setup: &mut Setup) -> Result<()> {
        for (flag, given, used) in [
            ("core-viscosity", self.core_viscosity.is_some(), self.core == Core::Shell),
            ("core-bending", self.core_bending.is_some(), self.core == Core::Shell),
            ("core-stiffness", self.core_stiffness.is_some(), matches!(self.core, Core::Shell | Core::Disc)),
        ] {
            ensure!(used || !given, "--{flag} means nothing to this core: leave it out or give --core shell");
        }
        let (radius, [dx, dy]) = (self.core_radius, self.core_offset);
        ensure!(
            self.core == Core::None || (LEAST_RADIUS..RADIUS).contains(&radius),
            "--core-radius {radius}: give from {LEAST_RADIUS}, below which steps are as short as the core is small, to \
             less than {RADIUS}, the radius of the droplet"
        );
        ensure!(
            self.core == Core::None || dx.hypot(dy) + radius < RADIUS,
            "--core-offset {dx},{dy} puts the core of radius {radius} out of the droplet of radius {RADIUS}: give one \
             shorter than {:.4}",
            RADIUS - radius
        );
        let [x, y] = setup.droplets[0].centre;
        let centre = [x + dx, y + dy];
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
                    shape: DropletShape::Round { radius },
                    stretching: self.core_stiffness.unwrap_or(usual.stretching),
                    bending: self.core_bending.unwrap_or(usual.bending),
                    ..usual
                }];
            }
            Core::Disc => {
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
#[command(after_help = "The default run takes 2,155 steps, 4,311 evaluations of the flow.")]
struct Flags {
    #[command(flatten)]
    core: CoreFlags,
    #[command(flatten)]
    scene: SceneFlags<AnyRegionFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { core: core_flags, scene: flags }: &Flags) -> Result<()> {
    // The droplet, as a layer beside a grid where that is needed, its region and its core.
    let layers = Setup { method: Method::Layers(LayersMethod::default()), ..Setup::default() };
    let base = (core_flags.core == Core::Disc && flags.method.preset == Preset::Accurate).then_some(layers);
    let mut setup = flags.method.setup(&flags.droplet, base)?;
    flags.region.apply(&mut setup)?;
    core_flags.apply(&mut setup)?;

    // The run, with all that watches it.
    let built = setup.build()?;
    let core = core_of(&built);
    let mut run = flags.watch(built, &setup, "nucleus")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let turning = turning_rate(&run.table()?.curve("time", "heading_degrees")?);
    let speed = run.last()?.observables.speed();
    summary.put("turning_rate", turning, "of the heading, in the second half of the run (radians per time)");
    // Straight tracks turn by round-off alone.
    let radius = turning.filter(|rate| rate.abs() > 1e-12).map(|rate| speed / rate.abs());
    summary.put("track_radius", radius, "of the track, speed over turning rate (R0)");
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
