//! Gels inside droplets: a droplet that swims by its gel alone, defects, relaxation.

use std::f64::consts::FRAC_PI_2;

use motile::interior_fields::{Anchoring, DirectorStart, GelInDroplet, GelMaterial, GelObservables};
use motile::prelude::*;

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
    assert!(velocities[0].perp().distance(velocities[1]) < 1e-3 * velocities[0].length(), "{velocities:?}");
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

/// With layers the aspect ratio of such a droplet, .91 on the plain grid, was .89 and 1.01 at two spacings.
#[test]
fn gels_between_elastic_walls_need_plain_surfaces() {
    let material = GelMaterial { frank: 2.0, alignment: 0.5, activity: -200.0, ..GelMaterial::default() };
    let start = DirectorStart::Uniform { angle: 0.3, noise: 0.0, seed: 1 };
    let mut setup = filled(GelSetup { material, start, ..GelSetup::default() });
    setup.region = Region::Channel { length: 6.0, width: 4.5, drive: Drive::ZeroGradient };
    let springs = Material::Springs { shear: 5000.0 };
    let mut run = |spacing: f64, surface: Surface| {
        setup.method = Method::Grid(GridMethod::of_spacing(spacing));
        setup.solids = SolidSetup::walls(&ChannelShape::Straight { width: 3.0 }, &springs);
        setup.solids.iter_mut().for_each(|wall| wall.surface = surface);
        let Built { mut scene, droplets, .. } = setup.build()?;
        scene.run(1.0).go().expect("a run");
        Ok::<_, SetupError>(scene.observe(droplets[0]).expect("a good state").aspect_ratio_moments)
    };
    let refused = run(0.15, Surface::Layer).unwrap_err().to_string();
    assert!(refused.contains("droplets[0].gel") && refused.contains("plain surfaces"), "{refused}");
    let [coarse, fine] = [0.15, 0.1].map(|spacing| run(spacing, Surface::Plain).unwrap());
    assert!((coarse - fine).abs() < 0.025 && (fine - 0.908).abs() < 0.01, "{coarse} {fine}");
}

/// The droplet and what fills it together have neither resultant nor torque.
#[test]
fn forces_of_the_gel_are_among_the_moments() {
    let material = GelMaterial { frank: 2.0, alignment: 0.5, activity: -200.0, ..GelMaterial::default() };
    let start = DirectorStart::Uniform { angle: 0.2, noise: 0.1, seed: 1 };
    for viscosity in [None, Some(1000.0)] {
        let mut setup = filled(GelSetup { material, start, ..GelSetup::default() });
        setup.droplets[0].viscosity = viscosity;
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(0.2).go().unwrap();
        let moments = scene.observe(droplets[0]).unwrap().moments;
        let [[xx, xy], [yx, yy]] = moments.dipole;
        let size = xx.abs().max(yy.abs());
        assert!(moments.force.iter().all(|force| force.abs() < 1e-10 * size), "{moments:?}");
        assert!((xy - yx).abs() < 1e-10 * size, "{moments:?}");
    }
}
