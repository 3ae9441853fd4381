use super::{Measure, shown};

#[test]
fn measures_find_what_points_are_made_of() {
    let made = |f: fn(f64) -> f64| (0..9).map(|k| 2.0 + f64::from(k)).map(|x| (x, f(x))).collect::<Vec<_>>();
    let decay = made(|x| 0.4 * (-x / 3.0).exp() + 0.1);
    for (measure, points, expected, tolerance) in [
        (Measure::Exponential, &decay, 3.0, 0.05),
        (Measure::Line, &made(|x| 5.0 - 0.25 * x), -0.25, 1e-12),
        (Measure::Correlation, &made(|x| 5.0 - 0.25 * x), -1.0, 1e-12),
        (Measure::Slope, &made(|x| 3.0 * x), 3.0, 1e-12),
        (Measure::Zero, &made(|x| x - 4.3), 4.3, 1e-12),
        (Measure::Intercept, &made(|x| 5.0 - 0.25 * x), 5.0, 1e-12),
        (Measure::Gain, &vec![(1.0, 4.0), (2.0, 1.5), (3.0, 5.0)], 0.25, 1e-12),
        (Measure::Undershoot, &vec![(1.0, 4.0), (2.0, 1.5), (3.0, 2.0)], 0.25, 1e-12),
        (Measure::Undershoot, &made(|x| 5.0 - 0.25 * x), 0.0, 0.0),
        (Measure::Peak, &made(|x| -(x - 7.0).powi(2)), 7.0, 0.0),
        (Measure::Count, &made(|x| f64::from(x > 4.0)), 6.0, 0.0),
        (Measure::Mean, &made(|x| x), 6.0, 1e-12),
        (Measure::Spread, &vec![(1.0, 0.9), (1.0, 1.1), (2.0, 5.0)], 0.2, 1e-12),
        (Measure::Spread, &vec![(1.0, 0.9), (1.0, 1.1), (2.0, 5.0), (2.0, 5.0)], 0.1, 1e-12),
        (Measure::Widest, &vec![(1.0, 0.9), (1.0, 1.1), (2.0, 5.0), (2.0, 5.0)], 0.2, 1e-12),
        (Measure::Flips, &vec![(1.0, 0.9), (1.0, 1.1), (2.0, 5.0), (2.0, -5.0), (3.0, -1.0)], 1.0, 0.0),
        (Measure::Sign, &vec![(1.0, 1.0), (1.0, -1.0), (2.0, 1.0), (2.0, 0.0), (3.0, -1.0), (3.0, -1.0)], 1.0, 0.0),
    ] {
        let (found, beside) = measure.of(points);
        assert!((found - expected).abs() <= tolerance, "{measure:?}: {found} ({beside}), expected {expected}");
    }
    // By hand: 8 of 10 and two standard errors, (0.8 + 0.2 -+ 2 sqrt(0.016 + 0.01))/1.4.
    let share =
        Measure::Share.of(&made(|x| f64::from(x > 2.0)).iter().copied().chain([(0.0, 0.0)]).collect::<Vec<_>>());
    assert!((share.0 - 0.8).abs() < 1e-12 && share.1.ends_with("two 0.4839 to 0.9446"), "{share:?}");
    // An exponential fits a line through points of 1/x worse than their range times 1 %.
    assert!(Measure::Exponential.of(&made(|x| 1.0 / x)).1 > Measure::Exponential.of(&decay).1);
    assert!(Measure::Zero.of(&decay).0.is_nan());
}

#[test]
fn numbers_have_four_figures() {
    for (value, text) in [(0.123_456, "0.1235"), (-12.0, "-12"), (0.0, "0"), (f64::NAN, "none"), (2.5e-7, "2.500e-7")] {
        assert_eq!(shown(value), text);
    }
}

/// Against the sums of binomial coefficients: 7 of 7, 9 of 10 and 5 of 10.
#[test]
fn sign_tests_are_exact() {
    for (up, down, expected) in [(7, 0, 2.0 / 128.0), (0, 7, 2.0 / 128.0), (9, 1, 22.0 / 1024.0), (5, 5, 1.0)] {
        let pairs = |count: usize, y: f64, from: usize| (from..from + count).flat_map(move |x| [(x as f64, y); 2]);
        let parted = [(0.5, 1.0), (0.5, -1.0)].into_iter();
        let points: Vec<(f64, f64)> = parted.chain(pairs(up, 1.0, 1)).chain(pairs(down, -1.0, 1 + up)).collect();
        let (found, beside) = Measure::Sign.of(&points);
        let all = up + down + 1;
        assert_eq!((found, beside), (up as f64, format!("of {}, of all {all}, p = {}", up + down, shown(expected))));
        // One-sided: the sums from `up` on.
        let one = [(7, 1.0 / 128.0), (0, 1.0), (9, 11.0 / 1024.0), (5, 638.0 / 1024.0)];
        let one = one.into_iter().find(|(count, _)| *count == up).map(|(_, p)| p);
        let (found, beside) = Measure::SignChance.of(&points);
        assert_eq!((Some(found), beside), (one, format!("{up} of {}, of all {all}", up + down)));
    }
}
