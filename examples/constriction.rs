//! An active droplet meets a constriction between elastic walls (thesis, section 4.1.3).
//!
//! `cargo run --release --example constriction` simulates it until it is clear what becomes of the droplet, prints that
//! and what was measured, and writes to `out/constriction/` what the example `elastic_channel` writes. The channel is
//! that of thesis figure 4.18, the droplet starts in the middle of its wide part; `--width`, `--throat` and
//! `--throat-length` change it. `--help` lists the flags.

use std::process::ExitCode;

use anyhow::Result;
use clap::Parser;
use motile::elastic_solids::Constriction;
use support::{
    DropletFlags, ElasticFlags, MethodFlags, OutputFlags, Passage, Verdict, WatchedRun, caption, positive, say,
    wall_caption,
};

/// An active droplet meets a constriction between elastic walls.
#[derive(Debug, Parser)]
struct Flags {
    /// Width of the throat (R0)
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    throat: f64,
    /// Length of the throat (R0)
    #[arg(long, default_value_t = 4.0, value_parser = positive, allow_hyphen_values = true)]
    throat_length: f64,
    /// Length of the ramps on both sides of it (R0)
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    ramp: f64,
    /// Time after which a droplet that is still on its way is called undecided
    #[arg(long, default_value_t = 400.0, value_parser = positive, allow_hyphen_values = true)]
    patience: f64,
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    walls: ElasticFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}
