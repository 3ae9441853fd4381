use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

/// Heights and velocities of `Re(a e^((s + i w) t))`.
fn signal(times: &[f64], s: f64, w: f64, phase: f64) -> (Vec<f64>, Vec<f64>) {
    times
        .iter()
        .map(|t| {
            let (sin, cos) = (w * t + phase).sin_cos();
            let size = 0.01 * (s * t).exp();
            (size * cos, size * (s * cos - w * sin))
        })
        .unzip()
}

fn even(end: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| end * i as f64 / (count - 1) as f64).collect()
}

/// The three modes of `channel_lateral_stability.csv`: w = 5, l = 12.
const REFERENCE: [(f64, f64); 3] =
    [(-0.000_942_6, 0.033_642_4), (0.006_669_6, 0.057_778_5), (0.001_177_4, 0.045_963_5)];

#[test]
fn modes_of_the_reference_from_one_period() {
    for (s, w) in REFERENCE {
        let times = even(TAU / w, 60);
        let (y, v) = signal(&times, s, w, 0.3);
        for velocities in [None, Some(&v[..])] {
            let mode = fit_linear_mode(&times, &y, velocities).unwrap();
            assert_relative_eq!(mode.growth_rate.value, s, max_relative = 1e-6);
            assert_relative_eq!(mode.frequency.unwrap().value, w, max_relative = 1e-8);
            assert!(mode.residual < 1e-9 && (mode.periods() - 1.0).abs() < 1e-6, "{mode:?}");
        }
    }
}

#[test]
fn a_quarter_of_a_period_with_velocities() {
    for (s, w) in REFERENCE {
        let times = even(0.25 * TAU / w, 40);
        let (y, v) = signal(&times, s, w, 1.0);
        let mode = fit_linear_mode(&times, &y, Some(&v)).unwrap();
        assert_relative_eq!(mode.growth_rate.value, s, max_relative = 1e-3);
        assert_relative_eq!(mode.frequency.unwrap().value, w, max_relative = 1e-4);
    }
}

#[test]
fn noise_does_not_bias_and_its_errors_are_honest() {
    let (s, w) = REFERENCE[1];
    let times = even(2.0 * TAU / w, 400);
    let (clean, _) = signal(&times, s, w, 0.0);
    // A fixed sequence of pseudo-random numbers in (-1, 1), five per cent of the amplitude.
    let mut seed = 1_u64;
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let trials = 40;
    let scores: Vec<f64> = (0..trials)
        .map(|_| {
            let y: Vec<f64> = clean.iter().map(|y| y + 5e-4 * noise()).collect();
            let mode = fit_linear_mode(&times, &y, None).unwrap();
            assert_relative_eq!(mode.growth_rate.value, s, max_relative = 0.03);
            (mode.growth_rate.value - s) / mode.growth_rate.error
        })
        .collect();
    let mean = scores.iter().sum::<f64>() / f64::from(trials);
    let spread = (scores.iter().map(|score| score * score).sum::<f64>() / f64::from(trials)).sqrt();
    assert!(mean.abs() < 0.5 && (0.6..1.4).contains(&spread), "{mean} {spread}");
}

/// N heights with noise sigma of an oscillation of amplitude A over a time T: rate and frequency are both known to
/// `sigma sqrt(24/N)/(A T)`, the bound of Cramer and Rao (Rife and Boorstyn, Single-tone parameter estimation).
#[test]
fn the_errors_of_rate_and_frequency() {
    let (w, count, periods) = (0.05, 2000, 20.0);
    let end = periods * TAU / w;
    let times = even(end, count);
    let (mut heights, _) = signal(&times, 0.0, w, 0.3);
    // As if random, uniform in (-1, 1) times five per cent of the amplitude.
    let noise = |k: usize| 2.0 * (k as f64 * 12.989_8 + 4.1).sin().mul_add(43_758.545_3, 0.0).rem_euclid(1.0) - 1.0;
    heights.iter_mut().enumerate().for_each(|(k, y)| *y += 5e-4 * noise(k));
    let mode = fit_linear_mode(&times, &heights, None).unwrap();
    let exact = 5e-4 / 3.0_f64.sqrt() * (24.0 / count as f64).sqrt() / (0.01 * end);
    for found in [mode.growth_rate, mode.frequency.unwrap()] {
        assert!((found.error / exact - 1.0).abs() < 0.05, "{found:?} {exact:e}");
    }
}

#[test]
fn motion_without_oscillation() {
    let times = even(30.0, 100);
    let one: Vec<f64> = times.iter().map(|t| 0.2 * (-0.1 * t).exp()).collect();
    let mode = fit_linear_mode(&times, &one, None).unwrap();
    assert_relative_eq!(mode.growth_rate.value, -0.1, max_relative = 1e-8);
    assert!(mode.frequency.is_none() && mode.period().is_none() && mode.periods() == 0.0);
    let two: Vec<f64> = times.iter().map(|t| 0.2 * (-0.1 * t).exp() - 0.1 * (-0.4 * t).exp()).collect();
    let mode = fit_linear_mode(&times, &two, None).unwrap();
    assert_relative_eq!(mode.growth_rate.value, -0.1, max_relative = 1e-6);
    assert_relative_eq!(mode.second_rate.unwrap(), -0.4, max_relative = 1e-6);
    // A straight line has the rate zero twice.
    let line: Vec<f64> = times.iter().map(|t| 0.1 + 0.02 * t).collect();
    let mode = fit_linear_mode(&times, &line, None).unwrap();
    assert!(mode.growth_rate.value.abs() < 1e-12 && mode.periods() < 1e-7, "{mode:?}");
    let rest = fit_linear_mode(&times, &[0.3; 100], Some(&[0.0; 100]));
    assert!(rest.is_err() || rest.unwrap().growth_rate.value.abs() < 1e-12);
}

#[test]
fn bad_input_is_refused() {
    let (times, y) = (even(1.0, 10), [1.0; 10]);
    assert!(fit_linear_mode(&times, &[0.0; 10], None).is_err());
    assert!(fit_linear_mode(&times[..7], &y[..7], None).is_err());
    assert!(fit_linear_mode(&times, &y[..9], None).is_err());
    assert!(fit_linear_mode(&[0.0; 10], &y, None).is_err());
    assert!(fit_linear_mode(&times, &[f64::NAN; 10], None).is_err());
    assert!(fit_linear_mode(&times, &y, Some(&y[..9])).is_err());
    assert!(fit_linear_mode(&times, &y, Some(&[f64::INFINITY; 10])).is_err());
}

proptest! {
    #[test]
    fn uneven_samples(s in -0.02..0.02f64, w in 0.02..0.2f64, phase in 0.0..6.3f64, periods in 0.6..5.0f64,
                      jitter in prop::collection::vec(-0.4..0.4f64, 120), known: bool) {
        let end = periods * TAU / w;
        let times: Vec<f64> = jitter.iter().enumerate().map(|(i, j)| end * (i as f64 + j) / 119.0).collect();
        let (y, v) = signal(&times, s, w, phase);
        let mode = fit_linear_mode(&times, &y, known.then_some(&v[..])).unwrap();
        prop_assert!((mode.growth_rate.value - s).abs() < 1e-5 * w, "{:?}", mode);
        prop_assert!((mode.frequency.unwrap().value - w).abs() < 1e-5 * w, "{:?}", mode);
    }
}

#[test]
fn integrals_are_exact_for_cubics() {
    let times = [0.0, 0.3, 0.4, 1.0, 1.1, 2.0];
    let value = |t: f64| 1.0 - 2.0 * t + 0.5 * t * t * t;
    let slope = |t: f64| -2.0 + 1.5 * t * t;
    let exact = |t: f64| t - t * t + 0.125 * t.powi(4);
    let (y, d) = (times.map(value), times.map(slope));
    for integral in [cumulative_integral(&times, &y, None), cumulative_integral(&times, &y, Some(&d))] {
        for (t, sum) in times.iter().zip(&integral) {
            assert!((sum - exact(*t)).abs() < 1e-14, "{integral:?}");
        }
    }
    assert_eq!(cumulative_integral(&[1.0], &[1.0], None), [0.0]);
    assert_eq!(cumulative_integral(&[1.0, 3.0], &[1.0, 2.0], None), [0.0, 3.0]);
}

#[test]
fn fourth_order() {
    let errors: Vec<f64> = [40, 80]
        .iter()
        .map(|&count| {
            let times: Vec<f64> = (0..=count).map(|i| 5.0 * f64::from(i) / f64::from(count)).collect();
            let y: Vec<f64> = times.iter().map(|t| t.cos()).collect();
            let integral = cumulative_integral(&times, &y, None);
            times.iter().zip(&integral).map(|(t, sum)| (sum - t.sin()).abs()).fold(0.0, f64::max)
        })
        .collect();
    assert!((errors[0] / errors[1]).log2() > 3.8, "{errors:?}");
}
