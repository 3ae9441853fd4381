use std::f64::consts::{PI, TAU};

use super::*;
use crate::hydrodynamics::tests::DragBox;
use crate::{MarkerBody, MarkerKind, Scene};

/// Fluid of viscosity 1.5 in which velocities are the forces over 7.5.
fn scene() -> Scene<DragBox> {
    Scene::new(DragBox::new(4.0, 1.5, 0.1))
}

/// Each entry of the stress is another number.
#[test]
fn the_mean_stress_has_its_components_in_their_places() {
    let imposed = ImposedFlow { gradient: [[0.5, 0.75], [0.25, -0.5]], ..ImposedFlow::NONE };
    let stress = Stress { stresslet: [[6.0, -2.0], [-2.0, -6.0]], area: 4.0, viscosity: 3.0, imposed };
    assert_eq!(stress.of_particles(), [[1.5, -0.5], [-0.5, -1.5]]);
    assert_eq!(stress.mean(), [[4.5, 2.5], [2.5, -4.5]]);
    assert_eq!((stress.effective_viscosity(), stress.normal_difference()), (Some(2.5), 9.0));
    let pure = Stress { imposed: ImposedFlow::extension(0.5), ..stress };
    assert_eq!((pure.mean(), pure.effective_viscosity()), ([[4.5, -0.5], [-0.5, -4.5]], None));
}

/// Minus the symmetric part without trace of the sum of F x, for two points, the first of which is at 0.
#[test]
fn points_have_the_moments_of_their_forces() {
    let mut scene = scene();
    let places = vec![Vec2::ZERO, Vec2::new(0.5, 0.25)];
    scene.add(MarkerBody::new("points", places, |_, forces| {
        forces.copy_from_slice(&[Vec2::new(7.0, 2.0), Vec2::new(-3.0, 1.0)]);
    }));
    let expected = [[0.875, 0.125], [0.125, -0.875]];
    assert_eq!(scene.system_mut().stresslets().unwrap(), [expected]);
    let stress = scene.system_mut().stress().unwrap();
    assert_eq!((stress.stresslet, stress.area, stress.viscosity), (expected, 16.0, 1.5));
}

/// A circle of 32 nodes of radius R that is stretched at the rate c along x, in fluid of half its viscosity: its forces
/// are 7.5 c (x, -y) a node, and the velocity has the moment 4 pi R^2 c times the difference of the viscosities.
#[test]
fn interfaces_between_viscosities_have_the_moment_of_their_velocity() {
    let (radius, rate, count) = (0.8, 0.3, 32);
    let mut scene = scene();
    let circle = (0..count).map(|k| radius * Vec2::from_angle(TAU * f64::from(k) / f64::from(count))).collect();
    let stretched = move |places: &[Vec2], forces: &mut [Vec2]| {
        let force = |place: &Vec2| 7.5 * rate * Vec2::new(place.x, -place.y);
        places.iter().zip(forces).for_each(|(place, out)| *out = force(place));
    };
    let kind = MarkerKind::Interface { viscosity_inside: Some(3.0) };
    scene.add(MarkerBody::new("circle", circle, stretched).with_kind(kind));
    let [[[xx, xy], [yx, yy]]] = scene.system_mut().stresslets().unwrap()[..] else { panic!() };
    let expected = radius * radius * rate * (-7.5 * 0.5 * f64::from(count) + 1.5 * 2.0 * PI);
    assert!((xx - expected).abs() < 1e-13 * expected.abs(), "{xx} {expected}");
    assert!(xy.abs() < 1e-13 * expected.abs() && (yx, yy) == (xy, -xx), "{xy} {yx} {yy}");
}
