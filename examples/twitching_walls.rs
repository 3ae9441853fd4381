//! An active droplet swims between walls that twitch: springs along their meshes contract at random.
//!
//! `cargo run --release --example twitching_walls` simulates it, prints what was measured, and writes to
//! `out/twitching_walls/` what the example `elastic_channel` writes; lines in the walls are the springs that are on,
//! colours their stress. `--tension`, `--on-rate`, `--off-rate` and `--wall-seed` stand beside the flags of
//! `elastic_channel`; `--help` lists them.

use std::process::ExitCode;

use clap::Parser;
use motile_examples::{ElasticFlags, SceneFlags, TwitchingFlags, swim_between_walls};

/// An active droplet swims between walls that twitch.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,237 steps, 2,475 evaluations of the flow.")]
struct Flags {
    #[command(flatten)]
    twitching: TwitchingFlags,
    #[command(flatten)]
    scene: SceneFlags<ElasticFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(|flags: &Flags| {
        swim_between_walls(&flags.scene, "twitching_walls", |setup| {
            flags.twitching.apply(setup);
            Ok(())
        })
    })
}
