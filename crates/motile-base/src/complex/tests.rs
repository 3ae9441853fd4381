use std::f64::consts::TAU;

use super::*;

fn values(len: usize) -> Vec<Complex64> {
    (0..len).map(|k| Complex64::new((0.37 * (k * k) as f64).sin() + 0.2, (1.3 * k as f64).cos())).collect()
}

#[test]
fn a_transform_is_the_sum_it_says_and_the_inverse_undoes_it() {
    for len in (1..40).chain([97, 128, 240]) {
        let mut transform = ComplexTransform::new(len).unwrap();
        let start = values(2 * len);
        let mut found = start.clone();
        transform.forward(&mut found).unwrap();
        for (index, value) in found.iter().enumerate() {
            let (part, m) = (&start[index / len * len..][..len], index % len);
            // Angles reduced exactly.
            let term = |(k, f): (usize, &Complex64)| f * Complex64::cis(-TAU * (m * k % len) as f64 / len as f64);
            let expected: Complex64 = part.iter().enumerate().map(term).sum();
            assert!((value - expected).norm() < 1e-12, "length {len}, entry {index}: {value} and {expected}");
        }
        transform.inverse(&mut found).unwrap();
        for (value, start) in found.iter().zip(&start) {
            assert!((value / len as f64 - start).norm() < 1e-14, "length {len}: {value} and {start}");
        }
    }
}

#[test]
fn wrong_lengths_are_errors_and_no_values_are_none() {
    let mut transform = ComplexTransform::new(6).unwrap();
    let mut seven = values(7);
    let expected = Err(InputError::WrongLength { name: "the complex numbers", expected: 6, found: 7 });
    assert_eq!(transform.forward(&mut seven), expected);
    assert_eq!(transform.inverse(&mut seven), expected);
    assert_eq!(seven, values(7));

    let mut none = ComplexTransform::new(0).unwrap();
    assert!(none.is_empty() && none.forward(&mut []).is_ok() && none.inverse(&mut []).is_ok());
    assert!(none.forward(&mut seven).is_err());
}

#[test]
fn a_transform_allocates_nothing() {
    for len in [64, 97, 240, 1009] {
        let (mut transform, mut numbers) = (ComplexTransform::new(len).unwrap(), values(len));
        let info = allocation_counter::measure(|| {
            transform.forward(&mut numbers).unwrap();
            transform.inverse(&mut numbers).unwrap();
        });
        assert_eq!(info.count_total, 0, "length {len}");
    }
}

#[test]
fn lengths_beyond_reason_are_refused_before_anything_is_allocated() {
    for len in [(1 << 26) + 1, usize::MAX / 16, usize::MAX] {
        let error = ComplexTransform::new(len).unwrap_err();
        assert!(matches!(error, InputError::OutOfRange { maximum: 67_108_864.0, .. }), "{error}");
    }
}
