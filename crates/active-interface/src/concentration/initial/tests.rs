use super::*;
use crate::{Curve, curve::polygon_perimeter};
use approx::assert_relative_eq;
use motile_base::InputError;
use proptest::prelude::*;
use std::f64::consts::PI;

#[test]
fn the_generator_is_splitmix64() {
    // First output for the seed 1234567, published with the reference implementation.
    let mut random = SplitMix64::new(1_234_567);
    let expected = 6_457_827_717_110_365_317u64;
    assert_eq!(random.uniform(), ((expected >> 11) + 1) as f64 / (1u64 << 53) as f64);
}

#[test]
fn polarised_is_equation_2_46() {
    let markers = Curve::circle(1.0).unwrap().translated(Vec2::new(4.0, 2.0)).markers(80).unwrap();
    let heading = 0.4;
    let numbers = InitialConcentration::polarised(100.0, heading).unwrap().particle_numbers(&markers).unwrap();
    let length = polygon_perimeter(&markers).unwrap() / 80.0;
    let width = TAU / 80.0;
    for (k, number) in numbers.iter().enumerate() {
        let (a, b) = (k as f64 * width - heading, (k + 1) as f64 * width - heading);
        let exact = 100.0 * (1.0 - (b.sin() - a.sin()) / width);
        assert_relative_eq!(number / length, exact, max_relative = 1e-10);
    }
}

#[test]
fn closures_are_averaged() {
    let markers = Curve::circle(1.0).unwrap().markers(200).unwrap();
    let length = polygon_perimeter(&markers).unwrap() / 200.0;
    let angle = InitialConcentration::by_polar_angle(|t| 3.0 + t.sin()).particle_numbers(&markers).unwrap();
    let arc = InitialConcentration::by_arc_fraction(|s| 3.0 + (TAU * s).sin()).particle_numbers(&markers).unwrap();
    for k in 0..200 {
        let (a, b) = (TAU * f64::from(k) / 200.0, TAU * f64::from(k + 1) / 200.0);
        let exact = 3.0 - (b.cos() - a.cos()) / (b - a);
        assert_relative_eq!(angle[k as usize] / length, exact, max_relative = 1e-6);
        assert_relative_eq!(arc[k as usize] / length, exact, max_relative = 1e-9);
    }
}

#[test]
fn a_seed_is_a_function_of_the_arc() {
    let state = |count, seed| {
        let markers = Curve::circle(1.0).unwrap().markers(count).unwrap();
        let numbers = InitialConcentration::perturbed(100.0, 0.01, seed).unwrap().particle_numbers(&markers).unwrap();
        (numbers, polygon_perimeter(&markers).unwrap() / count as f64)
    };
    let ((coarse, l), (fine, s), (other, _)) = (state(100, 7), state(200, 7), state(100, 8));
    for k in 0..100 {
        assert_relative_eq!(coarse[k] / l, 0.5 * (fine[2 * k] + fine[2 * k + 1]) / s, max_relative = 1e-12);
        assert!((coarse[k] / l - 100.0).abs() <= 1.0);
    }
    assert_ne!(coarse, other);
    assert_eq!(coarse, state(100, 7).0);
    let largest = coarse.iter().map(|n| (n / l - 100.0).abs()).fold(0.0, f64::max);
    assert!(largest > 0.1, "{largest}");
}

#[test]
fn bad_concentrations_are_refused() {
    assert!(InitialConcentration::polarised(0.0, 0.0).is_err());
    assert!(InitialConcentration::polarised(1.0, f64::NAN).is_err());
    assert!(InitialConcentration::perturbed(1.0, 1.0, 0).is_err());
    let markers = Curve::circle(1.0).unwrap().markers(20).unwrap();
    let negative = InitialConcentration::by_polar_angle(f64::cos).particle_numbers(&markers);
    assert!(matches!(negative, Err(InterfaceError::Input(InputError::Negative { .. }))));
    let infinite = InitialConcentration::by_arc_fraction(|s| 1.0 / s).particle_numbers(&markers);
    assert!(matches!(infinite, Err(InterfaceError::Input(InputError::EntryNotFinite { index: 0, .. }))));
    assert!(InitialConcentration::uniform(1.0).unwrap().particle_numbers(&markers[..2]).is_err());
}

proptest! {
    #[test]
    fn the_total_is_the_mean_times_the_perimeter(
        heading in -PI..PI, count in 8usize..300, a in 0.6..1.6f64, seed in 0u64..1000,
    ) {
        let markers = Curve::ellipse(a, 1.0).unwrap().markers(count).unwrap();
        let total = 100.0 * polygon_perimeter(&markers).unwrap();
        let polarised = InitialConcentration::polarised(100.0, heading);
        for state in [polarised, InitialConcentration::perturbed(100.0, 0.9, seed)] {
            let numbers = state.unwrap().particle_numbers(&markers).unwrap();
            prop_assert!((numbers.iter().sum::<f64>() / total - 1.0).abs() < 1e-13);
            prop_assert!(numbers.iter().all(|&n| n >= 0.0));
        }
    }
}
