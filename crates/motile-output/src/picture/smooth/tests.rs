use super::*;
use std::f64::consts::TAU;

/// Midway between two points of a circle the cubic is off by 3/128 of the fourth power of their angle.
#[test]
fn lines_lie_on_the_curve() {
    for (count, expected) in [(16, 5.6e-4), (32, 3.5e-5)] {
        let points: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(TAU * k as f64 / count as f64)).collect();
        let line = smooth(&points, Vec2::ZERO);
        assert_eq!((line.len(), line[0], line[4 * count]), (4 * count + 1, points[0], points[0]));
        let most = line.iter().map(|point| (point.length() - 1.0).abs()).fold(0.0, f64::max);
        assert!((most / expected - 1.0).abs() < 0.1, "{most}");
    }
}

/// A wave goes on into its next period without a kink; chords would be off by 8.5e-3.
#[test]
fn periodic_lines_go_on() {
    let wave = |x: f64| Vec2::new(x, (TAU * x / 3.0).sin());
    let points: Vec<Vec2> = (0..24).map(|k| wave(3.0 * f64::from(k) / 24.0)).collect();
    let line = smooth(&points, Vec2::new(3.0, 0.0));
    assert!(line.iter().all(|point| (point.y - wave(point.x).y).abs() < 4e-4));
    assert!(line[96].distance(wave(3.0)) < 1e-14);
    let values: Vec<f64> = points.iter().map(|point| point.y).collect();
    let there = between(&values);
    assert!(there.len() == line.len() && there.iter().zip(&line).all(|(v, point)| (v - point.y).abs() < 0.01));
    assert!(smooth(&[], Vec2::ZERO).is_empty() && between(&[]).is_empty());
}
