//! An active droplet swims between elastic walls (Cowley, chapter 4).
//!
//! `cargo run --release --example elastic_channel` simulates it, prints what was measured, and writes to
//! `out/elastic_channel/` what the example `rigid_channel` writes, with the walls in the pictures, in the table and for
//! ParaView (displacement, stress). `--help` lists the flags.

use std::process::ExitCode;

use clap::Parser;
use motile_examples::{ElasticFlags, SceneFlags, swim_between_walls};

/// An active droplet swims between elastic walls.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,106 steps, 2,213 evaluations of the flow.")]
struct Flags {
    #[command(flatten)]
    scene: SceneFlags<ElasticFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(|flags: &Flags| swim_between_walls(&flags.scene, "elastic_channel", |_| Ok(())))
}
