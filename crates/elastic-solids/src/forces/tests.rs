//! Laws that all elastic forces must satisfy.

use proptest::prelude::*;

use crate::check::{force_balance, patch_residual};
use crate::forces::{Hyperelastic, Springs};
use crate::material::{Mat2, MooneyRivlin, SaintVenantKirchhoff};
use crate::mesh::TriangleMesh;
use crate::mesh::equilateral_strip;
use crate::{ElasticForces, Interior, NeoHookean, Outline, SolidError};
use motile_base::{InputError, Vec2};

fn blob() -> TriangleMesh {
    let circle = |radius: f64| Outline::circle(Vec2::new(0.2, -0.1), radius).unwrap();
    Interior::new([circle(1.0), circle(0.4)]).unwrap().mesh(0.25).unwrap()
}

fn wall() -> TriangleMesh {
    let flat = Outline::flat(-1.5, 3.0, -1.0).unwrap();
    let wave = Outline::profile(-1.5, 3.0, |x| 0.2 * (std::f64::consts::TAU * x / 3.0).sin()).unwrap();
    Interior::new([flat, wave]).unwrap().mesh(0.2).unwrap()
}

/// All laws, some with moduli that depend on the place.
fn laws(mesh: &TriangleMesh) -> Vec<Box<dyn ElasticForces>> {
    vec![
        Box::new(Springs::new(mesh, 1.3).unwrap()),
        Box::new(Springs::graded(mesh, |s| 1.0 + 0.5 * s.x).unwrap()),
        Box::new(Hyperelastic::new(mesh, NeoHookean::new(1.3, 2.6).unwrap())),
        Box::new(Hyperelastic::graded(mesh, |s| NeoHookean::new(1.0 + 0.5 * s.x, 3.0 + s.y)).unwrap()),
        Box::new(Hyperelastic::new(mesh, SaintVenantKirchhoff::new(1.3, 2.6).unwrap())),
        // Triangles that share their change of area.
        Box::new(Hyperelastic::new(mesh, NeoHookean::new(0.1, 1.3).unwrap())),
        Box::new(Hyperelastic::graded(mesh, |s| NeoHookean::new(0.1 + 0.05 * s.x, 3.0 + s.y)).unwrap()),
        Box::new(Hyperelastic::new(mesh, SaintVenantKirchhoff::new(0.1, 1.3).unwrap())),
        Box::new(Hyperelastic::new(mesh, MooneyRivlin::new(1.3, 2.6, 0.4).unwrap())),
    ]
}

fn forces(law: &dyn ElasticForces, positions: &[Vec2]) -> Vec<Vec2> {
    let mut forces = vec![Vec2::ZERO; positions.len()];
    law.add_forces(positions, &mut forces).unwrap();
    forces
}

/// A smooth large deformation with a roughness on the scale of the mesh.
fn deformed(mesh: &TriangleMesh, amplitude: f64, roughness: f64, seed: u64) -> Vec<Vec2> {
    let mut state = seed.wrapping_mul(2).wrapping_add(1);
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    // Periodic in x for walls of period 3.
    let k = std::f64::consts::TAU / 3.0;
    let smooth = |s: &Vec2| Vec2::new((k * s.x + s.y).sin(), (2.0 * k * s.x).cos() * s.y);
    mesh.points().iter().map(|s| s + amplitude * smooth(s) + roughness * Vec2::new(random(), random())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn forces_sum_to_zero_and_give_no_torque(amplitude in 0.0..0.15, seed in any::<u64>()) {
        for (mesh, torque_free) in [(blob(), true), (wall(), false)] {
            let positions = deformed(&mesh, amplitude, 0.03, seed);
            for law in laws(&mesh) {
                let balance = force_balance(law.as_ref(), &positions).unwrap();
                prop_assert!(balance.sum < 1e-12, "{balance:?}");
                // A periodic wall has no torque to speak of.
                prop_assert!(!torque_free || balance.torque < 1e-12, "{balance:?}");
            }
        }
    }

    #[test]
    fn forces_are_minus_the_gradient_of_the_energy(
        amplitude in 0.0..0.15, seed in any::<u64>(), pick in any::<usize>(),
    ) {
        for mesh in [blob(), wall()] {
            let positions = deformed(&mesh, amplitude, 0.03, seed);
            for law in laws(&mesh) {
                let forces = forces(law.as_ref(), &positions);
                let scale = forces.iter().map(|v| v.length()).fold(0.0, f64::max);
                let (point, axis) = (pick % positions.len(), pick % 2);
                let energy_at = |shift: f64| {
                    let mut moved = positions.clone();
                    moved[point][axis] += shift;
                    law.energy(&moved).unwrap()
                };
                // Of fourth order in the step.
                let slope = |step: f64| (energy_at(-step) - energy_at(step)) / (2.0 * step);
                let difference = (4.0 * slope(1e-4) - slope(2e-4)) / 3.0;
                prop_assert!((forces[point][axis] - difference).abs() < 1e-9 * (1.0 + scale));
            }
        }
    }

    #[test]
    fn motion_as_a_whole_gives_no_force(x in -9.0..9.0, y in -9.0..9.0, angle in -3.2..3.2) {
        let mesh = blob();
        let rotation = Vec2::from_angle(angle);
        let moved: Vec<Vec2> = mesh.points().iter().map(|s| rotation.rotate(*s) + Vec2::new(x, y)).collect();
        for law in laws(&mesh) {
            prop_assert!(forces(law.as_ref(), &moved).iter().all(|force| force.length() < 1e-13 * 100.0));
            prop_assert!(law.energy(&moved).unwrap().abs() < 1e-14);
        }
    }
}

/// The patch test. Springs pass it on the equilateral lattice only: on another mesh neighbouring triangles differ as
/// materials.
#[test]
fn a_uniform_deformation_gives_no_force_inside() {
    let deformation = Mat2::from_rows_array(&[1.1, 0.2, -0.1, 0.9]);
    let residual = |mesh: &TriangleMesh, law: &dyn ElasticForces| patch_residual(mesh, law, deformation).unwrap();
    let (unstructured, lattice) = (blob(), crate::mesh::equilateral_block(Vec2::ZERO, 6, 5, 0.2).unwrap());
    // The first two laws are springs, the fourth and the seventh are not uniform.
    for law in laws(&unstructured).iter().enumerate().filter(|(number, _)| ![0, 1, 3, 6].contains(number)).map(|l| l.1)
    {
        assert!(residual(&unstructured, law.as_ref()) < 1e-13, "{law:?}");
    }
    for law in [&laws(&lattice)[0], &laws(&lattice)[2]] {
        assert!(residual(&lattice, law.as_ref()) < 1e-13);
    }
    // The residual is one that is seen where there is a force.
    assert!(residual(&unstructured, laws(&unstructured)[0].as_ref()) > 1e-3);
    assert!(residual(&unstructured, laws(&unstructured)[3].as_ref()) > 1e-3);
}

#[test]
fn springs_of_the_equilateral_lattice() {
    let mesh = equilateral_strip(Vec2::ZERO, 8, 6, 0.1).unwrap();
    let (shear, eps) = (2.0, 1e-6);
    let law = Springs::new(&mesh, shear).unwrap();
    // K = 4 mu/sqrt(3): moving one inner point by eps towards a neighbour pulls it back by 3 K eps.
    let mut positions = mesh.points().to_vec();
    let point = 3 * 8 + 4;
    positions[point].x += eps;
    let force = forces(&law, &positions)[point];
    let expected = -3.0 * 4.0 * shear / 3.0_f64.sqrt() * eps;
    assert!((force - Vec2::new(expected, 0.0)).length() < 1e-5 * expected.abs());
}

#[test]
fn the_stress_of_springs_is_the_derivative_of_their_energy() {
    let mesh = blob();
    let law = Springs::graded(&mesh, |s| 1.0 + 0.3 * s.x).unwrap();
    let gradient = Mat2::from_rows_array(&[1.1, 0.2, -0.15, 0.85]);
    let energy = |a: &Mat2| law.energy(&mesh.points().iter().map(|s| *a * *s).collect::<Vec<_>>()).unwrap();
    let stresses = (0..mesh.triangles().len()).map(|t| law.stress(t, &gradient).unwrap() * mesh.areas()[t]);
    let total = stresses.fold(Mat2::ZERO, |sum, stress| sum + stress);
    let total = total.to_cols_array();
    for entry in 0..4 {
        let at = |shift: f64| {
            let mut moved = gradient.to_cols_array();
            moved[entry] += shift;
            energy(&Mat2::from_cols_array(&moved))
        };
        let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
        assert!((total[entry] - difference).abs() < 1e-8);
    }
}

#[test]
fn an_inverted_triangle_is_named() {
    let mesh = blob();
    let law = Hyperelastic::new(&mesh, NeoHookean::new(1.0, 2.0).unwrap());
    let triangle = 17;
    let mut positions = mesh.points().to_vec();
    // One corner beyond the opposite side.
    let [a, b, c] = mesh.triangles()[triangle];
    positions[a] = positions[b] + positions[c] - positions[a];
    let mut forces = vec![Vec2::ZERO; positions.len()];
    // The first triangle at that point in the list is found first; all at fault touch the point.
    for result in [law.add_forces(&positions, &mut forces), law.energy(&positions).map(|_| ())] {
        match result {
            Err(SolidError::Inverted { triangle, jacobian, .. }) => {
                assert!(mesh.triangles()[triangle].contains(&a) && jacobian <= 0.0);
            }
            other => panic!("{other:?}"),
        }
    }
    positions[a].x = f64::NAN;
    assert!(matches!(law.add_forces(&positions, &mut forces), Err(SolidError::Inverted { .. })));
    // Across the seam of a wall, where it is: in the middle of its corners.
    let wall = wall();
    for triangle in 0..wall.triangles().len() {
        let [a, b, c] = wall.raw_corners(triangle, wall.points());
        let mut positions = wall.points().to_vec();
        positions[wall.triangles()[triangle][0]] = b + c - a;
        let law = Hyperelastic::new(&wall, NeoHookean::new(1.0, 2.0).unwrap());
        let Err(SolidError::Inverted { triangle, place, .. }) = law.energy(&positions) else { panic!("not inverted") };
        let middle = wall.raw_corners(triangle, &positions).iter().sum::<Vec2>() / 3.0;
        assert!((place - middle).length() < 1e-12, "{triangle}: {place} {middle}");
    }
    assert!(matches!(
        law.add_forces(&positions[1..], &mut forces),
        Err(SolidError::Input(InputError::WrongLength { .. }))
    ));
    let springs = Springs::new(&mesh, 1.0).unwrap();
    assert!(matches!(springs.energy(&positions[1..]), Err(SolidError::Input(InputError::WrongLength { .. }))));
    assert!(matches!(Springs::new(&mesh, -1.0), Err(SolidError::Input(InputError::NotPositive { .. }))));
    assert!(matches!(Springs::graded(&mesh, |s| s.x), Err(SolidError::Input(InputError::NotPositive { .. }))));
}

/// Springs of equilateral triangles whose sides on the boundary are divided are still the same material: a uniform
/// strain leaves inner points without forces and has the energy of the undivided lattice.
#[test]
fn springs_of_a_finer_boundary_are_the_same_material() {
    let lattice = equilateral_strip(Vec2::ZERO, 20, 6, 0.1).unwrap();
    let finer = lattice.with_finer_boundary(|s| s.y > 0.1).unwrap();
    let strained = |mesh: &TriangleMesh| -> Vec<Vec2> {
        mesh.points().iter().map(|s| Vec2::new(s.x + 0.1 * s.y, 1.05 * s.y)).collect()
    };
    let energy = |mesh: &TriangleMesh| Springs::new(mesh, 1.3).unwrap().energy(&strained(mesh)).unwrap();
    assert!((energy(&finer) / energy(&lattice) - 1.0).abs() < 1e-12);
    let law = Springs::new(&finer, 1.3).unwrap();
    let found = forces(&law, &strained(&finer));
    let inner = finer.inner_points();
    let largest = found.iter().zip(&inner).filter(|(_, inner)| **inner).map(|(f, _)| f.length()).fold(0.0, f64::max);
    assert!(largest < 1e-13 && finer.points().len() == lattice.points().len() + 20, "{largest:e}");
    // A periodic mesh has no torque.
    assert!(force_balance(&law, &strained(&finer)).unwrap().sum < 1e-12);
}
