//! Generating function of the birth-death process and extinction of the branching process of appendix B of Cowley.
//!
//! `cargo run --release -p studies -- birth_death` compares both with independent computations; `--write` keeps the
//! tables as `docs/tables/birth-death.csv` and `birth-death-2.csv`.

#[allow(dead_code, reason = "the example prints more than the tables have")]
#[path = "../../examples/birth_death.rs"]
mod example;

use anyhow::{Context, Result};
use motile_tests::validation::Table;

use crate::tables::{self, Measure};
use example::{branching, branching_limit, branching_simulated, generating, probabilities, simulated_mean};

/// Cells at first, time, simulations of each mean.
const CELLS: u32 = 3;
const TIME: f64 = 1.5;
const SIMULATIONS: u32 = 10_000;
/// Birth and death rates.
const RATES: [[f64; 2]; 3] = [[1.0, 0.6], [0.7, 1.0], [0.8, 0.8]];
/// Probabilities of 0, 1 and 2 cells, and generations; after the last ones nothing changes.
const CHANCES: [[f64; 3]; 3] = [[0.2, 0.3, 0.5], [0.4, 0.1, 0.5], [0.5, 0.2, 0.3]];
const GENERATIONS: [u32; 7] = [1, 2, 3, 4, 6, 8, 10];
const LATE: u32 = 2000;

pub(crate) fn run(keep: tables::Keep) -> Result<()> {
    let columns = "lambda | mu | z | closed | forward | simulated | error";
    let mut means = Table::new("Mean of z^N at t = 1.5 of a birth-death process of 3 cells", columns);
    for rates @ [lambda, mu] in RATES {
        let found = probabilities(CELLS, rates, TIME);
        for k in 0..=10 {
            let z = -1.0 + 0.2 * f64::from(k);
            means.measure(format_args!("{lambda} | {mu} | {z:.1}"), || {
                let closed = generating(CELLS, rates, z, TIME).context("a z beyond the pole")?;
                let forward = found.iter().rev().fold(0.0, |sum, p| sum * z + p);
                let [simulated, error] = simulated_mean(CELLS, rates, z, TIME, SIMULATIONS);
                Ok(format!("{closed:.12} | {forward:.12} | {simulated:.5} | {error:.5}"))
            })?;
        }
    }
    let columns = "p0 | p1 | p2 | generations | closed | simulated | error | late | limit";
    let mut extinct = Table::new("Extinction of a branching process of one cell", columns);
    for chances @ [p0, p1, p2] in CHANCES {
        let (late, limit) = (branching(1, chances, LATE), branching_limit(1, chances));
        for generations in GENERATIONS {
            extinct.measure(format_args!("{p0} | {p1} | {p2} | {generations}"), || {
                let closed = branching(1, chances, generations);
                let [simulated, error] = branching_simulated(1, chances, generations, SIMULATIONS);
                Ok(format!("{closed:.12} | {simulated:.5} | {error:.5} | {late:.12} | {limit:.12}"))
            })?;
        }
    }
    keep.tables("birth-death", "birth_death", &[means, extinct])
}
