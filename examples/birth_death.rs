//! Extinction of a birth-death process: appendix B of Cowley's thesis.
//!
//! `cargo run --release --example birth_death` compares the probability that `n` cells, which divide at a rate lambda
//! and die at a rate mu, all die out. The closed form (B.12) and the series (B.20) agree to 1e-9, and simulations agree
//! within four standard errors. Then it prints the ratios A = mu/lambda that observed fractions of tumours give, with
//! their bounds (B.23, B.24).
//!
//! (B.21) holds for mu < lambda only. For larger mu, (mu/lambda)^n exceeds 1, whereas the series gives 1, as it must.

/// Cells above which a simulation is taken not to die out.
const MANY: u32 = 2000;

/// Returns the probability that `n` cells die out, with the ratio mu/lambda: (B.12).
fn extinct(n: u32, ratio: f64) -> f64 {
    ratio.min(1.0).powi(n as i32)
}

/// That probability as the series (B.20) over the number of births, each term from the one before.
fn series(n: u32, ratio: f64) -> f64 {
    let (death, n) = (ratio / (1.0 + ratio), f64::from(n));
    let (mut term, mut sum) = (death.powf(n), 0.0);
    for k in (0..1_000_000).map(f64::from) {
        sum += term;
        // n (2k + n - 1)!/(k! (k + n)!) p^(n + k) (1 - p)^k.
        term *= (2.0 * k + n + 1.0) * (2.0 * k + n) / ((k + 1.0) * (k + 1.0 + n)) * death * (1.0 - death);
    }
    sum
}

/// Returns the fraction of simulations in which `n` cells die out, and its standard error.
fn simulated(n: u32, ratio: f64, simulations: u32) -> [f64; 2] {
    let (mut state, mut extinct) = (1, 0);
    for _ in 0..simulations {
        let mut cells = n;
        while (1..MANY).contains(&cells) {
            cells = if (1.0 + ratio) * uniform(&mut state) < ratio { cells - 1 } else { cells + 1 };
        }
        extinct += u32::from(cells == 0);
    }
    let fraction = f64::from(extinct) / f64::from(simulations);
    [fraction, (fraction * (1.0 - fraction) / f64::from(simulations)).sqrt()]
}

/// Returns a number from 0 to 1 (splitmix64, Steele, Lea and Flood 2014).
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Returns a = mu/lambda for which `cells` at first lead to a tumour with this probability: (B.22) solved for A.
fn rate_ratio((cells, fraction): (f64, f64)) -> f64 {
    (1.0 - fraction).powf(1.0 / cells)
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("   n  mu/lambda  closed (B.12)  series (B.20)  simulated, standard error");
    for n in [1, 4, 11] {
        for ratio in [0.5, 0.9, 1.1, 2.0] {
            let (exact, sum, [fraction, error]) = (extinct(n, ratio), series(n, ratio), simulated(n, ratio, 1000));
            println!("{n:>4}  {ratio:<9}  {exact:<13.6}  {sum:<13.6}  {fraction:.4} +- {error:.4}");
            assert!((sum - exact).abs() < 1e-9);
            assert!((fraction - exact).abs() <= 4.0 * error.max(1e-3), "{fraction} is not {exact}");
        }
    }
    println!("cells at first   fraction with a tumour   A       bounds");
    for (cells, error, fraction) in [(103.0, 10.0, 0.9), (36.0, 3.0, 0.2), (11.0, 2.0, 0.9), (4.0, 1.0, 0.2)] {
        let [low, high] = [(cells - error, fraction + 0.05), (cells + error, fraction - 0.05)].map(rate_ratio);
        let a = rate_ratio((cells, fraction));
        println!(
            "{:<15}  {:<23}  {a:.3}   {low:.3} to {high:.3}",
            format!("{cells} +- {error}"),
            format!("{fraction} +- 0.05")
        );
        assert!(low < a && a < high);
    }
    Ok(())
}
