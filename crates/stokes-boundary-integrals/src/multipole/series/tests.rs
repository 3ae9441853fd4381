use super::*;

fn lattice(periods: [f64; 2]) -> SeriesFinder {
    SeriesFinder::new(&Region::Box { lengths: periods }, 1e-15).unwrap()
}

fn around_the_source(periods: [f64; 2], unit: f64) -> Series {
    let mut series = Series::new();
    let extent = Extent { reach: 0.5 * periods[0].min(periods[1]), unit, degree: 40 };
    lattice(periods).find(Complex64::default(), &[Complex64::default()], extent, &mut series);
    series
}

#[test]
fn coefficients_of_the_square_lattice() {
    // Values for a square box of side 6 (design notes of the method, section B5), there without 1/2 in the
    // constant.
    let Series { s: [s, imaginary], t: [t, _] } = around_the_source([6.0, 6.0], 1.0);
    let factorial = |n: usize| (1..=n).map(|n| n as f64).product::<f64>();
    assert!((s[0] + 0.018_773_456_683_454_6).abs() < 1e-14);
    for (n, value) in [(4, 6.078_726_856_006_77e-4), (8, 3.167_221_73e-7), (12, 1.507_901_88e-10)] {
        assert!((s[n] / factorial(n) / value - 1.0).abs() < 1e-8, "{n}");
    }
    for (n, value) in [(2, 0.034_828_539_366_201_4), (6, 4.839_158_345_16e-5), (10, 3.209_009_65e-8)] {
        assert!((t[n] / factorial(n) / value - 1.0).abs() < 1e-8, "{n}");
    }
    for n in [1, 2, 3, 5, 6, 7] {
        assert!(s[n].abs() < 1e-12 && imaginary[n].abs() < 1e-12, "{n}");
    }
}

#[test]
fn coefficients_are_lattice_sums() {
    // n s_n is the sum over the lattice of w^-n, 2 t_m that of conj(w) w^-(m + 1).
    for periods in [[6.0f64, 6.0], [8.0, 5.0], [4.0, 10.0]] {
        let unit = periods[0].min(periods[1]);
        let Series { s: [s, _], t: [t, _] } = around_the_source(periods, unit);
        let sum = |n: i32, conjugate: bool| {
            let mut sum = 0.0;
            for i in -30..=30 {
                for j in -30..=30 {
                    if (i, j) != (0, 0) {
                        let w = Complex64::new(f64::from(i) * periods[0], f64::from(j) * periods[1]) / unit;
                        sum += (w.powi(-n) * if conjugate { w.conj() } else { Complex64::new(1.0, 0.0) }).re;
                    }
                }
            }
            sum
        };
        let mut factorial = 1.0;
        for n in 1..24 {
            factorial *= f64::from(n);
            if n >= 8 && n % 2 == 0 {
                let index = n as usize;
                let bound = 10.0 * 30f64.powi(2 - n) + 1e-14 * 2f64.powi(n);
                assert!((s[index] / factorial * f64::from(n) - sum(n, false)).abs() < bound * f64::from(n), "{n}");
                assert!((2.0 * t[index] / factorial - sum(n + 1, true)).abs() < bound, "{periods:?} {n}");
            }
        }
    }
}

#[test]
fn free_space_leaves_nothing_of_a_large_lattice() {
    // Around a distance D, with the closest image left out, a large box has its background alone.
    let mut finder = lattice([400.0, 500.0]);
    let distance = Complex64::new(3.0, -1.0);
    let extent = Extent { reach: 1.0, unit: 1.0, degree: 20 };
    let (mut with, mut without, mut free) = (Series::new(), Series::new(), Series::new());
    finder.find(distance, &[], extent, &mut with);
    finder.find(distance, &[distance], extent, &mut without);
    free.free(distance, extent);
    for n in 0..20 {
        for (a, (b, c)) in
            (with.s.iter().zip(without.s.iter().zip(&free.s))).chain(with.t.iter().zip(without.t.iter().zip(&free.t)))
        {
            let scale = (1..=n).map(|n| n as f64).product::<f64>();
            assert!((a[n] - b[n] - c[n]).abs() < 1e-13 * scale, "{n}: {} {} {}", a[n], b[n], c[n]);
            assert!(n < 3 || b[n].abs() < 1e-6 * scale);
        }
    }
}
