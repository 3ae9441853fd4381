use std::f64::consts::PI;

use super::*;
use crate::close::{add_direct, add_direct_double};
use crate::layers::Vectors;
use crate::surface::{at, dot, put, vectors};
use crate::surroundings::{lists, lists_mut};
use crate::{ContractileTension, ExcludedVolume, SpaceDroplet, SpaceDroplets};

fn one(place: [f64; 3]) -> Vectors {
    list(&[place])
}

fn list(places: &[[f64; 3]]) -> Vectors {
    let mut list = vectors(places.len());
    places.iter().enumerate().for_each(|(k, place)| put(&mut list, k, *place));
    list
}

/// Places between walls at 2 and 5, with some of both sides close to them, and vectors there.
fn scattered(count: usize, seed: f64) -> [Vectors; 3] {
    let noise = |k: usize, i: usize| (seed + 12.9898 * k as f64 + 78.233 * i as f64).sin();
    let vector = |from: usize| {
        let all: Vec<[f64; 3]> = (0..count).map(|k| std::array::from_fn(|i| noise(k, from + i))).collect();
        list(&all)
    };
    let mut places = vector(0);
    places[2].iter_mut().for_each(|z| *z = 3.5 + 1.2 * *z);
    [places, vector(3), vector(6)]
}

/// Strengths of sources: forces, or normals and velocities.
#[derive(Clone, Copy)]
enum Strength<'a> {
    Forces(&'a Vectors),
    Doubles(&'a Vectors, &'a Vectors),
}

struct Walls(Slit);

impl Walls {
    fn add(&mut self, places: &Vectors, strength: Strength<'_>, targets: &Vectors, out: &mut Vectors) {
        let places = lists(places);
        let source = match strength {
            Strength::Forces(forces) => Sources::Forces { places, forces: lists(forces) },
            Strength::Doubles(normals, velocities) => {
                Sources::Stresslets { places, normals: lists(normals), velocities: lists(velocities) }
            }
        };
        self.0.add_flow(&[source], &mut [Targets { places: lists(targets), flow: lists_mut(out) }]).unwrap();
    }
}

fn walls() -> Walls {
    Walls(Slit::new(2.0, 5.0).unwrap())
}

/// The closed form for a force along the walls in the mid-plane is 1.00412108 (Faxen's 1.004); the one across was
/// computed by two other rules.
#[test]
fn a_force_in_the_mid_plane_is_slowed_as_known() {
    let (place, half) = ([0.3, -7.0, 3.5], 1.5);
    for (axis, exact) in [(0, -1.004_121_08), (1, -1.004_121_08), (2, -1.451_6)] {
        let mut out = vectors(1);
        let mut force = [0.0; 3];
        force[axis] = 1.0;
        walls().add(&one(place), Strength::Forces(&one(force)), &one(place), &mut out);
        let factor = 6.0 * PI * half * out[axis][0];
        let within = if axis == 2 { 5e-5 } else { 1e-8 };
        assert!((factor - exact).abs() < within, "{axis}: {factor}");
        assert!((0..3).all(|i| i == axis || out[i][0].abs() < 1e-15));
    }
}

#[test]
fn the_flow_on_the_walls_is_zero() {
    let [places, normals, velocities] = scattered(20, 0.3);
    for wall in [2.0, 5.0] {
        let points: Vec<[f64; 3]> = (0..30).map(|k| [0.1 * f64::from(k) - 1.5, 0.7, wall]).collect();
        let targets = list(&points);
        let (mut free, mut both) = (vectors(30), vectors(30));
        add_direct(&places, &normals, &targets, [0.0; 3], &mut free);
        both.clone_from(&free);
        walls().add(&places, Strength::Forces(&normals), &targets, &mut both);
        let largest = |list: &Vectors| list.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
        assert!(largest(&both) < 1e-13 * largest(&free), "{:e} {:e}", largest(&both), largest(&free));

        let (mut free, mut both) = (vectors(30), vectors(30));
        add_direct_double(&places, [&normals, &velocities], &targets, [0.0; 3], &mut free);
        both.clone_from(&free);
        walls().add(&places, Strength::Doubles(&normals, &velocities), &targets, &mut both);
        assert!(largest(&both) < 1e-13 * largest(&free), "{:e} {:e}", largest(&both), largest(&free));
    }
}

/// Far from a force along the walls, its flow is the one of Hele-Shaw, up to waves that decay as `exp(-pi r/H)`: with
/// the pressure `p = 6 z'(H - z')/H^3 F.r/(2 pi r^2)`, the velocity is `-z (H - z)/2 grad p`.
#[test]
fn a_force_has_the_flow_of_hele_shaw_far_away() {
    let (height, force) = (3.0, [0.6, -0.8, 0.0]);
    for (low, at) in [(1.5, 0.7), (0.4, 2.1)] {
        let errors = [3.0, 5.0].map(|widths: f64| {
            let r = [0.28 * widths * height, 0.96 * widths * height];
            let target = [r[0], r[1], 2.0 + at];
            let mut out = vectors(1);
            add_direct(&one([0.0, 0.0, 2.0 + low]), &one(force), &one(target), [0.0; 3], &mut out);
            walls().add(&one([0.0, 0.0, 2.0 + low]), Strength::Forces(&one(force)), &one(target), &mut out);
            let square = r[0] * r[0] + r[1] * r[1];
            let along = (force[0] * r[0] + force[1] * r[1]) / square;
            let strength = 6.0 * low * (height - low) / height.powi(3) / (2.0 * PI * square);
            let exact = |i: usize| -0.5 * at * (height - at) * strength * (force[i] - 2.0 * along * r[i]);
            let difference = (0..2).map(|i| (out[i][0] - exact(i)).abs()).fold(out[2][0].abs(), f64::max);
            difference / exact(0).hypot(exact(1))
        });
        println!("{errors:?}");
        // From 3 to 5 widths, the first wave falls by exp(2 pi).
        assert!(errors[1] < 1e-4 && errors[1] < errors[0] / 200.0, "{errors:?}");
    }
}

#[test]
fn the_walls_flow_is_reciprocal() {
    let ([a, f, _], [b, g, _]) = (scattered(15, 0.1), scattered(15, 0.9));
    let power = |from: [&Vectors; 2], to: [&Vectors; 2]| {
        let mut out = vectors(15);
        walls().add(from[0], Strength::Forces(from[1]), to[0], &mut out);
        (0..15).map(|k| dot(at(&out, k), at(to[1], k))).sum::<f64>()
    };
    let (one, other) = (power([&a, &f], [&b, &g]), power([&b, &g], [&a, &f]));
    assert!((one / other - 1.0).abs() < 1e-12, "{one} {other}");
}

/// The double layer of a sphere with any velocity of its own fluid is the single layer of its tractions. For a flow
/// that is rigid, tractions vanish, so the walls feel nothing. For a strain, they are `2 e n`.
#[test]
fn the_double_layer_of_a_strain_is_its_single_layer() {
    let grid = sphere_harmonics::Grid::gauss(40).unwrap();
    let strain = [[0.3, 0.5, -0.2], [0.5, 0.4, 0.7], [-0.2, 0.7, -0.7]];
    let spin = [[0.0, 0.4, 0.1], [-0.4, 0.0, 0.2], [-0.1, -0.2, 0.0]];
    let len = grid.len();
    let (mut places, mut normals, mut velocities) = (vectors(len), vectors(len), vectors(len));
    let mut forces = vectors(len);
    for (k, (point, weight)) in grid.points().zip(grid.weights()).enumerate() {
        let n = point.direction();
        put(&mut places, k, [n[0], n[1], n[2] + 3.3]);
        put(&mut normals, k, n.map(|x| weight * x));
        let row = |i: usize| 1.0 + dot(strain[i], n) + dot(spin[i], n);
        put(&mut velocities, k, [row(0), row(1), row(2)]);
        put(&mut forces, k, [0, 1, 2].map(|i| 2.0 * weight * dot(strain[i], n)));
    }
    let [targets, ..] = scattered(10, 0.7);
    let (mut single, mut double) = (vectors(10), vectors(10));
    let mut walls = walls();
    walls.add(&places, Strength::Forces(&forces), &targets, &mut single);
    walls.add(&places, Strength::Doubles(&normals, &velocities), &targets, &mut double);
    // S t + D u = 0 outside, with D u = -INT T u n/(8 pi) in this kernel's sign.
    for k in 0..10 {
        for i in 0..3 {
            let (a, b) = (single[i][k], double[i][k]);
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}

/// A finer rule gives the same flow, also far along the walls and next to a wall.
#[test]
fn the_rule_resolves_far_and_close_sources() {
    for (place, target) in
        [([0.0, 0.0, 3.0], [20.0, 4.0, 4.0]), ([0.0, 0.0, 2.15], [0.01, 0.05, 2.2]), ([0.0, 0.0, 4.8], [3.0, 0.0, 4.6])]
    {
        // Sources and targets farther away and closer to the wall make the rule finer.
        let far = |x: [f64; 3]| {
            list(&[x, [x[0] + 2.0, x[1] - 2.0, x[2] + 0.3 * (x[2] - 3.5).signum() * (1.5 - (x[2] - 3.5).abs())]])
        };
        let force = [0.3, -0.5, 0.7];
        let (mut coarse, mut fine) = (vectors(1), vectors(2));
        walls().add(&one(place), Strength::Forces(&one(force)), &one(target), &mut coarse);
        walls().add(&far(place), Strength::Forces(&list(&[force, [0.0; 3]])), &far(target), &mut fine);
        let r: [f64; 3] = std::array::from_fn(|i| place[i] - target[i]);
        let scale = 1.0 / (8.0 * PI * dot(r, r).sqrt());
        for i in 0..3 {
            let error = (coarse[i][0] - fine[i][0]).abs() / scale;
            assert!(error < 1e-12, "{place:?} {i}: {error:e}");
        }
    }
}

#[test]
fn slits_without_width_are_refused() {
    let message = Slit::new(1.0, 1.0).unwrap_err().to_string();
    assert!(message.contains("Swap the heights"), "{message}");
    assert!(Slit::new(f64::NAN, 1.0).is_err() && Slit::new(0.0, f64::INFINITY).is_err());
}

/// A sphere of radius `radius` in the middle of a slit, whose tension grows along an axis.
fn marangoni(degree: usize, axis: [f64; 3], radius: f64, viscosities: [f64; 2]) -> SpaceDroplet {
    let law = ContractileTension::new(radius, -0.5 * radius.powi(3), ExcludedVolume::None, 1.0).unwrap();
    let droplet = SpaceDroplet::sphere(degree, radius, viscosities, law).unwrap();
    droplet.with_particles(0.1, |s| (1.0 + dot(s, axis)) / radius.powi(2)).unwrap()
}

/// Speeds over the one without walls, at half widths of 4 and 1.5 radii, along and across, by an independent program
/// with two rules (errors 2e-9 and 3e-5).
#[test]
fn marangoni_spheres_between_walls_are_those_of_another_program() {
    let references = [(4.0, 8, 0.993_667_68, 0.987_903_17, 1e-8), (1.5, 14, 0.902_89, 0.800_60, 4e-5)];
    for (half, degree, along, across, within) in references {
        for (axis, exact) in [([0.6, 0.8, 0.0], along), ([0.0, 0.0, 1.0], across)] {
            // In micrometres too.
            for radius in [1.0, 1e-6] {
                let walls = Slit::new(-half * radius, half * radius).unwrap();
                let mut droplet = marangoni(degree, axis, radius, [1.0, 1.0]).with_surroundings(walls).unwrap();
                let velocity = droplet.observe().unwrap().velocity;
                let ratio = dot(velocity, axis) / (-radius / 15.0);
                assert!((ratio - exact).abs() < within, "{half} {axis:?} {radius}: {ratio}");
            }
        }
    }
}

/// Two viscosities: far walls return the flow of the droplet's dipole at its centre, for any ratio. What is left is the
/// second derivative of this flow, which falls as the square of the width relative to it.
#[test]
fn viscous_spheres_between_distant_walls_feel_the_flow_of_their_dipole() {
    let along = |half: f64, viscosities: [f64; 2]| {
        let walls = Slit::new(-half, half).unwrap();
        let mut droplet = marangoni(6, [1.0, 0.0, 0.0], 1.0, viscosities).with_surroundings(walls).unwrap();
        droplet.observe().unwrap().velocity[0] * -3.0 * (2.0 * viscosities[1] + 3.0 * viscosities[0])
    };
    let change = |half: f64, viscosities: [f64; 2]| 1.0 - along(half, viscosities);
    // The dipole of a sphere depends on its speed alone.
    let error = |half: f64| (change(half, [10.0, 1.0]) / change(half, [1.0, 1.0]) - 1.0).abs();
    let errors = [6.0, 12.0].map(error);
    assert!(errors[0] < 0.1 && errors[1] < errors[0] / 3.0, "{errors:?}");
}

/// One droplet, the same among several, and the same after a quarter of a turn of the droplet about z.
#[test]
fn droplets_in_a_slit_do_not_depend_on_how_they_are_described() {
    let velocity = |turn: bool, several: bool| {
        let axis = if turn { [-0.6, 0.5, 0.3] } else { [0.5, 0.6, 0.3] };
        let shape = |s: [f64; 3]| {
            let [x, y] = if turn { [s[1], -s[0]] } else { [s[0], s[1]] };
            let [x, y, z] = [1.1 * x + 0.1 * s[2], 0.95 * y, s[2] + 0.1 * x * y];
            if turn { [-y, x, z] } else { [x, y, z] }
        };
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let droplet = SpaceDroplet::shaped(10, shape, [3.0, 1.0], law).unwrap();
        let droplet = droplet.with_particles(0.1, |s| 1.0 + dot(s, axis)).unwrap();
        let droplet = droplet.with_position([0.3, -0.2, 0.4]).unwrap();
        let walls = Slit::new(-2.0, 2.0).unwrap();
        let velocity = if several {
            let all = SpaceDroplets::new(vec![droplet]).unwrap();
            all.with_surroundings(walls).unwrap().observe(0).unwrap().velocity
        } else {
            droplet.with_surroundings(walls).unwrap().observe().unwrap().velocity
        };
        if turn { [velocity[1], -velocity[0], velocity[2]] } else { velocity }
    };
    let one = velocity(false, false);
    for other in [velocity(true, false), velocity(false, true)] {
        let error = (0..3).map(|i| (one[i] - other[i]).abs()).fold(0.0, f64::max);
        assert!(error < 1e-6 * dot(one, one).sqrt(), "{one:?} {other:?}");
    }
}

#[test]
fn droplets_that_do_not_fit_between_the_walls_are_refused() {
    let message = |half: f64| {
        let droplet = marangoni(8, [1.0, 0.0, 0.0], 1.0, [1.0, 1.0]);
        droplet.with_surroundings(Slit::new(-half, half).unwrap()).unwrap_err().to_string()
    };
    let (wide, close) = (message(0.9), message(1.02));
    assert!(wide.contains("droplet 0 crosses the wall at z = ") && wide.contains("make it smaller"), "{wide}");
    assert!(close.contains("too small") && close.contains("Use a higher degree"), "{close}");
}
