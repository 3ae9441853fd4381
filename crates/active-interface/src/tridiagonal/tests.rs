use super::*;
use motile_base::Vec2;
use proptest::prelude::*;

fn apply(lower: &[f64], diagonal: &[f64], upper: &[f64], x: &[f64]) -> Vec<f64> {
    let n = x.len();
    (0..n).map(|k| lower[k] * x[(k + n - 1) % n] + diagonal[k] * x[k] + upper[k] * x[(k + 1) % n]).collect()
}

#[test]
fn singular_systems_have_no_finite_solution() {
    let mut x = [1.0, 2.0, 3.0, 4.0];
    CyclicTridiagonal::new(4).solve(&[0.0; 4], &[0.0; 4], &[0.0; 4], &mut x);
    assert!(x.iter().all(|value| !value.is_finite()));
}

#[test]
fn smoothing_damps_a_mode_by_its_symbol() {
    let n = 40;
    let mode = 7.0 * std::f64::consts::TAU / 40.0;
    let (width, spacing) = (0.3, 0.1);
    let mut x: Vec<Vec2> =
        (0..n).map(|k| Vec2::new((mode * f64::from(k)).cos(), (mode * f64::from(k)).sin())).collect();
    let before = x.clone();
    CirculantTridiagonal::smoothing(width, spacing).solve(&mut x);
    let symbol = 1.0 / (1.0 + (width / spacing * 2.0 * (0.5 * mode).sin()).powi(2));
    for (after, before) in x.iter().zip(&before) {
        assert!((after - before * symbol).length() < 1e-15);
    }
}

proptest! {
    #[test]
    fn the_solution_solves(
        n in 3usize..60,
        seed in proptest::collection::vec((-1.0..1.0f64, -1.0..1.0f64, 0.05..1.0f64, -5.0..5.0f64), 60),
    ) {
        let lower: Vec<f64> = seed[..n].iter().map(|s| s.0).collect();
        let upper: Vec<f64> = seed[..n].iter().map(|s| s.1).collect();
        let diagonal: Vec<f64> = seed[..n].iter().map(|s| s.0.abs() + s.1.abs() + s.2).collect();
        let rhs: Vec<f64> = seed[..n].iter().map(|s| s.3).collect();
        let mut x = rhs.clone();
        CyclicTridiagonal::new(n).solve(&lower, &diagonal, &upper, &mut x);
        for (found, wanted) in apply(&lower, &diagonal, &upper, &x).iter().zip(&rhs) {
            prop_assert!((found - wanted).abs() < 1e-10);
        }
    }

    #[test]
    fn constant_coefficients_agree_with_general(
        n in 3usize..60, off in -1.0..1.0f64, excess in 0.01..2.0f64, sign in prop::bool::ANY,
        rhs in proptest::collection::vec(-5.0..5.0f64, 60),
    ) {
        let diagonal = (2.0 * off.abs() + excess) * if sign { 1.0 } else { -1.0 };
        let mut fast = rhs[..n].to_vec();
        let mut general = fast.clone();
        CirculantTridiagonal::new(diagonal, off).solve(&mut fast);
        CyclicTridiagonal::new(n).solve(&vec![off; n], &vec![diagonal; n], &vec![off; n], &mut general);
        for (a, b) in fast.iter().zip(&general) {
            prop_assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()));
        }
    }
}
