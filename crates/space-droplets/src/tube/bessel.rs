//! Ratios of modified Bessel functions.

/// Step of the trapezoidal rule for K, whose error is exp(-pi^2/step).
const STEP: f64 = 0.2;

/// Usual length of lists.
const LENGTH: usize = 640;

/// Writes `I_n(x)/I_(n-1)(x)` for n = 1 .. up to the length of the list, by the recurrence downwards.
pub(super) fn ratios_of_i(x: f64, ratios: &mut [f64]) {
    // The start is the same for lists of any usual length, so that results do not depend on what was asked for before.
    let orders = ratios.len().next_multiple_of(LENGTH) as f64;
    // Errors of the start fall by the square of a ratio in each step, together as exp(-(n^2 - orders^2)/x).
    let mut n = (orders * orders + 40.0 * x).sqrt() as usize + 10;
    let mut ratio = x / (n as f64 + (n as f64).hypot(x));
    while n > 0 {
        ratio = x / (2.0 * n as f64 + x * ratio);
        if let Some(entry) = ratios.get_mut(n - 1) {
            *entry = ratio;
        }
        n -= 1;
    }
}

/// Returns `K_(n+1)(x)/K_n(x)` for n = 0 .. count - 1, by the recurrence upwards.
pub(super) fn ratios_of_k(x: f64, count: usize) -> Vec<f64> {
    // K_n(x) = INT exp(-x cosh t) cosh(n t) dt from 0; beyond the end, nothing counts.
    let end = (1.0 + 40.0 / x).acosh() + 1.0;
    let (mut zero, mut one) = (0.5, 0.5);
    for k in 1..(end / STEP) as usize {
        let cosh = (k as f64 * STEP).cosh();
        let value = (-x * (cosh - 1.0)).exp();
        zero += value;
        one += value * cosh;
    }
    let mut ratio = one / zero;
    (0..count)
        .map(|n| {
            let here = ratio;
            ratio = 2.0 * (n + 1) as f64 / x + 1.0 / here;
            here
        })
        .collect()
}
