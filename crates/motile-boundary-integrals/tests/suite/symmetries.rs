//! Properties that hold for any shape and force.

use crate::scenes;

use std::f64::consts::TAU;

use motile_base::{Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings};
use motile_scene::{Hydrodynamics, Markers};
use proptest::prelude::*;
use scenes::{Ellipse, markers};

const COUNT: usize = 128;

fn ellipse() -> impl Strategy<Value = Ellipse> {
    let tensions: [fn(f64) -> f64; 3] = [|t| 1.0 + 0.5 * t.cos(), |t| 2.0 + (2.0 * t - 1.0).sin(), |t| t.sin().exp()];
    (-1.0..1.0f64, -1.0..1.0f64, 0.7..1.3f64, 0.0..TAU, -2.0..2.0f64, 0usize..3).prop_map(
        move |(x, y, a, angle, exponent, tension)| Ellipse {
            centre: [x, y],
            axes: [a, 1.0 / a],
            angle,
            viscosity: Some(10f64.powf(exponent)),
            tension: tensions[tension],
        },
    )
}

fn settings() -> Settings {
    // Ellipses of aspect ratio two need some nodes for what is to be exact.
    Settings { nodes: COUNT, tolerance: 1e-12, ..Settings::default() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn turning_the_scene_turns_the_flow(shape in ellipse(), angle in 0.0..TAU) {
        let mut solver = BoundaryIntegral::new(Region::Plane, 1.0, settings()).unwrap();
        let mut first = markers(&[shape], COUNT);
        solver.velocities(&mut first).unwrap();
        let (sin, cos) = angle.sin_cos();
        let turn = |v: &Vec2| Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
        let mut second = first.clone();
        second.positions_mut().iter_mut().for_each(|x| *x = turn(x));
        second.forces_mut().iter_mut().for_each(|f| *f = turn(f));
        solver.velocities(&mut second).unwrap();
        for (a, b) in first.velocities().iter().zip(second.velocities()) {
            prop_assert!((turn(a) - b).length() < 1e-10);
        }
    }

    #[test]
    fn the_area_does_not_change_and_work_is_dissipated(shape in ellipse()) {
        let mut solver = BoundaryIntegral::new(Region::Box { lengths: [5.0, 6.0] }, 1.0, settings()).unwrap();
        let mut markers = markers(&[shape], COUNT);
        solver.velocities(&mut markers).unwrap();
        let mut tangents = vec![Vec2::ZERO; COUNT];
        PeriodicCalculus::new(COUNT).unwrap().derivative(markers.positions(), &mut tangents).unwrap();
        let pairs = markers.velocities().iter().zip(&tangents);
        let flux: f64 = pairs.map(|(v, t)| v.x * t.y - v.y * t.x).sum::<f64>() * TAU / COUNT as f64;
        prop_assert!(flux.abs() < 1e-9, "{}", flux);
        let power: f64 = markers.velocities().iter().zip(markers.forces()).map(|(v, f)| v.dot(*f)).sum();
        prop_assert!(power > 0.0);
    }

    #[test]
    fn flows_of_two_droplets_are_reciprocal(first in ellipse(), mut second in ellipse(), wave in 0.0..TAU) {
        // Lorentz: the work of one set of forces on the flow of another is that of the other on the flow of the first.
        second.centre[0] += 6.0;
        let mut solver = BoundaryIntegral::new(Region::Plane, 1.0, settings()).unwrap();
        let mut one = markers(&[first, second], COUNT);
        let mut two = one.clone();
        let push = |k: usize| (3.0 * TAU * k as f64 / COUNT as f64 + wave).sin();
        for (k, force) in two.forces_mut().iter_mut().enumerate() {
            *force = Vec2::new(push(k), push(2 * k + 1)) / COUNT as f64;
        }
        solver.velocities(&mut one).unwrap();
        solver.velocities(&mut two).unwrap();
        let work = |a: &Markers, b: &Markers| -> f64 {
            a.forces().iter().zip(b.velocities()).map(|(f, v)| f.dot(*v)).sum()
        };
        let (ab, ba) = (work(&one, &two), work(&two, &one));
        prop_assert!((ab - ba).abs() < 1e-9 * (1.0 + ab.abs()), "{} {}", ab, ba);
    }

    #[test]
    fn calculus_of_waves(m in 1usize..20, phase in 0.0..TAU, len in 41usize..80) {
        let wave = |t: f64| Vec2::new((m as f64 * t + phase).cos(), (m as f64 * t).sin());
        let samples: Vec<Vec2> = (0..len).map(|k| wave(TAU * k as f64 / len as f64)).collect();
        let mut calculus = PeriodicCalculus::new(len).unwrap();
        let mut out = vec![Vec2::ZERO; len];
        calculus.derivative(&samples, &mut out).unwrap();
        for (k, slope) in out.iter().enumerate() {
            let t = TAU * k as f64 / len as f64;
            let expected = Vec2::new(-(m as f64 * t + phase).sin(), (m as f64 * t).cos()) * m as f64;
            prop_assert!((slope - expected).length() < 1e-11);
        }
    }
}

#[test]
fn markers_may_be_any_number_from_that_of_the_nodes_on() {
    // The same shape and forces by 33, 64, 65 and 127 markers, odd and even nodes.
    for nodes in [32, 33] {
        let mut solver = BoundaryIntegral::new(Region::Plane, 1.0, Settings { nodes, ..settings() }).unwrap();
        let shape = Ellipse { viscosity: Some(3.0), ..Ellipse::circle(0.2, 0.1, |t| 1.0 + 0.5 * (t - 0.3).cos()) };
        for count in [33, 64, 65, 127] {
            let mut markers = markers(&[shape], count);
            solver.velocities(&mut markers).unwrap();
            // The first marker is at the same place for all.
            let mut reference = scenes::markers(&[shape], 256);
            solver.velocities(&mut reference).unwrap();
            assert!((markers.velocities()[0] - reference.velocities()[0]).length() < 1e-12, "{nodes} {count}");
        }
    }
}
