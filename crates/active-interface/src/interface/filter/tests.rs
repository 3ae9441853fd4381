use std::f64::consts::TAU;

use super::*;

/// A circle of 24 markers, its radius changed by `ripple` from marker to marker.
fn ring(ripple: f64) -> (Vec<Vec2>, Geometry) {
    let radius = |k: u32| if k.is_multiple_of(2) { 1.0 + ripple } else { 1.0 - ripple };
    let markers: Vec<Vec2> = (0..24).map(|k| radius(k) * Vec2::from_angle(TAU * f64::from(k) / 24.0)).collect();
    let mut geometry = Geometry::default();
    geometry.update(&markers, 0.0);
    (markers, geometry)
}

fn filtered(ripple: f64, strength: impl Fn(usize) -> f64) -> Vec<Vec2> {
    let (mut markers, geometry) = ring(ripple);
    ShortWaveFilter::default().apply(&mut markers, &geometry, 0.5, strength);
    markers
}

#[test]
fn circles_stay_and_areas_are_kept_to_first_order() {
    // Every marker of a circle would move inwards alike.
    for (after, before) in filtered(0.0, |_| 0.4).iter().zip(&ring(0.0).0) {
        assert!((after - before).length() < 1e-15, "{after} {before}");
    }
    // A filter that is stronger on one side sweeps unequally.
    let (before, geometry) = ring(0.05);
    let after = filtered(0.05, |k| if k < 12 { 0.4 } else { 0.1 });
    let shifts = after.iter().zip(&before).zip(&geometry.tangents).map(|((x, y), tau)| (x - y).dot(outward(*tau)));
    let swept = |shifts: &[f64]| shifts.iter().zip(&geometry.weights).map(|(shift, w)| shift * w).sum::<f64>();
    let shifts: Vec<f64> = shifts.collect();
    let sizes: Vec<f64> = shifts.iter().map(|shift| shift.abs()).collect();
    assert!(swept(&shifts).abs() < 1e-14 && swept(&sizes) > 0.02, "{shifts:?}");
}

#[test]
fn long_steps_filter_in_passes_of_a_half() {
    let (mut passes, geometry) = ring(0.05);
    for _ in 0..8 {
        ShortWaveFilter::default().apply(&mut passes, &geometry, 0.5, |_| 0.5);
    }
    assert_eq!(filtered(0.05, |_| 4.0), passes);
    // What would take more than twenty is not followed any further.
    for _ in 8..20 {
        ShortWaveFilter::default().apply(&mut passes, &geometry, 0.5, |_| 0.5);
    }
    assert_eq!(filtered(0.05, |_| 1e6), passes);
    for strength in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(filtered(0.05, |_| strength), ring(0.05).0);
    }
}
