//! An active droplet swims between elastic walls (thesis, chapter 4).
//!
//! `cargo run --release --example elastic_channel` simulates it, prints what was measured, and writes to
//! `out/elastic_channel/` what the example `rigid_channel` writes, with the walls in the pictures, in the table and for
//! ParaView (displacement, stress). `--help` lists the flags.

use std::process::ExitCode;

use anyhow::Result;
use clap::Parser;
use motile::active_interface::trajectory::{Evidence, RegimeCriteria};
use motile::ib_core::Body;
use motile::{Built, ChannelShape};
use motile_examples::{DropletFlags, ElasticFlags, MethodFlags, OutputFlags, WatchedRun, caption, say};

/// An active droplet swims between elastic walls.
#[derive(Debug, Parser)]
struct Flags {
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
    // The droplet and the walls.
    let shape = ChannelShape::Straight { width: flags.walls.width };
    let setup = flags.walls.setup(&shape, &flags.droplet, &flags.method, 0.0, None)?;
    let Built { mut scene, droplets, solids } = setup.build()?;
    for wall in &solids {
        say(format_args!("{}: {}", scene.body(*wall)?.name(), scene.body(*wall)?.mesh().quality()));
    }

    // The run, with all that watches it.
    let title = format!("{},  {}", caption(&setup), flags.walls.caption()?);
    let mut run =
        WatchedRun::new(&mut scene, &droplets, &setup, &flags.method, &flags.output, "elastic_channel", title)?;
    let outcome = run.go(&mut scene)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let report = run.recorder().records().regime(&RegimeCriteria::default())?;
    let Evidence { amplitude, .. } = report.evidence;
    summary.put("regime", report.regime.to_string(), "across the channel");
    summary.put("amplitude", amplitude, "largest distance from the centre line, in the end (R0)");
    if let Some(last) = run.recorder().records().records().last() {
        summary.put("pressure_gradient", last.pressure_gradient, "mean along the channel");
    }
    summary.write(&run.directory().join("summary.json"))?;
    say(summary.table().trim_end());
    run.write_pictures(&mut scene)?;
    say(format_args!("results in {}", run.directory().display()));
    Ok(outcome?)
}
