//! Elastic walls of a shape of your own.
//!
//! `cargo run --release --example custom_geometry` lets a droplet swim through the channel that the function `closure`
//! below describes, which is meant to be copied; `--case ratchet` and `--case branch` through two of the ready ones.
//! Prints what was measured and writes to `out/custom_geometry/` what the example `elastic_channel` writes. `--help`
//! lists the flags.

use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, ValueEnum};
use motile::ElasticChannel;
use motile::elastic_solids::{
    Channel, SolidError,
    channel::{BranchingChannel, Ratchet},
};
use motile_examples::{DropletFlags, ElasticFlags, MethodFlags, OutputFlags, WatchedRun, caption, say, wall_caption};

/// A channel whose walls are functions of x: bumps below, and a step to a narrower part above.
fn closure(period: f64, width: f64) -> Result<Channel, SolidError> {
    let wave = std::f64::consts::TAU / period;
    let lower = move |x: f64| -0.5 * width - 0.25 * (2.0 * wave * x).cos();
    let upper = move |x: f64| 0.5 * width - 0.2 * (3.0 * ((wave * x).sin() - 0.5)).tanh();
    Channel::between(-0.5 * period, period, lower, upper)
}

/// A channel with asymmetric teeth.
fn ratchet(period: f64, width: f64) -> Result<Channel, SolidError> {
    Ratchet { period, width, throat: 0.65 * width, teeth: 3, rise: 0.7, sharp: false }.channel()
}

/// A channel that parts around an island; its upper branch is the wider one.
fn branch(period: f64, width: f64) -> Result<Channel, SolidError> {
    let (island_length, ramp) = (0.35 * period, 0.2 * period);
    let branches = [0.6 * width, 0.7 * width];
    BranchingChannel { period, width, branches, island_length, island_thickness: 0.5 * width, ramp }.channel()
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
struct Flags {
    /// Geometry
    #[arg(long, value_enum, default_value_t = Case::Closure)]
    case: Case,
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    walls: ElasticFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(flags: &Flags) -> Result<()> {
    // The walls, and a droplet where the channel begins.
    let channel: ElasticChannel = flags.walls.channel(&flags.droplet, &flags.method, -0.5 * flags.walls.length)?;
    let [period, width] = channel.swimmer.lengths;
    let shape = match flags.case {
        Case::Closure => closure(period, width)?,
        Case::Ratchet => ratchet(period, width)?,
        Case::Branch => branch(period, width)?,
    };
    let (mut scene, droplet, solids) = channel.build_in(&shape)?;
    for solid in &solids {
        say(format_args!("{}", scene.body(*solid)?.mesh().quality()));
    }

    // The run and its results.
    let (swimmer, end) = (&channel.swimmer, flags.method.time);
    let title = format!("{},  {}", caption(swimmer), wall_caption(&channel));
    let run = WatchedRun::new(&mut scene, droplet, swimmer, end, &flags.output, "custom_geometry", title)?;
    let mut run = run.with_set_back(channel.set_back());
    let outcome = run.go(&mut scene)?;
    let summary = run.summary()?;
    summary.write(&run.directory().join("summary.json"))?;
    say(summary.table().trim_end());
    run.write_pictures(&mut scene)?;
    say(format_args!("results in {}", run.directory().display()));
    Ok(outcome?)
}
