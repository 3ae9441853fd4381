use std::f64::consts::TAU;

use super::*;

fn wave(m: usize, len: usize) -> Vec<[f64; 2]> {
    let angle = |k: usize| TAU * (m * k) as f64 / len as f64 + 0.4;
    (0..len).map(|k| [angle(k).cos(), 2.0 * angle(k).sin()]).collect()
}

#[test]
fn low_modes_stay_and_high_ones_go() {
    for (len, modes) in [(30, 7), (65, 32), (64, 1), (33, 0)] {
        let mut limit = BandLimit::new(len, modes);
        for m in 0..=len / 2 {
            let mut values = wave(m, len);
            limit.apply(&mut values).unwrap();
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
    BandLimit::new(10, 10).apply(&mut values).unwrap();
    assert_eq!(values, wave(5, 10));
    let expected = Err(FourierError::WrongLength { name: "the samples", expected: 12, found: 10 });
    assert_eq!(BandLimit::new(12, 4).apply(&mut values), expected);
    assert_eq!(BandLimit::new(12, 40).apply(&mut values), expected);
    assert_eq!(values, wave(5, 10));
}
