//! Spreading over triangles: transposed operations, fields that it keeps, its order.

use motile_base::Vec2;
use motile_scene::Body;

use crate::mesh::{TriangleMesh, equilateral_strip};
use crate::solid::tests::fluid_view;
use crate::{NeoHookean, Outline, Solid};

fn disc(spacing: f64) -> TriangleMesh {
    Outline::circle(Vec2::new(0.3, -0.2), 1.0).unwrap().mesh(spacing).unwrap()
}

fn spread(mesh: TriangleMesh) -> Solid {
    Solid::hyperelastic(mesh, NeoHookean::new(1.0, 2.0).unwrap()).spread_over_triangles()
}

fn markers(solid: &Solid) -> Vec<Vec2> {
    let mut markers = vec![Vec2::ZERO; solid.marker_count()];
    solid.write_markers(&mut markers);
    markers
}

fn rate(solid: &mut Solid, velocity: impl Fn(Vec2) -> Vec2) -> Vec<Vec2> {
    let velocities: Vec<Vec2> = markers(solid).into_iter().map(velocity).collect();
    let mut rate = vec![0.0; solid.state_len()];
    solid.rate(&velocities, &mut rate);
    rate.chunks_exact(2).map(|pair| Vec2::new(pair[0], pair[1])).collect()
}

fn wavy(at: Vec2) -> Vec2 {
    Vec2::new((3.0 * at.y + at.x).sin(), (2.0 * at.x).cos() - at.y * at.y)
}

/// Forces of the markers on the fluid.
fn forces(solid: &mut Solid) -> Vec<Vec2> {
    let mut forces = vec![Vec2::ZERO; solid.marker_count()];
    solid.write_forces(&fluid_view(), &mut forces).unwrap();
    forces
}

/// A periodic wall, deformed, its lowest row pinned; and a free disc.
fn solids() -> [Solid; 2] {
    let strip = equilateral_strip(Vec2::new(-2.0, -2.0), 20, 6, 0.2).unwrap();
    let deformed =
        |solid: Solid| solid.deformed(|s| s + 0.05 * Vec2::new((2.0 * s.y).sin(), (1.5 * s.x).cos())).unwrap();
    [deformed(spread(strip).pinned(|s| s.y < -1.99).unwrap()), deformed(spread(disc(0.2)))]
}

#[test]
fn forces_give_the_same_power_on_both_sides() {
    for mut solid in solids() {
        let velocities: Vec<Vec2> = markers(&solid).into_iter().map(wavy).collect();
        let fluid: f64 = forces(&mut solid).iter().zip(&velocities).map(|(force, velocity)| force.dot(*velocity)).sum();
        let rates = rate(&mut solid, wavy);
        let own: f64 = rates.iter().zip(&solid.free).map(|(v, &point)| v.dot(solid.forces[point])).sum();
        assert!((fluid - own).abs() < 1e-12 * own.abs(), "{fluid} {own}");
        // Energy falls by that power.
        let energy = |time: f64| {
            let mut moved = solid.clone();
            let mut places = moved.positions.clone();
            solid.free.iter().zip(&rates).for_each(|(&point, v)| places[point] += time * *v);
            moved.set_positions(&places).unwrap();
            moved.elastic_energy().unwrap()
        };
        // Central differences at two steps, extrapolated.
        let slope = |step: f64| (energy(step) - energy(-step)) / (2.0 * step);
        let fall = -(4.0 * slope(1e-5) - slope(2e-5)) / 3.0;
        assert!((fall - own).abs() < 1e-8 * own.abs(), "{fall} {own}");
    }
}

/// Adds the forces of the stresses that belong to velocities of the markers.
fn add_viscous_forces(solid: &mut Solid, velocities: &[Vec2], forces: &mut [Vec2]) {
    let viscous = solid.as_viscous().expect("a viscous solid");
    let [mut stresses, mut compliances] = [0; 2].map(|_| vec![0.0; viscous.stress_count()]);
    viscous.write_rates(velocities, &mut stresses);
    viscous.write_compliances(&mut compliances);
    stresses.iter_mut().zip(compliances).for_each(|(stress, compliance)| *stress /= compliance);
    viscous.add_stress_forces(&stresses, forces);
}

/// Of solids more viscous than the fluid: as much as the points dissipate, symmetric, nothing in a rotation.
#[test]
fn viscous_forces_are_spread_as_well() {
    for solid in solids() {
        let mut solid = solid.with_excess_viscosity(3.0).unwrap();
        let places = markers(&solid);
        let mut power = |one: &dyn Fn(Vec2) -> Vec2, other: &dyn Fn(Vec2) -> Vec2| {
            let velocities: Vec<Vec2> = places.iter().map(|at| one(*at)).collect();
            let mut forces = vec![Vec2::ZERO; places.len()];
            add_viscous_forces(&mut solid, &velocities, &mut forces);
            -forces.iter().zip(&places).map(|(force, at)| force.dot(other(*at))).sum::<f64>()
        };
        let shear = |at: Vec2| Vec2::new(at.y + 2.0, 0.0);
        let dissipated = power(&wavy, &wavy);
        assert!(dissipated > 1.0);
        assert!((power(&shear, &wavy) - power(&wavy, &shear)).abs() < 1e-9 * dissipated);
        let free = solid.free.len() == solid.positions.len();
        let mut solid = solid;
        let velocities: Vec<Vec2> = markers(&solid).into_iter().map(Vec2::perp).collect();
        let mut forces = vec![Vec2::ZERO; velocities.len()];
        add_viscous_forces(&mut solid, &velocities, &mut forces);
        let largest = forces.iter().map(|force| force.length()).fold(0.0, f64::max);
        assert_eq!(free, largest < 1e-9 * dissipated, "{largest} of {dissipated}");
    }
}

#[test]
fn forces_keep_their_sum_and_torque() {
    let [_, mut solid] = solids();
    let forces = forces(&mut solid);
    let largest = forces.iter().map(|force| force.length()).fold(0.0, f64::max);
    let torque: f64 = markers(&solid).iter().zip(&forces).map(|(at, force)| at.perp_dot(*force)).sum();
    assert!(largest > 1e-4, "{largest}");
    assert!(forces.iter().sum::<Vec2>().length() < 1e-11 * largest && torque.abs() < 1e-11 * largest);
}

#[test]
fn linear_flows_move_points_exactly() {
    let linear = |at: Vec2| Vec2::new(0.4 - 2.0 * at.y + 0.7 * at.x, 1.3 * at.x - 0.7 * at.y);
    let mut solid = spread(disc(0.2));
    let places = solid.positions.clone();
    for (velocity, place) in rate(&mut solid, linear).iter().zip(&places) {
        assert!(velocity.distance(linear(*place)) < 1e-11, "{place}: {velocity}");
    }
    // Pinned points are at rest, also for the points about them.
    let [mut wall, _] = solids();
    let places = wall.positions.clone();
    let shear = |at: Vec2| Vec2::new(at.y + 2.0, 0.0);
    let undeformed = wall.mesh.points().to_vec();
    wall.set_positions(&undeformed).unwrap();
    let rates = rate(&mut wall, shear);
    for (velocity, &point) in rates.iter().zip(&wall.free) {
        assert!(velocity.distance(shear(undeformed[point])) < 1e-11, "{}", places[point]);
    }
}

#[test]
fn smooth_flows_move_points_to_second_order() {
    let errors = [0.2, 0.1, 0.05].map(|spacing| {
        let mut solid = spread(disc(spacing));
        let places = solid.positions.clone();
        let squares =
            rate(&mut solid, wavy).iter().zip(&places).map(|(v, at)| (*v - wavy(*at)).length_squared()).sum::<f64>();
        (squares / places.len() as f64).sqrt()
    });
    println!("{errors:?}");
    assert!(errors[0] < 0.02 && errors.windows(2).all(|pair| pair[0] / pair[1] > 3.4), "{errors:?}");
}

#[test]
fn markers_are_surface_points_and_places_in_triangles() {
    let [wall, disc] = solids();
    let inner = disc.mesh.inner_points().iter().filter(|inner| **inner).count();
    let surface = disc.positions.len() - inner;
    assert!(disc.marker_count() > surface && (disc.marker_count() - surface) % 3 == 0);
    assert_eq!(disc.state_len(), 2 * disc.positions.len());
    // All triangles of the wall have an inner point; its upper surface is a layer still.
    assert_eq!(wall.marker_count(), 20 + 3 * wall.mesh.triangles().len());
    let fixed = |curve: &motile_scene::gap::SurfaceCurve| curve.markers().count() == 0;
    assert_eq!(wall.surfaces().iter().map(fixed).collect::<Vec<bool>>().iter().filter(|fixed| **fixed).count(), 1);
    let (at, upper) = (markers(&wall), wall.surfaces().into_iter().find(|curve| !fixed(curve)).unwrap());
    assert!(upper.markers().all(|(marker, _)| at[marker].y > -1.1));
    assert!(!wall.mirror(&[], &[], &mut []));
    // Without an inner point there are but the points of the boundary.
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].to_vec();
    let square = TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let mut square = spread(square).deformed(|s| s + 0.1 * Vec2::new(s.y * s.x, 0.0)).unwrap();
    assert_eq!(square.marker_count(), 4);
    let spread_forces = forces(&mut square);
    assert!(spread_forces == square.forces && spread_forces[0] != Vec2::ZERO);
}
