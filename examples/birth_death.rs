//! Extinction of a birth-death process, its generating function, and the branching process: appendix B of Cowley's
//! thesis.
//!
//! `cargo run --release --example birth_death` compares the probability that `n` cells, which divide at a rate lambda
//! and die at a rate mu, all die out. The closed form (B.12) and the series (B.20) agree to 1e-9, and simulations agree
//! within four standard errors. Then it prints the ratios A = mu/lambda that observed fractions of tumours give, with
//! their bounds (B.23, B.24).
//!
//! The generating function (B.9), (B.10) is compared with the forward equations (B.2), (B.3) and with simulations, the
//! branching process of section B.2 with its fixed points (B.15) and with simulations.
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

/// Returns the generating function of the number N of cells at a time t after there were `n`: the mean of `z^N` (B.4).
/// It is (B.9), and (B.10) if lambda = mu:
///
/// ```text
/// ((z + s (mu - lambda z))/(1 + s (mu - lambda z)))^n  with  s = (exp((mu - lambda) t) - 1)/(mu - lambda)
/// ```
///
/// where s is t if lambda = mu; written so, nothing cancels for rates that are almost equal. It is `None` for a z at or
/// beyond the pole of this formula, because the mean does not exist there.
pub(crate) fn generating(n: u32, [lambda, mu]: [f64; 2], z: f64, t: f64) -> Option<f64> {
    let net = mu - lambda;
    let s = if net == 0.0 { t } else { (net * t).exp_m1() / net };
    let pole = (1.0 + s * mu) / (s * lambda);
    let step = s * (mu - lambda * z);
    (z.abs() < pole).then(|| ((z + step) / (1.0 + step)).powi(n as i32))
}

/// Returns the generating function as (B.9) is printed, for lambda other than mu.
fn as_printed(n: u32, [lambda, mu]: [f64; 2], z: f64, t: f64) -> f64 {
    let decay = (mu - lambda * z) * ((mu - lambda) * t).exp();
    ((mu * (1.0 - z) - decay) / (lambda * (1.0 - z) - decay)).powi(n as i32)
}

/// Returns the probabilities of 0, 1, ... cells at a time t after there were `n`: the forward equations (B.2), (B.3) by
/// the method of Runge and Kutta.
pub(crate) fn probabilities(n: u32, [lambda, mu]: [f64; 2], t: f64) -> Vec<f64> {
    const MOST: usize = 300;
    let rate = |p: &[f64]| -> Vec<f64> {
        let flow = |m: usize, rate: f64| rate * m as f64 * p.get(m).copied().unwrap_or(0.0);
        let gained = |m: usize| if m > 0 { flow(m - 1, lambda) } else { 0.0 } + flow(m + 1, mu);
        (0..MOST).map(|m| gained(m) - flow(m, lambda + mu)).collect()
    };
    let moved =
        |p: &[f64], by: f64, rate: &[f64]| -> Vec<f64> { p.iter().zip(rate).map(|(p, r)| p + by * r).collect() };
    let mut p = vec![0.0; MOST];
    p[n as usize] = 1.0;
    let steps = (2.0 * (lambda + mu) * MOST as f64 * t).ceil();
    let dt = t / steps;
    for _ in 0..steps as usize {
        let first = rate(&p);
        let second = rate(&moved(&p, 0.5 * dt, &first));
        let third = rate(&moved(&p, 0.5 * dt, &second));
        let fourth = rate(&moved(&p, dt, &third));
        for (m, p) in p.iter_mut().enumerate() {
            *p += dt / 6.0 * (first[m] + 2.0 * second[m] + 2.0 * third[m] + fourth[m]);
        }
    }
    p
}

/// Returns the mean of `z^N` over simulations of the process up to a time t, and its standard error.
pub(crate) fn simulated_mean(n: u32, [lambda, mu]: [f64; 2], z: f64, t: f64, simulations: u32) -> [f64; 2] {
    let mut state = 2;
    let values = (0..simulations).map(|_| {
        let (mut cells, mut time) = (n, 0.0);
        while cells > 0 {
            time -= (1.0 - uniform(&mut state)).ln() / ((lambda + mu) * f64::from(cells));
            if time > t {
                break;
            }
            cells = if (lambda + mu) * uniform(&mut state) < mu { cells - 1 } else { cells + 1 };
        }
        z.powi(cells as i32)
    });
    mean_and_error(values)
}

/// Returns the mean of values and its standard error.
fn mean_and_error(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [count, sum, squares] = values.fold([0.0; 3], |[n, sum, squares], x| [n + 1.0, sum + x, squares + x * x]);
    let mean = sum / count;
    [mean, ((squares / count - mean * mean).max(0.0) / count).sqrt()]
}

/// Returns the probability that the branching process of `n` cells has died out after so many generations: (B.14)
/// applied to 0 again and again. Each cell leaves 0, 1 or 2 cells with these probabilities.
pub(crate) fn branching(n: u32, [p0, p1, p2]: [f64; 3], generations: u32) -> f64 {
    (0..generations).fold(0.0_f64, |theta, _| p0 + p1 * theta + p2 * theta * theta).powi(n as i32)
}

/// Returns the limit of many generations: the smallest root (B.15), to the power n (B.16).
pub(crate) fn branching_limit(n: u32, [p0, _, p2]: [f64; 3]) -> f64 {
    (p0 / p2).min(1.0).powi(n as i32)
}

/// Returns the fraction of simulations in which the branching process has died out after so many generations, and its
/// standard error.
pub(crate) fn branching_simulated(n: u32, [p0, p1, _]: [f64; 3], generations: u32, simulations: u32) -> [f64; 2] {
    let mut state = 3;
    let values = (0..simulations).map(|_| {
        let mut cells = n;
        for _ in 0..generations {
            let left = |_| match uniform(&mut state) {
                u if u < p0 => 0,
                u if u < p0 + p1 => 1,
                _ => 2,
            };
            cells = (0..cells).map(left).sum();
        }
        f64::from(u8::from(cells == 0))
    });
    mean_and_error(values)
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
    println!("lambda  mu   z     generating function  forward equations  simulated, standard error");
    for [lambda, mu] in [[1.0, 0.6], [0.7, 1.0], [0.8, 0.8]] {
        let (n, t, rates) = (3, 1.5, [lambda, mu]);
        let found = probabilities(n, rates, t);
        let mean = |n: u32, z: f64, t: f64| generating(n, rates, z, t).ok_or("a z beyond the pole");
        // Nobody is left with the probability (B.11), and all probabilities add up to 1.
        assert!((mean(n, 0.0, t)? - found[0]).abs() < 1e-9);
        assert!((mean(n, 1.0, t)? - 1.0).abs() < 1e-12);
        for z in [-1.0, -0.4, 0.3, 0.8, 1.15_f64] {
            let exact = mean(n, z, t)?;
            let sum = found.iter().rev().fold(0.0, |sum, p| sum * z + p);
            let [simulated, error] = simulated_mean(n, rates, z, t, 4000);
            println!("{lambda:<6}  {mu:<3}  {z:<4}  {exact:<19.6}  {sum:<17.6}  {simulated:.4} +- {error:.4}");
            assert!((sum - exact).abs() < 1e-9, "{sum} is not {exact}");
            assert!((simulated - exact).abs() <= 4.0 * error, "{simulated} is not {exact}");
            // At first there are n cells, and after two times as after their sum (Chapman and Kolmogorov).
            assert!((mean(n, z, 0.0)? - z.powi(3)).abs() < 1e-12);
            let half = mean(1, z, 0.6 * t)?;
            assert!((mean(n, half, 0.4 * t)? - exact).abs() < 1e-12);
            if lambda != mu {
                assert!((as_printed(n, rates, z, t) - exact).abs() < 1e-12);
            }
        }
    }
    assert!(generating(3, [1.0, 0.6], 2.0, 1.5).is_none(), "the mean of 2^N exists");
    println!("   n  p0   p1   p2   after 5 generations  simulated, standard error  in the end (B.16)");
    for n in [1, 4] {
        for [p0, p1, p2] in [[0.2, 0.3, 0.5], [0.4, 0.1, 0.5], [0.5, 0.2, 0.3]] {
            let chances = [p0, p1, p2];
            let (exact, limit) = (branching(n, chances, 5), branching_limit(n, chances));
            let [fraction, error] = branching_simulated(n, chances, 5, 4000);
            println!("{n:>4}  {p0}  {p1}  {p2}  {exact:<19.6}  {fraction:.4} +- {error:.4}           {limit:.6}");
            assert!((fraction - exact).abs() <= 4.0 * error, "{fraction} is not {exact}");
            // The limit is the smallest fixed point, and a division next to a death leads to (B.12).
            assert!((branching(n, chances, 2000) - limit).abs() < 1e-12);
            assert!((limit - extinct(n, p0 / p2)).abs() < 1e-15);
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
