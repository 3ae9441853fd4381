use std::f64::consts::TAU;

use super::*;
use crate::{MarkerKind, hydrodynamics::SurfaceCurve};

const PLANE: Domain = Domain { origin: [0.0; 2], periods: [None; 2], walls: None };

fn circle(markers: &mut Markers, centre: Vec2, radius: f64) {
    let (start, count) = (markers.len(), 48);
    markers.push_group(count, MarkerKind::Interface { viscosity_inside: None });
    for k in 0..count {
        let angle = TAU * k as f64 / count as f64;
        markers.positions[start + k] =
            centre + radius * Vec2::new(angle.cos(), (1.0 + 0.1 * angle.sin()) * angle.sin());
    }
}

/// A wall of period 4 below y = 0, wavy above: nine points of which one does not move with the surface.
fn wall(markers: &mut Markers) {
    let start = markers.len();
    // The solid to its left: along -x.
    let curve = SurfaceCurve { markers: (0..8).map(|k| (8 - k, 0)).collect(), periods: -1 };
    markers.push_solid(9, MarkerKind::Points, vec![curve]);
    for k in 0..9 {
        markers.positions[start + k] = Vec2::new(0.5 * k as f64 - 2.0, -1.1 + 0.04 * (k as f64).sin());
    }
}

struct Scene {
    markers: Markers,
    domain: Domain,
    walls: Option<Boundary>,
    around: Vec<Option<usize>>,
}

impl Scene {
    fn new(domain: Domain) -> Self {
        Self { markers: Markers::new(), domain, walls: None, around: vec![None; 4] }
    }

    fn films(&self, reach: f64) -> Films {
        let mut films = Films::default();
        let surroundings = Surroundings { domain: self.domain, walls: self.walls.as_ref(), around: &self.around };
        films.find(&self.markers, surroundings, reach);
        films
    }

    fn forces(&mut self, repulsion: &Repulsion) -> Vec<Vec2> {
        self.markers.forces.fill(Vec2::ZERO);
        self.films(repulsion.range()).push_apart(repulsion, &mut self.markers);
        self.markers.forces.clone()
    }

    fn energy(&self, repulsion: &Repulsion) -> f64 {
        self.films(repulsion.range()).energy(repulsion)
    }
}

fn scenes() -> [(&'static str, Scene, bool); 6] {
    let channel = Domain { origin: [-2.0, -1.05], periods: [Some(4.0), None], walls: Some([-1.05, 1.2]) };
    let mut pair = Scene::new(PLANE);
    circle(&mut pair.markers, Vec2::ZERO, 1.0);
    circle(&mut pair.markers, Vec2::new(1.6, 0.35), 0.6);
    let mut nested = Scene::new(PLANE);
    circle(&mut nested.markers, Vec2::ZERO, 1.0);
    circle(&mut nested.markers, Vec2::new(0.3, 0.1), 0.6);
    nested.around[1] = Some(0);
    let mut images = Scene::new(Domain { periods: [Some(2.1), Some(2.15)], ..PLANE });
    circle(&mut images.markers, Vec2::ZERO, 1.0);
    let mut solid = Scene::new(Domain { periods: [Some(4.0), None], ..PLANE });
    circle(&mut solid.markers, Vec2::new(1.7, 0.0), 1.0);
    wall(&mut solid.markers);
    let mut straight = Scene::new(channel);
    circle(&mut straight.markers, Vec2::new(0.2, 0.0), 1.0);
    let mut post = Scene::new(PLANE);
    circle(&mut post.markers, Vec2::ZERO, 1.0);
    let mut square = Boundary::default();
    square.push_loop(&[(1.05, -0.5), (2.0, -0.4), (2.0, 1.0), (0.9, 0.6)].map(|(x, y)| Vec2::new(x, y)));
    square.sort();
    post.walls = Some(square);
    [
        ("pair", pair, true),
        ("nested", nested, true),
        ("images", images, true),
        ("solid", solid, true),
        ("straight walls", straight, false),
        ("post", post, false),
    ]
}

#[test]
fn forces_are_minus_the_gradient_of_the_energy() {
    let repulsion = Repulsion::new(30.0, 0.25).unwrap();
    for (name, mut scene, free) in scenes() {
        let (forces, step) = (scene.forces(&repulsion), 1e-6);
        let largest = forces.iter().map(|force| force.length()).fold(0.0, f64::max);
        assert!(largest > 0.01, "{name}");
        for (k, force) in forces.iter().enumerate() {
            for (axis, unit) in [Vec2::X, Vec2::Y].into_iter().enumerate() {
                let mut energy = |by: f64| {
                    scene.markers.positions[k] += by * unit;
                    let energy = scene.energy(&repulsion);
                    scene.markers.positions[k] -= by * unit;
                    energy
                };
                let expected = (energy(-step) - energy(step)) / (2.0 * step);
                assert!((force[axis] - expected).abs() < 1e-6 * largest, "{name} {k}: {force} {expected}");
            }
        }
        // Action and reaction.
        let (sum, positions) = (forces.iter().sum::<Vec2>(), scene.markers.positions());
        let torque: f64 = positions.iter().zip(&forces).map(|(x, f)| x.perp_dot(*f)).sum();
        assert_eq!(sum.length() < 1e-12 * largest, free, "{name}: {sum}");
        // Across a period a force has another lever on either side.
        assert!(!free || scene.domain.periods[0].is_some() || torque.abs() < 1e-12 * largest, "{name}: {torque}");
    }
}

/// Two flat sides at the distance d: away from their ends the pressure on each is that of the law.
#[test]
fn flat_surfaces_are_pushed_apart_by_the_pressure() {
    let (repulsion, count) = (Repulsion::new(30.0, 0.25).unwrap(), 40);
    for gap in [0.05, 0.1, 0.2] {
        let mut scene = Scene::new(PLANE);
        for low in [0.0, 1.0 + gap] {
            let start = scene.markers.len();
            scene.markers.push_group(2 * count, MarkerKind::Interface { viscosity_inside: None });
            for k in 0..count {
                let x = k as f64 / (count - 1) as f64;
                scene.markers.positions[start + k] = Vec2::new(x, low);
                scene.markers.positions[start + count + k] = Vec2::new(1.0 - x, low + 1.0);
            }
        }
        let middle = scene.forces(&repulsion)[2 * count + count / 2] * (count - 1) as f64;
        assert!((middle - repulsion.pressure(gap) * Vec2::Y).length() < 1e-10 * middle.y, "{gap}: {middle}");
    }
}

#[test]
fn the_time_in_which_a_film_closes() {
    let [(_, mut scene, _), .., (_, mut walls, _), _] = scenes();
    let films = scene.films(0.4);
    scene.markers.velocities[48..].fill(Vec2::new(-0.5, 0.0));
    let (time, body) = films.closing(&scene.markers, 0.0).unwrap();
    let gaps = films.contacts.iter().map(|contact| contact.gap / (0.5 * contact.normal.x.abs()));
    assert!((time - gaps.fold(f64::INFINITY, f64::min)).abs() < 1e-12 && body < 2);
    scene.markers.velocities[48..].fill(Vec2::new(0.5, 0.0));
    let apart = films.closing(&scene.markers, 0.0);
    assert!(apart.is_none_or(|(later, _)| later > 2.0 * time), "{apart:?}");
    walls.markers.velocities.fill(Vec2::new(3.0, -0.1));
    let lowest = walls.markers.positions.iter().map(|place| place.y + 1.05).fold(f64::INFINITY, f64::min);
    let (time, _) = walls.films(0.4).closing(&walls.markers, 0.0).unwrap();
    assert!((time - lowest / 0.1).abs() < 1e-12);
}
