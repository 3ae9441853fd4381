//! An active droplet swims between elastic walls (Cowley, chapter 4).
//!
//! `cargo run --release --example elastic_channel` simulates it, prints what was measured, and writes to
//! `out/elastic_channel/` what the example `rigid_channel` writes, with the walls in the pictures, in the table and for
//! ParaView (displacement, stress). `--help` lists the flags.

use std::process::ExitCode;

use anyhow::Result;
use clap::Parser;
use motile::elastic_solids::ChannelShape;
use motile::motile_scene::Body;
use motile_examples::{ElasticFlags, SceneFlags};
use motile_output::run::say;

/// An active droplet swims between elastic walls.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 4,431 steps, 8,863 evaluations of the flow.")]
struct Flags {
    #[command(flatten)]
    scene: SceneFlags<ElasticFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { scene: flags }: &Flags) -> Result<()> {
    // The droplet and the walls.
    let shape = ChannelShape::Straight { width: flags.region.width };
    let setup = flags.setup(&shape, 0.0)?;
    let built = setup.build()?;
    for wall in &built.solids {
        let wall = built.scene.body(*wall)?;
        say(format_args!("{}: {}", wall.name(), wall.mesh().quality()));
    }

    // The run, with all that watches it.
    let mut run = flags.watch(built, &setup, "elastic_channel")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    run.put_regime(&mut summary)?;
    summary.put("pressure_gradient", run.last()?.pressure_gradient, "mean along the channel");
    run.finish(&summary)
}
