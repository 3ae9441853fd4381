//! Timing by turns.

use std::time::{Duration, Instant};

use criterion::Criterion;

/// A piece of work with its name.
pub(crate) type Named<'a> = (&'a str, &'a mut dyn FnMut());

/// Criterion with short runs: ratios matter here, which [`print_ratios`] measures by turns.
pub(crate) fn short() -> Criterion {
    let time = Duration::from_millis(500);
    Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(100)).measurement_time(time)
}

/// Prints the times of `works` in units of that of `unit`. All run by turns, so that a busy machine slows them alike, and of each
/// the fastest turn counts, the one least disturbed.
pub(crate) fn print_ratios(size: &str, unit: &mut Named<'_>, works: &mut [Named<'_>]) {
    // A run as a test only has to get through.
    let budget = Duration::from_millis(if std::env::args().any(|arg| arg == "--test") { 0 } else { 1500 });
    let mut of_unit = f64::INFINITY;
    let mut of_works = vec![f64::INFINITY; works.len()];
    let start = Instant::now();
    while of_unit == f64::INFINITY || start.elapsed() < budget {
        of_unit = of_unit.min(seconds(unit.1));
        for (work, time) in works.iter_mut().zip(&mut of_works) {
            *time = time.min(seconds(work.1));
        }
    }
    print!("{size}: {} {:.1} us", unit.0, of_unit * 1e6);
    for (work, time) in works.iter().zip(&of_works) {
        print!(", {} {:.2}", work.0, time / of_unit);
    }
    println!(" of it");
}

/// Mean time of one run in a turn of several, some hundred microseconds long.
fn seconds(work: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    let mut runs = 0;
    while runs == 0 || start.elapsed() < Duration::from_micros(300) {
        work();
        runs += 1;
    }
    start.elapsed().as_secs_f64() / f64::from(runs)
}
