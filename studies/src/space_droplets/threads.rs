//! Gain of two threads.

use std::cell::RefCell;
use std::time::Duration;

use anyhow::{Result, bail, ensure};
use motile::scene::integrator::Dynamics;
use motile_cli::run::say;
use motile_tests::validation::Table;
use motile_timing::Turns;
use rayon::{ThreadPool, ThreadPoolBuilder};
use space_droplets::SpaceDroplets;

use super::swimmer;

const DEGREE: usize = 16;
/// Distance of the centres of droplets (R0), and time spent on each number (seconds).
const DISTANCE: f64 = 2.5;
const SECONDS: f64 = 10.0;

/// Least times of an evaluation of several droplets in a row on one thread and on two, by turns.
pub(super) fn threads() -> Result<Table> {
    ensure!(cfg!(feature = "rayon"), "motile runs on one thread here: add --features rayon");
    let mut table = Table::new("Droplets without symmetry on two threads, degree 16", "droplets | ms | two threads");
    let pools = [1, 2].map(|threads| ThreadPoolBuilder::new().num_threads(threads).build());
    let [Ok(one), Ok(two)] = pools else { bail!("no threads to be had") };
    for count in [1, 2, 8] {
        let droplets = (0..count)
            .map(|k| Ok(swimmer(DEGREE, [100.0; 2], -1.0, 2.0)?.with_position([DISTANCE * f64::from(k), 0.0, 0.0])?));
        let droplets = SpaceDroplets::new(droplets.collect::<Result<_>>()?)?;
        let (mut state, failed) = (Vec::new(), RefCell::new(None));
        droplets.write_state(&mut state);
        let shared = RefCell::new((droplets, vec![0.0; state.len()]));
        let evaluate = |pool: &ThreadPool| {
            let (droplets, rate) = &mut *shared.borrow_mut();
            if let Err(error) = pool.install(|| droplets.rate(&state, rate)) {
                failed.replace(Some(error));
            }
        };
        let (mut single, mut double) = (|| evaluate(&one), || evaluate(&two));
        let turns = Turns::measure(Duration::from_secs_f64(SECONDS), &mut [&mut single, &mut double]);
        failed.into_inner().map_or(Ok(()), Err)?;
        let [single, double] = [0, 1].map(|work| 1e3 * turns.least(work));
        let row = format!("{count} | {single:.2} | {:.2}", single / double);
        say(&row);
        table.row(format_args!("{row}"));
    }
    Ok(table)
}
