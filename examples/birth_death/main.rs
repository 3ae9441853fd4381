//! Extinction of a birth-death process: appendix B of Cowley.
//!
//! `cargo run --release --example birth_death` compares, for `n` cells that divide at a rate lambda and die at a rate
//! mu, the probability that all of them die out: the closed form (B.12), the series (B.20) and seeded simulations; then
//! the ratios A = mu/lambda that observed fractions of tumours give, with their bounds (B.23, B.24).
//!
//! (B.21) holds for mu < lambda only: the transformation of the series' hypergeometric function needs a probability of
//! death below 1/2. Beyond it (mu/lambda)^n exceeds 1, whereas the series gives 1, as it must.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::Parser;
use motile_output::run::say;

/// Compares closed form, series and simulation of the extinction of a birth-death process.
#[derive(Debug, Parser)]
struct Flags {
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
        say("  n   mu/lambda   closed (B.12)  series (B.20)  (mu/lambda)^n (B.21)  simulated, standard error");
        for n in [1, 4, 11] {
            for ratio in [0.5_f64, 0.9, 1.0, 1.1, 2.0] {
                let (simulated, error) = simulated(n, ratio, flags.simulations, flags.seed);
                say(format_args!(
                    "{n:>3}   {ratio:<9}   {:<13.6}  {:<13.6}  {:<20.6}  {simulated:.4} +- {error:.4}",
                    closed(n, ratio),
                    series(n, ratio)?,
                    ratio.powi(n as i32)
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

/// Probability that `n` cells die out, for a rate of death over that of birth: (B.12).
fn closed(n: u32, ratio: f64) -> f64 {
    ratio.min(1.0).powi(n as i32)
}

/// The same as the series (B.20) over the number of births, each term from the one before.
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
    anyhow::bail!("the series of n = {n}, ratio {ratio} did not converge in {TERMS} terms")
}

/// The fraction of simulations that die out, and its standard error.
fn simulated(n: u32, ratio: f64, simulations: u32, seed: u64) -> (f64, f64) {
    let death = ratio / (1.0 + ratio);
    let mut state = seed;
    let mut extinct = 0_u32;
    for _ in 0..simulations {
        let mut cells = n;
        while (1..MANY).contains(&cells) {
            cells = if uniform(&mut state) < death { cells - 1 } else { cells + 1 };
        }
        extinct += u32::from(cells == 0);
    }
    let fraction = f64::from(extinct) / f64::from(simulations);
    (fraction, (fraction * (1.0 - fraction) / f64::from(simulations)).sqrt())
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
