use super::*;
use proptest::prelude::*;

fn labels(ticks: &Ticks) -> Vec<&str> {
    ticks.ticks.iter().filter_map(|t| t.label.as_deref()).collect()
}

#[test]
fn linear_labels_have_the_decimals_of_the_step() {
    assert_eq!(labels(&Ticks::linear(-3.0, 3.0, 6)), ["−3", "−2", "−1", "0", "1", "2", "3"]);
    assert_eq!(labels(&Ticks::linear(0.0, 0.62, 6)), ["0.0", "0.2", "0.4", "0.6"]);
    let small = Ticks::linear(0.0, 3.1e-4, 6);
    assert_eq!((labels(&small)[1], small.exponent), ("1", -4));
    // Five digits are written out, six are not.
    for (high, label, exponent) in [(4e4, "10000", 0), (4e5, "1", 5), (0.04, "0.01", 0), (0.004, "1", -3)] {
        let ticks = Ticks::linear(0.0, high, 4);
        assert_eq!((labels(&ticks)[1], ticks.exponent), (label, exponent));
    }
}

#[test]
fn axes_without_length_have_one_tick() {
    for (low, high) in [(1.0, 1.0), (1e20, 1e20 + 1e5), (2.0, 1.0), (3.0, f64::NAN)] {
        assert_eq!(Ticks::linear(low, high, 5).ticks.len(), 1);
    }
}

#[test]
fn logarithmic_labels() {
    assert_eq!(labels(&Ticks::logarithmic(1e-4, 1.0)), ["10^{−4}", "10^{−3}", "10^{−2}", "10^{−1}", "10^{0}"]);
    assert_eq!(labels(&Ticks::logarithmic(0.025, 0.2)), ["0.05", "0.1", "0.2"]);
    assert_eq!(labels(&Ticks::logarithmic(0.01, 3.0)), ["0.01", "0.1", "1"]);
    assert!(Ticks::logarithmic(0.0, 1.0).ticks.is_empty());
}

#[test]
fn numbers_as_text() {
    let cases = [(0.073_04, "0.07304"), (-2.0, "−2"), (1e7, "10^{7}"), (250.0, "250")];
    for (value, text) in cases.into_iter().chain([(-2.5e-5, "−2.5×10^{−5}")]) {
        assert_eq!(number(value), text);
    }
}

proptest! {
    #[test]
    fn ticks_lie_within_their_axis_and_are_few(low in -1e6..1e6f64, span in 1e-5..1e6f64, target in 2usize..12) {
        let high = low + span;
        let ticks = Ticks::linear(low, high, target).ticks;
        prop_assert!(ticks.len() >= 2 && ticks.len() <= target.max(4) + 1, "{}", ticks.len());
        let slack = 1e-6 * span;
        prop_assert!(ticks.iter().all(|t| t.value >= low - slack && t.value <= high + slack));
    }
}
