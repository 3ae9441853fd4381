//! Five questions about what cells do and feel: the tables of
//! `docs/evidence/results/{cortex,confinement,gradients,scattering,swing}.md`.
//!
//! `cargo run --release -p studies -- questions TABLE` prints one of them; with `--write` it becomes a file of
//! `docs/tables`.

mod confinement;
mod cortex;
mod gradients;
mod scattering;
mod swing;

use anyhow::Result;
use clap::{Args, builder::PossibleValuesParser};
use motile::setup::{IntegralMethod, Method};
use motile_tests::validation::Table;

use crate::tables;

/// Answers a question about what cells do and feel.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The table
    #[arg(value_parser = PossibleValuesParser::new(TABLES.map(|(name, _)| name)))]
    table: String,
    #[command(flatten)]
    keep: tables::Keep,
}

type Run = fn() -> Result<Vec<Table>>;

const TABLES: [(&str, Run); 6] = [
    // Threshold, speed and shape from droplet to cortex.
    ("cortex", cortex::cortex),
    // Speed over the width of a channel, with friction.
    ("confinement", confinement::confinement),
    // Turning of swimmers in gradients of activity.
    ("gradients", gradients::gradients),
    // Encounters of two swimmers in three dimensions.
    ("scattering", scattering::scattering),
    // Swing of an unstable swimmer in a tube: plane or helix.
    ("swing", swing::swing),
    // The same in tubes of other radii.
    ("tubes", swing::tubes),
];

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let Flags { table, keep } = flags;
    for (name, tables) in TABLES.into_iter().filter(|(name, _)| name == table) {
        keep.tables(&format!("questions-{name}"), &format!("questions {name}"), &tables()?)?;
    }
    Ok(())
}

/// Boundary integrals with so many nodes.
fn nodes(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements: 4 * nodes })
}
