//! An active droplet swims in a channel with rigid no-slip walls (thesis, chapter 3).
//!
//! `cargo run --release --example rigid_channel` simulates it, prints what was measured, and writes to
//! `out/rigid_channel/` what the example `swimming_droplet` writes, with the channel and the path of the droplet in the
//! pictures. `--help` lists the flags.

use std::process::ExitCode;

use anyhow::Result;
use clap::Parser;
use motile::Swimmer;
use support::{ChannelFlags, DropletFlags, MethodFlags, OutputFlags, WatchedRun, caption};

/// An active droplet swims in a channel with rigid walls.
#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    channel: ChannelFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

fn main() -> ExitCode {
    support::run(swim)
}

fn swim(flags: &Flags) -> Result<()> {
    // The droplet, in the middle of its channel unless an offset is given, and the channel.
    let ChannelFlags { width, length, lateral_offset, drive } = flags.channel;
    flags.channel.cells(&flags.method)?;
    let swimmer =
        Swimmer { lengths: [length, width], offset: [0.0, lateral_offset], ..flags.droplet.swimmer(&flags.method) };
    let (mut scene, droplet) = swimmer.build_in_channel(drive.into())?;

    // The run, with all that watches it.
    let title = format!("{},  w = {width},  l = {length}", caption(&swimmer));
    let end = flags.method.time;
    let mut run = WatchedRun::new(&mut scene, droplet, &swimmer, end, &flags.output, "rigid_channel", title)?;
    let outcome = run.go(&mut scene)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let system = scene.system();
    let gradient = system.report().mean_pressure_gradient[0];
    summary.put("pressure_gradient", gradient, "mean along the channel, in the end");
    summary.put("minimum_gap", system.minimum_wall_gap(), "to the walls, over the run (R0)");
    summary.write(&run.directory().join("summary.json"))?;
    print!("{}", summary.table());
    run.write_pictures(&mut scene)?;
    println!("results in {}", run.directory().display());
    Ok(outcome?)
}
