use super::*;
use proptest::prelude::*;
use std::f64::consts::TAU;

fn points(list: &[[f64; 2]]) -> Vec<Vec2> {
    list.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
}

/// All pairs.
fn slow(points: &[Vec2]) -> Option<(usize, usize)> {
    let m = points.len();
    for i in 0..m {
        for j in i + 1..m {
            let (p, q, r, s) = (points[i], points[(i + 1) % m], points[j], points[(j + 1) % m]);
            let meet = if j == i + 1 {
                folds_back(q - p, s - q)
            } else if i == 0 && j == m - 1 {
                folds_back(p - r, q - p)
            } else {
                segments_meet(p, q, r, s)
            };
            if meet {
                return Some((i, j));
            }
        }
    }
    None
}

#[test]
fn a_square_is_simple_and_a_bow_tie_is_not() {
    assert_eq!(first_crossing(&points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])).unwrap(), None);
    let tie = points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    assert_eq!(first_crossing(&tie).unwrap(), Some((1, 3)));
}

#[test]
fn touching_and_folding_back_count() {
    let touching = points(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(first_crossing(&touching).unwrap(), Some((0, 2)));
    let spike = points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 3.0], [1.0, 1.5], [0.0, 1.0]]);
    assert_eq!(first_crossing(&spike).unwrap(), Some((2, 3)));
    assert!(first_crossing(&points(&[[0.0, 0.0], [1.0, 0.0]])).is_err());
    assert!(first_crossing(&points(&[[0.0, 0.0], [1.0, 0.0], [f64::NAN, 1.0]])).is_err());
    assert!(first_crossing(&points(&[[1.0, 1.0]; 5])).unwrap().is_some());
}

#[test]
fn a_necking_shape_crosses_when_its_neck_closes() {
    // (cos t, sin t (neck + (1 - neck) cos^2 t)) pinches at t = pi/2 and crosses for a negative neck.
    let shape = |neck: f64| -> Vec<Vec2> {
        (0..400)
            .map(|k| {
                let (s, c) = (TAU * (f64::from(k) + 0.5) / 400.0).sin_cos();
                Vec2::new(c, s * (neck + (1.0 - neck) * c * c))
            })
            .collect()
    };
    assert_eq!(first_crossing(&shape(0.01)).unwrap(), None);
    assert!(first_crossing(&shape(-0.01)).unwrap().is_some());
}

proptest! {
    #[test]
    fn agrees_with_all_pairs(list in proptest::collection::vec((0.0..1.0f64, 0.0..1.0f64), 3..40)) {
        let points: Vec<Vec2> = list.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
        prop_assert_eq!(first_crossing(&points).unwrap(), slow(&points));
    }

    #[test]
    fn agrees_with_all_pairs_on_wiggly_curves(
        seed in proptest::collection::vec(-1.0..1.0f64, 12), amplitude in 0.0..1.2f64, m in 8usize..150,
    ) {
        let points: Vec<Vec2> = (0..m).map(|k| {
            let t = TAU * k as f64 / m as f64;
            let mode = |j: usize, shift: usize| seed[(j + shift) % 12] * ((j + 2) as f64 * t + 9.0 * seed[j]).cos();
            let wave = |shift: usize| (0..6).map(|j| mode(j, shift)).sum::<f64>();
            Vec2::new(t.cos() + 0.3 * amplitude * wave(0), t.sin() + 0.3 * amplitude * wave(6))
        }).collect();
        prop_assert_eq!(first_crossing(&points).unwrap(), slow(&points));
    }
}

/// An overhanging line crosses its own image before it crosses itself.
#[test]
fn lines_cross_their_next_images() {
    let period = 4.0;
    let line = |overhang: f64| -> Vec<Vec2> {
        let angle = |k: usize| -> f64 { TAU * k as f64 / 200.0 };
        (0..200)
            .map(|k| Vec2::new(period * k as f64 / 200.0 + overhang * (2.0 * angle(k)).sin(), angle(k).cos()))
            .collect()
    };
    let mut finder = CrossingFinder::default();
    for direction in [1.0, -1.0] {
        let mut crossing = |overhang: f64| {
            let mut points = line(overhang);
            points.iter_mut().for_each(|point| point.x *= direction);
            finder.first_crossing_over(&points, direction * period).unwrap()
        };
        assert_eq!([0.0, 0.3, 0.6].map(&mut crossing), [None; 3], "{direction}");
        // It turns back by more than the period: its arms meet.
        assert!(crossing(3.0).is_some());
    }
    // A closed polygon is one.
    let circle: Vec<Vec2> = (0..20).map(|k| Vec2::from_angle(0.1 * std::f64::consts::PI * f64::from(k))).collect();
    assert_eq!(finder.first_crossing_over(&circle, 0.0).unwrap(), None);
}

#[test]
fn lines_that_are_none_are_refused() {
    let mut finder = CrossingFinder::default();
    let line = points(&[[0.0, 0.0], [1.0, 0.5], [2.0, 0.0]]);
    let at = |y: f64| points(&[[0.0, 0.0], [1.0, y], [2.0, 0.0]]);
    assert_eq!(finder.first_crossing_over(&line, 3.0).unwrap(), None);
    // Though x goes on and on.
    assert!(finder.first_crossing_over(&at(f64::NAN), 3.0).is_err());
    assert!(finder.first_crossing_over(&at(f64::INFINITY), 3.0).is_err());
    for advance in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(finder.first_crossing_over(&line, advance), Err(InputError::NotFinite { .. })), "{advance}");
    }
    for count in 0..3 {
        assert!(finder.first_crossing_over(&line[..count], 3.0).is_err(), "{count}");
    }
}
