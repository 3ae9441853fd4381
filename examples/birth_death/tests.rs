use super::{closed, rate_ratio, series, simulated};

#[test]
fn the_series_is_the_closed_form_on_both_sides_of_equal_rates() {
    for n in [1, 4, 36] {
        for ratio in [0.2, 0.9, 1.1, 3.0] {
            let (found, expected) = (series(n, ratio).expect("a series"), closed(n, ratio));
            assert!((found - expected).abs() < 1e-10, "{n}, {ratio}: {found}, expected {expected}");
        }
        let found = series(n, 1.0).expect("a series");
        assert!((found - 1.0).abs() < 1e-6, "{n}, equal rates: {found}");
    }
    assert!(series(1, f64::NAN).is_err() && series(1, 0.0).is_err());
}

#[test]
fn simulations_agree_within_four_standard_errors() {
    for (n, ratio) in [(1, 0.5), (4, 0.9), (2, 1.2)] {
        let (fraction, error) = simulated(n, ratio, 4000, 7);
        assert!((fraction - closed(n, ratio)).abs() <= 4.0 * error, "{n}, {ratio}: {fraction} +- {error}");
    }
}

#[test]
fn ratios_are_those_of_the_thesis() {
    for (cells, fraction, expected) in [(103.0, 0.9, 0.978), (36.0, 0.2, 0.994), (11.0, 0.9, 0.811), (4.0, 0.2, 0.946)]
    {
        assert!((rate_ratio((cells, fraction)) - expected).abs() < 6e-4, "{cells}");
    }
}
