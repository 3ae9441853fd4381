use super::*;

/// On the unit circle the forces of a tension gamma are `(2 pi/n)(gamma' tau - gamma n)`, wherever it is given.
#[test]
fn tensions_of_points_and_of_segments_have_the_same_forces() {
    let count = 24;
    let angle = |k: usize, shift: f64| TAU * (k as f64 + shift) / count as f64;
    let positions: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(angle(k, 0.0))).collect();
    let mut calculus = PeriodicCalculus::new(count).unwrap();
    for (placement, shift) in [(TensionPlacement::Points, 0.0), (TensionPlacement::Segments, 0.5)] {
        let tension: Vec<f64> = (0..count).map(|k| 2.0 + (angle(k, shift) - 0.4).sin()).collect();
        let mut forces = vec![Vec2::ZERO; count];
        calculus.tension_forces(&positions, &tension, placement, &mut forces).unwrap();
        for (k, (force, normal)) in forces.iter().zip(&positions).enumerate() {
            let at = angle(k, 0.0) - 0.4;
            let exact = (TAU / count as f64) * (at.cos() * normal.perp() - (2.0 + at.sin()) * *normal);
            assert!(force.distance(exact) < 1e-12, "{placement:?}, {k}: {force} {exact}");
        }
    }
}
