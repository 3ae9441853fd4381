//! Droplets of revolution in runs.

use std::f64::consts::PI;

use motile::prelude::*;
use motile::setup::{Exclusion, RigidBodySetup};

fn scene(region: Region, [nodes, cells]: [usize; 2]) -> Setup {
    let mut setup = Setup {
        region,
        method: Method::Integral(IntegralMethod { nodes, cells }),
        droplets: vec![DropletSetup::active(-1.0)],
        ..Setup::default()
    };
    if let Some(particles) = &mut setup.droplets[0].particles {
        particles.excluded_volume = Exclusion::Step(2.0);
    }
    setup
}

/// Speed, aspect ratio and largest concentration of the steady swimmer (`axisymmetric.csv`), particles and volume kept.
#[test]
fn a_droplet_in_space_swims_to_the_steady_state_of_the_reference() {
    let Built { mut scene, droplets, .. } = scene(Region::Space, [48, 192]).build().unwrap();
    let before = scene.observe(droplets[0]).unwrap();
    scene.run(30.0).go().unwrap();
    let seen = scene.observe(droplets[0]).unwrap();
    let values = [seen.speed(), seen.aspect_ratio_moments, seen.concentration_range.unwrap()[0] / 100.0];
    for ((value, exact), limit) in values.into_iter().zip([0.126_082_1, 0.957_860, 2.753_94]).zip([3e-3, 6e-3, 2e-3]) {
        assert!((value / exact - 1.0_f64).abs() < limit, "{values:?}");
    }
    assert!((seen.particle_number / before.particle_number - 1.0).abs() < 1e-12);
    assert!((before.particle_number / (400.0 * PI) - 1.0).abs() < 2e-4);
    assert!((seen.area / before.area - 1.0).abs() < 1e-4, "volume {} of {}", seen.area, before.area);
    assert!(seen.moments.stresslet()[0][0] > 0.0 && seen.squirmer.beta().unwrap() < 0.0, "a pusher");
}

/// A tube slows a droplet down, the more the tighter it is.
#[test]
fn droplets_in_tubes_are_slower() {
    let speeds = [None, Some(2.0), Some(1.4)].map(|radius| {
        let region = radius.map_or(Region::Space, Region::tube);
        let Built { mut scene, droplets, .. } = scene(region, [32, 128]).build().unwrap();
        scene.run(2.0).go().unwrap();
        scene.observe(droplets[0]).unwrap().speed()
    });
    assert!(speeds[1] < 0.9 * speeds[0] && speeds[2] < 0.9 * speeds[1] && speeds[2] > 0.0, "{speeds:?}");
}

#[test]
fn what_has_no_meaning_in_three_dimensions_is_refused() {
    let setup = scene(Region::Space, [48, 192]);
    let refused = |change: &dyn Fn(&mut Setup), words: &str| {
        let mut setup = setup.clone();
        change(&mut setup);
        let error = setup.check().unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&|setup| setup.droplets[0].centre = [0.0, 0.3], "on the x axis");
    refused(&|setup| setup.droplets[0].angle = 1.0, "along the x axis");
    refused(&|setup| setup.method = Method::Grid(GridMethod::default()), "no grid");
    refused(&|setup| setup.rigid_bodies.push(RigidBodySetup::disc(0.3)), "two dimensions");
    refused(&|setup| setup.region = Region::tube(-1.0), "region.tube.radius");
    assert!(scene(Region::tube(0.9), [48, 192]).build().is_err());
}
