use motile_base::{Drive, Region, Vec2};
use proptest::prelude::*;

use super::*;
use crate::{curve::LayerCurve, plan::Plan};

/// A curve of so many nodes with its plan, its fine nodes ready.
fn curve(positions: &[Vec2], period: f64, nodes: usize) -> (Curve, Plan) {
    let region =
        Region::Channel { length: if period == 0.0 { 6.0 } else { period }, width: 9.0, drive: Drive::default() };
    let (mut plans, mut curve) = (Vec::new(), Curve::new(nodes));
    Plan::find(&mut plans, nodes).unwrap();
    let given = LayerCurve { positions, period: Vec2::new(period, 0.0), nodes };
    curve.load(&mut plans[0].transforms, (given, &[]), &region, 0).unwrap();
    curve.refine(&mut plans[0].transforms);
    (curve, plans.remove(0))
}

fn angle(k: usize, count: usize) -> f64 {
    TAU * k as f64 / count as f64
}

/// Plain kernels of a row at all fine nodes, down to distances where differences of exponentials have lost all digits.
#[test]
fn kernels_of_an_open_curve_are_those_of_a_row_of_images() {
    let (count, period) = (32, 5.0);
    let positions: Vec<Vec2> =
        (0..count).map(|k| Vec2::new(period * k as f64 / count as f64, 0.1 * angle(k, count).sin())).collect();
    let (curve, mut plan) = curve(&positions, period, count);
    let greens = curve.greens();
    for distance in [1e-9, 1e-4, 0.01, 0.03, 0.1, 0.5, 2.0] {
        for j in [0, 1, 5, 127] {
            let d = Complex64::from_polar(distance, 0.3 + j as f64);
            let place = Place { point: curve.fine.position[j] - d, nearest: j, preimage: None };
            plan.weights.fill::<3>(&curve, &place);
            for (i, z) in curve.fine.position.iter().enumerate() {
                let (found, exact) = (plan.weights.fine.at(i), greens.at(z - place.point));
                // Round-off of the distance itself.
                let scale = 1.0 + 1e-2 / curve.wrap(z - place.point).norm();
                assert!((found.log - exact.log).abs() < 1e-13 * scale, "{distance}, {j}, {i}");
                for k in 0..3 {
                    let tolerance = 1e-12 * scale * (1.0 + exact.c[k].norm());
                    assert!((found.c[k] - exact.c[k]).norm() < tolerance, "{distance}, {j}, {i}: c {k}");
                    assert!((found.e[k] - exact.e[k]).norm() < tolerance * scale, "{distance}, {j}, {i}: e {k}");
                }
            }
        }
    }
}

proptest! {
    /// The nearest fine node of curves with lobes and narrow necks, where the nearest node is on another arm.
    #[test]
    fn the_nearest_fine_node_is_found(
        lobes in 2usize..6,
        depth in 0.0..0.93f64,
        skew in -0.4..0.4f64,
        x in -2.0..2.0f64,
        y in -2.0..2.0f64,
    ) {
        let count = 96;
        let positions: Vec<Vec2> = (0..count).map(|k| {
            let a = angle(k, count);
            Vec2::from_angle(a + skew * (a + 1.0).sin()) * (1.0 + depth * (lobes as f64 * a).cos())
        }).collect();
        let (curve, mut plan) = curve(&positions, 0.0, count);
        let point = Complex64::new(x, y);
        let place = plan.weights.place(&curve, point, reach(1e-8));
        let distance = |j: usize| (curve.fine.position[j] - point).norm_sqr();
        let least = (0..curve.fine.position.len()).map(distance).fold(f64::INFINITY, f64::min);
        prop_assert_eq!(distance(place.nearest), least);
    }
}
