use std::f64::consts::TAU;

use stokes_layers::{Geometry, dense::DoubleLayerMatrix};

use super::*;

fn ellipse(centre: Vec2, count: u32) -> Vec<Vec2> {
    let at = |k: u32| TAU * f64::from(k) / f64::from(count);
    (0..count).map(|k| centre + Vec2::new(1.2 * at(k).cos(), 0.8 * at(k).sin())).collect()
}

/// Orthonormal in the product weighted by the arc length; none of them stretches the droplet, and forces have their net
/// force and torque as components.
#[test]
fn three_rigid_motions_of_each_droplet() {
    let matrix = DoubleLayerMatrix::new(Geometry::Box { lengths: [8.0; 2] }, 0.0, 0.01).unwrap();
    let droplets = [ellipse(Vec2::new(-2.0, 0.3), 40), ellipse(Vec2::new(1.5, -0.4), 56)];
    let mut curves = [NodeCurve::default(), NodeCurve::default()];
    for (curve, (first, positions)) in curves.iter_mut().zip([0, 40].into_iter().zip(&droplets)) {
        curve.load(&matrix, first, [2.0, 1.0], positions).unwrap();
    }
    let (mut modes, nodes) = (RigidModes::default(), 96);
    modes.fill(&curves);
    for (i, motion) in modes.motions(nodes).enumerate() {
        for (j, weighted) in modes.weighted(nodes).enumerate() {
            let product: f64 = motion.iter().zip(weighted).map(|(a, b)| a * b).sum();
            assert!((product - f64::from(u8::from(i == j))).abs() < 1e-13, "{i} {j}: {product}");
        }
        let curve = &curves[i / RIGID];
        let velocity = |k: usize| Vec2::new(motion[curve.first + k], motion[nodes + curve.first + k]);
        for k in 1..curve.len() {
            let side = curve.positions[k] - curve.positions[0];
            assert!((velocity(k) - velocity(0)).dot(side).abs() < 1e-14, "motion {i}, node {k}");
        }
    }
    // A couple of forces on the second droplet: a torque of 2.4 alone.
    let mut forces = vec![Vec2::ZERO; nodes];
    (forces[40], forces[40 + 28]) = (Vec2::Y, -Vec2::Y);
    let moment = |curve: &NodeCurve| -> f64 {
        curve.positions.iter().zip(&curve.weights).map(|(x, w)| w * x.length_squared()).sum()
    };
    let expected = [0.0, 0.0, 0.0, 0.0, 0.0, 2.4 / moment(&curves[1]).sqrt()];
    for (motion, expected) in expected.into_iter().enumerate() {
        assert!((modes.component(motion, &forces) - expected).abs() < 1e-12, "motion {motion}");
    }
}
