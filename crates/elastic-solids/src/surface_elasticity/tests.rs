use std::f64::consts::TAU;

use motile_scene::Body;
use proptest::prelude::*;

use super::*;
use crate::{Mesher, Outline, Solid};

/// A wall of length 3 between y = -1 and 0.
fn wall(spacing: f64) -> TriangleMesh {
    let channel = crate::channel::ChannelShape::Straight { width: 2.0 }.channel(3.0).unwrap();
    channel.lower_wall(-2.0, &Mesher::new(spacing).unwrap()).unwrap()
}

fn moved(mesh: &TriangleMesh, by: impl Fn(Vec2) -> Vec2) -> Vec<Vec2> {
    mesh.points().iter().map(|&s| s + by(s)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn forces_are_minus_the_gradient_of_the_energy(
        waves in prop::array::uniform3(prop::array::uniform2(-0.08..0.08_f64)),
        stretch in 0.7..1.3_f64,
        angle in 0.0..TAU,
    ) {
        let mesh = wall(0.25);
        let surface = SurfaceElasticity::new(&mesh, 3.0, 0.7).unwrap();
        let bend = |s: Vec2| waves.iter().zip(1..).map(|(w, m)| {
            let phase = TAU * f64::from(m) * s.x / 3.0;
            Vec2::new(w[0] * phase.sin(), w[1] * phase.cos() + (stretch - 1.0) * s.y)
        }).sum::<Vec2>();
        let mut points = moved(&mesh, bend);
        let mut forces = vec![Vec2::ZERO; points.len()];
        surface.add_forces(&points, &mut forces);
        let total: Vec2 = forces.iter().sum();
        prop_assert!(total.length() < 1e-12, "{total}");
        let direction = Vec2::from_angle(angle);
        for k in mesh.boundary_loops()[0].points.iter().step_by(3) {
            let there = points[*k];
            let energies = [1e-5, -1e-5].map(|step| {
                points[*k] = there + step * direction;
                surface.energy(&points)
            });
            points[*k] = there;
            let slope = (energies[1] - energies[0]) / 2e-5;
            prop_assert!((slope - forces[*k].dot(direction)).abs() < 1e-6 * (1.0 + slope.abs()), "{k}: {slope}");
        }
    }
}

/// A wave y = a sin(q x) of small amplitude: B/2 INT kappa^2 ds = B a^2 q^4 l/4, of second order in the spacing; a wall
/// that is stretched by a tenth: E_s/2 0.01 l, on both sides. Moved as a whole, and turned, there is none.
#[test]
fn energies_of_waves_and_stretches() {
    let q = TAU / 3.0;
    let spacings = [0.2, 0.1, 0.05];
    let errors = spacings.map(|spacing| {
        let mesh = wall(spacing);
        let bending = SurfaceElasticity::new(&mesh, 0.0, 2.0).unwrap();
        let wave = moved(&mesh, |s| Vec2::new(0.0, if s.y > -0.5 - 1.0 { 1e-4 * (q * s.x).sin() } else { 0.0 }));
        let exact = 2.0 * 1e-8 * q.powi(4) * 3.0 / 4.0;
        assert!(bending.energy(&moved(&mesh, |_| Vec2::new(0.3, -0.1))) < 1e-20);
        (bending.energy(&wave) / exact - 1.0).abs()
    });
    let orders = [0, 1].map(|k| (errors[k] / errors[k + 1]).log2());
    assert!(errors[2] < 2e-3 && orders.iter().all(|order| (1.8..2.3).contains(order)), "{errors:?} {orders:?}");

    let disc = Outline::circle(Vec2::ZERO, 1.0).unwrap().mesh(0.2).unwrap();
    let surface = SurfaceElasticity::new(&disc, 5.0, 2.0).unwrap();
    let length: f64 = surface.sides.iter().map(|side| side.length).sum();
    let grown = moved(&disc, |s| 0.1 * s);
    assert!((surface.energy(&grown) / (0.5 * 5.0 * 0.01 * length) - 1.0).abs() < 1e-12);
    let turned = moved(&disc, |s| Vec2::from_angle(0.7).rotate(s) - s);
    assert!(surface.energy(&turned) < 1e-25);
}

/// A disc with surface elasticity and the same without: forces, energy and what a scene is told.
#[test]
fn solids_with_surface_elasticity() {
    let disc = Outline::circle(Vec2::ZERO, 1.0).unwrap().mesh(0.2).unwrap();
    let bare = Solid::springs(disc, 10.0).unwrap().deformed(|s| 1.1 * s).unwrap();
    let covered = bare.clone().with_surface_elasticity(5.0, 0.1).unwrap();
    let more = covered.elastic_energy().unwrap() - bare.elastic_energy().unwrap();
    assert!((more / (0.5 * 5.0 * 0.01 * TAU) - 1.0).abs() < 0.006, "{more}");
    assert_ne!(bare.properties(), covered.properties());
    for moduli in [[-1.0, 0.0], [0.0, f64::NAN]] {
        assert!(bare.clone().with_surface_elasticity(moduli[0], moduli[1]).is_err());
    }
}

/// Waves of two sides relax at the rate of the forces that they have, by `1/(4 eta q)`: along and across the surface.
#[test]
fn stiffness_is_that_of_the_shortest_waves() {
    let mesh = wall(0.1);
    for moduli in [[5.0, 0.0], [0.0, 2.0], [5.0, 2.0]] {
        let surface = SurfaceElasticity::new(&mesh, moduli[0], moduli[1]).unwrap();
        let (amplitude, length) = (1e-6, surface.sides[0].length);
        let rates = [Vec2::X, Vec2::Y].map(|direction| {
            let mut positions = mesh.points().to_vec();
            let points = &mesh.boundary_loops()[0].points;
            for (k, &point) in points.iter().enumerate() {
                positions[point] += if k % 2 == 0 { amplitude } else { -amplitude } * direction;
            }
            let mut forces = vec![Vec2::ZERO; positions.len()];
            surface.add_forces(&positions, &mut forces);
            // Far from the ends of an odd number of sides.
            -forces[points[8]].dot(direction) / length / amplitude / (2.0 * TAU / length)
        });
        let sum: f64 = rates.iter().sum();
        assert!((surface.stiffness() / sum - 1.0).abs() < 1e-5, "{moduli:?}: {} {rates:?}", surface.stiffness());
        let solid = Solid::springs(mesh.clone(), 1e-3).unwrap().with_surface_elasticity(moduli[0], moduli[1]).unwrap();
        let view = crate::solid::tests::fluid_view();
        let rate = 2.0 / crate::solid::tests::limit(&solid, &view) * view.viscosity;
        assert!((rate / sum - 1.0).abs() < 2e-4, "{moduli:?}: {rate} {sum}");
    }
}
