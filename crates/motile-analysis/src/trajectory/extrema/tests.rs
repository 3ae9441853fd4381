use super::*;
use proptest::prelude::*;
use std::f64::consts::TAU;

fn sine(samples: f64, periods: f64) -> (Vec<f64>, Vec<f64>) {
    (0..(samples * periods) as usize)
        .map(|i| {
            let t = i as f64 / samples;
            (t, (TAU * t).sin())
        })
        .unzip()
}

#[test]
fn accuracy_on_a_sine() {
    for (samples, tolerance) in [(7.3, 1e-2), (20.7, 1e-4), (60.3, 1e-5), (300.1, 1e-5)] {
        let (times, heights) = sine(samples, 6.0);
        let turns = extrema(&times, &heights, 0.1).unwrap();
        assert!((11..=12).contains(&turns.len()));
        for (k, turn) in turns.iter().enumerate() {
            assert!((turn.time - (0.25 + 0.5 * k as f64)).abs() < tolerance, "{samples} {turn:?}");
            assert!((turn.height.abs() - 1.0).abs() < tolerance, "{samples} {turn:?}");
            assert_eq!(turn.is_maximum, k % 2 == 0);
            assert_eq!(turn.is_maximum, turn.height > 0.0);
        }
    }
}

#[test]
fn small_oscillations_do_not_count() {
    let (times, mut heights) = sine(100.0, 3.0);
    for (i, y) in heights.iter_mut().enumerate() {
        *y += 0.02 * (1.7 * i as f64).sin();
    }
    assert_eq!(extrema(&times, &heights, 0.1).unwrap().len(), 6);
    assert!(extrema(&times, &heights, 0.0).unwrap().len() > 20);
    assert!(extrema(&times, &heights, 3.0).unwrap().is_empty());
}

#[test]
fn ends_do_not_count() {
    let times: Vec<f64> = (0..50).map(f64::from).collect();
    let monotone: Vec<f64> = times.iter().map(|t| (-0.1 * t).exp()).collect();
    assert!(extrema(&times, &monotone, 0.0).unwrap().is_empty());
    let plateau: Vec<f64> = times.iter().map(|t| t.min(20.0)).collect();
    assert!(extrema(&times, &plateau, 0.0).unwrap().is_empty());
    assert!(extrema(&[], &[], 0.0).unwrap().is_empty());
    assert!(extrema(&times, &monotone[..3], 0.0).is_err() && extrema(&times, &monotone, f64::NAN).is_err());
}

proptest! {
    #[test]
    fn maxima_and_minima_alternate(heights in prop::collection::vec(-1.0..1.0f64, 0..80), hysteresis in 0.0..0.5f64) {
        let times: Vec<f64> = (0..heights.len()).map(|i| i as f64 * 0.3).collect();
        let turns = extrema(&times, &heights, hysteresis).unwrap();
        for pair in turns.windows(2) {
            prop_assert!(pair[0].is_maximum != pair[1].is_maximum && pair[0].time < pair[1].time);
        }
    }
}
