//! Extinction of a birth-death process: appendix B of Cowley.
//!
//! `cargo run --release --example birth_death` compares, for `n` cells that divide at a rate lambda and die at a rate
//! mu, the probability that all of them have died out by a time `--by`: the closed form (B.11) and seeded simulations;
//! and that they ever do: the closed form (B.12), the series (B.20) and the same simulations. Then the ratios
//! A = mu/lambda that observed fractions of tumours give, with their bounds (B.23, B.24).
//!
//! (B.21) holds for mu < lambda only: the transformation of the series' hypergeometric function needs a probability of
//! death below 1/2. Beyond it (mu/lambda)^n exceeds 1, whereas the series gives 1, as it must.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::Parser;
use motile_cli::run::say;
use motile_examples::positive;

/// Compares closed form, series and simulation of the extinction of a birth-death process.
#[derive(Debug, Parser)]
struct Flags {
    /// Numbers of cells at first
    #[arg(long, value_delimiter = ',', default_values_t = [1, 4, 11],
        value_parser = clap::value_parser!(u32).range(1..=1000))]
    cells: Vec<u32>,
    /// Rate lambda at which a cell divides (1 per time)
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    birth: f64,
    /// Rates mu at which a cell dies (1 per time)
    #[arg(long, value_delimiter = ',', default_values_t = [0.5, 0.9, 1.0, 1.1, 2.0], value_parser = positive,
        allow_hyphen_values = true)]
    death: Vec<f64>,
    /// Time by which cells have died out, (B.11)
    #[arg(long, value_name = "TIME", default_value_t = 2.0, value_parser = positive, allow_hyphen_values = true)]
    by: f64,
    /// Simulations of each case
    #[arg(long, default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    simulations: u32,
    /// Seed of the simulations
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Cells from which on a simulation is taken not to die out.
const MANY: u32 = 2000;
/// Terms of the series at most.
const TERMS: u32 = 20_000_000;

fn main() -> ExitCode {
    motile_examples::run(|flags: &Flags| {
        say(format_args!("                by time {:<42}  ever", flags.by));
        say("   n  mu        closed (B.11)  simulated, standard error   \
             closed (B.12)  series (B.20)  (mu/lambda)^n (B.21)  simulated, standard error");
        for &n in &flags.cells {
            for &death in &flags.death {
                let rates = Rates { birth: flags.birth, death };
                let [by, ever] = rates.simulated(n, flags.by, flags.simulations, flags.seed);
                say(format_args!(
                    "{n:>4}  {death:<8}  {:<13.6}  {:.4} +- {:<17.4}  {:<13.6}  {:<13.6}  {:<20.6}  {:.4} +- {:.4}",
                    rates.extinct_by(n, flags.by),
                    by.0,
                    by.1,
                    rates.extinct(n),
                    series(n, rates.ratio())?,
                    rates.ratio().powi(n as i32),
                    ever.0,
                    ever.1
                ));
            }
        }
        say("\n  cells at first   fraction with a tumour   A       bounds");
        for (cells, error, fraction) in [(103.0, 10.0, 0.9), (36.0, 3.0, 0.2), (11.0, 2.0, 0.9), (4.0, 1.0, 0.2)] {
            let [low, high] = [(cells - error, fraction + 0.05), (cells + error, fraction - 0.05)].map(rate_ratio);
            let a = rate_ratio((cells, fraction));
            say(format_args!(
                "  {:<15}  {:<23}  {a:.3}   {low:.3} to {high:.3}",
                format!("{cells} +- {error}"),
                format!("{fraction} +- 0.05")
            ));
        }
        Ok(())
    })
}

/// Rates at which a cell divides and dies, lambda and mu (1 per time).
#[derive(Debug, Clone, Copy)]
struct Rates {
    birth: f64,
    death: f64,
}

impl Rates {
    /// mu/lambda.
    fn ratio(self) -> f64 {
        self.death / self.birth
    }

    /// Probability that `n` cells die out: (B.12).
    fn extinct(self, n: u32) -> f64 {
        self.ratio().min(1.0).powi(n as i32)
    }

    /// Probability that `n` cells have died out by a time: (B.11), as [mu x/(1 + min(mu, lambda) x)]^n with
    /// x = (1 - e^(-d t))/d and d = |mu - lambda|, which is exact also where the rates are nearly equal.
    fn extinct_by(self, n: u32, time: f64) -> f64 {
        let difference = (self.death - self.birth).abs();
        let x = if difference == 0.0 { time } else { -(-difference * time).exp_m1() / difference };
        (self.death * x / (1.0 + self.death.min(self.birth) * x)).powi(n as i32)
    }

    /// The fractions of simulations that die out by a time and ever, each with its standard error.
    fn simulated(self, n: u32, time: f64, simulations: u32, seed: u64) -> [(f64, f64); 2] {
        let (total, mut state) = (self.birth + self.death, seed);
        let mut extinct = [0_u32; 2];
        for _ in 0..simulations {
            let (mut cells, mut now) = (n, 0.0);
            while (1..MANY).contains(&cells) {
                now -= (1.0 - uniform(&mut state)).ln() / (total * f64::from(cells));
                cells = if total * uniform(&mut state) < self.death { cells - 1 } else { cells + 1 };
            }
            extinct[0] += u32::from(cells == 0 && now <= time);
            extinct[1] += u32::from(cells == 0);
        }
        extinct.map(|extinct| {
            let fraction = f64::from(extinct) / f64::from(simulations);
            (fraction, (fraction * (1.0 - fraction) / f64::from(simulations)).sqrt())
        })
    }
}

/// Probability that `n` cells die out as the series (B.20) over the number of births, each term from the one before.
///
/// # Errors
/// A ratio that is not above 0; a series that does not converge within 2e7 terms to 1e-12.
fn series(n: u32, ratio: f64) -> Result<f64> {
    ensure!(ratio.is_finite() && ratio > 0.0, "ratio = {ratio}: give one above 0");
    let death = ratio / (1.0 + ratio);
    let n = f64::from(n);
    let factor = death * (1.0 - death);
    let (mut term, mut sum) = (death.powf(n), 0.0);
    for k in (0..TERMS).map(f64::from) {
        sum += term;
        // n (2k + n - 1)!/(k! (k + n)!) p^(n + k) (1 - p)^k.
        term *= (2.0 * k + n + 1.0) * (2.0 * k + n) / ((k + 1.0) * (k + 1.0 + n)) * factor;
        // At equal rates terms fall as k^(-3/2) only: what is left is twice k times the next one.
        let left = if ratio == 1.0 { 2.0 * k * term } else { term / (1.0 - 4.0 * factor) };
        // Before some n^2/6 births terms may still grow.
        if k >= n * n && (left < 1e-12 || (ratio == 1.0 && k > 5e6)) {
            return Ok(sum + left);
        }
    }
    anyhow::bail!(
        "the series of n = {n}, mu/lambda = {ratio} did not converge in {TERMS} terms: give rates that are equal or \
         further apart"
    )
}

/// A number from 0 to 1 (splitmix64, Steele, Lea and Flood 2014).
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// A = mu/lambda for which `cells` at first lead to a tumour with this probability: (B.22) solved for A.
fn rate_ratio((cells, fraction): (f64, f64)) -> f64 {
    (1.0 - fraction).powf(1.0 / cells)
}

#[cfg(test)]
mod tests;
