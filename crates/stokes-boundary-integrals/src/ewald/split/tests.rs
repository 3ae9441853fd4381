use super::*;

/// Values of both polynomials of a pair at t.
fn both(pairs: &[[f64; 4]], t: f64) -> [f64; 2] {
    let sum = |first: usize| pairs.iter().rev().fold(0.0, |sum, row| sum * t * t + row[first] + t * row[first + 1]);
    [sum(0), sum(2)]
}

#[test]
fn the_smooth_part_is_all_there_is_from_the_cutoff_on() {
    for exponent in 3..=13 {
        let tolerance = 10f64.powi(-exponent);
        let split = Split::new(tolerance);
        // The Stokeslet is r r there, the stress -4 r r r.
        let ([b, g], [a, slope]) = (both(&split.stokeslet, 1.0), both(&split.stress, 1.0));
        let (error, of_stress) = (b.abs().max((g - 1.0).abs()), a.abs().max((slope + 2.0).abs()));
        println!("{tolerance:e}: {error:.1e} {of_stress:.1e}");
        assert!(error < tolerance && of_stress < 100.0 * tolerance, "{tolerance:e}: {error:e} {of_stress:e}");
    }
}

#[test]
fn the_smooth_part_has_its_spectrum() {
    // The trace 2 b + s g of the smooth part by its inverse transform, 2 INT phi(k)/k J_0(k r) dk, differences of which
    // do not depend on the divergence at k = 0.
    let split = Split::new(1e-12);
    let transform = |r: f64| {
        let sum = |(x, weight): (f64, f64)| {
            let k = 0.5 * split.c * (1.0 + x);
            split.c * weight * split.phi(k) / k * (bessel::<0>(k * r) - bessel::<0>(0.0))
        };
        gauss_legendre(QUADRATURE).into_iter().map(sum).sum::<f64>()
    };
    let trace = |r: f64| {
        let [b, g] = both(&split.stokeslet, 2.0 * r * r - 1.0);
        2.0 * b + r * r * g
    };
    for r in [0.1, 0.4, 0.9] {
        let error = (trace(r) - trace(0.0) - transform(r)).abs();
        assert!(error < 1e-12, "{r}: {error:e}");
    }
    assert!((split.own - both(&split.stokeslet, -1.0)[0]).abs() < 1e-13);
}

#[test]
fn bessel_functions() {
    // Abramowitz and Stegun, Handbook of Mathematical Functions, table 9.1.
    assert!((bessel::<0>(2.0) - 0.223_890_779_141_235_67).abs() < 1e-15);
    assert!((bessel::<1>(2.0) * 2.0 - 0.576_724_807_756_873_4).abs() < 1e-15);
    assert!((bessel::<2>(2.0) * 4.0 - 0.352_834_028_615_637_7).abs() < 1e-15);
    assert!((bessel::<0>(17.5) - -0.103_110_398_228_685_88).abs() < 1e-14);
}
