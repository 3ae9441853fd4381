use std::f64::consts::TAU;

use super::*;
use crate::{
    MarkerKind, Markers,
    gap::{SurfaceCurve, SurfacePoint},
};

const PLANE: Domain = Domain { origin: [0.0; 2], periods: Periods { lengths: [None; 2], tilt: 0.0 }, walls: None };

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
    let curve = SurfaceCurve::through((0..8).map(|k| 8 - k), -1);
    markers.push_body(9, MarkerKind::Points, vec![curve]);
    for k in 0..9 {
        markers.positions[start + k] = Vec2::new(0.5 * k as f64 - 2.0, -1.1 + 0.04 * (k as f64).sin());
    }
}

struct Scene {
    markers: Markers,
    domain: Domain,
    walls: Option<Boundary>,
    around: Vec<Option<usize>>,
    axisymmetric: bool,
}

impl Scene {
    fn new(domain: Domain) -> Self {
        Self { markers: Markers::new(), domain, walls: None, around: vec![None; 4], axisymmetric: false }
    }

    fn films(&self, reach: f64) -> (Surfaces, Films) {
        let (mut surfaces, mut films) = (Surfaces::default(), Films::default());
        surfaces.update(&self.markers, self.domain.periods[0].unwrap_or(0.0));
        let (walls, axisymmetric) = (self.walls.as_ref(), self.axisymmetric);
        let surroundings = Surroundings { domain: self.domain, walls, around: &self.around, axisymmetric };
        films.find(&surfaces, surroundings, reach);
        (surfaces, films)
    }

    fn forces(&mut self, repulsion: &Repulsion) -> Vec<Vec2> {
        self.markers.forces.fill(Vec2::ZERO);
        let (surfaces, mut films) = self.films(repulsion.range());
        films.push_apart(repulsion, &surfaces, &mut self.markers.forces);
        self.markers.forces.clone()
    }

    fn energy(&self, repulsion: &Repulsion) -> f64 {
        self.films(repulsion.range()).1.energy(repulsion)
    }
}

/// A droplet above a block whose left half is pinned, where both halves meet: of its corners only the markers move.
fn pinned() -> Scene {
    let mut scene = Scene::new(PLANE);
    circle(&mut scene.markers, Vec2::ZERO, 1.0);
    let right: Vec<Vec2> = [(0.1, -1.7), (0.6, -1.7), (0.6, -1.1), (0.1, -1.08)].map(Vec2::from).to_vec();
    let left = [(-0.2, -1.08), (-0.6, -1.1), (-0.6, -1.7), (-0.2, -1.7)].map(Vec2::from);
    let free = (0..right.len()).map(|marker| (SurfacePoint::Marker(marker), 0));
    let points = free.chain(left.map(|place| (SurfacePoint::Fixed(place), 0))).collect();
    scene.markers.push_body(right.len(), MarkerKind::Points, vec![SurfaceCurve { points, periods: 0 }]);
    scene.markers.positions[48..].copy_from_slice(&right);
    scene
}

fn scenes() -> [(&'static str, Scene, bool); 8] {
    let channel = Domain { origin: [-2.0, -1.05], periods: [Some(4.0), None].into(), walls: Some([-1.05, 1.2]) };
    let mut pair = Scene::new(PLANE);
    circle(&mut pair.markers, Vec2::ZERO, 1.0);
    circle(&mut pair.markers, Vec2::new(1.6, 0.35), 0.6);
    let mut rings = Scene { axisymmetric: true, ..Scene::new(PLANE) };
    circle(&mut rings.markers, Vec2::ZERO, 1.0);
    circle(&mut rings.markers, Vec2::new(1.75, 0.0), 0.6);
    let mut nested = Scene::new(PLANE);
    circle(&mut nested.markers, Vec2::ZERO, 1.0);
    circle(&mut nested.markers, Vec2::new(0.3, 0.1), 0.6);
    nested.around[1] = Some(0);
    let mut images = Scene::new(Domain { periods: [Some(2.1), Some(2.15)].into(), ..PLANE });
    circle(&mut images.markers, Vec2::ZERO, 1.0);
    let mut solid = Scene::new(Domain { periods: [Some(4.0), None].into(), ..PLANE });
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
        ("rings", rings, true),
        ("nested", nested, true),
        ("images", images, true),
        ("solid", solid, true),
        ("pinned in part", pinned(), false),
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
        let (mut sum, positions) = (forces.iter().sum::<Vec2>(), scene.markers.positions());
        // Forces across the axis are those of a whole ring, which cancel.
        sum.y = if scene.axisymmetric { 0.0 } else { sum.y };
        let torque: f64 = positions.iter().zip(&forces).map(|(x, f)| x.perp_dot(*f)).sum();
        assert_eq!(sum.length() < 1e-12 * largest, free, "{name}: {sum}");
        // Across a period a force has another lever on either side.
        let alone = scene.domain.periods[0].is_none() && !scene.axisymmetric;
        assert!(!free || !alone || torque.abs() < 1e-12 * largest, "{name}: {torque}");
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
    let (surfaces, films) = scene.films(0.4);
    scene.markers.velocities[48..].fill(Vec2::new(-0.5, 0.0));
    let (time, body) = films.closing(&surfaces, &scene.markers.velocities, 0.0).unwrap();
    let gaps = films.contacts().map(|contact| contact.gap / (0.5 * contact.normal.x.abs()));
    assert!((time - gaps.fold(f64::INFINITY, f64::min)).abs() < 1e-12 && body < 2);
    scene.markers.velocities[48..].fill(Vec2::new(0.5, 0.0));
    let apart = films.closing(&surfaces, &scene.markers.velocities, 0.0);
    assert!(apart.is_none_or(|(later, _)| later > 2.0 * time), "{apart:?}");
    walls.markers.velocities.fill(Vec2::new(3.0, -0.1));
    let lowest = walls.markers.positions.iter().map(|place| place.y + 1.05).fold(f64::INFINITY, f64::min);
    let (surfaces, films) = walls.films(0.4);
    let (time, _) = films.closing(&surfaces, &walls.markers.velocities, 0.0).unwrap();
    assert!((time - lowest / 0.1).abs() < 1e-12);
}

#[test]
fn what_is_pinned_in_part_has_films() {
    let (repulsion, mut scene) = (Repulsion::new(30.0, 0.25).unwrap(), pinned());
    let forces = scene.forces(&repulsion);
    // The free corner nearest to the droplet is pushed away from it; the rest of the reaction is the pinned half's.
    let (up, down) = (forces[..48].iter().sum::<Vec2>().y, forces[51].y);
    assert!(down < -0.01 && up > -1.5 * down, "{up} {down}");
    // The droplet sinks, the free half with it: films with the pinned one alone close.
    scene.markers.velocities.fill(-0.1 * Vec2::Y);
    let (surfaces, films) = scene.films(0.25);
    let (time, body) = films.closing(&surfaces, &scene.markers.velocities, 0.0).unwrap();
    let fixed = |contact: &Contact| surfaces.corners[contact.corner].marker.is_none() && contact.ends.is_some();
    let gaps = films.contacts().filter(|contact| fixed(contact)).map(|contact| contact.gap);
    let least = gaps.reduce(f64::min).unwrap();
    assert!(body < 2 && time > 0.0 && time < 1.5 * least / 0.1, "{time} {least}");
    // With a block that moves as a whole there is none.
    scene.markers.groups[1].surfaces[0].points.truncate(4);
    let (surfaces, films) = scene.films(0.25);
    assert!(films.contacts().next().is_some());
    assert_eq!(films.closing(&surfaces, &scene.markers.velocities, 0.0), None);
}

/// A droplet pushes its own image as it pushes another droplet in its place.
#[test]
fn images_of_ones_own_are_pushed_like_others() {
    let repulsion = Repulsion::new(3.0, 0.2).unwrap();
    let forces = |count: usize| {
        let periods = [Some(2.05 * count as f64), Some(5.0)];
        let mut scene = Scene::new(Domain { periods: periods.into(), ..PLANE });
        (0..count).for_each(|k| circle(&mut scene.markers, Vec2::new(2.05 * k as f64, 0.0), 1.0));
        scene.forces(&repulsion)
    };
    let (alone, pair) = (forces(1), forces(2));
    assert!(alone[0].x < -0.01, "{}", alone[0]);
    for (a, b) in alone.iter().zip(&pair) {
        assert!((*a - *b).length() < 1e-12, "{a} {b}");
    }
}

#[test]
fn the_load_of_a_film_is_that_of_its_pair() {
    // Two circles across the period of a box, the second one displaced by periods as bodies that swim are.
    let periods = Periods { lengths: [Some(6.0), Some(5.0)], tilt: 0.0 };
    let repulsion = Repulsion::holding(0.1, 40.0).unwrap();
    let loads: Vec<_> = [Vec2::new(2.05, 0.0), Vec2::new(2.05 - 12.0, 5.0), Vec2::new(2.05, -5.0)]
        .into_iter()
        .map(|place| {
            let mut scene = Scene::new(Domain { periods, ..PLANE });
            circle(&mut scene.markers, Vec2::ZERO, 1.0);
            circle(&mut scene.markers, place, 1.0);
            let forces = scene.forces(&repulsion);
            let (surfaces, films) = scene.films(repulsion.range());
            let load = films.load(&repulsion, &surfaces);
            let force = forces[..48].iter().map(|force| force.x).sum::<f64>();
            // The force on the first one is to the left, the other one 2.05 to its right.
            assert!((load.virial[0][0] + 2.05 * force).abs() < 1e-12 * force.abs(), "{load:?} {force}");
            assert!(load.virial[1][1].abs() < 1e-12 * load.virial[0][0], "{load:?}");
            let film = load.mean_film.unwrap();
            assert!(film > 0.05 && film < 0.1 && load.largest_pressure <= repulsion.pressure(0.049), "{load:?}");
            load
        })
        .collect();
    assert!(loads.iter().all(|load| (load.virial[0][0] / loads[0].virial[0][0] - 1.0).abs() < 1e-9), "{loads:?}");
    let mut apart = Scene::new(PLANE);
    circle(&mut apart.markers, Vec2::ZERO, 1.0);
    circle(&mut apart.markers, Vec2::new(3.0, 0.0), 1.0);
    let (surfaces, films) = apart.films(repulsion.range());
    let load = films.load(&repulsion, &surfaces);
    assert_eq!((load.virial, load.mean_film, load.length), ([[0.0; 2]; 2], None, 0.0));
}
