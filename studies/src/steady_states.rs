//! Steady swimmers, their stability and bifurcations: the tables of `docs/evidence/results/steady-states.md`.
//!
//! `cargo run --release -p studies -- steady_states TABLE` prints one of them; with `--write` it becomes a file of
//! `docs/tables`.

mod bifurcations;
mod bubble;
mod parameters;
mod revolution;
mod swimmers;

use anyhow::Result;
use clap::{Args, builder::PossibleValuesParser};
use motile::base::Drive;
use motile::base::Region;
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};

use motile_tests::validation::Table;

use crate::tables;

pub(crate) use bifurcations::{activity, polarisation};

/// Prints a table of steady states.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The table
    #[arg(value_parser = PossibleValuesParser::new(TABLES.map(|(name, _)| name)))]
    table: String,
    /// Nodes, where the table has no list of its own
    #[arg(long, default_value_t = 96)]
    nodes: usize,
    #[command(flatten)]
    keep: tables::Keep,
}

/// What makes the tables of a name, with so many nodes where they have no list of their own.
type Run = fn(usize) -> Result<Vec<Table>>;

const TABLES: [(&str, Run); 13] = [
    // Swimmers of the reference: errors.
    ("swimmers", |_| swimmers::swimmers()),
    // Growth rates of swings in channels.
    ("lateral", |_| swimmers::lateral()),
    // The threshold of polarisation over the width, and whether swimming sets in smoothly.
    ("threshold", bifurcations::threshold),
    // Hopf points over width and activity.
    ("regimes", bifurcations::regimes),
    // Speed over the length of a channel of width 2.
    ("length", parameters::length),
    // Branches over the viscosity ratio, strong activity.
    ("contrast", parameters::contrast),
    // Limit cycles of width 5 from their Hopf point on.
    ("cycle", bifurcations::cycle),
    // Swimmers in three dimensions: in unbounded fluid, in tubes, the folds of their onset, a run past a fold and back.
    ("space", |_| revolution::space()),
    ("tubes", |_| revolution::tubes()),
    ("folds", revolution::folds),
    ("hysteresis", |_| revolution::hysteresis()),
    // How swimming sets in over the tension, against the closed form for a sphere.
    ("onset", revolution::onset),
    // The fold of a bubble in extension, against the exact one.
    ("bubble", |_| bubble::bubble()),
];

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let Flags { table, nodes, keep } = flags;
    for (name, tables) in TABLES.into_iter().filter(|(name, _)| name == table) {
        let (file, command) = (format!("steady-{name}"), format!("steady_states {name} --nodes {nodes}"));
        keep.tables(&file, &command, &tables(*nodes)?)?;
    }
    Ok(())
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
