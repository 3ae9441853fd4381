use super::{Rates, rate_ratio, series};

#[test]
fn the_series_is_the_closed_form_on_both_sides_of_equal_rates() {
    for n in [1, 4, 36] {
        for ratio in [0.2, 0.9, 1.1, 3.0] {
            let expected = Rates { birth: 2.0, death: 2.0 * ratio }.extinct(n);
            let found = series(n, ratio).expect("a series");
            assert!((found - expected).abs() < 1e-10, "{n}, {ratio}: {found}, expected {expected}");
        }
        let found = series(n, 1.0).expect("a series");
        assert!((found - 1.0).abs() < 1e-6, "{n}, equal rates: {found}");
    }
    assert!(series(1, f64::NAN).is_err() && series(1, 0.0).is_err());
}

/// Probability of no cells at a time from
/// `d P_k/dt = lambda (k - 1) P_(k-1) + mu (k + 1) P_(k+1) - (lambda + mu) k P_k` up to 400 cells, by Runge and Kutta's
/// method of fourth order.
fn integrated(rates: Rates, n: usize, time: f64, steps: u32) -> f64 {
    let change = |p: &[f64]| -> Vec<f64> {
        let flux = |k: usize, rate: f64| p.get(k).map_or(0.0, |p| rate * k as f64 * p);
        let gain = |k: usize| flux(k.wrapping_sub(1), rates.birth) + flux(k + 1, rates.death);
        (0..p.len()).map(|k| gain(k) - flux(k, rates.birth + rates.death)).collect()
    };
    let add =
        |p: &[f64], step: f64, rate: &[f64]| -> Vec<f64> { p.iter().zip(rate).map(|(p, r)| p + step * r).collect() };
    let step = time / f64::from(steps);
    let mut p = vec![0.0; 401];
    p[n] = 1.0;
    for _ in 0..steps {
        let first = change(&p);
        let second = change(&add(&p, 0.5 * step, &first));
        let third = change(&add(&p, 0.5 * step, &second));
        let fourth = change(&add(&p, step, &third));
        for (weight, rate) in [(1.0, first), (2.0, second), (2.0, third), (1.0, fourth)] {
            p = add(&p, step * weight / 6.0, &rate);
        }
    }
    p[0]
}

#[test]
fn extinction_by_a_time_solves_the_master_equation_and_tends_to_extinction() {
    for (birth, death) in [(1.0, 0.5), (0.7, 1.2), (0.8, 0.8), (0.8, 0.8 + 1e-9)] {
        let rates = Rates { birth, death };
        for n in [1, 4] {
            let (found, expected) = (rates.extinct_by(n, 2.0), integrated(rates, n as usize, 2.0, 1000));
            assert!((found - expected).abs() < 1e-9, "{n}, {birth}, {death}: {found}, expected {expected}");
            let (late, ever) = (rates.extinct_by(n, 1e12), rates.extinct(n));
            assert!((late - ever).abs() < 1e-8, "{n}, {birth}, {death}: {late}, expected {ever}");
        }
    }
}

#[test]
fn simulations_agree_within_four_standard_errors() {
    for (n, birth, death, time) in [(1, 1.0, 0.5, 1.0), (4, 2.0, 1.8, 3.0), (2, 1.0, 1.2, 2.0)] {
        let rates = Rates { birth, death };
        let expected = [rates.extinct_by(n, time), rates.extinct(n)];
        for ((fraction, error), expected) in rates.simulated(n, time, 4000, 7).into_iter().zip(expected) {
            assert!(
                (fraction - expected).abs() <= 4.0 * error,
                "{n}, {birth}, {death}: {fraction}, expected {expected}"
            );
        }
    }
}

#[test]
fn ratios_are_those_of_the_thesis() {
    for (cells, fraction, expected) in [(103.0, 0.9, 0.978), (36.0, 0.2, 0.994), (11.0, 0.9, 0.811), (4.0, 0.2, 0.946)]
    {
        assert!((rate_ratio((cells, fraction)) - expected).abs() < 6e-4, "{cells}");
    }
}
