//! Cost of boundary integrals over many nodes: time against their number, memory, threads.
//!
//! `cargo run --release -p studies --features rayon -- sums` prints a table, which `--write` keeps as
//! `docs/tables/sums.csv`. Times are those of an evaluation of the flow of droplets on a lattice, area fraction 0.3,
//! 64 nodes each, equal viscosities, the least of some turns, in units of a forward and an inverse FFT of 120 x 120
//! values by turns; exponents are those against the row before.

use std::cell::RefCell;
use std::time::Duration;

use allocation_counter::measure;
use anyhow::{Context, Result};
use motile::boundary_integrals::BoundaryIntegral;
use motile::scene::{FlowError, Hydrodynamics, Markers};
use motile_cli::run::say;
use motile_tests::validation::Table;
use motile_tests::validation::fast_sums::{Surroundings, Suspension};
use motile_timing::{PlainPair, Turns};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::tables;

/// Time spent on each number of nodes, or that of two turns if they take longer (seconds).
const SECONDS: f64 = 3.0;
const FRACTION: f64 = 0.3;
/// Regions, tolerances and the largest numbers of droplets along a side of a lattice.
const CASES: [(Surroundings, f64, usize); 5] = [
    (Surroundings::Box, 1e-6, 128),
    (Surroundings::Box, 1e-8, 32),
    (Surroundings::Box, 1e-3, 32),
    (Surroundings::Plane, 1e-6, 32),
    (Surroundings::Channel, 1e-6, 32),
];
const SIDES: [usize; 8] = [2, 3, 4, 8, 16, 32, 64, 128];

pub(crate) fn run(keep: tables::Keep) -> Result<()> {
    let columns = "region | tolerance | nodes | ms | FFT pairs | exponent | bytes a node | two threads";
    let mut table = Table::new("an evaluation of the flow of many droplets, area fraction 0.3", columns);
    let pools = [1, 2].map(|threads| ThreadPoolBuilder::new().num_threads(threads).build());
    let [Ok(one), Ok(two)] = pools else { anyhow::bail!("no threads to be had") };
    for (region, tolerance, most) in CASES {
        let mut before: Option<(usize, f64)> = None;
        for side in SIDES.into_iter().filter(|side| *side <= most) {
            let suspension = Suspension::lattice([side, side], FRACTION, 1.0);
            let nodes = suspension.nodes();
            let mut built = None;
            let memory = measure(|| built = Some(evaluated(&suspension, region, tolerance)));
            let (solver, markers) = built.context("no scene")??;
            let [ms, pairs, gain] = times((solver, markers), [&one, &two], SECONDS)?;
            let exponent = before.map_or_else(String::new, |(fewer, least)| {
                format!("{:.2}", (pairs / least).ln() / (nodes as f64 / fewer as f64).ln())
            });
            before = Some((nodes, pairs));
            let name = format!("{region:?}").to_lowercase();
            let gain = if cfg!(feature = "rayon") { format!("{gain:.2}") } else { String::new() };
            let bytes = memory.bytes_max as f64 / nodes as f64;
            let row =
                format!("{name} | {tolerance:e} | {nodes} | {ms:.3} | {pairs:.1} | {exponent} | {bytes:.0} | {gain}");
            say(&row);
            table.row(format_args!("{row}"));
        }
    }
    keep.tables("sums", "sums", &[table])
}

/// A solver that has found its flow once, so that it has all its memory.
fn evaluated(suspension: &Suspension, region: Surroundings, tolerance: f64) -> Result<(BoundaryIntegral, Markers)> {
    let (mut solver, mut markers) = suspension.solver(region, tolerance)?;
    solver.velocities(&mut markers)?;
    Ok((solver, markers))
}

/// Least time of an evaluation on one thread, in milliseconds and in FFT pairs, and how many times as fast two are.
fn times(
    (mut solver, mut markers): (BoundaryIntegral, Markers),
    pools: [&ThreadPool; 2],
    seconds: f64,
) -> Result<[f64; 3]> {
    let mut pair = PlainPair::new(120, 120);
    let failed: RefCell<Option<FlowError>> = RefCell::new(None);
    let shared = RefCell::new((&mut solver, &mut markers));
    let mut plain = || pair.run();
    let run = |pool: &ThreadPool| {
        let (solver, markers) = &mut *shared.borrow_mut();
        if let Err(error) = pool.install(|| solver.velocities(markers).map(drop)) {
            failed.replace(Some(error));
        }
    };
    let (mut single, mut double) = (|| run(pools[0]), || run(pools[1]));
    let turns = Turns::measure(Duration::from_secs_f64(seconds), &mut [&mut plain, &mut single, &mut double]);
    failed.into_inner().map_or(Ok(()), Err)?;
    let [unit, one, two] = [0, 1, 2].map(|work| turns.least(work));
    Ok([1e3 * one, one / unit, one / two])
}

#[cfg(test)]
mod tests;
