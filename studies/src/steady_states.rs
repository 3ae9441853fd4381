//! Steady swimmers, their stability and bifurcations: the tables of `docs/steady-states.md`.
//!
//! `cargo run --release -p studies -- steady_states TABLE` prints one of them.

mod bifurcations;
mod parameters;
mod swimmers;

use anyhow::Result;
use clap::{Args, ValueEnum};
use motile::stokes_grid::Drive;
use motile::{DropletSetup, IntegralMethod, Method, Region, Setup};
use motile_examples::say;

/// Prints a table of steady states.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The table
    #[arg(value_enum)]
    table: Table,
    /// Nodes, where the table has no list of its own
    #[arg(long, default_value_t = 96)]
    nodes: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Table {
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
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    match flags.table {
        Table::Swimmers => swimmers::swimmers(),
        Table::Lateral => swimmers::lateral(),
        Table::Cost => swimmers::cost(),
        Table::Cycle => bifurcations::cycle(flags.nodes),
        Table::Threshold => bifurcations::threshold(flags.nodes),
        Table::Regimes => bifurcations::regimes(flags.nodes),
        Table::Length => parameters::length(flags.nodes),
        Table::Contrast => parameters::contrast(flags.nodes),
    }
}

/// The method with so many nodes.
fn nodes(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, cells: 4 * nodes })
}

/// A droplet in a channel without a mean pressure gradient.
fn channel(length: f64, width: f64, activity: f64, excluded_volume: f64, count: usize) -> Setup {
    let region = Region::Channel { length, width, drive: Drive::ZeroGradient };
    let droplets = vec![DropletSetup::contractile(activity, excluded_volume)];
    Setup { region, method: nodes(count), droplets, ..Setup::default() }
}

/// The head of a table.
fn head(names: &[&str]) {
    say(format_args!("| {} |", names.join(" | ")));
    say(format_args!("|{}", "---|".repeat(names.len())));
}

/// A row of a table.
fn row(cells: &[String]) {
    say(format_args!("| {} |", cells.join(" | ")));
}
