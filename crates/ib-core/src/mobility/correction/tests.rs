use std::f64::consts::TAU;

use super::*;
use crate::BSpline;

/// Cells of 0.1 between walls at -1 and 1, a kernel of variance 4.
const CHANNEL: Setting =
    Setting { spacing: 0.1, origin: [0.0; 2], viscosity: 3.0, walls: Some([-1.0, 1.0]), variance: 4.0 };

/// erfc(1) = 0.157299207, erfc(1/2) = 0.479500122.
#[test]
fn corrections_fade_towards_walls() {
    // One and two spacings from either wall: x = 1/2 and 1.
    for (gap, tangential, normal) in
        [(0.0, 0.0, 0.0), (1.0, 0.646_145_14, 0.154_818_12), (2.0, 0.910_926_15, 0.399_576_4)]
    {
        for left in [CHANNEL.left(-1.0 + 0.1 * gap), CHANNEL.left(1.0 - 0.1 * gap)] {
            assert!((left[0] - tangential).abs() < 2e-6 && (left[1] - normal).abs() < 1e-7, "{gap}: {left:?}");
        }
    }
    assert_eq!(Setting { walls: None, ..CHANNEL }.left(7.0), [1.0; 2]);
}

/// An ellipse off the grid's axes, and what the correction makes of forces on it.
fn corrected(force: impl Fn(Vec2) -> Vec2) -> Vec<Vec2> {
    let turn = Vec2::from_angle(0.3);
    let at = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / 128.0).sin_cos();
        turn.rotate(Vec2::new(0.7 * cos, 0.5 * sin))
    };
    let positions: Vec<Vec2> = (0..128).map(at).collect();
    let forces: Vec<Vec2> = (0..128).map(|k| force(0.5 * (at(k + 1) - at(k + 127)))).collect();
    let mut velocities = vec![Vec2::ZERO; 128];
    let deficit = MobilityDeficit::new(&BSpline::<4>);
    let setting = Setting { walls: None, ..CHANNEL };
    MobilityCorrection::new(deficit).apply(&setting, &positions, &forces, &mut velocities).unwrap();
    velocities
}

/// The normal forces of a uniform pressure inside are balanced by it, in whatever direction the interface runs.
#[test]
fn a_uniform_pressure_moves_nothing() {
    let largest = |velocities: &[Vec2]| velocities.iter().map(|v| v.length()).fold(0.0, f64::max);
    let pressed = corrected(|chord| 2.0 * Vec2::new(chord.y, -chord.x));
    let dragged = corrected(|chord| 2.0 * chord);
    assert!(largest(&pressed) < 1e-14 && largest(&dragged) > 0.01, "{} {}", largest(&pressed), largest(&dragged));
}

/// Where an interface runs along the grid, what the correction takes off is periodic in its height: the first harmonic,
/// and the second one times the part that the kernel has of it.
#[test]
fn harmonics_of_the_height_have_their_ratio() {
    let (count, radius, spacing) = (512_u32, 4.0, 0.1);
    let speed = |height: f64| {
        let at = |k: u32| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
            Vec2::new(radius * cos, radius * sin + height)
        };
        let positions: Vec<Vec2> = (0..count).map(at).collect();
        let forces: Vec<Vec2> = (0..count).map(|k| 0.5 * (at(k + 1) - at(k + count - 1))).collect();
        let mut velocities = vec![Vec2::ZERO; count as usize];
        let setting = Setting { walls: None, ..CHANNEL };
        let deficit = MobilityDeficit::new(&BSpline::<4>);
        MobilityCorrection::new(deficit).apply(&setting, &positions, &forces, &mut velocities).unwrap();
        velocities[count as usize / 4].x
    };
    let speeds: Vec<f64> = (0..16).map(|k| speed(spacing * f64::from(k) / 16.0)).collect();
    let harmonic = |n: f64| {
        let part = |k: usize| speeds[k] * (TAU * n * k as f64 / 16.0).cos();
        (0..16).map(part).sum::<f64>() / 8.0
    };
    let [first, second, fourth] = [1.0, 2.0, 4.0].map(harmonic);
    let ratio = MobilityDeficit::new(&BSpline::<4>).second_harmonic();
    assert!((second / first / ratio - 1.0).abs() < 0.2, "{first:e} {second:e} {ratio}");
    assert!(fourth.abs() < 0.2 * second.abs(), "{second:e} {fourth:e}");
}
