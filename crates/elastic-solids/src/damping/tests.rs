use super::*;
use crate::{Interior, Outline};

/// Velocities of a uniform gradient dissipate `2 eta E:E` over the deformed area, rotations nothing, and the forces of
/// one motion work against another as the other way round.
#[test]
fn forces_dissipate_the_power_of_the_stress_and_are_symmetric() {
    let mesh = Interior::new([Outline::circle(Vec2::new(0.2, -0.1), 1.0).unwrap()]).unwrap().mesh(0.25).unwrap();
    let positions: Vec<Vec2> = mesh.points().iter().map(|s| Vec2::new(1.2 * s.x + 0.3 * s.y, 0.9 * s.y)).collect();
    let mut damping = Damping::new(&mesh, 3.0);
    let mut power = |one: &dyn Fn(Vec2) -> Vec2, other: &dyn Fn(Vec2) -> Vec2| {
        let mut stresses = vec![0.0; damping.stresses.len()];
        let mut compliances = stresses.clone();
        damping.update(&positions);
        damping.write_rates(&positions, positions.iter().map(|x| one(*x)).enumerate(), &mut stresses);
        damping.write_compliances(&mut compliances);
        stresses.iter_mut().zip(compliances).for_each(|(stress, compliance)| *stress /= compliance);
        let forces = damping.forces(&positions, &stresses);
        -forces.iter().zip(&positions).map(|(force, x)| force.dot(other(*x))).sum::<f64>()
    };
    let area = mesh.area() * 1.2 * 0.9;
    let shear = |x: Vec2| Vec2::new(2.0 * x.y, 0.0);
    let stretch = |x: Vec2| Vec2::new(x.x, -x.y);
    let rough = |x: Vec2| Vec2::new((7.0 * x.y).sin(), (5.0 * x.x).cos());
    assert!((power(&shear, &shear) / (3.0 * 4.0 * area) - 1.0).abs() < 1e-12);
    assert!((power(&stretch, &stretch) / (3.0 * 4.0 * area) - 1.0).abs() < 1e-12);
    assert!(power(&|x| x.perp(), &|x| x.perp()).abs() < 1e-12 && power(&rough, &rough) > 1.0);
    assert!((power(&shear, &rough) - power(&rough, &shear)).abs() < 1e-12);
}
