//! Cost of droplets in three dimensions without symmetry, and their error in tubes: tables of
//! `docs/evidence/work-precision.md`.
//!
//! `cargo run --release -p studies --features rayon -- space_droplets TABLE` prints one of them; with `--write` it
//! becomes a file of `docs/tables`.

mod cost;
mod memory;
mod threads;
mod tube;

use anyhow::Result;
use clap::{Args, builder::PossibleValuesParser};
use motile_tests::validation::Table;
use space_droplets::{ContractileTension, SpaceDroplet};

use crate::tables;

/// Measures droplets in three dimensions without symmetry.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The table
    #[arg(value_parser = PossibleValuesParser::new(TABLES.map(|(name, _)| name)))]
    table: String,
    #[command(flatten)]
    keep: tables::Keep,
}

type Run = fn() -> Result<Table>;

const TABLES: [(&str, Run); 4] = [
    // Time of an evaluation next to the axisymmetric code at the same error.
    ("cost", cost::cost),
    // What two threads gain.
    ("threads", threads::threads),
    // Memory, error and a step up to degree 48.
    ("memory", memory::memory),
    // Speed of a swimmer in a tube.
    ("tube", tube::tube),
];

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let Flags { table, keep } = flags;
    for (name, find) in TABLES.into_iter().filter(|(name, _)| name == table) {
        keep.tables(&format!("space-droplets-{name}"), &format!("space_droplets {name}"), &[find()?])?;
    }
    Ok(())
}

/// A sphere with the particles from which swimmers along -z start.
fn swimmer(degree: usize, viscosities: [f64; 2], activity: f64, strength: f64) -> Result<SpaceDroplet> {
    let law = ContractileTension::thesis(10.0, activity, strength, 100.0)?;
    let sphere = SpaceDroplet::sphere(degree, 1.0, viscosities, law)?;
    Ok(sphere.with_particles(0.1, |s| 100.0 * (1.0 + 0.9 * s[2]))?)
}
