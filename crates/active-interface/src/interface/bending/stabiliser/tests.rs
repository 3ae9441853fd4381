use std::f64::consts::TAU;

use super::*;

const COUNT: usize = 24;

fn prepared(modes: usize, dt: f64) -> BendingStabiliser {
    let mut made = BendingStabiliser::new(COUNT).unwrap();
    let of = Stiffness { perimeter: TAU, viscosity: 2.0, largest: 1.0, dt, modes };
    made.prepare(|wave| 3.0 * wave * wave, of);
    made
}

/// Places of a wave of the number m about an advancing line, and of its height alone.
fn wave(m: usize, advance: f64) -> [Vec<f64>; 2] {
    let of = |line: f64| {
        let place = |k: usize| {
            let part = k as f64 / COUNT as f64;
            [line * part + 0.1 * (TAU * m as f64 * part).cos(), 0.2 * (TAU * m as f64 * part).sin()]
        };
        (0..COUNT).flat_map(place).collect()
    };
    [of(advance), of(0.0)]
}

/// A wave of the number q decays at `B q^3/(4 eta)`, and beyond the largest response at that times `B q^2`, less what a
/// step follows.
#[test]
fn each_wave_decays_at_its_own_rate() {
    for advance in [0.0, 5.0] {
        for (m, dt, rate) in [
            (1, f64::INFINITY, 3.0 / 8.0),
            (3, f64::INFINITY, 81.0 / 8.0),
            (6, f64::INFINITY, 108.0 / 2.0),
            (9, f64::INFINITY, 0.0),
            (1, 2.0, 0.0),
            (3, 0.25, 81.0 / 8.0 - 4.0),
        ] {
            let mut made = prepared(17, dt);
            let [places, heights] = wave(m, advance);
            let mut change = vec![0.0; 2 * COUNT];
            made.add(&places, advance, 0.5, &mut change);
            let mut solved = places.clone();
            made.solve(&mut solved, advance, 0.5);
            let mut back = vec![0.0; 2 * COUNT];
            let markers: Vec<Vec2> = places.chunks(2).map(|pair| Vec2::new(pair[0], pair[1])).collect();
            made.release(&markers, advance, &mut back);
            for k in 0..2 * COUNT {
                assert!((change[k] + 0.5 * rate * heights[k]).abs() < 1e-12, "{m}");
                assert!((back[k] - rate * heights[k]).abs() < 1e-12, "{m}");
                assert!((solved[k] - places[k] + heights[k] * (1.0 - 1.0 / (1.0 + 0.5 * rate))).abs() < 1e-14, "{m}");
            }
        }
    }
}

/// Outside of a prepared step, nothing happens.
#[test]
fn a_stabiliser_at_rest_does_nothing() {
    let mut made = prepared(17, 1.0);
    made.rest();
    let [places, _] = wave(2, 0.0);
    let mut same = places.clone();
    made.solve(&mut same, 0.0, 1.0);
    made.add(&places, 0.0, 1.0, &mut same);
    assert_eq!(same, places);
}
