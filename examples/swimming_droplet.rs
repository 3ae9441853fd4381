//! An active droplet swims in a periodic box.
//!
//! `cargo run --release --example swimming_droplet` simulates it until it swims steadily, prints what was measured, and
//! writes to `out/swimming_droplet/`:
//!
//! * `final.png`, a picture of the final state, and `swim.gif`, an animation of the run;
//! * `time_series.svg` and `concentration_profile.svg`, plots (also as PNG);
//! * `trajectory.csv`, all observables over time, and `summary.json`, the results;
//! * `vtk/fields.pvd` and `vtk/interface.pvd`, the flow and the interface for ParaView.
//!
//! `--help` lists the flags.

use std::process::ExitCode;

use anyhow::Result;
use clap::Parser;
use motile::Swimmer;
use motile_examples::{BoxFlags, DropletFlags, MethodFlags, OutputFlags, WatchedRun, caption, say};

/// An active droplet swims in a periodic box.
#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    region: BoxFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(flags: &Flags) -> Result<()> {
    // The droplet, in the middle of its box unless an offset is given, and the box.
    flags.region.check(&flags.method)?;
    let side = flags.region.side;
    let swimmer =
        Swimmer { lengths: [side, side], offset: flags.region.offset, ..flags.droplet.swimmer(&flags.method) };
    let (mut scene, droplet) = swimmer.build()?;

    // The run, with all that watches it.
    let (end, title) = (flags.method.time, caption(&swimmer));
    let mut run = WatchedRun::new(&mut scene, droplet, &swimmer, end, &flags.output, "swimming_droplet", title)?;
    let outcome = run.go(&mut scene)?;

    // The results, also of a run that broke off.
    let summary = run.summary()?;
    summary.write(&run.directory().join("summary.json"))?;
    say(summary.table().trim_end());
    run.write_pictures(&mut scene)?;
    say(format_args!("results in {}", run.directory().display()));
    Ok(outcome?)
}
