//! Runs in constrictions of tubes, and the cost of an evaluation of the flow: tables of
//! `docs/evidence/results/three-dimensions.md`.
//!
//! `cargo run --release -p studies -- tubes TABLE` prints one of them; with `--write` it becomes a file of
//! `docs/tables`.

mod constrictions;
mod cost;

use anyhow::Result;
use clap::Args;
use motile::base::Region;
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};

use crate::tables;

/// Prints a table of runs in tubes.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Least throats that a droplet passes, or the cost of an evaluation
    #[arg(value_parser = ["constrictions", "cost"])]
    table: String,
    #[command(flatten)]
    keep: tables::Keep,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let found = if flags.table == "cost" { cost::cost() } else { constrictions::constrictions() };
    let name = &flags.table;
    flags.keep.tables(&format!("tubes-{name}"), &format!("tubes {name}"), &[found?])
}

/// One droplet, computed with so many nodes.
fn scene(region: Region, droplet: DropletSetup, nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    Setup { region, droplets: vec![droplet], method, ..Setup::default() }
}
