use std::f64::consts::{FRAC_PI_2, TAU};

use active_interface::internal::SplitMix64;
use motile_base::Vec2;
use motile_scene::StepCause;

use super::Director;
use crate::gel::{Anchoring, GelMaterial, elements::Elements};
use crate::{DiscMesh, InteriorError};

const PASSIVE: GelMaterial = GelMaterial {
    frank: 2.0,
    bend: None,
    spontaneous_splay: 0.0,
    rotational_viscosity: 3.0,
    alignment: -0.7,
    activity: 0.0,
};

/// A bent disc with a director that turns a lot.
fn bent(material: GelMaterial, anchoring: Anchoring) -> (Director, Vec<Vec2>) {
    let mut mesh = DiscMesh::new(24, 0.3).unwrap();
    let curve = |k: usize| {
        let angle = TAU * k as f64 / 24.0;
        Vec2::new(1.3 * angle.cos() + 0.1 * (2.0 * angle).cos(), angle.sin())
    };
    let mut nodes: Vec<Vec2> = (0..mesh.node_count()).map(curve).collect();
    mesh.place(&mut nodes);
    let angles = nodes.iter().map(|node| 2.0 * node.x + (3.0 * node.y).sin()).collect();
    let elements = Elements::new(mesh.triangles().to_vec(), nodes.len(), [None; 2]);
    let anchored = anchoring.angle_from_tangent().map(|angle| (angle, 24));
    let mut director = Director::new(material, elements, angles, anchored, anchored.map_or(0, |(_, count)| count));
    director.move_to(&nodes);
    (director, nodes)
}

fn random(count: usize) -> Vec<Vec2> {
    let mut random = SplitMix64::new(7);
    (0..count).map(|_| Vec2::new(random.uniform() - 0.5, random.uniform() - 0.5)).collect()
}

/// The rate of change of the energy with nodes that move with the fluid, by differences.
fn energy_rate(director: &Director, nodes: &[Vec2], fluid: &[Vec2], rate: &[f64]) -> f64 {
    let energy = |time: f64| {
        let mut director = director.clone();
        let moved: Vec<Vec2> = nodes.iter().zip(fluid).map(|(node, velocity)| *node + time * *velocity).collect();
        let angles: Vec<f64> = director.free_angles().iter().zip(rate).map(|(a, rate)| a + time * rate).collect();
        director.read(&angles).unwrap();
        director.move_to(&moved);
        director.energy()
    };
    (energy(1e-5) - energy(-1e-5)) / 2e-5
}

#[test]
fn without_activity_the_flow_takes_what_the_energy_gives_but_for_dissipation() {
    let two = GelMaterial { bend: Some(5.0), spontaneous_splay: -1.5, ..PASSIVE };
    let anchorings = [Anchoring::Free, Anchoring::Homeotropic, Anchoring::Planar];
    for (anchoring, material) in anchorings.into_iter().flat_map(|anchoring| [(anchoring, PASSIVE), (anchoring, two)]) {
        let (mut director, nodes) = bent(material, anchoring);
        let mut forces = vec![Vec2::ZERO; nodes.len()];
        director.write_forces(&nodes, &mut forces).unwrap();
        let fluid = random(nodes.len());
        let mut rate = vec![0.0; director.free_angles().len()];
        director.write_rate(&fluid, &fluid, &mut rate);
        let power: f64 = forces.iter().zip(&fluid).map(|(force, velocity)| force.dot(*velocity)).sum();
        let anchored = director.anchored();
        let masses = &director.elements.masses[anchored..];
        let couples = director.couples[anchored..].iter().zip(masses);
        let dissipation: f64 = couples.map(|(couple, mass)| couple * couple / mass).sum::<f64>() / 3.0;
        let sum = power + energy_rate(&director, &nodes, &fluid, &rate);
        assert!(dissipation > 1.0);
        assert!((sum + dissipation).abs() < 1e-7 * dissipation, "{anchoring:?}: {sum} {dissipation}");
    }
}

#[test]
fn forces_have_neither_resultant_nor_torque() {
    for anchoring in [Anchoring::Free, Anchoring::Homeotropic, Anchoring::Planar] {
        let material = GelMaterial { activity: -5.0, bend: Some(5.0), spontaneous_splay: -1.5, ..PASSIVE };
        let (mut director, nodes) = bent(material, anchoring);
        let mut forces = vec![Vec2::ZERO; nodes.len()];
        director.write_forces(&nodes, &mut forces).unwrap();
        let size: f64 = forces.iter().map(|force| force.length()).sum();
        let torque: f64 = nodes.iter().zip(&forces).map(|(node, force)| node.perp_dot(*force)).sum();
        assert!(forces.iter().sum::<Vec2>().length() < 1e-14 * size, "{anchoring:?}");
        assert!(torque.abs() < 1e-14 * size, "{anchoring:?}: {torque} of {size}");
    }
}

/// The moment of the forces on the fluid is the stress `zeta_b (p p - 1/2)` times the area: a contractile gel draws the
/// fluid in along its director.
#[test]
fn a_contractile_gel_draws_the_fluid_in_along_its_director() {
    let material = GelMaterial { frank: 0.0, activity: -5.0, ..PASSIVE };
    let (mut director, nodes) = bent(material, Anchoring::Free);
    let angle: f64 = 0.4;
    director.read(&vec![angle; nodes.len()]).unwrap();
    let mut forces = vec![Vec2::ZERO; nodes.len()];
    director.write_forces(&nodes, &mut forces).unwrap();
    let area: f64 = director.elements.masses.iter().sum();
    let moment = |of: fn(&Vec2, &Vec2) -> f64| nodes.iter().zip(&forces).map(|(x, f)| of(x, f)).sum::<f64>() / area;
    let found =
        [moment(|x, f| x.x * f.x), moment(|x, f| x.y * f.x), moment(|x, f| x.x * f.y), moment(|x, f| x.y * f.y)];
    let [along, off] = [0.5 * (2.0 * angle).cos(), 0.5 * (2.0 * angle).sin()].map(|part| -5.0 * part);
    for (found, expected) in found.into_iter().zip([along, off, off, -along]) {
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
}

#[test]
fn a_gel_turns_and_moves_with_a_rigid_flow() {
    let (mut director, nodes) = bent(GelMaterial { frank: 0.0, ..PASSIVE }, Anchoring::Free);
    let mut forces = vec![Vec2::ZERO; nodes.len()];
    director.write_forces(&nodes, &mut forces).unwrap();
    let fluid: Vec<Vec2> = nodes.iter().map(|node| Vec2::new(3.0, 1.0) + 0.5 * node.perp()).collect();
    let mut rate = vec![0.0; nodes.len()];
    director.write_rate(&fluid, &fluid, &mut rate);
    assert!(rate.iter().all(|rate| (rate - 0.5).abs() < 1e-12));
}

#[test]
fn rods_lie_down_in_a_shear_flow() {
    // nu1 cos 2a = -1 is where a director in the flow (y, 0) rests
    let resting = 0.5 * (1.0_f64 / 1.3).acos();
    let elements = Elements::new(vec![[0, 1, 2]], 3, [None; 2]);
    let material = GelMaterial { frank: 0.0, alignment: -1.3, ..PASSIVE };
    let mut director = Director::new(material, elements, vec![resting, resting + 0.1, resting - 0.1], None, 0);
    let nodes = [Vec2::ZERO, Vec2::X, Vec2::Y];
    director.move_to(&nodes);
    director.write_forces(&nodes, &mut [Vec2::ZERO; 3]).unwrap();
    let fluid = nodes.map(|node| Vec2::new(node.y, 0.0));
    let mut rate = [0.0; 3];
    director.write_rate(&fluid, &fluid, &mut rate);
    assert!(rate[0].abs() < 1e-14 && rate[1] < -0.05 && rate[2] > 0.05, "{rate:?}");
}

#[test]
fn defects_are_found_where_they_are() {
    let mut mesh = DiscMesh::new(64, 0.1).unwrap();
    let mut nodes: Vec<Vec2> = (0..mesh.node_count()).map(|k| Vec2::from_angle(TAU * k as f64 / 64.0)).collect();
    mesh.place(&mut nodes);
    let places = [Vec2::new(0.413, 0.121), Vec2::new(-0.307, -0.222)];
    let of = |charges: [f64; 2]| {
        let turn = |node: &Vec2| (0..2).map(|k| charges[k] * (*node - places[k]).to_angle()).sum::<f64>() + FRAC_PI_2;
        let elements = Elements::new(mesh.triangles().to_vec(), nodes.len(), [None; 2]);
        let mut director = Director::new(PASSIVE, elements, nodes.iter().map(turn).collect(), None, 0);
        director.move_to(&nodes);
        director.defects(&nodes)
    };
    for charges in [[1.0, -1.0], [1.0, 1.0], [-1.0, 0.0]] {
        let found = of(charges);
        assert_eq!(found.len(), charges.iter().filter(|charge| **charge != 0.0).count());
        for (place, charge) in places.into_iter().zip(charges).filter(|(_, charge)| *charge != 0.0) {
            let near = |defect: &&crate::Defect| place.distance(defect.position.into()) < 0.06;
            assert_eq!(found.iter().find(near).map(|defect| f64::from(defect.charge)), Some(charge));
        }
    }
}

#[test]
fn a_folded_mesh_is_an_error() {
    let elements = Elements::new(vec![[0, 1, 2]], 3, [None; 2]);
    let mut director = Director::new(PASSIVE, elements, vec![0.0; 3], None, 0);
    let nodes = [Vec2::ZERO, Vec2::Y, Vec2::X];
    director.move_to(&nodes);
    let error = director.write_forces(&nodes, &mut [Vec2::ZERO; 3]).unwrap_err();
    assert!(matches!(error, InteriorError::Folded { .. }));
}

/// Without elasticity the director turns at most at the rate of the flow that the activity drives, `|a| (1 + |nu|)/(2
/// eta)`.
#[test]
fn activity_bounds_the_step() {
    let material = GelMaterial { frank: 1e-12, activity: -4.0, ..PASSIVE };
    let (director, _) = bent(material, Anchoring::Planar);
    let exact = 2.0 / (4.0 * 1.7 / (2.0 * 1.5));
    director.step_limits(1.5, &mut |limit| {
        let StepCause::Stabilised { bare } = limit.cause else { panic!("{limit:?}") };
        assert!((limit.dt / exact - 1.0).abs() < 1e-6 && (bare / exact - 1.0).abs() < 1e-6, "{limit:?} {exact}");
    });
}

/// An aster only splays and a vortex only bends, each with the energy `pi K ln(R/r)` between two radii. Spontaneous
/// splay is k times the length of the boundary that the director points out of.
#[test]
fn splay_and_bend_have_their_own_constants() {
    let energy = |[count, rows]: [usize; 2], bend: f64, spontaneous_splay: f64, turn: f64| {
        let ring = |row: usize| {
            let radius = 1.0 + row as f64 / rows as f64;
            (0..count).map(move |k| radius * Vec2::from_angle(TAU * k as f64 / count as f64))
        };
        let nodes: Vec<Vec2> = (0..=rows).flat_map(ring).collect();
        let number = |row: usize, k: usize| row * count + k % count;
        let cells = (0..rows).flat_map(|row| (0..count).map(move |k| (row, k)));
        let triangles = cells.flat_map(|(row, k)| {
            let [a, b, c, d] = [number(row, k), number(row + 1, k), number(row + 1, k + 1), number(row, k + 1)];
            [[a, b, c], [a, c, d]]
        });
        let material = GelMaterial { frank: 2.0, bend: Some(bend), spontaneous_splay, ..PASSIVE };
        let elements = Elements::new(triangles.collect(), nodes.len(), [None; 2]);
        let angles = nodes.iter().map(|node| node.to_angle() + turn).collect();
        let mut director = Director::new(material, elements, angles, None, 0);
        director.move_to(&nodes);
        director.energy()
    };
    let exact = std::f64::consts::PI * 2.0_f64.ln();
    for (bend, splay, turn, expected) in [
        (7.0, 0.0, 0.0, 2.0 * exact),
        (7.0, 0.0, FRAC_PI_2, 7.0 * exact),
        // Out of the outer circle and into the inner one: 2 pi (2 - 1).
        (2.0, -1.5, 0.0, 2.0 * exact - 1.5 * TAU),
        (2.0, -1.5, FRAC_PI_2, 2.0 * exact),
    ] {
        let errors = [[100, 20], [200, 40]].map(|size| (energy(size, bend, splay, turn) - expected).abs());
        // Of second order.
        let order = (errors[0] / errors[1]).log2();
        assert!(errors[1] < 2e-3 * expected.abs() && order > 1.9, "{bend} {splay} {turn}: {errors:?} {expected}");
    }
}
