use std::f64::consts::{PI, TAU};

use super::*;

/// A curve of the wave numbers `m` and `-m`.
fn curve(m: usize, alpha: f64) -> [f64; 2] {
    [(m as f64 * alpha + 0.7).cos(), 2.0 * (m as f64 * alpha).sin()]
}

fn samples(m: usize, len: usize) -> Vec<[f64; 2]> {
    (0..len).map(|k| curve(m, TAU * k as f64 / len as f64)).collect()
}

fn assert_is(series: &mut PeriodicSeries, tolerance: f64, expected: impl Fn(f64) -> [f64; 2]) {
    let len = series.len();
    let mut found = vec![[f64::NAN; 2]; len];
    series.write_vectors(&mut found).unwrap();
    for (k, found) in found.iter().enumerate() {
        let expected = expected(TAU * k as f64 / len as f64);
        let error = (found[0] - expected[0]).hypot(found[1] - expected[1]);
        assert!(error < tolerance, "{len} samples, sample {k}: {found:?} and {expected:?}");
    }
}

#[test]
fn operators_do_to_waves_what_they_say() {
    for len in (13..40).chain([64, 97]) {
        let mut series = PeriodicSeries::new(len).unwrap();
        for m in 0..=spectrum::largest_wave(len) {
            let wave = m as f64;
            let vectors = samples(m, len);
            series.analyse_vectors(&vectors).unwrap();
            assert_is(&mut series, 1e-14, |alpha| curve(m, alpha));

            series.differentiate();
            let slope = |alpha: f64| [-wave * (wave * alpha + 0.7).sin(), 2.0 * wave * (wave * alpha).cos()];
            assert_is(&mut series, 1e-11, slope);
            series.shift(0.3);
            assert_is(&mut series, 1e-11, |alpha| slope(alpha + 0.3));

            series.analyse_vectors(&vectors).unwrap();
            series.scale(|m| PI / m.max(1) as f64);
            let factor = PI / wave.max(1.0);
            assert_is(&mut series, 1e-13, |alpha| curve(m, alpha).map(|value| factor * value));

            // Half of the sum over both directions.
            series.analyse_vectors(&vectors).unwrap();
            series.multiply(|wave| if wave > 0.0 { Complex64::ZERO } else { Complex64::ONE });
            let c = Complex64::from_polar(0.5, -0.7) - Complex64::from(if m == 0 { 0.0 } else { 1.0 });
            if m > 0 {
                assert_is(&mut series, 1e-13, |alpha| {
                    let value = c * Complex64::cis(-wave * alpha);
                    [value.re, value.im]
                });
            }
        }
    }
}

#[test]
fn resampling_keeps_the_curve() {
    for (from, to) in [(21, 64), (64, 21), (20, 97), (97, 20), (32, 32)] {
        let (mut coarse, mut fine) = (PeriodicSeries::new(from).unwrap(), PeriodicSeries::new(to).unwrap());
        for m in 0..10 {
            coarse.analyse_vectors(&samples(m, from)).unwrap();
            fine.resample(&coarse);
            assert_is(&mut fine, 1e-13, |alpha| curve(m, alpha));
        }
    }
    let mut coarse = PeriodicSeries::new(8).unwrap();
    let mut fine = PeriodicSeries::new(40).unwrap();
    fine.analyse_vectors(&samples(4, 40)).unwrap();
    coarse.resample(&fine);
    assert_is(&mut coarse, 1e-15, |_| [0.0; 2]);
}

#[test]
fn wrong_lengths_are_errors_and_nothing_is_allocated() {
    let mut series = PeriodicSeries::new(6).unwrap();
    series.analyse_vectors(&samples(1, 6)).unwrap();
    let before = series.coefficients().to_vec();
    let expected = Err(InputError::WrongLength { name: "the samples", expected: 6, found: 7 });
    assert_eq!(series.analyse_vectors(&samples(1, 7)), expected);
    assert_eq!(series.coefficients(), before);
    let expected = Err(InputError::WrongLength { name: "the vectors", expected: 6, found: 5 });
    assert_eq!(series.write_vectors(&mut samples(1, 5)), expected);

    let mut vectors = samples(2, 6);
    let info = allocation_counter::measure(|| {
        series.analyse_vectors(&vectors).unwrap();
        series.differentiate();
        series.write_vectors(&mut vectors).unwrap();
    });
    assert_eq!(info.count_total, 0);
}

fn wave(m: usize, len: usize) -> Vec<[f64; 2]> {
    let angle = |k: usize| TAU * (m * k) as f64 / len as f64 + 0.4;
    (0..len).map(|k| [angle(k).cos(), 2.0 * angle(k).sin()]).collect()
}

#[test]
fn low_modes_stay_and_high_ones_go() {
    for (len, modes) in [(30, 7), (65, 32), (64, 1), (33, 0)] {
        let mut series = PeriodicSeries::new(len).unwrap();
        for m in 0..=len / 2 {
            let mut values = wave(m, len);
            series.truncate_vectors(&mut values, modes).unwrap();
            let kept = if 2 * m < modes.max(1) { 1.0 } else { 0.0 };
            for (value, wave) in values.iter().zip(wave(m, len)) {
                let error = (value[0] - kept * wave[0]).hypot(value[1] - kept * wave[1]);
                assert!(error < 1e-13, "mode {m}, {modes} of {len}: {value:?} and {wave:?}");
            }
        }
    }
}

#[test]
fn as_many_modes_as_samples_leave_them_bitwise_and_wrong_lengths_are_errors() {
    let mut values = wave(5, 10);
    PeriodicSeries::new(10).unwrap().truncate_vectors(&mut values, 10).unwrap();
    assert_eq!(values, wave(5, 10));
    let expected = Err(InputError::WrongLength { name: "the samples", expected: 12, found: 10 });
    assert_eq!(PeriodicSeries::new(12).unwrap().truncate_vectors(&mut values, 4), expected);
    assert_eq!(PeriodicSeries::new(12).unwrap().truncate_vectors(&mut values, 40), expected);
    assert_eq!(values, wave(5, 10));
}

#[test]
fn lengths_beyond_reason_are_refused_before_anything_is_allocated() {
    for len in [(1 << 26) + 1, usize::MAX / 16, usize::MAX] {
        let error = PeriodicSeries::new(len).unwrap_err();
        assert!(matches!(error, InputError::OutOfRange { maximum: 67_108_864.0, .. }), "{error}");
    }
}

/// Extremes between the samples, against a fine search.
#[test]
fn the_range_is_that_between_the_samples() {
    let f = |t: f64| (3.0 * t + 0.4).cos() + 0.5 * (5.0 * t).sin();
    let count = 24;
    let mut series = PeriodicSeries::new(count).unwrap();
    series.analyse((0..count).map(|k| f(TAU * k as f64 / count as f64).into())).unwrap();
    let all = (0..200_000).map(|k| f(TAU * f64::from(k) / 2e5));
    let exact = all.fold([f64::NEG_INFINITY, f64::INFINITY], |[most, least], v| [most.max(v), least.min(v)]);
    let found = series.range().unwrap();
    assert!((found[0] - exact[0]).abs() < 1e-5 && (found[1] - exact[1]).abs() < 1e-5, "{found:?} {exact:?}");
}
