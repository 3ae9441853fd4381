//! Elastic walls of a shape of your own.
//!
//! `cargo run --release --example custom_geometry` lets a droplet swim through the channel that the function `closure`
//! below describes, which is meant to be copied; `--case ratchet` and `--case branch` through two of the ready ones.
//! Prints what was measured and writes to `out/custom_geometry/` what the example `elastic_channel` writes. `--help`
//! lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Parser, ValueEnum};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::{Channel, SolidError};
use motile::scene::Scene;
use motile::setup::{Built, Setup};
use motile_cli::run::say;
use motile_examples::{ElasticFlags, SceneFlags};

/// A channel whose walls are functions of x: bumps below, and a step to a narrower part above.
fn closure(period: f64, width: f64) -> Result<Channel, SolidError> {
    let wave = std::f64::consts::TAU / period;
    let lower = move |x: f64| -0.5 * width - 0.25 * (2.0 * wave * x).cos();
    let upper = move |x: f64| 0.5 * width - 0.2 * (3.0 * ((wave * x).sin() - 0.5)).tanh();
    Channel::between(-0.5 * period, period, lower, upper)
}

/// A channel with asymmetric teeth.
fn ratchet(width: f64) -> ChannelShape {
    ChannelShape::Ratchet { width, throat: 0.65 * width, teeth: 3, rise: 0.7, sharp: false }
}

/// A channel that splits around an island; its upper branch is the wider one.
fn branch(period: f64, width: f64) -> ChannelShape {
    let (island_length, ramp) = (0.35 * period, 0.2 * period);
    let branches = [0.6 * width, 0.7 * width];
    ChannelShape::Branching { width, branches, island_length, island_thickness: 0.5 * width, ramp }
}

/// The scene of a description, with walls of another shape than those it names.
fn build_with(setup: &Setup, shape: &Channel) -> Result<Built> {
    let mut scene = Scene::new(setup.flow()?).with_step_size(setup.step);
    let droplets = vec![scene.add(setup.droplet(&setup.droplets[0])?)];
    let (walls, top) = (&setup.solids, 0.5 * setup.region.lengths()[1]);
    let lower = walls[0].on_mesh(shape.lower_wall(-top, &walls[0].mesher(setup)?)?, setup)?;
    let upper = walls[1].on_mesh(shape.upper_wall(top, &walls[1].mesher(setup)?)?, setup)?;
    let solids = vec![scene.add(lower), scene.add(upper)];
    Ok(Built {
        scene,
        droplets,
        solids,
        rigid_bodies: Vec::new(),
        shells: Vec::new(),
        gels: Vec::new(),
        interfaces: Vec::new(),
    })
}

/// Which geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Case {
    /// Two functions of x.
    Closure,
    /// Asymmetric teeth.
    Ratchet,
    /// An island between two branches.
    Branch,
}

/// A droplet in an elastic channel of any shape.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,121 steps, 2,243 evaluations of the flow.")]
struct Flags {
    /// Geometry
    #[arg(long, value_enum, default_value_t = Case::Closure)]
    case: Case,
    #[command(flatten)]
    scene: SceneFlags<ElasticFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { case, scene: flags }: &Flags) -> Result<()> {
    ensure!(
        *case != Case::Closure || flags.output.write_scene.is_none(),
        "--write-scene cannot write walls that are functions in code: leave it out, or give --case ratchet or branch"
    );
    // The walls, and a droplet where the channel begins.
    let (width, length) = (flags.region.width, flags.region.along.length);
    let shape = match case {
        Case::Closure => ChannelShape::Straight { width },
        Case::Ratchet => ratchet(width),
        Case::Branch => branch(length, width),
    };
    let setup = flags.setup(&shape, -0.5 * length)?;
    let built = match case {
        Case::Closure => build_with(&setup, &closure(length, width)?)?,
        Case::Ratchet | Case::Branch => setup.build()?,
    };
    for solid in &built.solids {
        say(built.scene.body(*solid)?.mesh().quality());
    }

    // The run and its results.
    let mut run = flags.watch(built, &setup, "custom_geometry")?;
    run.go(None)?;
    let summary = run.summary()?;
    run.finish(&summary)
}
