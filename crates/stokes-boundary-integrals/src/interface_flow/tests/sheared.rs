//! Images that a shear has displaced.

use std::f64::consts::TAU;

use super::*;
use crate::{PeriodicCalculus, TensionPlacement};

const LENGTHS: [f64; 2] = [5.0, 4.0];

/// Ellipses about these centres with a tension that varies along them.
fn solved(lengths: [f64; 2], strain: f64, centres: &[Vec2], viscosity: f64) -> InterfaceFlow {
    let count = 64;
    let angle = |k: usize| TAU * k as f64 / count as f64;
    let mut calculus = PeriodicCalculus::new(count).unwrap();
    let tension: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * angle(k).cos()).collect();
    let ellipses: Vec<(Vec<Vec2>, Vec<Vec2>)> = centres
        .iter()
        .map(|centre| {
            let place = |k: usize| {
                *centre + Vec2::new(1.3 * angle(k).cos(), angle(k).sin() / 1.3).rotate(Vec2::from_angle(0.4))
            };
            let positions: Vec<Vec2> = (0..count).map(place).collect();
            let mut forces = vec![Vec2::ZERO; count];
            calculus.tension_forces(&positions, &tension, TensionPlacement::Points, &mut forces).unwrap();
            (positions, forces)
        })
        .collect();
    let settings = Settings { tolerance: 1e-12, nodes: 64, ..Settings::default() };
    let mut flow = InterfaceFlow::new(Region::Box { lengths }, 1.0, settings).unwrap();
    flow.impose(ImposedFlow::NONE, strain).unwrap();
    flow.load(ellipses.iter().map(|(x, f)| Interface::closed(x, f, [viscosity, 1.0]))).unwrap();
    flow.solve().unwrap();
    flow
}

/// Velocities on the first curve, and the flow at some points.
fn seen(flow: &mut InterfaceFlow) -> Vec<f64> {
    let mut velocities = vec![Vec2::ZERO; 64];
    flow.velocities(0, &mut velocities).unwrap();
    let points = [Vec2::new(0.1, -0.2), Vec2::new(2.3, 1.7), Vec2::new(-1.9, -1.9), Vec2::new(1.25, 0.5)];
    let mut samples = [FlowSample::default(); 4];
    flow.sample(&points, &mut samples).unwrap();
    let base = samples[1].pressure;
    let of_samples = samples.iter().flat_map(|s| {
        let [[ux, uy], [vx, vy]] = s.gradient;
        [s.velocity.x, s.velocity.y, s.pressure - base, ux, uy, vx, vy]
    });
    velocities.iter().flat_map(|v| [v.x, v.y]).chain(of_samples).collect()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Rows that are displaced by half a period are those of a box twice as high with two droplets in it.
#[test]
fn half_a_period() {
    let [lx, ly] = LENGTHS;
    for viscosity in [1.0, 8.0] {
        let place = Vec2::new(0.3, 0.2);
        let mut sheared = solved(LENGTHS, 0.5 * lx / ly, &[place], viscosity);
        let mut high = solved([lx, 2.0 * ly], 0.0, &[place, place + Vec2::new(0.5 * lx, ly)], viscosity);
        let error = apart(&seen(&mut sheared), &seen(&mut high));
        assert!(error < 1e-10, "{viscosity} {error:e}");
        assert!(apart(&seen(&mut sheared), &seen(&mut solved(LENGTHS, 0.0, &[place], viscosity))) > 1e-3);
    }
}

/// Whole periods change nothing but round-off, and the mean velocity stays zero under a mirror image in x, which turns
/// the displacement around.
#[test]
fn whole_periods() {
    let [lx, ly] = LENGTHS;
    let strain = 0.23;
    let at = |strain: f64| seen(&mut solved(LENGTHS, strain, &[Vec2::ZERO, Vec2::new(0.4, 2.05)], 5.0));
    let error = apart(&at(strain), &at(strain - 3.0 * lx / ly));
    assert!(error < 1e-11, "{error:e}");
}

/// In a shear the flow at an image one row above is that here and the shear rate times the period, inside and outside
/// of a droplet and in a rigid body.
#[test]
fn images_move_with_the_shear() {
    let [lx, ly] = LENGTHS;
    let (rate, strain) = (0.7, 0.31);
    let mut flow = solved(LENGTHS, strain, &[Vec2::ZERO, Vec2::new(0.4, 2.05)], 5.0);
    flow.impose(ImposedFlow::shear(rate), strain).unwrap();
    flow.solve().unwrap();
    let points = [Vec2::new(0.1, -0.2), Vec2::new(0.3, 2.0), Vec2::new(2.2, 0.3), Vec2::new(1.2, 0.5)];
    let sampled = |flow: &mut InterfaceFlow, shift: Vec2| {
        let mut samples = [FlowSample::default(); 4];
        flow.sample(&points.map(|point| point + shift), &mut samples).unwrap();
        samples
    };
    let here = sampled(&mut flow, Vec2::ZERO);
    let above = sampled(&mut flow, Vec2::new(strain * ly - lx, ly));
    for (here, above) in here.into_iter().zip(above) {
        assert!((above.velocity - here.velocity - Vec2::new(rate * ly, 0.0)).length() < 1e-10, "{here:?} {above:?}");
        assert!((above.pressure - here.pressure).abs() < 1e-9, "{here:?} {above:?}");
    }
    let mut inside = [Vec2::ZERO; 2];
    flow.velocities_inside(0, &[points[0], points[0] + Vec2::new(strain * ly, ly)], &mut inside).unwrap();
    assert!((inside[0] - here[0].velocity).length() < 1e-10, "{inside:?}");
    assert!((inside[1] - inside[0] - Vec2::new(rate * ly, 0.0)).length() < 1e-10, "{inside:?}");
}
