//! An active droplet swims between viscoelastic walls, whose stress relaxes.
//!
//! `cargo run --release --example viscoelastic_channel` simulates it, prints what was measured, and writes to
//! `out/viscoelastic_channel/` what the example `elastic_channel` writes; colours of the walls are the stress that
//! relaxes. `--relaxation-time` and `--maxwell-modulus` stand beside the flags of `elastic_channel`; `--help` lists
//! them.

use std::process::ExitCode;

use clap::Parser;
use motile_examples::{ElasticFlags, RelaxationFlags, SceneFlags, swim_between_walls};

/// An active droplet swims between viscoelastic walls.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,100 steps, 2,201 evaluations of the flow.")]
struct Flags {
    #[command(flatten)]
    relaxation: RelaxationFlags,
    #[command(flatten)]
    scene: SceneFlags<ElasticFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(|flags: &Flags| {
        swim_between_walls(&flags.scene, "viscoelastic_channel", |setup| {
            flags.relaxation.apply(setup);
            Ok(())
        })
    })
}
