use std::f64::consts::TAU;

use super::*;

fn values(len: usize) -> Vec<f64> {
    (0..len).map(|k| (0.37 * (k * k) as f64).sin() + 0.2).collect()
}

#[test]
fn a_transform_is_the_sum_it_says_and_the_inverse_undoes_it() {
    for len in (1..40).chain([97, 128, 240]) {
        let mut transform = RealTransform::new(len).unwrap();
        let (start, mut found) = (values(len), values(len));
        let mut spectrum = vec![Complex64::ZERO; transform.spectrum_len()];
        transform.forward(&mut found, &mut spectrum).unwrap();
        for (m, value) in spectrum.iter_mut().enumerate() {
            let term = |(k, f): (usize, &f64)| f * Complex64::cis(-TAU * (m * k % len) as f64 / len as f64);
            let expected: Complex64 = start.iter().enumerate().map(term).sum();
            assert!((*value - expected).norm() < 1e-12, "length {len}, entry {m}: {value} and {expected}");
        }
        // No part of any real values.
        spectrum[0].im = 1.0;
        transform.inverse(&mut spectrum, &mut found).unwrap();
        for (value, start) in found.iter().zip(&start) {
            assert!((value / len as f64 - start).abs() < 1e-14, "length {len}: {value} and {start}");
        }
    }
}

#[test]
fn wrong_lengths_are_errors() {
    let mut transform = RealTransform::new(6).unwrap();
    let (mut six, mut four) = (values(6), vec![Complex64::ZERO; 4]);
    let expected = Err(InputError::WrongLength { name: "the spectrum", expected: 4, found: 3 });
    assert_eq!(transform.forward(&mut six, &mut four[..3]), expected);
    assert_eq!(transform.inverse(&mut four[..3], &mut six), expected);
    let expected = Err(InputError::WrongLength { name: "the real numbers", expected: 6, found: 5 });
    assert_eq!(transform.forward(&mut six[..5], &mut four), expected);
    assert_eq!(transform.inverse(&mut four, &mut six[..5]), expected);
    assert_eq!(six, values(6));

    let mut none = RealTransform::new(0).unwrap();
    assert!(none.is_empty() && none.forward(&mut [], &mut four[..1]).is_ok());
    assert!(none.inverse(&mut four[..1], &mut []).is_ok());
}

#[test]
fn a_transform_allocates_nothing() {
    for len in [64, 97, 240] {
        let (mut transform, mut numbers) = (RealTransform::new(len).unwrap(), values(len));
        let mut spectrum = vec![Complex64::ZERO; transform.spectrum_len()];
        let info = allocation_counter::measure(|| {
            transform.forward(&mut numbers, &mut spectrum).unwrap();
            transform.inverse(&mut spectrum, &mut numbers).unwrap();
        });
        assert_eq!(info.count_total, 0, "length {len}");
    }
}

#[test]
fn lengths_beyond_reason_are_refused_before_anything_is_allocated() {
    for len in [(1 << 26) + 1, usize::MAX / 16, usize::MAX] {
        let error = RealTransform::new(len).unwrap_err();
        assert!(matches!(error, InputError::OutOfRange { maximum: 67_108_864.0, .. }), "{error}");
    }
}
