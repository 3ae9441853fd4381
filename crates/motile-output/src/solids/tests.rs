use super::*;
use motile::elastic_solids::ChannelShape;
use motile::prelude::*;
use motile::setup::{Material, SolidSetup};

#[test]
fn walls_of_a_channel() {
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 5.4, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod { spacing: 0.1, ..LayersMethod::default() }),
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear: 100.0 }),
        ..Setup::default()
    };
    let mut scene = setup.build().unwrap().scene;
    let thickness = 1.5;
    let system = scene.system();
    let area = |ring: &[Vec2]| {
        let next = ring.iter().cycle().skip(1);
        0.5 * ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
    };
    for solid in solids(system) {
        let shape = solid_shape(solid);
        assert_eq!((shape.area.len(), shape.edges.len()), (1, 2));
        let triangles: f64 = shape.triangles.iter().map(|corners| area(corners)).sum();
        assert!((triangles - 4.0 * thickness).abs() < 1e-9, "{triangles}");
        assert!(shape.stress.iter().chain(&shape.displacement).all(|v| v.abs() < 1e-9));
        assert!((area(&shape.area[0]) - 4.0 * thickness).abs() < 1e-9, "{}", area(&shape.area[0]));
        // One line begins within half a period of the other one's end, wherever the wall is.
        let ends = shape.area[0].iter().fold([f64::INFINITY, -f64::INFINITY], |[a, b], at| [a.min(at.x), b.max(at.x)]);
        assert!(ends[1] - ends[0] < 1.5 * 4.0 + 1e-9, "{ends:?}");
        let shift = Vec2::new(2.0, 0.0);
        let moved = Solid::springs(solid.mesh().clone(), 1.0).unwrap().deformed(|place| place + shift).unwrap();
        let pairs = solid_shape(&moved).area.concat().into_iter().zip(&shape.area[0]);
        assert!(pairs.clone().count() == shape.area[0].len());
        pairs.for_each(|(to, from)| assert!((to - *from - shift).length() < 1e-12, "{from:?} to {to:?}"));
    }
    let mut meter = SolidMeter::of(system).unwrap();
    let measured = meter.measure(system).unwrap();
    let value = |name: &str| measured[SolidMeter::NAMES.iter().position(|known| *known == name).unwrap()];
    assert!((value("channel_width_min") - 2.4).abs() < 1e-12 && (value("channel_width_max") - 2.4).abs() < 1e-12);
    assert!((value("droplet_gap") - 0.2).abs() < 5e-3 && value("elastic_energy") < 1e-18);
    assert!((value("smallest_jacobian") - 1.0).abs() < 1e-12);
    // The droplet presses on them: of both walls the largest displacements count.
    scene.run(0.2).go().unwrap();
    let system = scene.system();
    let measured = meter.measure(system).unwrap();
    let value = |name: &str| measured[SolidMeter::NAMES.iter().position(|known| *known == name).unwrap()];
    let largest =
        |of: fn(&Deformation) -> f64| solids(system).map(|solid| of(&Deformation::of(solid))).fold(0.0, f64::max);
    assert!(value("largest_normal_displacement") > 1e-4);
    assert_eq!(value("largest_normal_displacement"), largest(|seen| seen.largest_normal_displacement));
    assert_eq!(value("largest_displacement"), largest(|seen| seen.largest_displacement));
}

/// A solid that is moved as a whole has that displacement everywhere.
#[test]
fn displacements_are_those_of_the_triangles() {
    let disc = motile::elastic_solids::Outline::circle(Vec2::ZERO, 1.0).unwrap().mesh(0.3).unwrap();
    let moved = Solid::springs(disc, 1.0).unwrap().deformed(|s| s + Vec2::new(0.3, -0.4)).unwrap();
    assert!(solid_shape(&moved).displacement.iter().all(|length| (length - 0.5).abs() < 1e-12));
}

/// Of several solids the smallest Jacobian counts, wherever it is in the list, and all energies together.
#[test]
fn the_smallest_jacobian_is_that_of_all_solids() {
    let disc = |x: f64, stretch: f64| {
        let outline = motile::elastic_solids::Outline::circle(Vec2::new(x, 0.0), 0.5).unwrap();
        let solid = Solid::springs(outline.mesh(0.25).unwrap(), 10.0).unwrap();
        solid.deformed(|s| Vec2::new(x + stretch * (s.x - x), s.y)).unwrap()
    };
    for stretches in [[0.8, 1.1], [1.1, 0.8]] {
        let mut scene = Scene::new(motile::scene::Substrate::new(1.0).unwrap());
        let energies = stretches.iter().zip([-1.0, 1.0]).map(|(stretch, x)| {
            let solid = disc(x, *stretch);
            let energy = solid.elastic_energy().unwrap();
            scene.add(solid);
            energy
        });
        let energy: f64 = energies.sum();
        let measured = SolidMeter::of(scene.system()).unwrap().measure(scene.system()).unwrap();
        let value = |name: &str| measured[SolidMeter::NAMES.iter().position(|known| *known == name).unwrap()];
        assert!((value("smallest_jacobian") - 0.8).abs() < 1e-12, "{measured:?}");
        assert!(energy > 0.1 && (value("elastic_energy") / energy - 1.0).abs() < 1e-12, "{measured:?}");
    }
}

/// Rigid walls reach to the straight walls behind them, on the side away from the fluid, which is on their right.
#[test]
fn rigid_walls_reach_away_from_the_fluid() {
    let straight = Some([-3.0, 3.0]);
    for (way, height, thickness) in [(-1.0, -1.0, 2.0), (1.0, 2.0, 1.0)] {
        let mut boundary = Boundary::default();
        let at = |k: i32| Vec2::new(way * 0.5 * f64::from(k), height);
        (-4..4).for_each(|k| boundary.push(at(k), at(k + 1)));
        boundary.sort();
        let shape = rigid_shape(&boundary, straight);
        let ring = &shape.area[0];
        let next = ring.iter().cycle().skip(1);
        let area = 0.5 * ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>();
        assert!((area.abs() - 4.0 * thickness).abs() < 1e-12, "{way}: {ring:?}");
        assert_eq!(shape.edges[0].len(), 9);
    }
}
