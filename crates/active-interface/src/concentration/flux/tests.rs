use super::*;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Largest error of the face values of exp(sin x), n cells, averages by 8-point Gauss quadrature.
fn error(n: usize) -> f64 {
    let nodes = [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_3];
    let weights = [0.362_683_783_378_362, 0.313_706_645_877_887_3, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26];
    let h = TAU / n as f64;
    let f = |x: f64| x.sin().exp();
    let average: Vec<f64> = (0..n)
        .map(|k| {
            let middle = (k as f64 + 0.5) * h;
            (0..4).map(|i| weights[i] * (f(middle - 0.5 * h * nodes[i]) + f(middle + 0.5 * h * nodes[i]))).sum::<f64>()
                / 2.0
        })
        .collect();
    (0..n)
        .map(|k| {
            let v = std::array::from_fn(|i| average[(k + n + i - 3) % n]);
            (weno5(v) - f(k as f64 * h)).abs()
        })
        .fold(0.0, f64::max)
}

#[test]
fn fifth_order_on_smooth_data() {
    let errors = [error(40), error(80), error(160)];
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 4.7, "order {order}, errors {errors:?}");
    }
    assert!(errors[2] < 1e-7, "{errors:?}");
}

#[test]
fn a_step_is_not_overshot() {
    for position in 0..6 {
        let v = std::array::from_fn(|i| if i < position { 1.0 } else { 0.0 });
        let value = weno5(v);
        assert!((-1e-6..=1.0 + 1e-6).contains(&value), "{v:?}: {value}");
    }
}

proptest! {
    #[test]
    fn scales_with_the_data(v in proptest::array::uniform5(0.1..10.0f64), factor in 1e-6..1e6f64) {
        let scaled = weno5(v.map(|x| x * factor));
        prop_assert!((scaled / factor - weno5(v)).abs() < 1e-9 * 10.0);
    }

    #[test]
    fn straight_lines_are_exact(slope in -5.0..5.0f64, offset in -5.0..5.0f64) {
        let v = std::array::from_fn(|i| offset + slope * (i as f64 - 2.5));
        prop_assert!((weno5(v) - offset).abs() < 1e-12);
    }
}

#[test]
fn parabolas_are_exact() {
    // Averages of x^2 over unit cells around 0; the face is at x = 1/2.
    let v = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|i: f64| i * i + 1.0 / 12.0);
    assert!((weno5(v) - 0.25).abs() < 1e-14);
}
