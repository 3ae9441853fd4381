use super::*;

#[test]
fn low_modes_stay_and_high_ones_go() {
    let len = 30;
    let at = |m: f64, k: usize| (std::f64::consts::TAU * m * k as f64 / len as f64).sin_cos();
    let wave = |m: f64, k: usize| Vec2::new(at(m, k).0 + 0.5, at(m, k).1);
    let low: Vec<Vec2> = (0..len).map(|k| wave(3.0, k)).collect();
    let mut values: Vec<Vec2> = (0..len).map(|k| wave(3.0, k) + wave(4.0, k) - Vec2::new(0.5, 0.0)).collect();
    let mut plan = BandLimit::new(len, 7);
    plan.apply(&mut values);
    for (value, low) in values.iter().zip(&low) {
        assert!((value - low).norm() < 1e-14);
    }
}
