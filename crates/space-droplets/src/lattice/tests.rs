use std::f64::consts::PI;

use super::*;
use crate::close::{add_direct, add_direct_double};
use crate::layers::Vectors;
use crate::surface::{at, dot, put, vectors};
use crate::surroundings::{lists, lists_mut};
use crate::{ContractileTension, ExcludedVolume, SpaceDroplet, SpaceDroplets};

fn list(places: &[[f64; 3]]) -> Vectors {
    let mut list = vectors(places.len());
    places.iter().enumerate().for_each(|(k, place)| put(&mut list, k, *place));
    list
}

/// Strengths of sources: forces, or normals and velocities.
#[derive(Clone, Copy)]
enum Strength<'a> {
    Forces(&'a Vectors),
    Doubles(&'a Vectors, &'a Vectors),
}

struct BoxFlow(PeriodicBox);

impl BoxFlow {
    fn new(size: [f64; 3]) -> Self {
        Self(PeriodicBox::new(size).unwrap())
    }

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

fn cube() -> BoxFlow {
    BoxFlow::new([1.0; 3])
}

/// Hasimoto's drag of a sphere in a cubic lattice: for uniform forces on its surface, the velocity averaged over the
/// surface is `1 - 2.837297 a/L + (4 pi/3)(a/L)^3` exactly.
#[test]
fn a_dragged_sphere_in_a_cube_is_slowed_as_hasimoto_found() {
    let grid = sphere_harmonics::Grid::gauss(12).unwrap();
    for a in [0.01, 0.1, 0.2] {
        let places: Vec<[f64; 3]> = grid.points().map(|point| point.direction().map(|x| a * x)).collect();
        let forces: Vec<[f64; 3]> = grid.weights().map(|weight| [0.0, weight / (4.0 * PI), 0.0]).collect();
        let places = list(&places);
        let mut out = vectors(places[0].len());
        cube().add(&places, Strength::Forces(&list(&forces)), &places, &mut out);
        let mean = grid.integral(&out[1]).unwrap() / (4.0 * PI);
        let exact = (-2.837_297_479_5 * a + 4.0 * PI / 3.0 * a.powi(3)) / (6.0 * PI * a);
        assert!((mean / exact - 1.0).abs() < 1e-10, "{a}: {mean} {exact}");
    }
}

/// Five forces in a row with the weights 1, -4, 6, -4, 1: their flow falls as the fifth power of the distance, and the
/// plain sum over images converges.
#[test]
fn the_split_sum_is_the_plain_sum_over_images() {
    let size = [1.0, 1.4, 0.8];
    let step = [0.03, 0.02, -0.025];
    let row = |middle: [f64; 3]| -> Vec<[f64; 3]> {
        (0..5).map(|k| std::array::from_fn(|i| middle[i] + (f64::from(k) - 2.0) * step[i])).collect()
    };
    let weights = [1.0, -4.0, 6.0, -4.0, 1.0];
    let places = list(&row([0.1, 0.2, 0.3]));
    let (force, normal) = ([0.3, -0.8, 0.5], [0.7, 0.2, -0.4]);
    let forces = list(&weights.map(|w| force.map(|x| w * x)));
    let normals = list(&weights.map(|w| normal.map(|x| w * x)));
    let velocities = list(&[force; 5]);
    let targets = list(&[[0.5, 0.6, 0.1], [0.15, 0.2, 0.35], [0.9, -0.3, 0.6]]);
    let plain = |images: i64, double: bool| {
        let mut out = vectors(3);
        for x in -images..=images {
            for y in -images..=images {
                for z in -images..=images {
                    if [x, y, z] != [0, 0, 0] {
                        let shift = [-x as f64 * size[0], -y as f64 * size[1], -z as f64 * size[2]];
                        if double {
                            add_direct_double(&places, [&normals, &velocities], &targets, shift, &mut out);
                        } else {
                            add_direct(&places, &forces, &targets, shift, &mut out);
                        }
                    }
                }
            }
        }
        out
    };
    let mut flow = BoxFlow::new(size);
    for double in [false, true] {
        let strength = if double { Strength::Doubles(&normals, &velocities) } else { Strength::Forces(&forces) };
        let mut split = vectors(3);
        flow.add(&places, strength, &targets, &mut split);
        let error = |images: i64| {
            let plain = plain(images, double);
            let difference = |i: usize, k: usize| {
                // The plain sum has no mean: compare differences between targets.
                (split[i][k] - split[i][0]) - (plain[i][k] - plain[i][0])
            };
            (0..9).map(|n| difference(n / 3, n % 3).abs()).fold(0.0, f64::max)
        };
        let size = split.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
        let errors = [4, 8, 16].map(|images| error(images) / size);
        assert!(errors[2] < 1e-6 && errors[2] < 0.3 * errors[1] && errors[1] < 0.3 * errors[0], "{errors:?}");
    }
}

/// The cut-off is a choice of the method: boxes that are repeated give the same flow as one of them.
#[test]
fn a_box_of_two_copies_has_the_same_flow() {
    let noise = |k: usize, i: usize| (0.4 + 12.9898 * k as f64 + 78.233 * i as f64).sin();
    let vector = |count: usize, from: usize| -> Vec<[f64; 3]> {
        (0..count).map(|k| std::array::from_fn(|i| noise(k, from + i))).collect()
    };
    let (places, forces, velocities) = (vector(6, 0), vector(6, 3), vector(6, 6));
    let size = [2.0, 2.5, 3.0];
    for axis in 0..3 {
        let mut double = size;
        double[axis] *= 2.0;
        let mut shift = [0.0; 3];
        shift[axis] = size[axis];
        let copy: Vec<[f64; 3]> = places.iter().map(|x| std::array::from_fn(|i| x[i] + shift[i])).collect();
        let twice = |list: &[[f64; 3]]| [list, list].concat();
        let targets = list(&vector(7, 9));
        let value = |size: [f64; 3], places: &Vectors, [f, u]: [&Vectors; 2], double: bool| {
            let mut out = vectors(7);
            let strength = if double { Strength::Doubles(f, u) } else { Strength::Forces(f) };
            BoxFlow::new(size).add(places, strength, &targets, &mut out);
            if double {
                add_direct_double(places, [f, u], &targets, [0.0; 3], &mut out);
            } else {
                add_direct(places, f, &targets, [0.0; 3], &mut out);
            }
            out
        };
        for doubles in [false, true] {
            let one = value(size, &list(&places), [&list(&forces), &list(&velocities)], doubles);
            let both = list(&[places.clone(), copy.clone()].concat());
            let (f, u) = (list(&twice(&forces)), list(&twice(&velocities)));
            let two = value(double, &both, [&f, &u], doubles);
            for k in 0..7 {
                let (a, b) = (at(&one, k), at(&two, k));
                let error = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
                let scale = one.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
                assert!(error < 1e-11 * scale, "{axis} {doubles} {k}: {a:?} {b:?} {error:e}");
            }
        }
    }
}

/// A closed surface with a uniform velocity: its double layer is minus that velocity inside and zero outside, which has
/// the right mean, so the images add nothing.
#[test]
fn the_images_of_the_double_layer_of_a_uniform_velocity_add_nothing() {
    let grid = sphere_harmonics::Grid::gauss(30).unwrap();
    let a = 0.3;
    let velocity = [0.5, -0.3, 0.2];
    let scaled = |point: sphere_harmonics::Point, scale: f64| point.direction().map(|x| scale * x);
    let places: Vec<[f64; 3]> = grid.points().map(|point| scaled(point, a)).collect();
    let normals: Vec<[f64; 3]> = grid.points().zip(grid.weights()).map(|(p, w)| scaled(p, a * a * w)).collect();
    let places = list(&places);
    let velocities = list(&vec![velocity; places[0].len()]);
    let targets = list(&[[0.0; 3], [0.1, 0.05, 0.0], [0.5, 0.5, 0.5]]);
    let mut out = vectors(3);
    cube().add(&places, Strength::Doubles(&list(&normals), &velocities), &targets, &mut out);
    let largest = out.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
    assert!(largest < 1e-12, "{largest:e}");
}

#[test]
fn boxes_that_cannot_be_used_are_refused() {
    let message = PeriodicBox::new([1.0, 60.0, 1.0]).unwrap_err().to_string();
    assert!(message.contains("too long for its width"), "{message}");
    assert!(PeriodicBox::new([1.0, 0.0, 1.0]).is_err() && PeriodicBox::new([f64::NAN, 1.0, 1.0]).is_err());
}

/// A sphere whose tension grows along an axis.
fn marangoni(degree: usize, axis: [f64; 3], radius: f64, viscosities: [f64; 2]) -> SpaceDroplet {
    let law = ContractileTension::new(radius, -0.5 * radius.powi(3), ExcludedVolume::None, 1.0).unwrap();
    let droplet = SpaceDroplet::sphere(degree, radius, viscosities, law).unwrap();
    droplet.with_particles(0.1, |s| (1.0 + dot(s, axis)) / radius.powi(2)).unwrap()
}

/// With equal viscosities, the velocity is the mean of the flow over the sphere. The dipoles of a cubic lattice have no
/// flow in the middle except for their mean, so the speed is `1 - 4 pi/3 (R/L)^3` times the one without images.
#[test]
fn marangoni_spheres_in_a_cube_are_slower_by_their_part_of_the_volume() {
    let axis = [0.6, 0.0, 0.8];
    for (radius, side, degree) in [(1.0, 5.0, 8), (1e-6, 5e-6, 8), (1.0, 3.0, 16)] {
        let droplet = marangoni(degree, axis, radius, [1.0, 1.0]).with_position([0.3 * side, 7.0 * side, 0.0]).unwrap();
        let mut droplet = droplet.with_surroundings(PeriodicBox::new([side; 3]).unwrap()).unwrap();
        let velocity = droplet.observe().unwrap().velocity;
        let exact = -radius / 15.0 * (1.0 - 4.0 * PI / 3.0 * (radius / side).powi(3));
        for i in 0..3 {
            let error = (velocity[i] / exact - axis[i]).abs();
            assert!(error < 2e-9, "{radius} {side} {i}: {error:e}");
        }
    }
}

/// Two droplets in a box are one droplet in half of it, at two viscosities; the images of the one are the other.
#[test]
fn two_droplets_in_a_box_are_one_in_half_of_it() {
    let shape = |s: [f64; 3]| [1.1 * s[0], 0.9 * s[1] + 0.1 * s[0] * s[2], s[2]];
    let drop = |x: f64| {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let droplet = SpaceDroplet::shaped(12, shape, [4.0, 1.0], law).unwrap();
        let droplet = droplet.with_particles(0.1, |s| 1.0 + 0.5 * s[0] - 0.3 * s[1]).unwrap();
        droplet.with_position([x, 0.1, 0.2]).unwrap()
    };
    // Positions may be many boxes apart.
    for (side, away, within) in [(4.0, 24.0, 1e-8), (2.6, 0.0, 2e-5)] {
        let mut one = drop(0.4).with_surroundings(PeriodicBox::new([side, 4.0, 4.5]).unwrap()).unwrap();
        let one = one.observe().unwrap().velocity;
        let pair = SpaceDroplets::new(vec![drop(0.4), drop(0.4 + side + away)]).unwrap();
        let mut pair = pair.with_surroundings(PeriodicBox::new([2.0 * side, 4.0, 4.5]).unwrap()).unwrap();
        for k in 0..2 {
            let two = pair.observe(k).unwrap().velocity;
            let error = (0..3).map(|i| (one[i] - two[i]).abs()).fold(0.0, f64::max) / dot(one, one).sqrt();
            assert!(error < within, "{side} {k}: {one:?} {two:?} {error:e}");
        }
    }
}

#[test]
fn droplets_that_do_not_fit_into_the_box_are_refused() {
    let message = |side: f64| {
        let droplet = marangoni(8, [1.0, 0.0, 0.0], 1.0, [1.0, 1.0]);
        droplet.with_surroundings(PeriodicBox::new([4.0, side, 4.0]).unwrap()).unwrap_err().to_string()
    };
    let (small, close) = (message(1.9), message(2.05));
    assert!(small.contains("droplet 0 does not fit") && small.contains("Enlarge the box"), "{small}");
    assert!(close.contains("too close to its image"), "{close}");
}
