//! Steady swimmers, their stability and bifurcations: the tables of `docs/steady-states.md`.
//!
//! `cargo run --release -p studies -- steady_states TABLE` prints one of them; with `--write` it becomes a file of
//! `docs/tables`.

mod bifurcations;
mod parameters;
mod revolution;
mod swimmers;

use anyhow::Result;
use clap::{Args, ValueEnum};
use motile::base::Drive;
use motile::base::Region;
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};

use crate::tables;

/// Prints a table of steady states.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The table
    #[arg(value_enum)]
    table: Which,
    /// Nodes, where the table has no list of its own
    #[arg(long, default_value_t = 96)]
    nodes: usize,
    #[command(flatten)]
    keep: tables::Keep,
}

/// Sources that the tables depend on besides those of every run.
const INPUTS: [&str; 3] = ["tests/src/validation", "crates/motile-steady-states/src", "studies/src/steady_states"];

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Which {
    /// Swimmers of the reference: errors, residuals, seconds
    Swimmers,
    /// Growth rates of swings in channels
    Lateral,
    /// The threshold of polarisation over the width, and whether swimming sets in smoothly
    Threshold,
    /// Hopf points over width and activity
    Regimes,
    /// Speed over the length of a channel of width 2
    Length,
    /// Branches over the viscosity ratio, strong activity
    Contrast,
    /// Seconds of each part over the nodes
    Cost,
    /// Limit cycles of width 5 from their Hopf point on
    Cycle,
    /// Swimmers in three dimensions, in unbounded fluid
    Space,
    /// Those in tubes
    Tubes,
    /// Folds of their onset
    Folds,
    /// A run past the fold and back
    Hysteresis,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let Flags { table, nodes, keep } = *flags;
    let found = match table {
        Which::Swimmers => swimmers::swimmers(),
        Which::Lateral => swimmers::lateral(),
        Which::Cost => swimmers::cost(),
        Which::Cycle => bifurcations::cycle(nodes),
        Which::Threshold => bifurcations::threshold(nodes),
        Which::Regimes => bifurcations::regimes(nodes),
        Which::Length => parameters::length(nodes),
        Which::Contrast => parameters::contrast(nodes),
        Which::Space => revolution::space(),
        Which::Tubes => revolution::tubes(),
        Which::Hysteresis => revolution::hysteresis(),
        Which::Folds => revolution::folds(nodes),
    }?;
    let name = table.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
    keep.tables(&format!("steady-{name}"), &format!("steady_states {name} --nodes {nodes}"), &INPUTS, &found)
}

/// The method with so many nodes.
fn nodes(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements: 4 * nodes })
}

/// A droplet in a channel without a mean pressure gradient.
fn channel(length: f64, width: f64, activity: f64, excluded_volume: f64, count: usize) -> Setup {
    let region = Region::Channel { length, width, drive: Drive::ZeroGradient };
    let droplets = vec![DropletSetup::contractile(activity, excluded_volume)];
    Setup { region, method: nodes(count), droplets, ..Setup::default() }
}
