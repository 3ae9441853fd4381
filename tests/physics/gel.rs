//! Gels inside droplets: a droplet that swims by its gel alone, defects, relaxation.

use std::f64::consts::FRAC_PI_2;

use motile::active_interface::polygon_moments;
use motile::elastic_solids::ChannelShape;
use motile::interior::{Anchoring, DirectorStart, GelInDroplet, GelMaterial, GelObservables};
use motile::prelude::*;
use motile::setup::{AnyFlow, DropletShape, GelSetup, Material, SolidSetup};

/// A passive droplet of tension 200 with a gel, on a coarse grid.
fn filled(gel: GelSetup) -> Setup {
    Setup {
        method: Method::Grid(GridMethod::of_spacing(0.15)),
        droplets: vec![DropletSetup { gel: Some(gel), ..DropletSetup::passive(200.0) }],
        ..Setup::default()
    }
}

fn seen(scene: &mut Scene<AnyFlow>) -> GelObservables {
    let (gel, _) = scene.system().bodies::<GelInDroplet>().next().expect("a gel");
    scene.observe(gel).expect("a good state")
}

/// The passive droplet has nothing else that could move it, and a grid that is turned with it changes nothing.
#[test]
fn a_droplet_swims_by_its_gel_alone_in_any_direction() {
    let material = GelMaterial { frank: 2.0, alignment: 0.5, activity: -200.0, ..GelMaterial::default() };
    let start = DirectorStart::Uniform { angle: 0.0, noise: 0.5, seed: 1 };
    let mut setup = filled(GelSetup { material, start, ..GelSetup::default() });
    let velocities = [0.0, FRAC_PI_2].map(|angle| {
        setup.droplets[0].angle = angle;
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(70.0).go().unwrap();
        let velocity = scene.observe(droplets[0]).unwrap().velocity;
        assert!((velocity.length() - 0.0514).abs() < 5e-4, "{velocity}");
        velocity
    });
    assert!(velocities[0].perp().distance(velocities[1]) < 1e-8 * velocities[0].length(), "{velocities:?}");
}

/// By Poincare and Hopf, whatever happens inside.
#[test]
fn charges_within_an_anchored_interface_add_up_to_one() {
    for (anchoring, activity) in [(Anchoring::Homeotropic, 0.0), (Anchoring::Planar, -50.0)] {
        let material = GelMaterial { activity, ..GelMaterial::default() };
        let start = DirectorStart::Random { seed: 3 };
        let mut scene = filled(GelSetup { material, anchoring, start, spacing: None }).build().unwrap().scene;
        let mut numbers = Vec::new();
        for end in [0.0, 0.02, 0.1, 1.0, 8.0] {
            if end > 0.0 {
                scene.run(end).go().unwrap();
            }
            let defects = seen(&mut scene).defects;
            assert_eq!(defects.iter().map(|defect| defect.charge).sum::<i32>(), 1, "at {end}");
            numbers.push(defects.len());
        }
        assert!(numbers[0] > 10 && numbers[4] <= 3, "{numbers:?}");
    }
}

/// Frank energy and that of the interface together, in fluids of any viscosity.
#[test]
fn without_activity_energy_only_falls() {
    for viscosity in [None, Some(1000.0), Some(20.0)] {
        let material = GelMaterial { activity: 0.0, ..GelMaterial::default() };
        let start = DirectorStart::Random { seed: 5 };
        let mut setup = filled(GelSetup { material, anchoring: Anchoring::Free, start, spacing: None });
        setup.droplets[0].viscosity = viscosity;
        if viscosity.is_some() {
            setup.method = Method::Layers(LayersMethod { nodes: 48, elements: 96, ..LayersMethod::of_spacing(0.15) });
        }
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let mut last = f64::INFINITY;
        for end in [0.02, 0.05, 0.1, 0.3, 1.0, 3.0] {
            scene.run(end).go().unwrap();
            let perimeter = scene.observe(droplets[0]).unwrap().perimeter;
            let energy = seen(&mut scene).director_energy + 200.0 * perimeter;
            assert!(energy < last, "{viscosity:?}: {energy} at {end} after {last}");
            last = energy;
        }
    }
}

/// Deviations `[(xx - yy)/2, xy]` of the area moments of a droplet over half their sum.
fn deformation(markers: &[Vec2]) -> [f64; 2] {
    let moments = polygon_moments(markers).expect("an area");
    let sum = moments.xx + moments.yy;
    [(moments.xx - moments.yy) / sum, 2.0 * moments.xy / sum]
}

/// An ellipse of a viscosity that its contractile gel deforms until t = 0.5.
fn deformed(method: Method, viscosity: f64) -> [f64; 2] {
    let material = GelMaterial { frank: 2.0, alignment: 0.5, activity: -200.0, ..GelMaterial::default() };
    let start = DirectorStart::Uniform { angle: 0.3, noise: 0.0, seed: 1 };
    let mut setup = filled(GelSetup { material, start, spacing: Some(0.1), ..GelSetup::default() });
    setup.droplets[0].shape = DropletShape::Ellipse { half_axes: [1.15, 1.0 / 1.15] };
    setup.droplets[0].viscosity = Some(viscosity);
    let Built { mut scene, droplets, .. } = Setup { method, ..setup }.build().expect("a scene");
    scene.run(0.5).step_size(StepSize::Fixed(0.02)).go().expect("a scene");
    deformation(scene.body(droplets[0]).expect("a scene").markers())
}

/// Beside interfaces that are layers the error of the grid is of second order at any ratio of viscosities, and for
/// equal ones the limit is that of the grid alone.
#[test]
fn gels_among_layers_converge() {
    let layers =
        |spacing: f64| Method::Layers(LayersMethod { nodes: 64, elements: 128, ..LayersMethod::of_spacing(spacing) });
    for viscosity in [20.0, 100.0, 1000.0] {
        let all = [0.2, 0.1, 0.05].map(|spacing| deformed(layers(spacing), viscosity));
        let change = |k: usize| (all[k][0] - all[k + 1][0]).hypot(all[k][1] - all[k + 1][1]);
        let [coarse, fine] = [change(0), change(1)];
        println!("{viscosity}: {all:?}, {coarse:.1e} {fine:.1e}");
        assert!(fine < 5e-4 && coarse / fine > 2.6, "{viscosity}: {all:?}");
        if viscosity == 100.0 {
            let alone = deformed(Method::Grid(GridMethod::of_spacing(0.05)), viscosity);
            let apart = (alone[0] - all[2][0]).hypot(alone[1] - all[2][1]);
            assert!(apart < 2e-4, "{alone:?} {all:?}");
        }
    }
}

/// Between layers the shape depends little on the grid; walls on the grid stand in front of where they are.
#[test]
fn gels_between_elastic_walls() {
    let material = GelMaterial { frank: 2.0, alignment: 0.5, activity: -200.0, ..GelMaterial::default() };
    let start = DirectorStart::Uniform { angle: 0.3, noise: 0.0, seed: 1 };
    let mut setup = filled(GelSetup { material, start, spacing: Some(0.1), ..GelSetup::default() });
    setup.region = Region::Channel { length: 6.0, width: 4.5, drive: Drive::ZeroGradient };
    let springs = Material::Springs { shear: 5000.0 };
    let mut run = |method: Method| {
        setup.method = method;
        setup.solids = SolidSetup::walls(&ChannelShape::Straight { width: 3.0 }, &springs);
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(1.0).go().expect("a run");
        deformation(scene.body(droplets[0]).unwrap().markers())
    };
    let layers = [0.15, 0.1].map(|spacing| run(Method::Layers(LayersMethod::of_spacing(spacing))));
    let plain = [0.15, 0.1].map(|spacing| run(Method::Grid(GridMethod::uncorrected(spacing))));
    let apart = |one: [f64; 2], other: [f64; 2]| (one[0] - other[0]).hypot(one[1] - other[1]);
    println!("{layers:?} {plain:?}");
    assert!(apart(layers[0], layers[1]) < 1e-3, "{layers:?}");
    assert!(apart(plain[1], layers[1]) < 0.7 * apart(plain[0], layers[1]), "{layers:?} {plain:?}");
}

/// The droplet and what fills it together have neither resultant nor torque.
#[test]
fn forces_of_the_gel_are_among_the_moments() {
    let material = GelMaterial { frank: 2.0, alignment: 0.5, activity: -200.0, ..GelMaterial::default() };
    let start = DirectorStart::Uniform { angle: 0.2, noise: 0.1, seed: 1 };
    for viscosity in [None, Some(1000.0)] {
        let mut setup = filled(GelSetup { material, start, ..GelSetup::default() });
        setup.droplets[0].viscosity = viscosity;
        if viscosity.is_some() {
            setup.method = Method::Layers(LayersMethod { nodes: 48, elements: 96, ..LayersMethod::of_spacing(0.15) });
        }
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(0.2).go().unwrap();
        let moments = scene.observe(droplets[0]).unwrap().moments;
        let [[xx, xy], [yx, yy]] = moments.dipole;
        let size = xx.abs().max(yy.abs());
        assert!(moments.force.iter().all(|force| force.abs() < 1e-10 * size), "{moments:?}");
        assert!((xy - yx).abs() < 1e-10 * size, "{moments:?}");
    }
}
