//! A steady swimmer and its stability, without a run.
//!
//! `cargo run --release --example steady_state` finds the droplet that a run of the same flags settles to, by Newton's
//! method, prints what was measured, and writes to `out/steady_state/`: `summary.json`, the results; `spectrum.csv`,
//! the eigenvalues; `steady_state.svg` (also as PNG), shape, concentration and the leading mode. `--help` lists flags.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use motile_steady_examples::SteadyFlags;

/// A steady swimmer and its stability, without a run.
#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    scene: SteadyFlags,
    /// The droplet at rest with particles everywhere alike, not a swimmer
    #[arg(long)]
    uniform: bool,
    /// Draw no pictures
    #[arg(long)]
    no_pictures: bool,
    /// Directory of the results
    #[arg(long, value_name = "DIRECTORY", default_value = "out/steady_state")]
    out: PathBuf,
}

fn main() -> ExitCode {
    motile_examples::run(|flags: &Flags| {
        motile_cli::steady::solve(&flags.scene.setup()?, flags.uniform, !flags.no_pictures, &flags.out)
    })
}
