use std::f64::consts::PI;

use super::{
    super::waves::{Pair, Waves},
    *,
};

const NODES: usize = 16;
const INTERVALS: usize = 50;

/// Forces at the points with a step, which no wave resolves, and a smooth part.
fn force(j: usize) -> Vec2 {
    let t = PI * j as f64 / INTERVALS as f64;
    let step = if j > 13 && j < INTERVALS { 1.0 } else { 0.0 };
    Vec2::new(t.sin() * (1.3 + step), t.sin().powi(2) * t.cos() + step)
}

fn truncated(force: impl Fn(usize) -> Vec2) -> Pair {
    let mut out = Pair::new(NODES + 1);
    Truncation::new(NODES, INTERVALS).unwrap().apply(force, &mut out).unwrap();
    out
}

/// Values (across, along) of coefficients at t.
fn values(Pair { cos, sin }: &Pair, t: f64) -> (f64, f64) {
    let mut waves = Waves::new(NODES + 1);
    waves.fill(t);
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum();
    (sum(cos, &waves.cos), sum(sin, &waves.sin))
}

/// The truncated force has the power of the series through the points in every velocity that the nodes carry, the net
/// force among them, and none of it is at the poles.
#[test]
fn powers_stay_and_poles_are_free() {
    let out = truncated(force);
    // Series through the points, and the powers by many points.
    let n = INTERVALS as f64;
    let series = |t: f64| {
        let mut sum = (0.0, 0.0);
        for k in 0..=INTERVALS {
            let end = |j: usize| if j == 0 || j == INTERVALS { 0.5 } else { 1.0 };
            for j in 0..=INTERVALS {
                let (s, c) = (PI * (k * j) as f64 / n).sin_cos();
                let weight = 2.0 / n * end(j);
                sum.0 += weight * end(k) * c * force(j).y * (k as f64 * t).cos();
                sum.1 += weight * s * force(j).x * (k as f64 * t).sin();
            }
        }
        sum
    };
    let fine = 400;
    let mut powers = [[0.0; 2]; 2 * NODES];
    for p in 0..fine {
        let t = PI * (f64::from(p) + 0.5) / f64::from(fine);
        let weight = {
            let sines = (1..fine).step_by(2).map(|k| (f64::from(k) * t).sin() * 4.0 / f64::from(fine * k));
            sines.sum::<f64>()
        };
        for (which, (across, along)) in [series(t), values(&out, t)].into_iter().enumerate() {
            for k in 0..NODES {
                let (sin, cos) = (k as f64 * t).sin_cos();
                powers[2 * k][which] += weight * along * cos;
                powers[2 * k + 1][which] += weight * across * sin;
            }
        }
    }
    for (k, [given, found]) in powers.into_iter().enumerate() {
        assert!((given - found).abs() < 1e-12, "{k}: {given} {found}");
    }
    for pole in [0.0, PI] {
        assert!(values(&out, pole).0.abs() < 1e-13, "{:e}", values(&out, pole).0);
    }
}

/// Forces that the nodes carry stay as they are.
#[test]
fn smooth_forces_stay() {
    let exact = |t: f64| Vec2::new(t.sin() * (0.3 + (3.0 * t).cos()), t.sin() * (2.0 * t).sin());
    let out = truncated(|j| exact(PI * j as f64 / INTERVALS as f64));
    for t in [0.0, 0.1, 1.0, 2.0, 3.1] {
        let (across, along) = values(&out, t);
        assert!((Vec2::new(along, across) - exact(t)).length() < 1e-13, "{t}");
    }
}
