use std::f64::consts::{PI, TAU};

use super::*;

const MODULI: [f64; 2] = [3.0, 0.7];

fn circle(radius: f64, count: u32) -> Vec<Vec2> {
    (0..count).map(|k| radius * Vec2::from_angle(TAU * f64::from(k) / f64::from(count))).collect()
}

/// A curve with unevenly spaced markers, nowhere as it is at rest.
fn bent(count: u32) -> Vec<Vec2> {
    let place = |t: f64| {
        let radius = 1.2 + 0.1 * (2.0 * t).cos() + 0.05 * (3.0 * t + 0.4).sin();
        radius * Vec2::from_angle(t + 0.2 * (t + 1.0).sin())
    };
    (0..count).map(|k| place(TAU * f64::from(k) / f64::from(count))).collect()
}

/// A circle of radius R blown up to s: the stretch is s/R, the curvature 1/s, and the curvature times the stretch 1/R.
#[test]
fn circles_have_their_energies_strains_tensions_and_forces() {
    let ([stretching, bending], rest, radius, count) = (MODULI, 1.5, 1.8, 32);
    let (stretch, bend) = (radius / rest, 1.0 / radius - 1.0 / rest);
    let length = TAU * rest;
    let stretched = 0.5 * stretching * (stretch - 1.0).powi(2) * length;
    // Minus the derivative of the energy by s is the sum of the radial forces.
    let pulled = -stretching * (stretch - 1.0) / rest * length;
    for (measure, bent, strain, energy, force, tension) in [
        (
            BendingMeasure::Curvature,
            1.0 / radius,
            bend,
            stretched + 0.5 * bending * bend * bend * length,
            pulled + bending * bend / (radius * radius) * length,
            stretching * (stretch - 1.0) - bending * bend / (radius * stretch),
        ),
        (BendingMeasure::TurningAngle, 1.0 / rest, 0.0, stretched, pulled, stretching * (stretch - 1.0)),
    ] {
        let mut membrane = Membrane::new(MODULI, &circle(rest, count), Vec2::ZERO).unwrap().with_measure(measure);
        assert!((membrane.at_rest()[0] - length).abs() < 1e-12 && (membrane.at_rest()[1] * rest - 1.0).abs() < 1e-12);
        assert!(membrane.energy().abs() < 1e-24);
        let places = circle(radius, count);
        membrane.move_to(&places, Vec2::ZERO).unwrap();
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-12 * (1.0 + expected.abs());
        assert!(close(membrane.energy(), energy), "{measure:?}: {} {energy}", membrane.energy());
        assert!(membrane.strains().all(|[s, b]| close(s, stretch) && close(b, strain)), "{measure:?}: {bent}");
        assert!(membrane.tensions().all(|found| close(found, tension)), "{measure:?}: {tension}");
        let mut forces = vec![Vec2::ZERO; places.len()];
        membrane.add_forces(&mut forces).unwrap();
        let radial: f64 = forces.iter().zip(&places).map(|(force, place)| force.dot(*place) / radius).sum();
        assert!(close(radial, force), "{measure:?}: {radial} {force}");
    }
}

/// By differences of the energy along each coordinate of some markers.
#[test]
fn forces_are_minus_the_gradient_of_the_energy() {
    for measure in [BendingMeasure::Curvature, BendingMeasure::TurningAngle] {
        let mut membrane = Membrane::new(MODULI, &circle(1.0, 24), Vec2::ZERO).unwrap().with_measure(measure);
        let places = bent(24);
        membrane.move_to(&places, Vec2::ZERO).unwrap();
        let mut forces = vec![Vec2::ZERO; places.len()];
        membrane.add_forces(&mut forces).unwrap();
        let size = forces.iter().map(|force| force.length()).fold(0.0, f64::max);
        let step = 1e-5;
        for (marker, axis) in (0..24).step_by(5).flat_map(|marker| [(marker, 0), (marker, 1)]) {
            let mut energy = |by: f64| {
                let mut moved = places.clone();
                moved[marker][axis] += by;
                membrane.move_to(&moved, Vec2::ZERO).unwrap();
                membrane.energy()
            };
            let expected = (energy(-step) - energy(step)) / (2.0 * step);
            assert!((forces[marker][axis] - expected).abs() < 1e-6 * size, "{measure:?}: {marker} {axis} {expected}");
        }
        assert!(forces.iter().sum::<Vec2>().length() < 1e-12 * size);
        let torque: f64 = places.iter().zip(&forces).map(|(place, force)| place.perp_dot(*force)).sum();
        assert!(torque.abs() < 1e-12 * size, "{torque}");
    }
}

/// Twice as long the membrane resists waves twice as much, and its tension is K; half as long the same, by its length.
#[test]
fn the_stiffness_counts_stretched_and_crowded_parts() {
    let [stretching, bending] = MODULI;
    for (radius, tension) in [(2.0, stretching), (0.5, 0.5 * stretching), (1.0, 0.0)] {
        let mut membrane = Membrane::new(MODULI, &circle(1.0, 16), Vec2::ZERO).unwrap();
        membrane.move_to(&circle(radius, 16), Vec2::ZERO).unwrap();
        let stretched = f64::max(radius, 1.0 / radius);
        let expected = stretched * (stretching + bending * 9.0) + tension;
        assert!((membrane.stiffness(3.0) / expected - 1.0).abs() < 1e-12, "{radius}: {expected}");
    }
}

/// A reference curvature of its own takes the place of that of the first shape.
#[test]
fn a_membrane_bends_towards_its_reference_curvature() {
    let mut membrane = Membrane::new([0.0, 2.0], &circle(1.0, 16), Vec2::ZERO).unwrap();
    membrane = membrane.with_reference_curvature(0.25).unwrap();
    membrane.move_to(&circle(1.0, 16), Vec2::ZERO).unwrap();
    assert!((membrane.energy() - 0.75 * 0.75 * TAU).abs() < 1e-12, "{}", membrane.energy());
    assert!((membrane.at_rest()[1] - 0.25).abs() < 1e-15 && membrane.moduli() == [0.0, 2.0]);
    let flat = Membrane::new([1.0, 0.0], &circle(1.0, 16), Vec2::ZERO).unwrap();
    assert!((flat.at_rest()[0] / (2.0 * PI) - 1.0).abs() < 1e-12);
}
