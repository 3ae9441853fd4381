use super::*;
use ib_core::{CubicQuadratic, MobilityDeficit};

#[test]
fn the_shape_is_the_mean_distance_from_a_spline() {
    // phi(s) = 1/2 (E|s + Z| - |s|) by quadrature over the cubic B-spline.
    let density = |z: f64| {
        let a = z.abs();
        if a < 1.0 { 2.0 / 3.0 - a * a + 0.5 * a * a * a } else { (2.0 - a).powi(3) / 6.0 }
    };
    for s in [0.0, 0.3, 0.9, 1.0, 1.4, 2.0, 2.5] {
        let steps = 40_000;
        let mean: f64 = (0..steps)
            .map(|k| 4.0 * (f64::from(k) + 0.5) / f64::from(steps) - 2.0)
            .map(|z| density(z) * (s + z).abs() * 4.0 / f64::from(steps))
            .sum();
        assert!((spline(s) - 0.5 * (mean - s)).abs() < 1e-8, "{s}");
    }
}

#[test]
fn the_deficit_of_the_default_kernel_is_that_of_the_shape() {
    let along_the_grid = MobilityDeficit::new(&CubicQuadratic::default()).flat(Vec2::new(1.0, 0.0));
    assert!((along_the_grid - SPLINE_AT_ZERO).abs() < 2e-3, "{along_the_grid}");
}

#[test]
fn it_has_no_divergence_and_ends() {
    let (step, spacing) = (1e-4, 0.1);
    for kink in [RoundedKink::new(0.25, 20.0), RoundedKink::new(0.25, 2.5), RoundedKink::new(0.4, 1.2)] {
        // What is missing on y = 0 is sin(x).
        let velocity = |x: f64, y: f64| {
            let beside = kink.beside(Vec2::new(0.0, y), Vec2::new(1.0, 0.0), 0.0, spacing);
            beside.map_or_else(Vec2::default, |beside| beside.velocity(x.sin(), x.cos()))
        };
        let places: [(f64, f64); 5] = [(0.3, 0.2), (0.3, -0.7), (1.2, 1.1), (2.0, -2.3), (0.1, 3.0)];
        for (x, s) in places.into_iter().filter(|(_, s)| s.abs() + 0.01 < kink.reach()) {
            let y = spacing * s;
            let divergence =
                (velocity(x + step, y) - velocity(x - step, y)).x + (velocity(x, y + step) - velocity(x, y - step)).y;
            assert!((0.5 * divergence / step).abs() < 1e-5, "{x} {s}: {divergence}");
        }
        assert!((velocity(1.0, 0.0) - Vec2::new(1.0_f64.sin(), 0.0)).length() < 1e-15);
        // Nothing flows across where it ends.
        assert!(velocity(0.0, spacing * kink.reach() * (1.0 - 1e-9)).y.abs() < 1e-8);
    }
}

#[test]
fn velocity_and_work_are_adjoint() {
    let kink = RoundedKink::new(0.25, 20.0);
    let beside = kink.beside(Vec2::new(0.03, -0.11), Vec2::new(0.6, 0.8), 0.5, 0.1).unwrap();
    let (force, missing, slope) = (Vec2::new(1.3, -0.4), 0.7, -2.1);
    let [on_missing, on_slope] = beside.work(force);
    let (power, adjoint) = (force.dot(beside.velocity(missing, slope)), on_missing * missing + on_slope * slope);
    assert!((power - adjoint).abs() < 1e-14 && power.abs() > 1e-4, "{power} {adjoint}");
}
