use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

fn thesis() -> Law {
    ExcludedVolume::Step(10.0).law(100.0)
}

fn step(strength: f64, threshold: f64, steepness: f64) -> Law {
    ExcludedVolume::StepAt { strength, threshold, steepness }.law(1.0)
}

#[test]
fn step_slope_is_equation_2_41() {
    let law = thesis();
    for c in [0.0, 1.0, 50.0, 100.0, 180.0, 199.0, 200.0, 230.0, 400.0, 1500.0] {
        let printed = 10.0 - 10.0 * 20f64.sinh() / (20f64.cosh() + (20.0 * c / 200.0_f64).cosh());
        assert!((law.slope(c) - printed).abs() < 1e-14 * 10.0, "c = {c}");
    }
    assert_relative_eq!(law.slope(200.0), 5.0, epsilon = 1e-7);
}

#[test]
fn step_pressure_is_the_integral_of_the_slope() {
    // Composite Simpson, 2000 intervals: an independent value of (2.40).
    let law = thesis();
    for c in [80.0, 200.0, 260.0, 700.0] {
        let n = 2000;
        let h = c / f64::from(n);
        let sum: f64 = (0..=n)
            .map(|i| {
                let weight = if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                weight * law.slope(f64::from(i) * h)
            })
            .sum();
        assert_relative_eq!(law.pressure(c), sum * h / 3.0, max_relative = 1e-9);
    }
}

#[test]
fn nothing_overflows_far_above_the_threshold() {
    let law = step(10.0, 200.0, 300.0);
    assert_relative_eq!(law.pressure(1e9), 10.0 * (1e9 - 200.0), max_relative = 1e-14);
    assert_relative_eq!(law.slope(1e9), 10.0);
    assert_eq!(law.pressure(0.0), 0.0);
}

#[test]
fn plateau_is_where_the_slope_equals_the_pull() {
    for law in [thesis(), step(8.0, 90.0, 300.0)] {
        for pull in [0.5, 2.0, 4.0, 7.9] {
            let c = law.plateau(pull).unwrap();
            assert_relative_eq!(law.slope(c), pull, max_relative = 1e-11);
        }
        assert_eq!(law.plateau(10.0), None);
    }
    assert_eq!(Law::Quadratic(0.02).plateau(3.0), Some(150.0));
    assert_eq!(Law::None.plateau(1.0), None);
}

#[test]
fn the_quadratic_law_by_hand() {
    let law = Law::Quadratic(0.25);
    assert_eq!([0.0, 2.0, 12.0].map(|c| law.pressure(c)), [0.0, 0.5, 18.0]);
    assert_eq!([0.0, 2.0, 12.0].map(|c| law.slope(c)), [0.0, 0.5, 3.0]);
}

#[test]
fn bad_values_are_refused() {
    let step = |strength, threshold, steepness| ExcludedVolume::StepAt { strength, threshold, steepness };
    assert!(ExcludedVolume::Step(1.0).check().is_ok() && ExcludedVolume::None.check().is_ok());
    assert!(ExcludedVolume::Step(-1.0).check().is_err());
    assert!(step(-1.0, 200.0, 20.0).check().is_err());
    assert!(step(1.0, 0.0, 20.0).check().is_err());
    assert!(step(1.0, 200.0, f64::NAN).check().is_err());
    assert!(step(1.0, 200.0, 301.0).check().is_err());
    assert!(ExcludedVolume::Quadratic(f64::INFINITY).check().is_err());
}

proptest! {
    #[test]
    fn pressure_and_slope_agree(c in 0.0..3000.0f64, a in 1.0..60.0f64, strength in 0.0..50.0f64) {
        let law = step(strength, 200.0, a);
        let step = 1e-3;
        let difference = (law.pressure(c + step) - law.pressure(c - step)) / (2.0 * step);
        prop_assert!((difference - law.slope(c)).abs() < 1e-6 * (1.0 + strength));
        prop_assert!(law.slope(c) >= 0.0 && law.slope(c) <= strength);
    }
}
