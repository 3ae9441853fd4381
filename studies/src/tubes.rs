//! Runs in constrictions of tubes, and the cost of an evaluation of the flow: tables of `docs/three-dimensions.md`.
//!
//! `cargo run --release -p studies -- tubes TABLE` prints one of them; with `--write` it becomes a file of
//! `docs/tables`.

mod constrictions;
mod cost;

use anyhow::Result;
use clap::{Args, ValueEnum};
use motile::base::Region;
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};

use crate::tables;

/// Prints a table of runs in tubes.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The table
    #[arg(value_enum)]
    table: Which,
    #[command(flatten)]
    keep: tables::Keep,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Which {
    /// Least throats that a droplet passes, beside those of channels in the plane
    Constrictions,
    /// Cost of an evaluation beside the plane's, and the gain of two threads
    Cost,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let Flags { table, keep } = *flags;
    let (name, inputs, found): (_, &[&str], _) = match table {
        Which::Constrictions => ("constrictions", &constrictions::INPUTS, constrictions::constrictions()),
        Which::Cost => ("cost", &["studies/src/tubes/cost.rs", "benches/src/turns.rs"], cost::cost()),
    };
    keep.tables(&format!("tubes-{name}"), &format!("tubes {name}"), inputs, &[found?])
}

/// One droplet, computed with so many nodes.
fn scene(region: Region, droplet: DropletSetup, nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    Setup { region, droplets: vec![droplet], method, ..Setup::default() }
}
