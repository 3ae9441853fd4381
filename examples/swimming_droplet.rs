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
//! Of a scene file it records all droplets, interfaces and other bodies, and the flow (`droplets.csv`,
//! `interfaces.csv`, `bodies.csv`, `flow.csv`), as the program `motile run` does.
//!
//! `--help` lists the flags.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use clap::Parser;
use motile_examples::{BoxFlags, SceneFlags, scene_file};

/// An active droplet swims in a periodic box.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,169 steps, 2,339 evaluations of the flow.")]
struct Flags {
    /// Scene file (TOML) to start from: any region, method, droplets and solids; the other flags override its entries
    #[arg(long = "scene", value_name = "FILE")]
    file: Option<PathBuf>,
    #[command(flatten)]
    scene: SceneFlags<BoxFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { file, scene: flags }: &Flags) -> Result<()> {
    flags.output.check("swimming_droplet", file.as_deref())?;
    // The scene: a droplet in a box, or what the file says.
    let file = file.as_deref().map(scene_file).transpose()?;
    let mut setup = flags.method.setup(&flags.droplet, file)?;
    flags.region.apply(&mut setup)?;

    // The run, with all that watches it.
    let mut run = flags.watch(setup.build()?, &setup, "swimming_droplet")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let summary = run.summary()?;
    run.finish(&summary)
}
