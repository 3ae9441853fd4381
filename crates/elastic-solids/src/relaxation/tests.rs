use super::*;
use crate::{ElasticForces, Interior, NeoHookean, Outline, Solid, mesh::equilateral_block};

fn element() -> Maxwell {
    Maxwell::new(3.0, 0.7).unwrap()
}

/// Solids of triangles, of springs, and of springs with uneven triangles at the boundary.
fn solids() -> Vec<Solid> {
    let disc = Interior::new([Outline::circle(Vec2::new(0.2, -0.1), 1.0).unwrap()]).unwrap().mesh(0.25).unwrap();
    let block = equilateral_block(Vec2::ZERO, 6, 5, 0.2).unwrap();
    let finer = block.with_finer_boundary(|_| true).unwrap();
    vec![
        Solid::hyperelastic(disc.clone(), NeoHookean::new(1.0, 2.0).unwrap()),
        Solid::springs(block, 1.0).unwrap(),
        Solid::springs(finer, 1.0).unwrap(),
        Solid::fluid_like(disc),
    ]
}

/// A smooth deformation that grows with time.
fn deformed(solid: &Solid, t: f64) -> Vec<Vec2> {
    let shift = |s: &Vec2| Vec2::new((2.0 * s.x + s.y).sin() + s.y, (3.0 * s.x).cos() * s.y);
    solid.mesh().points().iter().map(|s| *s + 0.1 * t * shift(s)).collect()
}

fn relaxation(solid: &Solid) -> Relaxation {
    solid.clone().with_maxwell(element()).unwrap().relaxation.unwrap()
}

/// Steps from the reference state along a deformation, by the exact update.
fn advance(solid: &Solid, relaxation: &mut Relaxation, steps: usize) {
    for step in 0..steps {
        let at = |step: usize| deformed(solid, step as f64 / steps as f64);
        relaxation.begin_step(&at(step), 1.0 / steps as f64);
        relaxation.end_step(&at(step + 1), 1.0 / steps as f64);
    }
}

#[test]
fn forces_are_minus_the_gradient_of_the_energy_and_balance() {
    for solid in solids() {
        let mut relaxing = relaxation(&solid);
        advance(&solid, &mut relaxing, 10);
        let positions = deformed(&solid, 1.0);
        let mut forces = vec![Vec2::ZERO; positions.len()];
        relaxing.add_forces(&positions, &mut forces).unwrap();
        let scale = forces.iter().map(|force| force.length()).fold(0.0, f64::max);
        assert!(scale > 1e-3);
        for point in 0..positions.len() {
            for axis in 0..2 {
                let energy = |shift: f64| {
                    let mut moved = positions.clone();
                    moved[point][axis] += shift;
                    relaxing.energies(&moved).unwrap()[0]
                };
                // Richardson's extrapolation of central differences.
                let slope = |step: f64| (energy(step) - energy(-step)) / (2.0 * step);
                let exact = -(4.0 * slope(1e-4) - slope(2e-4)) / 3.0;
                assert!((forces[point][axis] - exact).abs() < 1e-9 * (1.0 + scale));
            }
        }
        let sum: Vec2 = forces.iter().copied().sum();
        let torque: f64 = forces.iter().zip(&positions).map(|(force, place)| place.perp_dot(*force)).sum();
        assert!(sum.length() < 1e-12 * scale && torque.abs() < 1e-12 * scale, "{sum} {torque}");
    }
}

/// Work of the forces along the deformation = energy stored + energy dissipated, to second order in the step.
#[test]
fn work_is_stored_or_dissipated() {
    for solid in solids() {
        let balance = |steps: usize| {
            let mut relaxing = relaxation(&solid);
            let (mut work, mut lost) = (0.0, 0.0);
            let state = |relaxing: &Relaxation, positions: &[Vec2]| {
                let mut forces = vec![Vec2::ZERO; positions.len()];
                relaxing.add_forces(positions, &mut forces).unwrap();
                (forces, relaxing.energies(positions).unwrap())
            };
            let dt = 1.0 / steps as f64;
            for step in 0..steps {
                let [before, after] = [step, step + 1].map(|step| deformed(&solid, step as f64 * dt));
                let (forces, [_, dissipation]) = state(&relaxing, &before);
                relaxing.begin_step(&before, dt);
                relaxing.end_step(&after, dt);
                let (forces_after, [_, dissipation_after]) = state(&relaxing, &after);
                lost += 0.5 * dt * (dissipation + dissipation_after);
                let moved = before.iter().zip(&after).map(|(a, b)| *b - *a);
                work -=
                    forces.iter().zip(forces_after).zip(moved).map(|((f, g), x)| 0.5 * (*f + g).dot(x)).sum::<f64>();
            }
            let stored = relaxing.energies(&deformed(&solid, 1.0)).unwrap()[0];
            assert!(lost > 0.0 && stored > 0.0);
            ((work - stored - lost) / work).abs()
        };
        let [coarse, fine] = [balance(80), balance(160)];
        assert!(fine < 1e-4 && (1.8..2.3).contains(&(coarse / fine).log2()), "{coarse:e} {fine:e}");
    }
}

/// At rest it stays, at a fixed strain the stress decays as `exp(-t/tau)` by steps of any length, and turning the whole
/// changes no energy.
#[test]
fn stress_decays_at_a_fixed_strain() {
    for solid in solids() {
        let mut relaxing = relaxation(&solid);
        relaxing.begin_step(solid.mesh().points(), 0.3);
        relaxing.end_step(solid.mesh().points(), 0.3);
        let rest = relaxation(&solid).values;
        assert!(relaxing.values.iter().zip(&rest).all(|(a, b)| (a - b).abs() < 1e-15));
        // Small, so that forces are proportional to what relaxes.
        let strained: Vec<Vec2> = solid.mesh().points().iter().map(|s| *s + 1e-6 * Vec2::new(s.y, 0.3 * s.y)).collect();
        let forces = |relaxing: &Relaxation| {
            let mut forces = vec![Vec2::ZERO; strained.len()];
            relaxing.add_forces(&strained, &mut forces).unwrap();
            forces
        };
        let first = forces(&relaxing);
        for dt in [0.1, 1.0, 0.01] {
            relaxing.begin_step(&strained, dt);
            relaxing.end_step(&strained, dt);
        }
        let decay = (-1.11_f64 / 0.7).exp();
        let scale = first.iter().map(|force| force.length()).fold(0.0, f64::max);
        for (first, now) in first.iter().zip(forces(&relaxing)) {
            assert!((now - *first * decay).length() < 1e-5 * scale);
        }
        let turned: Vec<Vec2> = strained.iter().map(|place| Vec2::from_angle(1.0).rotate(*place)).collect();
        let [[energy, _], [other, _]] = [&strained, &turned].map(|at| relaxing.energies(at).unwrap());
        assert!((energy - other).abs() < 1e-9 * energy + 1e-14, "{energy:e} {other:e}");
    }
}

#[test]
fn moduli_are_those_of_the_element() {
    let gradient = 1e-4;
    for solid in solids() {
        let sheared: Vec<Vec2> = solid.mesh().points().iter().map(|s| *s + Vec2::new(gradient * s.y, 0.0)).collect();
        let energy = relaxation(&solid).energies(&sheared).unwrap()[0] / solid.mesh().area();
        let expected = 0.5 * 3.0 * gradient * gradient;
        assert!((energy / expected - 1.0).abs() < 9e-9, "{energy:e} {expected:e}");
    }
    assert_eq!(NoElasticity { points: 3, triangles: 1 }.stiffest().shear(), 0.0);
}

#[test]
fn numbers_out_of_range_are_refused() {
    for (modulus, time) in [(0.0, 1.0), (1.0, 0.0), (-1.0, 1.0), (1.0, f64::INFINITY), (f64::NAN, 1.0)] {
        assert!(Maxwell::new(modulus, time).is_err());
    }
}
