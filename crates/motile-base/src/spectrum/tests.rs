use super::*;

/// Coefficients numbered by their wave numbers, the unpaired one 0.
fn numbered(len: usize) -> Vec<Complex64> {
    (0..len).map(|index| Complex64::from(wave(index, len))).collect()
}

#[test]
fn waves_are_signed_and_the_unpaired_one_has_none() {
    let waves = |len: usize| -> Vec<f64> { (0..len).map(|index| wave(index, len)).collect() };
    assert_eq!(waves(5), [0.0, 1.0, 2.0, -2.0, -1.0]);
    assert_eq!(waves(6), [0.0, 1.0, 2.0, 0.0, -2.0, -1.0]);
    assert_eq!([0, 1, 2, 3, 4, 5].map(largest_wave), [0, 0, 0, 1, 1, 2]);
}

#[test]
fn a_band_is_copied_to_its_waves_whatever_the_lengths() {
    for from in 1..20 {
        for to in 1..20 {
            for largest in [0, 1, 3, usize::MAX] {
                let mut copy = vec![Complex64::from(99.0); to];
                copy_band(&numbered(from), &mut copy, largest);
                let both = largest.min(largest_wave(from)).min(largest_wave(to)) as f64;
                for (index, value) in copy.iter().enumerate() {
                    let wave = wave(index, to);
                    assert_eq!(value.re, if wave.abs() <= both { wave } else { 0.0 }, "{from} to {to}, entry {index}");
                }
            }
        }
    }
    copy_band(&[], &mut [], 3);
}

#[test]
fn a_truncated_spectrum_has_no_higher_waves() {
    for len in 0..12 {
        for largest in 0..8 {
            let mut spectrum = vec![Complex64::from(1.0); len];
            truncate(&mut spectrum, largest);
            for (index, value) in spectrum.iter().enumerate() {
                let kept = index.min(len - index) <= largest;
                assert_eq!(value.re, if kept { 1.0 } else { 0.0 }, "{len} entries, up to {largest}, entry {index}");
            }
        }
    }
}

#[test]
fn numbers_with_small_factors_alone_are_products() {
    let products: Vec<usize> = (0..31).filter(|&number| is_product(number, &[0, 1, 2, 3, 5])).collect();
    assert_eq!(products, [1, 2, 3, 4, 5, 6, 8, 9, 10, 12, 15, 16, 18, 20, 24, 25, 27, 30]);
}
