//! Timing by turns.

use std::time::{Duration, Instant};

/// Times of several works that ran by turns, the first of which is the unit.
#[derive(Debug, Clone)]
pub struct Turns {
    /// Seconds of each work in each turn.
    samples: Vec<Vec<f64>>,
}

impl Turns {
    /// Runs `works` by turns for about `budget`, at least once each.
    pub fn measure(budget: Duration, works: &mut [&mut dyn FnMut()]) -> Self {
        let mut turns = Self { samples: vec![Vec::new(); works.len()] };
        let start = Instant::now();
        while turns.samples.iter().any(Vec::is_empty) || start.elapsed() < budget {
            for (work, samples) in works.iter_mut().zip(&mut turns.samples) {
                samples.push(seconds(work));
            }
        }
        turns
    }

    /// Median time of a work (seconds).
    #[must_use]
    pub fn time(&self, work: usize) -> f64 {
        median(&mut self.samples[work].clone())
    }

    /// Least time of a work (seconds): that of the turn least disturbed, for works so long that a busy machine
    /// interrupts most of them.
    #[must_use]
    pub fn least(&self, work: usize) -> f64 {
        self.samples[work].iter().fold(f64::INFINITY, |least, &time| least.min(time))
    }

    /// Median of the ratios of a work's time to that of the unit in the same turn.
    #[must_use]
    pub fn ratio(&self, work: usize) -> f64 {
        let mut ratios: Vec<f64> =
            self.samples[work].iter().zip(&self.samples[0]).map(|(time, unit)| time / unit).collect();
        median(&mut ratios)
    }
}

/// The median, not a number of nothing. Sorts.
#[must_use]
pub fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Prints the times of `works`, each with its name, in units of that of the first: medians over many turns.
pub fn print_ratios(size: &str, works: &mut [(&str, &mut dyn FnMut())]) {
    // A run as a test only has to get through.
    let budget = Duration::from_millis(if std::env::args().any(|arg| arg == "--test") { 0 } else { 1500 });
    let (names, mut runs): (Vec<&str>, Vec<&mut dyn FnMut()>) =
        works.iter_mut().map(|(name, work)| (*name, &mut **work as &mut dyn FnMut())).unzip();
    let turns = Turns::measure(budget, &mut runs);
    print!("{size}: {} {:.1} us", names[0], turns.time(0) * 1e6);
    for (index, name) in names.iter().enumerate().skip(1) {
        print!(", {name} {:.2}", turns.ratio(index));
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
